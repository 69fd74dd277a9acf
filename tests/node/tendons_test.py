#!/usr/bin/env python3
"""Tendons of a robot are drawn where its measured joints put them, and not where they were."""
import math
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MusclePaths, MuscleStates, TendonPaths
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray
from waiting import wait_for

ANGLE = 0.6  # [rad]


class Tendons(unittest.TestCase):

    def setUp(self):
        self.drawn, self.told, self.carried = [], [], []
        rospy.Subscriber('muscle_paths', MarkerArray, self.drawn.append)
        rospy.Subscriber('solved_paths', MusclePaths, self.told.append)
        rospy.Subscriber('tendon_paths', TendonPaths, self.carried.append)
        self.joints = rospy.Publisher('joint_states', JointState, queue_size=1)
        self.muscles = rospy.Publisher('muscle_states', MuscleStates, queue_size=1)
        end = time.time() + 20
        while not (self.joints.get_num_connections() and self.muscles.get_num_connections()):
            self.assertLess(time.time(), end)
            time.sleep(0.05)

    def measure(self, angle, forces, ahead=0.0):
        stamp = rospy.Time.now() + rospy.Duration(ahead)
        joint = JointState(name=['hinge'], position=[angle])
        joint.header.stamp = stamp
        if forces:
            states = MuscleStates(name=['flexor', 'extensor'], force=forces)
            states.header.stamp = stamp
            self.muscles.publish(states)
        self.joints.publish(joint)
        return stamp

    def see(self, angle, forces, good):
        """The first markers that are `good`, while this is measured."""
        end = time.time() + 20
        while time.time() < end:
            stamp = self.measure(angle, forces)
            time.sleep(0.05)
            if self.drawn and good(self.drawn[-1].markers):
                self.assertLessEqual(self.drawn[-1].markers[0].header.stamp, stamp)
                return self.drawn[-1].markers
        self.fail('not drawn: %s' % self.drawn[-1:])

    def test_surfaces_are_sent_again(self):
        """For an RViz that did not know their frames at first."""
        seen = []
        rospy.Subscriber('wrapping_surfaces', MarkerArray, seen.append)
        wait_for(lambda: len(seen) > 1, 15, 'the surfaces once more')
        self.assertEqual(seen[0], seen[1])

    def test_where_joints_are_measured_and_only_while_they_are(self):
        time.sleep(0.5)
        self.assertFalse(self.drawn)  # nothing is known yet

        # The hinge, half a metre up, turns about -y: the flexor's end is at (0.02, 0, -0.08) of the arm.
        c, s = math.cos(ANGLE), math.sin(ANGLE)
        x, z = 0.02 * c + 0.08 * s, 0.5 + 0.02 * s - 0.08 * c
        near = lambda markers: abs(markers[0].points[-1].x - x) < 1e-6 and abs(markers[0].points[-1].z - z) < 1e-6
        flexor, extensor = self.see(ANGLE, [40.0, math.nan], near)
        self.assertEqual((flexor.ns, extensor.ns), ('flexor', 'extensor'))
        self.assertGreater(flexor.color.r, 0.9)                                                  # taut: red
        self.assertEqual(extensor.color.r, extensor.color.b)                                     # not measured: grey
        self.assertGreater(flexor.lifetime.to_sec(), 0.0)
        self.see(-ANGLE, [40.0, 0.0], lambda markers: markers[0].points[-1].x < 0.0 and markers[1].color.b > 0.9)

        # Forces that are not measured any more are not shown.
        self.see(ANGLE, None, lambda markers: markers[0].color.r == markers[0].color.b)

        # Numbers are those of the picture; what nobody measured is not a number.
        self.see(ANGLE, [40.0, 0.2], near)
        wait_for(lambda: self.measure(ANGLE, [40.0, 0.2]) and self.told and self.told[-1].muscles[1].slack, 20, 'lengths')
        path, points = self.told[-1].muscles[0], self.drawn[-1].markers[0].points
        drawn = sum(math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)) for a, b in zip(points, points[1:]))
        self.assertEqual(path.name, 'flexor')
        self.assertAlmostEqual(path.length, drawn, delta=1e-4)
        self.assertFalse(path.slack)
        self.assertTrue(math.isnan(path.velocity) and math.isnan(path.spring_expansion))

        # By link, a point stays where it is; a tendon is slack where its force is small.
        flexor, extensor = self.carried[-1].muscles
        self.assertEqual((flexor.link[0], flexor.link[-1], extensor.link[-1]), ('world', 'arm', 'arm'))
        end = flexor.point[-1]
        self.assertLess(math.dist((end.x, end.y, end.z), (0.02, 0.0, -0.08)), 1e-9)
        self.assertEqual((flexor.force, flexor.slack, extensor.slack), (40.0, False, True))

        # Half a second later the robot may be anywhere.
        time.sleep(1.0)
        count = len(self.drawn)
        time.sleep(0.5)
        self.assertEqual(len(self.drawn), count)

        # Nor says a stamp that is far ahead where it is now.
        for _ in range(10):
            self.measure(ANGLE, [40.0, 0.0], ahead=30.0)
            time.sleep(0.05)
        self.assertEqual(len(self.drawn), count)
        self.see(ANGLE, [40.0, 0.0], near)


if __name__ == '__main__':
    rospy.init_node('tendons_drawn')
    rostest.rosrun('anthrob_tests', 'tendons_drawn', Tendons)
