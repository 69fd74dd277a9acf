#!/usr/bin/env python3
"""anthrob_new: each kind of folder loads, moves as its equations say, takes recordings, and is found by the launch file."""
import csv
import math
import os
import subprocess
import tempfile
import unittest

import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
KINDS = {'hinge': ['hinge'], 'servo': ['hinge'], 'slide': ['slide'], 'tendon': ['hinge'], 'arm': ['shoulder', 'elbow']}


def program(package, name):
    return subprocess.check_output(['catkin_find', '--first-only', '--libexec', package, name], text=True).strip()


class NewRobot(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_tool(self, package, name, *words):
        return subprocess.run([program(package, name), *words], cwd=self.folder.name, text=True, timeout=60,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def must(self, package, name, *words):
        done = self.run_tool(package, name, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def make(self, kind):
        self.must('anthrob_sim', 'anthrob_new', '--' + kind, 'my_' + kind)

    def record(self, kind, rows):
        """A recording as a user's program writes it, in the columns that the folder expects. @param rows: {from: [...]}"""
        with open(self.path('run.csv'), 'w') as out:
            table = csv.writer(out)
            table.writerow(rows)
            table.writerows(zip(*rows.values()))
        self.must('anthrob_recording', 'anthrob_convert', '--columns', 'my_%s/columns.yaml' % kind, 'run.csv', 'set')

    def replay(self, kind, *options):
        self.must('anthrob_sim', 'anthrob_replay', '--model', 'my_%s/model_I.yaml' % kind, '--in', 'set', '--out', 'out', *options)
        with open(self.path('out', 'joints.csv')) as file:
            rows = list(csv.DictReader(file))
        return {name: [float(row[name]) for row in rows if row[name]] for name in rows[0]}

    def test_a_slide_moves_as_its_mass_and_friction_say(self):
        self.make('slide')
        times = [0.01 * i for i in range(201)]
        self.record('slide', {'t [s]': times, 'position [mm]': [0.0] * 201, 'current [A]': [0.05] * 201})
        joints = self.replay('slide')
        mass, viscous, force = 2.0, 5.0, 0.05 * 20.0  # [kg, Ns/m, N] of the files
        for t, x in list(zip(joints['t'], joints['slide/position']))[20::50]:
            expected = force / viscous * (t - mass / viscous * (1.0 - math.exp(-viscous / mass * t)))
            self.assertAlmostEqual(x, expected, delta=0.01 * expected + 1e-5)

    def test_a_hinge_stays_where_gravity_and_torque_agree(self):
        self.make('hinge')
        rest = math.asin(0.5 * 0.5 / (0.5 * 9.81 * 0.15))  # torque over weight times lever, of the files
        self.record('hinge', {'t [s]': [0.01 * i for i in range(301)], 'angle [deg]': [math.degrees(rest)] * 301,
                              'current [A]': [0.5] * 301})
        position = self.replay('hinge')['hinge/position']
        self.assertAlmostEqual(max(position), rest, delta=1e-3)
        self.assertAlmostEqual(min(position), rest, delta=1e-3)

    def test_a_servo_stops_where_its_gain_carries_the_arm(self):
        self.make('servo')
        self.record('servo', {'t [s]': [0.01 * i for i in range(401)], 'angle [deg]': [''] * 401,
                              'goal [deg]': [0.0] * 20 + [60.0] * 381, 'motor [deg]': [''] * 401,
                              'voltage [V]': [''] * 401, 'current [A]': [''] * 401})
        position = self.replay('servo', '--mode', 'reference')['hinge/position']
        # Of the files: gain 40 V/rad, 6 ohm, 0.01 Nm/A, ratio 225, efficiency 0.8 against gravity.
        goal, end = math.radians(60.0), position[-1]
        torque = 0.5 * 9.81 * 0.15 * math.sin(end)
        self.assertAlmostEqual(position[0], 0.0, delta=1e-6)
        self.assertGreater(end, goal - torque / 0.8 / (0.01 * 225.0) * 6.0 / 40.0 - 1e-3)  # rising
        self.assertLess(end, goal - torque * 0.8 / (0.01 * 225.0) * 6.0 / 40.0 + 1e-3)  # held by the gear after overshoot

    def test_muscles_pull(self):
        for kind, muscles, moved in (('tendon', ['flexor', 'extensor'], 'hinge'),
                                     ('arm', ['shoulder_flexor', 'shoulder_extensor', 'elbow_flexor', 'elbow_extensor'], 'elbow')):
            with self.subTest(kind):
                self.make(kind)
                told = self.must('anthrob_sim', 'anthrob_muscles', '--model', 'my_%s/model_I.yaml' % kind)
                rows = {'t [s]': [0.01 * i for i in range(201)]}
                for joint in KINDS[kind]:
                    rows[joint + ' [deg]'] = [0.0] * 201
                for muscle in muscles:
                    self.assertRegex(told, muscle + r' +[\d.]+ +3\.\d+ +(4\.9|5\.0)')  # 5 N at rest
                    pull = 3.0 if muscle in (muscles[-2],) else -1.0 if muscle == muscles[-1] else 0.0
                    rows[muscle + ' reference [rad]'] = [0.0] * 50 + [pull] * 151
                    rows[muscle + ' position [rad]'] = rows[muscle + ' force [N]'] = [''] * 201
                self.record(kind, rows)
                position = self.replay(kind, '--mode', 'reference')[moved + '/position']
                self.assertLess(abs(position[0]), 0.02)
                self.assertGreater(position[-1], 0.2)

    def test_the_arm_is_that_of_the_tutorial(self):
        self.make('arm')
        with open(os.path.join(TOP, 'docs', 'your_robot.md')) as page:
            text = page.read()
        for file in ('robot.urdf', 'model_I.yaml', 'calibration.yaml'):
            with open(self.path('my_arm', file)) as made:
                self.assertIn(made.read(), text, file)

    def test_launch_files_take_it(self):
        for kind in ('slide', 'servo', 'arm'):  # without muscles, with a drive, with muscles
            self.make(kind)
            done = subprocess.run(['roslaunch', 'anthrob_bringup', 'sim.launch', 'robot:=my_' + kind, 'model:=I',
                                   'robot_folder:=' + self.path('my_' + kind), '--nodes'], text=True, timeout=60,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertIn('/my_%s/simulator' % kind, done.stdout, done.stderr)

    def test_what_is_wrong_is_said_in_one_line(self):
        self.make('hinge')
        for words, said in ((['--slide', 'my_hinge'], 'my_hinge: is there already; expected the name of a new folder'),
                            (['--slide', 'My-Axis'], 'NAME: My-Axis: expected lower-case letters'),
                            (['--slide', 'nowhere/axis'], 'nowhere: no such folder'),
                            (['--slide'], 'required: NAME'), (['axis'], 'one of the arguments --hinge --slide'),
                            (['--slide', '--arm', 'axis'], 'not allowed with argument')):
            done = self.run_tool('anthrob_sim', 'anthrob_new', *words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count('\n'), 1, done.stderr)
        self.assertEqual(os.listdir(self.folder.name), ['my_hinge'])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'new_robot', NewRobot)
