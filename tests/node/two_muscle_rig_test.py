#!/usr/bin/env python3
"""Another robot in the same node, as fast as possible: nothing of Anthrob is built in."""
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState


class TwoMuscleRig(unittest.TestCase):

    def test_swings_both_ways(self):
        joints, states, clock = [], [], []
        rospy.Subscriber('joint_states', JointState, joints.append)
        rospy.Subscriber('muscle_states', MuscleStates, states.append)
        rospy.Subscriber('/clock', Clock, clock.append)
        command = rospy.Publisher('muscle_command', MuscleCommand, queue_size=1)
        self.wait_until(lambda: joints and states and clock and command.get_num_connections() > 0)
        self.assertEqual(states[-1].name, ['flexor', 'extensor'])
        self.assertEqual(joints[-1].name, ['hinge'])

        def pull(flexor, extensor):
            # Without a time limit for commands one is enough, however fast simulated time runs.
            command.publish(MuscleCommand(name=['flexor', 'extensor'], mode=[1, 1],
                                          reference=[flexor, extensor]))
            self.wait_until(lambda: list(states[-1].reference) == [flexor, extensor])
            start = clock[-1].clock
            self.wait_until(lambda: (clock[-1].clock - start).to_sec() >= 4.0)
            arrived = len(joints)
            self.wait_until(lambda: len(joints) > arrived)
            return joints[-1].position[0]

        self.assertGreater(pull(3.0, -2.0), 0.2)
        self.assertLess(pull(-2.0, 3.0), -0.2)

    def wait_until(self, condition):
        end = time.time() + 30
        while not condition():
            self.assertLess(time.time(), end)
            time.sleep(0.005)


if __name__ == '__main__':
    rospy.init_node('two_muscle_rig_test')
    rostest.rosrun('anthrob_tests', 'two_muscle_rig', TwoMuscleRig)
