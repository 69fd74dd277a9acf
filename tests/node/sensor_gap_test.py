#!/usr/bin/env python3
"""Motion capture that blinks does not end a motion; one that is away for long does. In simulated time, which waits for
the controller, so that a busy machine makes no gap of its own."""
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates, SphericalJointStates
from anthrob_msgs.srv import GoTo
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Quaternion, Vector3
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header

MUSCLES = ['lateral_deltoid', 'anterior_deltoid', 'posterior_deltoid', 'supraspinatus', 'infraspinatus',
           'teres_minor', 'teres_major', 'pectoralis_major']
TICK = 0.005  # [s]
STALE_AFTER = 0.1  # [s] of control_tier1.yaml


class SensorGap(unittest.TestCase):

    def setUp(self):
        self.now, self.stamps, self.status = 10.0, [], ''
        self.mode = [MuscleCommand.FORCE] * len(MUSCLES)
        rospy.Subscriber('muscle_command', MuscleCommand, self.on_command)
        rospy.Subscriber('/diagnostics', DiagnosticArray, self.on_report)
        self.clock = rospy.Publisher('/clock', Clock, queue_size=10)
        self.muscles = rospy.Publisher('muscle_states', MuscleStates, queue_size=10)
        self.shoulder = rospy.Publisher('spherical_joint_states', SphericalJointStates, queue_size=10)
        end = time.time() + 20
        while not all(p.get_num_connections() for p in (self.clock, self.muscles, self.shoulder)):
            self.assertLess(time.time(), end)
            time.sleep(0.05)

    def on_command(self, message):
        self.mode = list(message.mode)  # as a robot that follows it
        self.stamps.append(message.header.stamp.to_sec())

    def on_report(self, message):
        self.status = message.status[0].message

    def tick(self, shoulder=True):
        """One tick; with a shoulder the next one waits for the answer to this one."""
        self.now += TICK
        stamp = rospy.Time.from_sec(self.now)
        zeros = [0.0] * len(MUSCLES)
        self.muscles.publish(MuscleStates(
            header=Header(stamp=stamp), name=MUSCLES, position=zeros, velocity=zeros, current=zeros,
            voltage=zeros, force=[5.0] * len(MUSCLES), reference=zeros, mode=self.mode,
            ecu_state=[MuscleStates.ENABLED] * len(MUSCLES)))
        if shoulder:
            self.shoulder.publish(SphericalJointStates(
                header=Header(stamp=stamp), name=['shoulder'], orientation=[Quaternion(w=1)],
                angular_velocity=[Vector3()]))
        time.sleep(0.002)  # so that measurements are there before their time is
        self.clock.publish(Clock(clock=stamp))
        end = time.time() + 2.0
        while shoulder and time.time() < end and not (self.stamps and self.stamps[-1] > self.now - 2.5 * TICK):
            time.sleep(0.001)
        if not shoulder:
            time.sleep(0.01)

    def run_until(self, status):
        self.status = ''
        end = time.time() + 20
        while status not in self.status:
            self.assertLess(time.time(), end, 'says: ' + self.status)
            self.tick()

    def gap(self, seconds):
        """@return the time between two commands that the silence made [s]"""
        before = self.stamps[-1]
        for _ in range(round(seconds / TICK)):
            self.tick(shoulder=False)
        for _ in range(5):
            self.tick()
        stamps = [before] + [stamp for stamp in self.stamps if stamp > before]
        return max(b - a for a, b in zip(stamps, stamps[1:]))

    def test_what_a_gap_ends(self):
        self.run_until('zero gravity')
        rospy.wait_for_service('controller/go_to')
        answer = rospy.ServiceProxy('controller/go_to', GoTo)(
            ball_joint_name=['shoulder'], ball_joint_orientation=[Quaternion(x=0.1, w=0.99498743710662)], duration=60)
        self.assertTrue(answer.success, answer.message)
        self.run_until('on the way')
        silence = self.gap(0.3)
        self.assertGreater(silence, STALE_AFTER)  # it was one
        self.assertLess(silence, 0.5)
        self.run_until('on the way')
        self.assertGreater(self.gap(0.9), 0.5)
        self.run_until('zero gravity')


if __name__ == '__main__':
    rospy.init_node('sensor_gap_test')
    rostest.rosrun('anthrob_tests', 'sensor_gap', SensorGap)
