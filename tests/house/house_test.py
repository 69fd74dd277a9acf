#!/usr/bin/env python3
"""The house keeps its rules, and each rule sees a breach that is made on purpose."""
import glob
import os
import sys
import tempfile
import unittest

import rosunit

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import rules  # noqa: E402

TOP = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..'))
CORE = ['anthrob_core', 'anthrob_ecu', 'anthrob_supervisor', 'anthrob_recording_core', 'anthrob_sim_core', 'anthrob_driver_core',
        'anthrob_emulation', 'anthrob_emulator_core', 'anthrob_mocap_core', 'anthrob_control_core', 'anthrob_recorder_core',
        'anthrob_calib_core', 'anthrob_discovery_core', 'anthrob_reference', 'anthrob_rviz_core', 'anthrob_virtual_robot']


class House(unittest.TestCase):

    def expect_kept(self, breaches):
        self.assertEqual(breaches, [], '\n' + '\n'.join(breaches))

    def test_doors(self):
        self.expect_kept(rules.doors(TOP))

    def test_the_map_names_doors_and_folders_that_exist(self):
        self.expect_kept(rules.doors_in_documents(TOP))
        self.expect_kept(rules.folders_in_documents(TOP))

    def test_core_sources_are_free_of_ros(self):
        self.expect_kept(rules.ros_in_sources(TOP))

    def test_core_libraries_are_free_of_ros(self):
        libraries = [os.path.join(folder, 'lib%s.so' % name) for name in CORE
                     for folder in os.environ.get('LD_LIBRARY_PATH', '').split(':')
                     if os.path.isfile(os.path.join(folder, 'lib%s.so' % name))]
        self.assertEqual(len({os.path.basename(library) for library in libraries}), len(CORE), libraries)
        for library in libraries:
            self.expect_kept(rules.ros_in_library(library))

    def test_folders_point_one_way(self):
        self.expect_kept(rules.folders(TOP))

    def test_stages_of_discovery_return_values(self):
        self.expect_kept(rules.filled_in(TOP))

    def test_numbers_that_decide_stand_in_options(self):
        self.expect_kept(rules.scattered_numbers(TOP))

    def test_what_is_missing_is_a_type(self):
        self.expect_kept(rules.answers(TOP))

    def test_packages_name_what_they_include(self):
        self.expect_kept(rules.packages_point_one_way(TOP))


class Breaches(unittest.TestCase):
    """A workspace of two packages, each test with one breach."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.write('src/anthrob_low/package.xml', '<package></package>')
        self.write('src/anthrob_high/package.xml', '<package><depend>anthrob_low</depend></package>')
        self.write('src/anthrob_low/include/anthrob_low/door.h', '#include "anthrob_low/beside.h"\n')
        self.write('src/anthrob_low/include/anthrob_low/beside.h', '')
        self.write('src/anthrob_low/src/first/door.cpp', '#include "anthrob_low/door.h"\n')
        self.write('src/anthrob_low/src/second/user.cpp', '#include "anthrob_low/door.h"\n#include "first/own.h"\n')
        self.write('src/anthrob_low/src/first/own.h', '')
        self.write('src/anthrob_high/src/high.cpp', '#include "anthrob_low/door.h"\n')
        self.write('tests/house/folders.yaml', 'anthrob_low: [., first, second]\nanthrob_high: [.]\n')

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)

    def expect(self, breaches, *ends):
        self.assertEqual([b[len(self.folder.name) + 1:].split(': ')[0] for b in breaches], list(ends), breaches)

    def test_a_sound_workspace_has_none(self):
        for rule in (rules.doors, rules.ros_in_sources, rules.folders, rules.packages_point_one_way):
            self.assertEqual(rule(self.folder.name), [])

    def test_a_private_header_in_include(self):
        self.write('src/anthrob_low/include/anthrob_low/private.h', '')
        self.write('src/anthrob_low/src/first/more.cpp', '#include "anthrob_low/private.h"\n')
        self.expect(rules.doors(self.folder.name), 'src/anthrob_low/include/anthrob_low/private.h:1')

    def test_a_door_that_is_only_told(self):
        self.write('map.md', '## Doors\n| package | include | for |\n| `anthrob_low` | `door.h`, `none.h` | all |\n## End\n')
        self.expect(rules.doors_in_documents(self.folder.name, 'map.md'), 'map.md:3')

    def test_a_folder_that_is_not_on_the_map(self):
        self.write('map.md', 'Of low: `first/`\n')
        self.expect(rules.folders_in_documents(self.folder.name, 'map.md'), 'map.md:1')

    def test_ros_in_a_core_source(self):
        self.write('src/anthrob_low/src/first/own.h', '#pragma once\n#include <ros/ros.h>\n')
        self.write('src/anthrob_low/src/ros/bridge.cpp', '#include <ros/ros.h>\n')
        self.expect(rules.ros_in_sources(self.folder.name), 'src/anthrob_low/src/first/own.h:2')

    def test_ros_in_a_core_library(self):
        library = glob.glob('/usr/lib/*/librosconsole.so')[0]  # needs other libraries of ROS
        self.assertNotEqual(rules.ros_in_library(library), [])

    def test_an_include_upwards(self):
        self.write('src/anthrob_low/src/second/late.h', '')
        self.write('src/anthrob_low/src/first/own.h', '#pragma once\n\n#include "second/late.h"\n')
        self.expect(rules.folders(self.folder.name), 'src/anthrob_low/src/first/own.h:3')

    def test_a_folder_without_a_place(self):
        self.write('src/anthrob_low/src/third/new.h', '')
        self.expect(rules.folders(self.folder.name), 'src/anthrob_low/src/third/new.h:1')

    def test_a_package_that_is_not_named(self):
        self.write('src/anthrob_low/src/first/own.h', '#include "anthrob_high/door.h"\n')
        self.expect(rules.packages_point_one_way(self.folder.name), 'src/anthrob_low/src/first/own.h:1')

    def test_a_result_that_is_filled_in(self):
        self.write('src/anthrob_discovery/src/a.h', 'void judge(const Answer& old, Answer& answer);\nvoid see(const Answer& a);\n')
        self.expect(rules.filled_in(self.folder.name), 'src/anthrob_discovery/src/a.h:1')

    def test_a_number_beside_the_code(self):
        self.write('src/anthrob_discovery/src/options/fit.h', 'constexpr double kHome = 3.0;\n')
        self.write('src/anthrob_discovery/src/a.cpp', '\nconstexpr double kOwn = 2.0;\n')
        self.expect(rules.scattered_numbers(self.folder.name), 'src/anthrob_discovery/src/a.cpp:2')

    def test_an_empty_text_or_a_number_that_means_none(self):
        self.write('src/anthrob_low/include/anthrob_low/door.h', '#pragma once\ninline double size() { return -1.0; }\n')
        self.write('src/anthrob_low/src/first/door.cpp', 'if (sound) return "";\nreturn "no " + name;\nreturn -1;\nreturn -12;\n')
        self.expect(rules.answers(self.folder.name, ['anthrob_low']), 'src/anthrob_low/include/anthrob_low/door.h:2',
                    'src/anthrob_low/src/first/door.cpp:1', 'src/anthrob_low/src/first/door.cpp:3')

    def test_an_answer_that_stays_does_so_in_its_place_only(self):
        name, line, _ = rules.ALLOWED_ANSWERS[0]
        self.write('src/' + name, line + '\nif (other) return "";\n')
        self.expect(rules.answers(self.folder.name, [name.split('/')[0]]), 'src/' + name + ':2')


if __name__ == '__main__':
    rosunit.unitrun('anthrob_tests', 'house', 'house_test')
