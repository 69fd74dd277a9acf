#!/usr/bin/env python3
"""What scripts/mocap_agreement.py says of a measured joint that equals the simulated one."""
import math
import os
import shutil
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from anthrob_msgs.msg import SphericalJointStates
from geometry_msgs.msg import Quaternion

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
SCRIPT = os.path.join(TOP, 'scripts', 'mocap_agreement.py')


def joint(t):
    """Turned to and fro, once in 4 s, by up to 0.5 rad."""
    half = 0.25 * math.sin(0.5 * math.pi * t)
    message = SphericalJointStates(name=['shoulder'], orientation=[Quaternion(w=math.cos(half), x=math.sin(half))])
    message.header.stamp = rospy.Time.from_sec(10.0 + t)
    return message


class MocapAgreement(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def say(self, is_simulated, status=0):
        """What it says of 4 s at 60 Hz, with the simulated states at 100 Hz for which is_simulated(t) is true."""
        bag = os.path.join(self.folder, 'run.bag')
        with rosbag.Bag(bag, 'w') as out:
            for topic, times in (('/robot/spherical_joint_states', [i / 60.0 for i in range(1, 239)]),
                                 ('/robot/sim/spherical_joint_states',
                                  [t for t in (i / 100.0 for i in range(401)) if is_simulated(t)])):
                for t in times:
                    out.write(topic, joint(t), t=joint(t).header.stamp)
        done = subprocess.run([SCRIPT, bag], stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout + done.stderr

    def worst(self, said):
        return float(said.split(' worst ')[1].split()[0])

    def test_without_gaps_nothing_is_left_out(self):
        said = self.say(lambda t: True)
        self.assertNotIn('left out', said)
        self.assertLess(self.worst(said), 0.01)

    def test_a_few_lost_states_are_interpolated(self):
        said = self.say(lambda t: not 1.005 < t < 1.035)
        self.assertNotIn('left out', said)
        self.assertLess(self.worst(said), 0.05)

    def test_a_gap_of_a_second_is_left_out(self):
        said = self.say(lambda t: not 1.005 < t < 1.995)
        self.assertIn('60 of 238 measurements left out', said)
        self.assertLess(self.worst(said), 0.01)

    def test_a_single_simulated_state_is_refused(self):
        self.assertIn('shoulder: expected two measurements or more', self.say(lambda t: t == 2.0, status=2))


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'mocap_agreement', MocapAgreement)
