#!/usr/bin/env python3
"""The computed-force node drives a robot, simulated in lock-step or behind a CAN bus: goes to postures, holds them in
zero gravity."""
import math
import time
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from anthrob_msgs.msg import GoToAction, GoToGoal, MuscleStates, SphericalJointStates
from anthrob_msgs.srv import GoTo, GoToRequest
from geometry_msgs.msg import Quaternion
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
import waiting

NAN = float('nan')
# Of the demo: abducted, flexed.
POSTURES = [([0.939693, 0.220336, 0.0, -0.261591], 1.0472), ([0.953717, -0.229992, 0.0, -0.193720], 1.5708)]


def angle(a, b):
    return 2.0 * math.degrees(math.acos(min(1.0, abs(sum(x * y for x, y in zip(a, b))))))


class ComputedForce(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.shoulder, cls.elbow, cls.muscles = [], [], []
        rospy.Subscriber('spherical_joint_states', SphericalJointStates, cls.see_shoulder, queue_size=1000)
        rospy.Subscriber('joint_states', JointState, lambda m: cls.elbow.append(m.position[0]), queue_size=1000)
        rospy.Subscriber('muscle_states', MuscleStates, cls.muscles.append, queue_size=1000)
        # Emulated robots may run slower than clocks; so do their users.
        cls.patience = 60.0 / rospy.get_param('~pace', 1.0)
        rospy.wait_for_service('controller/go_to', 30)
        cls.go_to = rospy.ServiceProxy('controller/go_to', GoTo)
        cls.zero_gravity = rospy.ServiceProxy('controller/zero_gravity', Trigger)
        cls.wait_for(lambda: cls.shoulder and cls.elbow and cls.muscles, 'measurements')
        enable = rospy.ServiceProxy('enable', Trigger)
        cls.wait_for(lambda: enable().success, 'enable')

    @classmethod
    def wait_for(cls, condition, what):
        waiting.wait_for(condition, cls.patience, what)

    @classmethod
    def see_shoulder(cls, message):
        q = message.orientation[0]
        cls.shoulder.append((message.header.stamp.to_sec(), [q.w, q.x, q.y, q.z]))

    def simulate(self, seconds):
        """Waits until so much time was simulated; returns the shoulder's way."""
        first = len(self.shoulder)
        start = self.shoulder[-1][0]
        limit = time.time() + self.patience
        while self.shoulder[-1][0] < start + seconds:
            self.assertLess(time.time(), limit, 'simulated time stands still')
            time.sleep(0.01)
        return [q for _, q in self.shoulder[first:]]

    def test_holds_postures_in_zero_gravity(self):
        for quaternion, elbow in POSTURES:
            w, x, y, z = quaternion
            answer = self.go_to(GoToRequest(joint_name=['elbow'], joint_position=[elbow],
                                            ball_joint_name=['shoulder'],
                                            ball_joint_orientation=[Quaternion(x, y, z, w)], duration=2.0))
            self.assertTrue(answer.success, answer.message)
            self.simulate(7.0)
            self.assertLess(angle(self.shoulder[-1][1], quaternion), 3.0)
            self.assertLess(abs(math.degrees(sum(self.elbow[-20:]) / 20 - elbow)), 3.0)
            self.assertEqual(set(self.muscles[-1].mode), {1})
            self.assertTrue(self.zero_gravity().success)
            self.simulate(0.5)
            start, elbow_start = self.shoulder[-1][1], sum(self.elbow[-20:]) / 20
            way = self.simulate(10.0)
            self.assertEqual(set(self.muscles[-1].mode), {3})
            drift = max(angle(start, q) for q in way)
            print('drift in 10 s: shoulder %.2f deg, elbow %.2f deg' %
                  (drift, abs(math.degrees(sum(self.elbow[-20:]) / 20 - elbow_start))))
            self.assertLess(drift, 2.0)
            self.assertLess(abs(math.degrees(sum(self.elbow[-20:]) / 20 - elbow_start)), 2.0)

    def goal_of(self, posture, duration):
        (w, x, y, z), elbow = posture
        return GoToGoal(joint_name=['elbow'], joint_position=[elbow], ball_joint_name=['shoulder'],
                        ball_joint_orientation=[Quaternion(x, y, z, w)], duration=duration)

    def ended(self, client):
        # Its status may come before its result.
        self.wait_for(lambda: client.simple_state == actionlib.SimpleGoalState.DONE, 'the end of go_to')
        return client.get_state()

    def test_an_action_tells_what_is_left_and_when_it_is_there(self):
        client = actionlib.SimpleActionClient('go_to', GoToAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(30)))
        feedback = []
        client.send_goal(self.goal_of(POSTURES[0], 2.0), feedback_cb=feedback.append)
        self.assertEqual(self.ended(client), GoalStatus.SUCCEEDED)
        result = client.get_result()
        self.assertTrue(result.success)
        self.assertLess(result.error, 0.06)
        self.assertLess(angle(self.shoulder[-1][1], POSTURES[0][0]), 4.0)
        self.assertGreater(len(feedback), 5)
        self.assertGreater(feedback[0].error, feedback[-1].error)
        self.assertGreater(feedback[0].time_left, feedback[-1].time_left)
        client.send_goal(self.goal_of((POSTURES[0][0], 99.0), 2.0))
        self.assertEqual(self.ended(client), GoalStatus.ABORTED)
        self.assertIn('limits', client.get_result().message)

    def test_an_action_that_is_cancelled_holds_the_arm_where_it_is(self):
        client = actionlib.SimpleActionClient('go_to', GoToAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(30)))
        moved = []
        client.send_goal(self.goal_of(POSTURES[1], 6.0), feedback_cb=moved.append)
        self.wait_for(lambda: moved and moved[-1].time_left < 4.0, 'a third of the way')
        client.cancel_goal()
        self.assertEqual(self.ended(client), GoalStatus.PREEMPTED)
        self.simulate(1.0)
        self.assertEqual(set(self.muscles[-1].mode), {3})
        start = self.shoulder[-1][1]
        self.assertLess(max(angle(start, q) for q in self.simulate(2.0)), 2.0)
        client.send_goal(self.goal_of(POSTURES[1], 6.0))
        self.wait_for(lambda: client.get_state() == GoalStatus.ACTIVE, 'another way')
        self.assertTrue(self.zero_gravity().success)
        self.assertEqual(self.ended(client), GoalStatus.ABORTED)
        self.assertIn('another request', client.get_result().message)

    def test_refuses_nonsense(self):
        cases = [
            (dict(joint_name=['knee'], joint_position=[0.0], duration=1.0), 'knee'),
            (dict(joint_name=['elbow'], joint_position=[NAN], duration=1.0), 'finite'),
            (dict(joint_name=['elbow'], joint_position=[3.0], duration=1.0), 'limits'),
            (dict(joint_name=['elbow'], joint_position=[], duration=1.0), 'differ'),
            (dict(ball_joint_name=['shoulder'], ball_joint_orientation=[Quaternion()], duration=1.0), 'quaternion'),
            (dict(duration=0.0), 'duration'),
        ]
        for fields, word in cases:
            answer = self.go_to(GoToRequest(**fields))
            self.assertFalse(answer.success)
            self.assertIn(word, answer.message)


if __name__ == '__main__':
    rospy.init_node('computed_force_test')
    rostest.rosrun('anthrob_tests', 'computed_force', ComputedForce)
