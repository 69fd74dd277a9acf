#!/usr/bin/env python3
"""Every launch file can be read, with what it asks for, and the programs it starts are there. (roslaunch-check does not find the
package of files that are links.)"""
import glob
import os
import unittest
import xml.etree.ElementTree as ElementTree

import roslaunch.config
import roslaunch.core
import rospkg
import roslib.packages
import rostest


class LaunchFiles(unittest.TestCase):

    def test_name_programs_that_are_there(self):
        files = glob.glob(os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'launch', '*.launch'))
        self.assertGreater(len(files), 6)
        for file in files:
            with self.subTest(os.path.basename(file)):
                self.check(file)

    def check(self, file):
        asked = ['%s:=tier1' % arg.get('name') for arg in ElementTree.parse(file).getroot().findall('arg')
                 if arg.get('default') is None and arg.get('value') is None]
        config = roslaunch.config.load_config_default([(file, asked)], None, assign_machines=False)
        self.assertFalse(config.config_errors)
        self.assertTrue(config.nodes)
        for node in config.nodes:
            self.assertTrue(roslib.packages.find_node(node.package, node.type), node.package + '/' + node.type)

    def test_hand_and_motion_capture_reach_every_back_end(self):
        file = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'launch', 'robot.launch')
        for backend in 'hardware', 'emulated', 'sim':
            with self.subTest(backend):
                asked = ['backend:=' + backend, 'hand:=true', 'mocap:=true']
                config = roslaunch.config.load_config_default([(file, asked)], None, assign_machines=False)
                self.assertIn('name="fingers"', config.params['/anthrob/robot_description'].value)
                models = [node.args for node in config.nodes if node.package == 'anthrob_emulator']
                models += [p.value for name, p in config.params.items() if name == '/anthrob/simulator/model']
                for model in models:
                    self.assertIn('model_II_hand.yaml', model)
                self.assertEqual(len(models), backend != 'hardware')
                seen = any(node.package == 'anthrob_mocap' for node in config.nodes)
                self.assertEqual(seen, backend != 'emulated')

    def check_types(self, launch, asked, node, expected, wrong):
        file = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'launch', launch)
        config = roslaunch.config.load_config_default([(file, asked)], None, assign_machines=False)
        for name, value in expected.items():
            found = config.params[node + '/' + name].value
            self.assertEqual((found, type(found)), (value, type(value)))
        for argument in wrong:
            with self.assertRaises(roslaunch.core.RLException):
                roslaunch.config.load_config_default([(file, [argument])], None, assign_machines=False)

    def test_parameters_of_the_driver_have_their_type(self):
        self.check_types('robot.launch', ['command_timeout:=1e-1', 'rate:=250', 'realtime:=true'], '/anthrob/driver',
                         {'command_timeout': 0.1, 'rate': 250.0, 'realtime': True, 'hand': False},
                         ['command_timeout:=soon', 'realtime:=perhaps'])

    def test_parameters_of_the_simulator_have_their_type(self):
        self.check_types('sim.launch', ['auto_enable:=0', 'paused:=1', 'step:=5e-4', 'rate:=2'], '/anthrob/simulator',
                         {'auto_enable': False, 'paused': True, 'step': 0.0005, 'rate': 2.0},
                         ['auto_enable:=no', 'paused:=please', 'rate:=fast'])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'launch_files', LaunchFiles)
