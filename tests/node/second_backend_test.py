#!/usr/bin/env python3
"""Two back ends must not speak for one robot: the second one refuses, and the first goes on."""
import os
import subprocess
import unittest

import rospkg
import rospy
import rostest
from anthrob_msgs.msg import MuscleStates


class SecondBackend(unittest.TestCase):

    def test_a_second_simulator_is_refused(self):
        rospy.wait_for_message('muscle_states', MuscleStates, 20)
        config = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob')
        second = subprocess.run(['rosrun', 'anthrob_sim', 'anthrob_simulator', '__name:=second', '__ns:=/anthrob',
                                 '_model:=' + os.path.join(config, 'model_I.yaml')],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=40)
        self.assertEqual(second.returncode, 2, second.stdout)
        self.assertIn('/anthrob/simulator publishes it already', second.stdout)
        rospy.wait_for_message('muscle_states', MuscleStates, 20)


if __name__ == '__main__':
    rospy.init_node('second_backend_test')
    rostest.rosrun('anthrob_tests', 'second_backend', SecondBackend)
