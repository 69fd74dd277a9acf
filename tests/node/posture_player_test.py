#!/usr/bin/env python3
"""The posture player ends where somebody stops the motors: the next enable finds nobody who takes up a posture."""
import os
import subprocess
import threading
import unittest

import rospkg
import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from std_srvs.srv import Trigger

CONFIG = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob')


class PosturePlayer(unittest.TestCase):

    def call(self, name):
        rospy.wait_for_service(name, 60)
        answer = rospy.ServiceProxy(name, Trigger)()
        self.assertTrue(answer.success, answer.message)

    def start(self):
        return subprocess.Popen(
            ['rosrun', 'anthrob_control', 'anthrob_posture_player', '__ns:=' + rospy.get_namespace(), '__name:=player',
             '_model:=' + os.path.join(CONFIG, 'model_I.yaml'),
             '_postures:=' + os.path.join(CONFIG, 'demo_postures.yaml')],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def ends(self, player):
        output = player.communicate(timeout=60)[0]
        self.assertEqual(player.returncode, 1, output)
        self.assertEqual(output.count('is not enabled; enable, then start again'), 1, output)

    def test_1_motors_that_were_not_enabled(self):
        rospy.wait_for_message('muscle_states', MuscleStates, 60)
        self.ends(self.start())

    def test_2_a_stop(self):
        commanded = threading.Event()
        commands = rospy.Subscriber('muscle_command', MuscleCommand, lambda _: commanded.set())
        self.call('enable')
        player = self.start()
        self.assertTrue(commanded.wait(60), 'no command')
        self.call('emergency_stop')
        self.ends(player)
        self.call('clear_faults')
        self.call('enable')
        commanded.clear()
        self.assertFalse(commanded.wait(2.0), 'somebody commands')
        self.assertEqual(commands.get_num_connections(), 0)


if __name__ == '__main__':
    rospy.init_node('posture_player_test')
    rostest.rosrun('anthrob_tests', 'posture_player', PosturePlayer)
