#!/usr/bin/env python3
"""That `rostopic echo` prints all fields of our messages: Debian's fails on a field of type uint8[]."""
import importlib.machinery
import importlib.util
import os
import shutil
import subprocess
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
import rostopic
from anthrob_msgs.msg import MuscleStates


class Rostopic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.bag = os.path.join(cls.folder, 'one.bag')
        with rosbag.Bag(cls.bag, 'w') as bag:
            bag.write('/arm/muscle_states', MuscleStates(name=['flexor', 'extensor'], position=[0.5, -0.5], mode=[1, 3],
                                                         ecu_state=[2, 4]), rospy.Time(1))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def echo(self, *arguments):
        done = subprocess.run(['rostopic', 'echo', '-b', self.bag, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=30)
        self.assertEqual(done.stderr, '')
        return done.stdout

    def test_a_field_of_bytes(self):
        self.assertEqual(self.echo('/arm/muscle_states/ecu_state'), '[2, 4]\n---\n')
        self.assertEqual(self.echo('/arm/muscle_states/mode[1]'), '3\n---\n')

    def test_other_fields_and_the_whole(self):
        self.assertEqual(self.echo('/arm/muscle_states/position'), '[0.5, -0.5]\n---\n')
        said = self.echo('/arm/muscle_states')
        self.assertIn('mode: [1, 3]\necu_state: [2, 4]\n', said)

    def test_a_field_of_a_topic_whose_type_is_known(self):
        """As of a running robot; a bag's fields come without type."""
        script = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'scripts', 'rostopic')
        loader = importlib.machinery.SourceFileLoader('our_rostopic', script)
        ours = importlib.util.module_from_spec(importlib.util.spec_from_loader('our_rostopic', loader))
        loader.exec_module(ours)
        echo = ours.CallbackEcho('', None)
        self.assertEqual(echo.custom_strify_message(b'\x02\x04', type_information='uint8[]'), '[2, 4]')
        self.assertEqual(echo.custom_strify_message(4, type_information='uint8[]'), '4')
        without_arrays = rostopic.create_value_transform(False, True)
        self.assertEqual(echo.custom_strify_message(b'\x02\x04', type_information='uint8[]', value_transform=without_arrays),
                         '"<array type: uint8, length: 2>"')


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'rostopic', Rostopic)
