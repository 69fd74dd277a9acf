#!/usr/bin/env python3
"""What scripts/mocap_rest.py finds in recordings of a ball joint whose mounts are known."""
import math
import os
import shutil
import subprocess
import tempfile
import unittest

import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
SCRIPT = os.path.join(TOP, 'scripts', 'mocap_rest.py')
HEADER = ['t'] + [target + '/' + column for target in ('trunk', 'arm')
                  for column in ('valid', 'x', 'y', 'z', 'qw', 'qx', 'qy', 'qz', 'rms')]
ONE = [1.0, 0.0, 0.0, 0.0]


def mul(a, b):
    w, x, y, z = a
    return [w * b[0] - x * b[1] - y * b[2] - z * b[3], w * b[1] + x * b[0] + y * b[3] - z * b[2],
            w * b[2] - x * b[3] + y * b[0] + z * b[1], w * b[3] + x * b[2] - y * b[1] + z * b[0]]


def inv(q):
    return [q[0], -q[1], -q[2], -q[3]]


def about(axis, degrees):
    length = math.hypot(*axis)
    half = math.radians(degrees) / 2
    return [math.cos(half)] + [math.sin(half) * x / length for x in axis]


# The truth, as docs/mocap.md names it: rpy of the floating joint's origin, mounts, camera in the link of the trunk.
RPY = [0.3, -0.2, 1.1]
ROLL, PITCH, YAW = [about(axis, math.degrees(angle)) for axis, angle in zip(([1, 0, 0], [0, 1, 0], [0, 0, 1]), RPY)]
ORIGIN = mul(YAW, mul(PITCH, ROLL))
MOUNT, CHILD_MOUNT = about([1, 2, -1], 7.0), about([-2, 1, 3], 11.0)
REST = mul(inv(MOUNT), ORIGIN)
CAMERA, CAMERA_POSITION, MOUNT_POSITION = about([1, -1, 1], 120.0), [0.4, -1.2, 0.3], [0.01, 0.02, -0.03]


class MocapRest(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def record(self, name, joint, unseen=False, mount=MOUNT, child_mount=CHILD_MOUNT, swing=0.0, sway=0.0):
        """Pairs of a joint that holds still but for noise that cancels; signs of quaternions as they come.
        swing: by how many degrees the joint turns, sway: by how many m the trunk moves, meanwhile
        """
        trunk = mul(inv(CAMERA), mount)
        apart = [0.0] + [a - b for a, b in zip(MOUNT_POSITION, CAMERA_POSITION)]
        place = mul(mul(inv(CAMERA), apart), CAMERA)[1:]
        lines = [HEADER]
        for i in range(12):
            noise = about([[1, 0, 0], [0, 1, 0], [0, 0, 1]][i // 2 % 3], 0.05 if i % 2 else -0.05)
            swung = mul(joint, about([0, 0, 1], swing * i / 11))
            q = mul(mul(mul(mul(trunk, mul(inv(mount), ORIGIN)), swung), child_mount), noise)
            arm = [1, 0.1, 0.2, 1.5, *[(-x if i % 4 == 1 else x) for x in q], 1e-4]
            if unseen or i == 5:
                arm = [0] + [''] * 8
            lines.append([0.1 * i, 1, place[0] + sway * i / 11, *place[1:], *trunk, 1e-4, *arm])
        with open(self.path(name), 'w') as file:
            file.write(''.join(','.join(str(cell) for cell in line) + '\n' for line in lines))
        return self.path(name)

    def run_script(self, *arguments):
        return subprocess.run([SCRIPT, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def results(self, *arguments):
        done = self.run_script(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        lines = [line for line in done.stdout.splitlines() if not line.startswith('#')]
        pairs = [line.split(': ') for line in lines]
        return {key: [float(x) for x in text.strip('[]').split(',')] for key, text in pairs}

    def refuse(self, expected, *arguments):
        done = self.run_script(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
        self.assertTrue(done.stderr.startswith('mocap_rest.py: '), done.stderr)
        self.assertIn(expected, done.stderr)

    def expect_same(self, found, expected, tolerance=1e-4):
        distance = min(max(abs(sign * x - y) for x, y in zip(found, expected)) for sign in (1, -1))
        self.assertLess(distance, tolerance, '%s, expected %s' % (found, expected))

    def test_a_robot_that_moved_is_refused(self):
        expected = 'expected a recording in which both hold still'
        self.refuse(expected, self.record('swing.csv', ONE, swing=5.0))
        self.refuse(expected, self.record('sway.csv', ONE, sway=0.05))
        self.assertEqual(self.run_script(self.record('rest.csv', ONE, swing=0.3, sway=0.003)).returncode, 0)

    def test_two_turns_find_all_mounts(self):
        rest = self.record('rest.csv', ONE)
        one = self.record('one.csv', about([0, 0, 1], 40.0))
        two = self.record('two.csv', about([-1, 0.2, -0.001], 36.0))
        found = self.results(rest, '--turn', one, 0, 0, 2, '--turn', two, -1, 0.2, '-1e-3',
                             '--origin-rpy', *RPY, '--position', *MOUNT_POSITION)
        self.expect_same(found['rest'], REST)
        self.expect_same(found['child_mount, mounts.arm.orientation'], CHILD_MOUNT)
        self.expect_same(found['mounts.trunk.orientation'], MOUNT)
        self.expect_same(found['camera.orientation'], CAMERA)
        for x, y in zip(found['camera.position'], CAMERA_POSITION):
            self.assertAlmostEqual(x, y, delta=3e-4)
        self.assertTrue(all(q[0] >= 0 for key, q in found.items() if key != 'camera.position'))

    def test_rest_alone_uses_the_mounts_as_given(self):
        rest = self.record('rest.csv', ONE)
        found = self.results(rest, '--mount', *MOUNT, '--child-mount', *CHILD_MOUNT, '--position', *MOUNT_POSITION)
        self.expect_same(found['rest'], REST)
        self.expect_same(found['mounts.trunk.orientation'], MOUNT)
        self.expect_same(found['camera.orientation'], CAMERA)
        identity = self.results(self.record('plain.csv', ONE, mount=ONE, child_mount=ONE))
        self.expect_same(identity['rest'], ORIGIN)
        self.expect_same(identity['mounts.trunk.orientation'], ONE)

    def test_turns_that_say_nothing_are_refused(self):
        rest = self.record('rest.csv', ONE)
        z = self.record('z.csv', about([0, 0, 1], 40.0))
        x = self.record('x.csv', about([1, 0, 0], 40.0))
        slight = self.record('slight.csv', about([1, 0, 0], 1.0))
        half = self.record('half.csv', about([1, 0, 0], 179.0))
        turn_z = ['--turn', z, 0, 0, 1]
        self.refuse('expected two turns or more', rest, *turn_z)
        self.refuse('expected two turns or more', rest, *turn_z, *turn_z)
        self.refuse('expected two turns or more', rest, *turn_z, '--turn', z, 1, 0, 0)
        self.refuse('slight.csv: the child turned by 1.0 degrees', rest, *turn_z, '--turn', slight, 1, 0, 0)
        self.refuse('half.csv: the child turned by 179.0 degrees', rest, *turn_z, '--turn', half, 1, 0, 0)
        self.refuse('check the axes and their signs', rest, *turn_z, '--turn', x, 1, 0, 1.5)
        self.refuse('expected the axis as three numbers, not all 0', rest, *turn_z, '--turn', x, 0, 0, 0)
        self.refuse('expected the axis as three numbers, not all 0', rest, *turn_z, '--turn', x, 1, 'y', 0)

    def test_bad_files_are_refused_in_one_line(self):
        rest = self.record('rest.csv', ONE)
        self.refuse('nowhere.csv: cannot be read', self.path('nowhere.csv'))
        self.refuse('cannot be read', self.folder)
        self.refuse('unseen.csv: none of the 12 pairs shows both targets, trunk and arm',
                    self.record('unseen.csv', ONE, unseen=True))
        self.refuse('no target humerus; set --child to one of: trunk, arm', rest, '--child', 'humerus')
        with open(rest) as file:
            good = file.read()
        for text, expected in (
                ('', 'expected a CSV file written by anthrob_mocap_offline'),
                ('index,t\n0,1\n', 'expected a CSV file written by anthrob_mocap_offline'),
                (good.replace('arm/qz', 'arm/q'), 'no column arm/qz'),
                (good.replace('0.1,0.2,1.5', '0.1,0.2,1.5,oops', 1), ":2: arm/qw: expected a number, not 'oops'"),
                (good.replace('0.1,0.2,1.5', '0.1,0.2,1.5,7', 1), ':2: arm/qw, qx, qy, qz: expected a unit quaternion'),
                (good.splitlines()[0] + '\n0,1,0,0,1,1,0,0,0,0,1,0,0\n', ":2: arm/qw: expected a number, not ''")):
            with open(self.path('bad.csv'), 'w') as file:
                file.write(text)
            self.refuse(expected, self.path('bad.csv'))
        with open(self.path('binary.csv'), 'wb') as file:
            file.write(bytes(range(256)))
        self.refuse('binary.csv: expected a CSV file', self.path('binary.csv'))

    def test_bad_arguments_are_refused_in_one_line(self):
        rest = self.record('rest.csv', ONE)
        self.refuse('arguments are required: REST.csv')
        self.refuse('--turn: expected 4 arguments', rest, '--turn', rest, 1)
        self.refuse('--mount: expected a unit quaternion', rest, '--mount', 1, 1, 0, 0)
        self.refuse('--origin-rpy: expected finite numbers', rest, '--origin-rpy', 'nan', 0, 0)
        self.refuse('expected two different targets', rest, '--child', 'trunk')
        done = self.run_script('--help')
        self.assertEqual(done.returncode, 0)
        for word in '--turn', '--origin-rpy', '--position', '--mount', '--child-mount', '--parent':
            self.assertIn(word, done.stdout)


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'mocap_rest', MocapRest)
