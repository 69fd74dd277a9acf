#!/usr/bin/env python3
"""What ./catkin_ws.sh does on other systems and beside another ROS. Commands that it would run are functions here, which a
shell takes before programs: nothing is installed."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import rostest
import yaml

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
UBUNTU = 'PRETTY_NAME="Ubuntu 20.04.6 LTS"\nVERSION_CODENAME=focal'
DEBIAN = 'PRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\nVERSION_CODENAME=bookworm'
NOTHING = {'dpkg-query': 'false'}
ALL = {'dpkg-query': 'shift 3; printf "%s installed\\n" "$@"'}
# Whether as root or through sudo: says what it was asked for, and fails.
FAKES = {'apt-get': 'echo asked: apt-get "$@"; false', 'sudo': 'echo asked: "$@"; false'}


def run(command, functions, script=os.path.join(TOP, 'catkin_ws.sh'), **environment):
    """Status and all that ./catkin_ws.sh said. @param command with its arguments, if it has some"""
    names = {'BASH_FUNC_%s%%%%' % name: '() { %s; }' % body for name, body in {**FAKES, **functions}.items()}
    done = subprocess.run(['bash', script, *([command] if isinstance(command, str) else command)], env={**os.environ, **names, **environment},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=50)
    return done.returncode, done.stdout


def system(release):
    return {'cat': "printf '%%s\\n' '%s'" % release}


class WorkspaceScript(unittest.TestCase):
    def test_installs_nothing_on_another_system(self):
        status, said = run('deps', {**NOTHING, **system(UBUNTU)})
        self.assertEqual(status, 1)
        self.assertEqual(said, 'catkin_ws.sh: needed packages are missing; only Debian 12 (bookworm) has them, and this '
                               'is Ubuntu 20.04.6 LTS: use a container of debian:12 (README, On another system)\n')

    def test_says_so_where_no_system_tells_its_name(self):
        status, said = run('deps', {**NOTHING, 'cat': 'false'})
        self.assertEqual(status, 1)
        self.assertIn('this is another system: use', said)

    def test_installs_on_debian_12(self):
        status, said = run('deps', {**NOTHING, **system(DEBIAN)})
        self.assertEqual(status, 1)
        self.assertIn('asked: apt-get update', said)
        self.assertIn('apt-get update failed', said)

    def test_asks_for_no_system_where_all_is_there(self):
        self.assertEqual(run('deps', {**ALL, **system(UBUNTU)}), (0, ''))

    def test_installs_what_is_not_there(self):
        some = ALL['dpkg-query'].replace('"$@"', '"${@:2}"')
        status, said = run('deps', {'dpkg-query': some, **system(DEBIAN), 'apt-get': 'echo asked: "$@"', 'env': 'echo asked: "$@"'})
        self.assertIn('--no-install-recommends catkin\n', said)

    def test_refuses_pictures_of_another_form(self):
        for command, expected in ((('picture',), 'expected OUT.png'), (('picture', 'arm.jpg', 'rest'), 'expected OUT.png'),
                                  (('movie', 'arm.png'), 'expected OUT.mp4 or OUT.gif')):
            status, said = run(command, {})
            self.assertEqual(status, 2)
            self.assertIn(expected, said)

    def test_pictures_show_the_robot_only(self):
        for robot, distance in ('anthrob', 0.95), ('two_muscle_rig', 1.15):
            shown = yaml.safe_load(subprocess.check_output([os.path.join(TOP, 'scripts', 'picture_view.py'), robot]))
            manager, window = shown['Visualization Manager'], shown['Window Geometry']
            self.assertEqual((shown['Panels'], window), ([], {'Height': 900, 'Width': 1280}))
            self.assertEqual(manager['Global Options']['Background Color'], '246; 247; 249')
            self.assertEqual(manager['Views']['Current']['Distance'], distance)
            frames, = [one for one in manager['Displays'] if one['Class'] == 'rviz/TF']
            self.assertFalse(frames['Show Names'] or frames['Show Axes'])

    def environment_with(self, distribution):
        """What a command of the script sees of variables that a ROS of /elsewhere has set."""
        names = ('CMAKE_PREFIX_PATH', 'LD_LIBRARY_PATH', 'PKG_CONFIG_PATH', 'ROS_PACKAGE_PATH')
        status, said = run('help', {'cat': 'env'}, ROS_DISTRO=distribution, ROS_MASTER_URI='http://there:11311',
                           **dict.fromkeys(names, '/elsewhere'))
        self.assertEqual(status, 0)
        self.assertIn('ROS_MASTER_URI=http://there:11311\n', said)
        return said, [name for name in names if name + '=/elsewhere\n' in said], names

    def test_forgets_another_ros(self):
        said, left, _ = self.environment_with('noetic')
        self.assertEqual(left, [])
        self.assertNotIn('ROS_DISTRO=', said)

    def test_keeps_overlays(self):
        _, left, names = self.environment_with('Debian')
        self.assertEqual(left, list(names))


class Rebuilding(unittest.TestCase):
    """What is built before a command that needs the workspace, in one whose catkin_make only makes a setup file and a program."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(os.path.join(TOP, 'catkin_ws.sh'), self.folder)
        self.write('src/arm/arm.cpp', '1')
        self.write('src/arm/CMakeLists.txt', 'one')
        self.write('config/arm/model_I.yaml', 'one')
        os.makedirs(self.path('src/anthrob_bringup'))
        os.symlink('../../config', self.path('src/anthrob_bringup/config'))
        self.write('scripts/study/nothing.py', '#!/bin/sh\n')
        os.chmod(self.path('scripts/study/nothing.py'), 0o755)
        self.catkin_make = 'mkdir -p devel; : >devel/setup.bash; echo program >devel/program'

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), 'w') as file:
            file.write(text)

    def builds(self, **environment):
        """Whether a study builds first."""
        status, said = run(('study', 'nothing'), {**ALL, 'catkin_make': self.catkin_make},
                           script=self.path('catkin_ws.sh'), **environment)
        self.assertEqual(status, 0, said)
        return 'building' in said

    def test_only_what_changed(self):
        self.assertTrue(self.builds())
        self.assertFalse(self.builds())
        for change in (lambda: self.write('src/arm/arm.cpp', '2'),
                       lambda: os.utime(self.path('src/arm/arm.cpp'), (1e9, 1e9)),
                       lambda: self.write('src/arm/hand.h', ''),
                       lambda: os.rename(self.path('src/arm/hand.h'), self.path('src/arm/fist.h')),
                       lambda: os.remove(self.path('src/arm/fist.h')),
                       lambda: self.write('src/arm/CMakeLists.txt', 'two'),
                       lambda: os.utime(self.path('catkin_ws.sh')),
                       lambda: os.remove(self.path('devel/program')),
                       lambda: os.remove(self.path('devel/setup.bash')),
                       lambda: shutil.rmtree(self.path('build'))):
            change()
            self.assertTrue(self.builds())
        self.assertFalse(self.builds())
        other = 'OFF' if os.environ.get('ANTHROB_WERROR') == 'ON' else 'ON'
        self.assertTrue(self.builds(ANTHROB_WERROR=other))

    def test_not_for_what_is_read_where_it_is(self):
        self.builds()
        self.write('config/arm/model_I.yaml', 'two')
        self.write('src/arm/__pycache__/arm.pyc', '')
        self.assertFalse(self.builds())

    def test_again_after_a_build_that_failed_or_was_overtaken(self):
        self.builds()
        self.write('src/arm/arm.cpp', '3')
        making, self.catkin_make = self.catkin_make, 'false'
        with self.assertRaises(AssertionError):
            self.builds()
        self.catkin_make = making + '; echo 4 >src/arm/arm.cpp'
        self.assertTrue(self.builds())
        self.catkin_make = making
        self.assertTrue(self.builds())
        self.assertFalse(self.builds())

    def test_that_the_simulator_says_what_to_try(self):
        self.write('bin/roslaunch', '#!/bin/sh\nprintf "<%s>" "$@"\n')
        os.chmod(self.path('bin/roslaunch'), 0o755)
        self.catkin_make = 'mkdir -p devel; echo "PATH=$PWD/bin:$PATH" >devel/setup.bash'
        for arguments, expected in (((), 'rostopic pub -r 10 /anthrob/muscle_command anthrob_msgs/MuscleCommand "{'),
                                    (('robot:=rig', 'rate:=0'), 'rostopic echo -n1 /rig/muscle_states>')):
            status, said = run(('sim', *arguments), {**ALL, 'catkin_make': self.catkin_make}, script=self.path('catkin_ws.sh'), DISPLAY='')
            self.assertEqual(status, 0, said)
            self.assertRegex(said, '<anthrob_bringup><sim.launch><rviz:=false><hint:=')
            self.assertIn(expected, said)
            if not arguments:
                with open(os.path.join(TOP, 'README.md')) as readme:
                    command = re.search(r'(rostopic pub[^>]*)>', said).group(1)
                    self.assertTrue(command in re.sub(r'[\\\s]+', ' ', readme.read()), command)
            self.assertTrue(said.endswith(''.join('<%s>' % argument for argument in arguments)), said)

    def test_again_after_a_build_with_arguments(self):
        self.builds()
        run(('build', '-DCMAKE_BUILD_TYPE=Debug'), {**ALL, 'catkin_make': self.catkin_make},
            script=self.path('catkin_ws.sh'))
        self.assertTrue(self.builds())


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'workspace_script', '__main__')
