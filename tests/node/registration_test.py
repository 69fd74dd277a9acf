#!/usr/bin/env python3
"""A back end that the ROS master does not know cannot be stopped by anybody who starts then: it stops by itself, and
registers again. The same for simulator and driver; the master is killed, held up and started again."""
import signal
import time

import rosgraph
import rospy
import rostest
from back_end import all_begin_anew
from own_robot import NODE, PACE, PATIENCE, PULL, OwnRobot
from waiting import wait_for


@all_begin_anew
class Registration(OwnRobot):

    def check_stops(self, why):
        begin = time.time()
        self.wait_for(self.is_stopped, PATIENCE + 16.0 / PACE, 'the motors to stop')
        print('stopped after %.2f s' % (time.time() - begin))
        # The driver's stops are in its values, too.
        self.wait_for(lambda: why in self.seen['report'].message + self.values.get('last_stop', ''), PATIENCE,
                      why + ' in diagnostics')

    def check_is_found_again(self):
        """And stays stopped until somebody wants it otherwise; a program that starts now stops it then."""
        begin = time.time()
        wait_for(self.is_registered, PATIENCE, 'registration')
        print('registered after %.2f s' % (time.time() - begin))
        time.sleep(0.5)
        self.assertTrue(self.is_stopped())
        # It looks at its registration once a second, of its own time.
        self.wait_for(lambda: 'clear_faults' in self.refusal(), PATIENCE, 'enable to want clear_faults')
        self.start()
        self.check_stop_by_topic()

    def refusal(self):
        answer = self.call('enable')
        self.assertFalse(answer.success)
        return answer.message

    def test_a_master_that_dies_and_comes_back(self):
        self.core.kill()
        self.check_stops('is gone')
        time.sleep(3.0)
        self.assertTrue(self.is_stopped())
        self.core.start()
        self.check_is_found_again()

    def test_a_master_that_is_started_again_at_once(self):
        self.core.kill()
        self.core.start()
        self.check_stops('the ROS master')
        self.check_is_found_again()

    def test_a_registration_that_somebody_takes_away(self):
        _, uri = self.server()
        self.assertEqual(rosgraph.Master(NODE).unregisterSubscriber('/anthrob/emergency_stop', uri), 1)
        self.check_stops('missing: /anthrob/emergency_stop)')
        self.check_is_found_again()

    def test_a_master_that_is_slow_and_one_that_hangs(self):
        self.core.process.send_signal(signal.SIGSTOP)
        try:
            end = time.time() + 6.0
            while time.time() < end:
                self.wait_for(lambda: self.volts() > 0.9 * PULL, 3.0, 'motion in spite of a slow master')
                time.sleep(0.05)
            self.check_stops('does not answer')
        finally:
            self.core.process.send_signal(signal.SIGCONT)
        self.check_is_found_again()

    def test_a_new_master_knows_that_time_is_simulated(self):
        simulated = rospy.get_param('/use_sim_time')
        self.core.kill()
        self.core.start()
        wait_for(lambda: rospy.get_param('/use_sim_time', False) == simulated, PATIENCE, '/use_sim_time')


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'registration', Registration)
