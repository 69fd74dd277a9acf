#!/usr/bin/env python3
"""Ctrl-C ends the driver while `home` winds the tendons in, at once and not only by force."""
import os
import signal
import subprocess
import tempfile
import threading
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from std_srvs.srv import Trigger, TriggerResponse
from waiting import wait_for


class InterruptDriver(unittest.TestCase):

    def setUp(self):
        pace = rospy.get_param('~pace', 1.0)
        self.slow = 1.0 / pace
        self.states = self.answer = None
        rospy.Subscriber('muscle_states', MuscleStates, self.receive_states, queue_size=10)
        self.said = tempfile.TemporaryFile('w+')
        self.addCleanup(self.said.close)
        # A session of its own: Ctrl-C reaches its nodes through roslaunch only.
        self.robot = subprocess.Popen(
            ['roslaunch', 'anthrob_bringup', 'robot.launch', 'backend:=emulated', 'can:=vcan0', 'realtime:=true',
             'pace:=%s' % pace], stdout=self.said, stderr=subprocess.STDOUT, start_new_session=True,
            env={key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'})
        self.addCleanup(self.end)

    def end(self):
        if self.robot.poll() is None:
            self.robot.send_signal(signal.SIGINT)
            self.robot.wait(60)

    def receive_states(self, message):
        self.states = message

    def home(self):
        try:
            self.answer = rospy.ServiceProxy('home', Trigger)()
        except rospy.ServiceException as gone:  # its connection may end before the answer
            self.answer = TriggerResponse(False, str(gone))

    def test_while_home_winds(self):
        rospy.wait_for_service('home', 60)
        wait_for(lambda: self.states is not None, 30 * self.slow, 'states')
        wait_for(lambda: rospy.ServiceProxy('enable', Trigger)().success, 30 * self.slow, 'enable')
        home = threading.Thread(target=self.home, daemon=True)
        home.start()
        wait_for(lambda: any(volts > 0.0 for volts in self.states.voltage), 30 * self.slow, 'home to pull')
        self.assertIsNone(self.answer)
        self.robot.send_signal(signal.SIGINT)
        self.robot.wait(60)
        self.said.seek(0)
        said = self.said.read()
        self.assertNotIn('escalating to SIGTERM', said)
        self.assertNotIn('process has died', said)
        home.join(10)
        self.assertFalse(home.is_alive(), 'the call of home hangs')
        self.assertFalse(self.answer.success, self.answer.message)


if __name__ == '__main__':
    rospy.init_node('interrupt_driver_test')
    rostest.rosrun('anthrob_tests', 'interrupt_driver', InterruptDriver)
