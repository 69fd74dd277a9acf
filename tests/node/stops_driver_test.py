#!/usr/bin/env python3
"""What is called while `home` runs is answered at once, and nothing that was called before an emergency stop undoes it."""
import threading
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from std_srvs.srv import Trigger
import waiting
from back_end import BackEnd, all_begin_anew

PACE = 1.0  # seconds of the robot in a second of the wall clock


def wait_for(condition, what, seconds):
    """Seconds are the robot's."""
    waiting.wait_for(condition, seconds / PACE, what)


class Call(threading.Thread):
    """A service call in a thread of its own."""

    def __init__(self, name):
        super().__init__(daemon=True)
        self.service, self.answer = rospy.ServiceProxy(name, Trigger), None
        self.start()

    def run(self):
        self.answer = self.service()


@all_begin_anew
class Stops(unittest.TestCase):

    def receive_states(self, message):
        self.states = message

    def call(self, name):
        return rospy.ServiceProxy(name, Trigger)()

    def setUp(self):
        self.states = None
        self.back_end = BackEnd()
        rospy.Subscriber('muscle_states', MuscleStates, self.receive_states, queue_size=10)
        for name in ['enable', 'home', 'clear_faults', 'disable', 'emergency_stop']:
            rospy.wait_for_service(name, 60)
        wait_for(lambda: self.states is not None, 'states', 30)

    def start(self):
        wait_for(lambda: self.call('clear_faults').success and self.call('enable').success, 'enable', 30)

    def recover(self):
        wait_for(lambda: self.call('disable').success and not any(self.states.voltage), 'rest', 30)

    def test_what_was_called_before_a_stop_does_not_undo_it(self):
        home = Call('home')
        wait_for(self.back_end.unless_lost(lambda: any(volts > 0.0 for volts in self.states.voltage)),
                 'home to pull', 30)
        called = {name: Call(name) for name in ['clear_faults', 'enable', 'home']}
        for name, call in called.items():
            call.join(60)
            self.assertIsNotNone(call.answer, name)
        self.assertTrue(home.is_alive(), 'they waited for home: ' + str(home.answer))
        self.assertEqual({name: (call.answer.success, call.answer.message) for name, call in called.items()},
                         {'clear_faults': (True, 'nothing to clear'), 'enable': (True, 'already enabled'),
                          'home': (False, 'home is running already')})
        self.assertTrue(self.call('emergency_stop').success)
        home.join(60)
        self.assertFalse(home.answer.success, home.answer.message)
        time.sleep(1.0 / PACE)
        self.assertEqual(set(self.states.ecu_state), {MuscleStates.STOPPING})
        answer = self.call('enable')
        self.assertFalse(answer.success)
        self.assertIn('emergency stop is latched', answer.message)
        self.assertTrue(self.call('clear_faults').success)
        self.assertTrue(self.call('enable').success)


if __name__ == '__main__':
    rospy.init_node('stops_driver_test')
    PACE = rospy.get_param('~pace', 1.0)
    rostest.rosrun('anthrob_tests', 'stops_driver', Stops)
