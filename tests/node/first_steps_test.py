#!/usr/bin/env python3
"""The commands of docs/start.md, word by word, and the numbers that the page gives."""
import glob
import math
import os
import re
import signal
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from anthrob_msgs.msg import MuscleStates, SphericalJointStates
from documents_test import TOP, prose_and_blocks, read
from waiting import wait_for


def blocks_of(page):
    """The blocks of commands of each section, by its heading."""
    sections = re.split(r'^## (.*)\n', page, flags=re.MULTILINE)[1:]
    return {title: [lines for _, lines in prose_and_blocks('\n' + body)[1]] for title, body in zip(sections[::2], sections[1::2])}


def angle_of(joints):
    return math.degrees(2.0 * math.acos(min(1.0, abs(joints.orientation[0].w))))


class FirstSteps(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        os.symlink(os.path.join(TOP, 'config'), os.path.join(self.folder, 'config'))
        self.page = read('docs/start.md')
        self.blocks = blocks_of(self.page)
        self.force = self.angle = math.nan  # [N, deg]
        self.seen = 0.0  # [s]
        self.stopped = []  # (time since the unit left ENABLED [s], force [N])
        self.left_enabled = None  # [s]
        rospy.Subscriber('/anthrob/muscle_states', MuscleStates, self.see)
        rospy.Subscriber('/anthrob/spherical_joint_states', SphericalJointStates, self.see_shoulder)

    def see(self, states):
        deltoid = states.name.index('lateral_deltoid')
        self.force, self.seen = states.force[deltoid], states.header.stamp.to_sec()
        if states.ecu_state[deltoid] == MuscleStates.ENABLED:
            self.left_enabled, self.stopped = None, []
        else:
            self.left_enabled = self.left_enabled or self.seen
            self.stopped.append((self.seen - self.left_enabled, self.force))

    def see_shoulder(self, joints):
        self.angle = angle_of(joints)

    def wait_until(self, time, what):
        wait_for(lambda: self.seen >= time, 60.0, what)

    def start(self, block):
        shell = subprocess.Popen(['bash', '-e', '-c', '\n'.join(block)], cwd=self.folder, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, universal_newlines=True, start_new_session=True)
        self.addCleanup(shell.communicate)
        self.addCleanup(lambda: os.killpg(shell.pid, signal.SIGINT))
        return shell

    def run_all(self, block):
        done = subprocess.run(['bash', '-e', '-c', '\n'.join(block)], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, timeout=120)
        lines = done.stdout.splitlines()
        self.assertEqual(done.returncode, 0, '\n'.join(lines[-1:] + lines))  # why it failed comes last; some see one line only
        return done.stdout

    def told(self, pattern):
        found = re.search(pattern, self.page)
        self.assertTrue(found, pattern)
        return [float(number) for number in found.groups()]

    def test_as_they_stand(self):
        wait_for(lambda: not math.isnan(self.force), 30.0, 'the simulator')
        moving, = self.blocks['Move a muscle and record']
        self.start(moving)
        bag = os.path.join(self.folder, 'run.bag')
        wait_for(lambda: os.path.exists(bag), 40.0, 'the recording')
        self.check_motion(bag)
        self.check_stop(*self.blocks['Inspect, stop and step the robot'])
        converted = self.run_all(self.blocks['Convert and replay the recording'][0])
        self.assertIn('lateral_deltoid', converted)  # of anthrob_muscles
        for name in 'run/commands.csv', 'run/muscles.csv', 'replayed/muscles.csv', 'figures/*.svg':
            self.assertTrue(glob.glob(os.path.join(self.folder, name)), name)

    def check_motion(self, bag):
        """Degrees so long after the first command, as recorded and, later, as seen."""
        begun, angles = None, []
        with rosbag.Bag(bag) as recording:
            for topic, message, arrived in recording.read_messages():
                if topic.endswith('muscle_command'):  # rostopic stamps nothing
                    begun = begun or arrived.to_sec()
                elif topic.endswith('spherical_joint_states') and begun:
                    angles.append((message.header.stamp.to_sec() - begun, angle_of(message)))
        angle, after, later_angle, later = self.told(r'from (\d+) degrees after\s+(\d+) s to (\d+) degrees after (\d+) s')
        self.assertGreater(angles[-1][0], after)
        self.assertAlmostEqual(min(angles, key=lambda a: abs(a[0] - after))[1], angle, delta=1.0)
        self.wait_until(begun + later, 'the arm to creep on')
        self.assertAlmostEqual(self.angle, later_angle, delta=1.0)

    def check_stop(self, block):
        before, after, seconds = self.told(r'(\d+) N become (\d+) N in (\d+) s')
        text = '\n'.join(block)
        stop = text.index('rosservice call /anthrob/clear_faults')
        self.assertAlmostEqual(self.force, before, delta=8.0)
        self.run_all(text[:stop].splitlines())
        # From the stop on, however long the commands take on a busy machine.
        wait_for(lambda: self.stopped and self.stopped[-1][0] >= seconds, 60.0, 'the tendon to give way')
        self.assertAlmostEqual(min(self.stopped, key=lambda seen: abs(seen[0] - seconds))[1], after, delta=8.0)
        said = self.run_all(text[stop:].splitlines())
        self.assertEqual(said.count('success: True'), 5, said)


if __name__ == '__main__':
    rospy.init_node('first_steps')
    rostest.rosrun('anthrob_tests', 'first_steps', FirstSteps)
