#!/usr/bin/env python3
"""However rarely the simulator publishes, it hears commands and stops at once."""
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from std_srvs.srv import Trigger
from waiting import wait_for


class SlowStates(unittest.TestCase):

    def setUp(self):
        self.states = []
        rospy.Subscriber('muscle_states', MuscleStates, self.states.append)
        self.commands = rospy.Publisher('muscle_command', MuscleCommand, queue_size=1, tcp_nodelay=True)
        wait_for(lambda: self.states and self.commands.get_num_connections(), 20, 'the simulator')

    def next_state(self):
        """With commands all the while."""
        count = len(self.states)
        end = time.time() + 10
        while len(self.states) == count:
            self.assertLess(time.time(), end)
            self.commands.publish(MuscleCommand(name=['flexor'], mode=[MuscleCommand.VOLTAGE], reference=[0.5]))
            time.sleep(0.02)
        return self.states[-1]

    def test_commands_and_stops_are_heard_between_states(self):
        for _ in range(2):
            self.next_state()
        first, second = self.next_state(), self.next_state()
        self.assertAlmostEqual((second.header.stamp - first.header.stamp).to_sec(), 1.0, places=6)
        for state in first, second:
            self.assertEqual(list(state.ecu_state), [MuscleStates.ENABLED] * 2)
            self.assertEqual(state.voltage[0], 0.5)
        # A state comes once in a second, the answer does not wait for it.
        stop = rospy.ServiceProxy('emergency_stop', Trigger)
        stop.wait_for_service(10)
        count = len(self.states)
        self.assertTrue(stop().success)
        self.assertEqual(len(self.states), count)
        wait_for(lambda: len(self.states) > count, 10, 'a state')
        self.assertNotIn(MuscleStates.ENABLED, self.states[-1].ecu_state)
        self.assertEqual(list(self.states[-1].voltage), [0.0, 0.0])


if __name__ == '__main__':
    rospy.init_node('slow_states_test')
    rostest.rosrun('anthrob_tests', 'slow_states', SlowStates)
