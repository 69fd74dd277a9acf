#!/usr/bin/env python3
"""anthrob_discover with files named as seen from where it was started: a driven axis with dry friction."""
import json
import math
import os
import shutil
import subprocess
import tempfile
import unittest

import rostest

MASS, VISCOUS, COULOMB = 95.1089, 203.5, 20.4  # of config/driven_axis, and what its model lacks


def record(folder, second):
    """Five seconds of an axis held by a spring under two frequencies of force."""
    os.makedirs(folder)
    position, velocity, step = 0.1, 0.0, 1e-4
    with open(os.path.join(folder, 'meta.yaml'), 'w') as file:
        file.write('robot: driven_axis\n')
    with open(os.path.join(folder, 'joints.csv'), 'w') as file:
        file.write('t,axis/position,axis/effort\n')
        for k in range(50000):
            t = 1e-3 * (k // 10)
            if k % 10 == 0:
                effort = 70 * math.sin(1.7 * t) + 35 * math.sin(second * t) - 2000 * (position - 0.1)
                file.write('%.3f,%.9f,%.6f\n' % (t, position, effort))
            drive = effort - VISCOUS * velocity
            sticks = velocity == 0.0 and abs(drive) < COULOMB
            friction = drive if sticks else math.copysign(COULOMB, velocity or drive)
            after = velocity + step / MASS * (drive - friction)
            velocity = 0.0 if after * velocity < 0.0 and abs(drive) < COULOMB else after
            position += step * velocity


class Discover(unittest.TestCase):

    def setUp(self):
        self.folder = os.path.join(tempfile.mkdtemp(), 'my recordings')
        self.addCleanup(shutil.rmtree, os.path.dirname(self.folder))
        record(os.path.join(self.folder, 'one'), 2.9)
        record(os.path.join(self.folder, 'two'), 4.3)

    def discover(self, *arguments):
        package = subprocess.check_output(['rospack', 'find', 'anthrob_bringup'], text=True).strip()
        return subprocess.run(
            ['rosrun', 'anthrob_discovery', 'anthrob_discover', '--model', package + '/config/driven_axis/model_I.yaml',
             '--train', 'one', '--test', 'two', '--out', 'found', '--jobs', '2',
             '--effects', 'joint_coulomb,joint_offset_torque', *arguments],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100)

    def test_from_a_folder_with_a_space(self):
        done = self.discover()
        self.assertEqual(done.returncode, 0, done.stdout)
        with open(os.path.join(self.folder, 'found', 'report.json')) as file:
            answer = json.load(file)
        self.assertEqual(answer['effects'][0]['id'], 'joint_coulomb', done.stdout)

    def test_wrong_options_are_refused(self):
        for option, value, complaint in [('--calibration', 'nowhere.yaml', 'nowhere.yaml: '), ('--seed', 'many', '--seed'),
                                         ('--close-the-loop', 'no_robot.yaml', 'no_robot.yaml: ')]:
            done = self.discover(option, value)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(complaint, done.stdout)


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'discover', Discover)
