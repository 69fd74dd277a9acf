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

    def test_swings_both_ways_faster_than_real_time(self):
        joints, states, clock = [], [], []
        rospy.Subscriber('joint_states', JointState, joints.append)
        rospy.Subscriber('muscle_states', MuscleStates, states.append)
        rospy.Subscriber('/clock', Clock, clock.append)
        command = rospy.Publisher('muscle_command', MuscleCommand, queue_size=1)
        end = time.time() + 30
        while time.time() < end and (not joints or not states or command.get_num_connections() == 0):
            time.sleep(0.02)
        self.assertEqual(states[-1].name, ['flexor', 'extensor'])
        self.assertEqual(joints[-1].name, ['hinge'])

        def pull(flexor, extensor):
            start = clock[-1].clock
            while (clock[-1].clock - start).to_sec() < 4.0:
                command.publish(MuscleCommand(name=['flexor', 'extensor'], mode=[1, 1],
                                              reference=[flexor, extensor]))
                time.sleep(0.005)
            return joints[-1].position[0]

        wall = time.time()
        forward = pull(3.0, -2.0)
        backward = pull(-2.0, 3.0)
        self.assertLess(time.time() - wall, 8.0)
        self.assertGreater(forward, 0.2)
        self.assertLess(backward, -0.2)


if __name__ == '__main__':
    rospy.init_node('two_muscle_rig_test')
    rostest.rosrun('anthrob_tests', 'two_muscle_rig', TwoMuscleRig)
