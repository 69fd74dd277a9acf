#!/usr/bin/env python3
"""A controller whose sensors fall silent stops sending, and says which sensor it misses. One whose robot refuses a
motion goes back to holding the arm."""
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates, SphericalJointStates
from anthrob_msgs.srv import GoTo, GoToRequest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Quaternion, Vector3
from std_srvs.srv import Trigger

MUSCLES = ['lateral_deltoid', 'anterior_deltoid', 'posterior_deltoid', 'supraspinatus', 'infraspinatus',
           'teres_minor', 'teres_major', 'pectoralis_major']


class StaleSensors(unittest.TestCase):

    def setUp(self):
        self.commands, self.reports = [], []
        rospy.Subscriber('muscle_command', MuscleCommand, self.commands.append)
        rospy.Subscriber('/diagnostics', DiagnosticArray, lambda m: self.reports.append(m.status[0].message))
        self.muscles = rospy.Publisher('muscle_states', MuscleStates, queue_size=1)
        self.shoulder = rospy.Publisher('spherical_joint_states', SphericalJointStates, queue_size=1)
        end = time.time() + 20
        while not (self.muscles.get_num_connections() and self.shoulder.get_num_connections()):
            self.assertLess(time.time(), end)
            time.sleep(0.05)

    def publish(self, until, shoulder=True, state=MuscleStates.ENABLED, patience=20):
        """Sensor messages until it is so; a busy machine may make a single message late."""
        n = len(MUSCLES)
        zeros = [0.0] * n
        end = time.time() + patience
        while time.time() < end and not until():
            m = MuscleStates(name=MUSCLES, position=zeros, velocity=zeros, current=zeros, voltage=zeros,
                             force=[5.0] * n, reference=zeros, mode=[3] * n, ecu_state=[state] * n)
            m.header.stamp = rospy.Time.now()
            self.muscles.publish(m)
            if shoulder:
                s = SphericalJointStates(name=['shoulder'], orientation=[Quaternion(w=1)],
                                         angular_velocity=[Vector3()])
                s.header.stamp = rospy.Time.now()
                self.shoulder.publish(s)
            time.sleep(0.005)
        self.assertTrue(until(), self.reports[-1:])

    def says(self, words):
        """Whether a report that is still to come holds these words."""
        heard = len(self.reports)
        return lambda: any(words in report for report in self.reports[heard:])

    def sends(self, count):
        """Whether so many commands more have come."""
        wanted = len(self.commands) + count
        return lambda: len(self.commands) >= wanted

    def test_a_motion_that_the_robot_refuses_is_broken_off(self):
        go_to = rospy.ServiceProxy('controller/go_to', GoTo)
        zero_gravity = rospy.ServiceProxy('controller/zero_gravity', Trigger)
        for service in go_to, zero_gravity:
            service.wait_for_service(20)
        self.publish(self.sends(20))
        heard = len(self.commands)
        there = GoToRequest(ball_joint_name=['shoulder'], duration=2.0,
                            ball_joint_orientation=[Quaternion(w=0.939693, x=0.220336, z=-0.261591)])
        self.assertTrue(go_to(there).success)
        # These muscle_states always tell of FORCE: the command with POSITION was refused.
        refused = self.says('refused its POSITION references')

        def moving():
            return [c.header.stamp.to_sec() for c in self.commands[heard:] if c.mode[0] == MuscleCommand.POSITION]
        self.publish(lambda: moving() and self.commands[-1].mode[0] == MuscleCommand.FORCE)
        self.assertLess(self.commands[-1].header.stamp.to_sec() - moving()[0], 0.45)  # before command_timeout
        self.publish(refused)
        self.assertTrue(zero_gravity().success)
        self.publish(self.says('zero gravity'))

    def test_silence_and_return(self):
        self.publish(self.sends(20))
        self.assertEqual(self.commands[-1].name, MUSCLES)
        self.publish(self.says('zero gravity'))
        # motion capture has lost the arm
        self.publish(self.says('joint shoulder'), shoulder=False)
        time.sleep(0.5)  # for a command that was on its way
        count = len(self.commands)
        end = time.time() + 1.5
        self.publish(lambda: time.time() > end, shoulder=False)
        self.assertEqual(len(self.commands), count)
        # and seen it again
        self.publish(self.sends(20))
        self.publish(self.says('not enabled'), state=MuscleStates.IDLE)


if __name__ == '__main__':
    rospy.init_node('stale_sensors_test')
    rostest.rosrun('anthrob_tests', 'stale_sensors', StaleSensors)
