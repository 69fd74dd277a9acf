#!/usr/bin/env python3
"""A test begins anew where the back end lost a unit, and for no other reason."""
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
import back_end
import waiting

LOST = ['ecu_lost: ecu_3: no complete answer of an ECU to two SYNCs in a row; check its power and cable',
        'bus_silent: no ECU completely answers two SYNCs in a row, and all did before; check the bus cable',
        'ecu_stopped: ecu_1: an ECU stopped by itself while enabled (sync_lost); check the driver and the bus']
STOPPED = ['ecu_stopped: ecu_1: an ECU stopped by itself while enabled (bus_off); check cable',
           'ecu_stopped: ecu_1: an ECU stopped by itself while enabled; see the reason in its diagnostics',
           'ecu_fault: ecu_2: an ECU reports a fault (over_current of brachialis); look for a short circuit',
           'ecu_restarted: ecu_2: an ECU restarted and lost its zero; check its power',
           'command_timeout: no fresh, valid muscle_command within `command_timeout`; keep commands coming',
           'home_failed: `home` met one of its limits; check the muscle that is named']


def report(stops, last_stop, *found):
    """Of a driver and one unit, about which something was found."""
    values = lambda pairs: [KeyValue(key, str(value)) for key, value in pairs]
    return DiagnosticArray(status=[
        DiagnosticStatus(name='/anthrob: driver', message='disabled',
                         values=values([('stops', stops), ('last_stop', last_stop)])),
        DiagnosticStatus(level=2, name='/anthrob: ecu_1', message='lost', values=values((f, '3x') for f in found))])


class Told(back_end.BackEnd):
    """Is told, and listens to nobody."""

    def __init__(self):
        super().__init__()
        self.subscriber.unregister()
        self.receive(report(1, LOST[0]))  # before anything begins
        self.begin()

    def unit_lost_by_now(self):
        return self.unit_lost()


class Robot:
    """A test of a robot that stops for the given reasons, one a time."""

    def __init__(self, *reasons):
        self.back_end, self.reasons = Told(), list(reasons)
        self.started = self.recovered = 0

    def start(self):
        self.started += 1

    def recover(self):
        self.recovered += 1

    @back_end.begins_anew_if_a_unit_is_lost
    def test_moves(self):
        if self.reasons:
            self.back_end.receive(report(self.back_end.stops + 1, self.reasons.pop(0)))
            raise AssertionError('it stands still')


class BackEnd(unittest.TestCase):

    def test_a_stop_before_it_began_does_not_count(self):
        told = Told()
        self.assertIsNone(told.unit_lost())
        told.receive(report(1, LOST[0]))
        self.assertIsNone(told.unit_lost())

    def test_what_counts_as_a_lost_unit(self):
        for reason in LOST + STOPPED:
            told = Told()
            told.receive(report(2, reason, 'ecu_lost'))
            self.assertEqual(told.unit_lost(), reason if reason in LOST else None)

    def test_units_are_lost_while_nothing_runs_too(self):
        told = Told()
        told.receive(report(1, STOPPED[0], 'ecu_lost'))
        self.assertEqual(told.unit_lost(), '/anthrob: ecu_1: ecu_lost: 3x')

    def test_a_simulator_loses_none(self):
        told = Told()
        told.receive(DiagnosticArray(status=[DiagnosticStatus(name='/anthrob: simulator')]))
        self.assertIsNone(told.unit_lost())

    def test_waits_no_longer_for_what_a_lost_unit_does_not_do(self):
        told = Told()
        told.receive(report(2, LOST[1]))
        waiting.wait_for(told.unless_lost(lambda: True), 1.0, 'what has come')
        with self.assertRaisesRegex(back_end.UnitLost, 'bus_silent'):
            waiting.wait_for(told.unless_lost(lambda: False), 30.0, 'what does not come')

    def test_begins_anew(self):
        robot = Robot(*LOST)
        robot.test_moves()
        self.assertEqual((robot.started, robot.recovered), (4, 3))

    def test_begins_anew_though_the_loss_is_cleared_by_now(self):
        class Late(Robot):
            @back_end.begins_anew_if_a_unit_is_lost
            def test_moves(self):
                if self.started == 1:  # a report that was made before start() and came after it
                    self.back_end.receive(report(1, LOST[1], 'bus_silent'))
                    self.back_end.unit_lost_by_now = lambda: None
                    waiting.wait_for(self.back_end.unless_lost(lambda: False), 30.0, 'what does not come')

        robot = Late()
        robot.test_moves()
        self.assertEqual((robot.started, robot.recovered), (2, 1))

    def test_has_failed_for_another_reason(self):
        for reason in STOPPED:
            robot = Robot(reason)
            with self.assertRaisesRegex(AssertionError, 'it stands still'):
                robot.test_moves()
            self.assertEqual((robot.started, robot.recovered), (1, 0))

    def test_has_failed_if_that_goes_on(self):
        robot = Robot(*(2 * LOST))
        with self.assertRaisesRegex(AssertionError, 'it stands still'):
            robot.test_moves()
        self.assertEqual(robot.started, back_end.ATTEMPTS)

    def test_who_waits_in_vain_says_what_is_diagnosed(self):
        publisher = rospy.Publisher('/diagnostics', DiagnosticArray, queue_size=1, latch=True)
        publisher.publish(report(3, LOST[0], 'ecu_lost'))
        with self.assertRaisesRegex(AssertionError, r'(?s)waited 0.1 s for: it; diagnostics:\n'
                                    r'  OK /anthrob: driver: disabled {stops: 3, last_stop: ecu_lost: .*}\n'
                                    r'  ERROR /anthrob: ecu_1: lost {ecu_lost: 3x}'):
            waiting.wait_for(lambda: False, 0.1, 'it')


if __name__ == '__main__':
    rospy.init_node('back_end_test')
    rostest.rosrun('anthrob_tests', 'back_end', BackEnd)
