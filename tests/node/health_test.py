#!/usr/bin/env python3
"""The test of tendons on a simulated robot, in lock-step: what it writes, when it begins, and when it ends early."""
import csv
import json
import os
import shutil
import subprocess
import tempfile
import threading
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, SphericalJointStates
from anthrob_msgs.srv import ApplyWrench, SetState
from geometry_msgs.msg import Vector3
from std_srvs.srv import Trigger

PATIENCE = 150  # [s] of wall time, on a machine that does other things


class Health(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('health_test')
        for service in 'sim/reset', 'enable', 'sim/apply_wrench', 'sim/set_state':
            rospy.wait_for_service(service, 30)

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.assertTrue(rospy.ServiceProxy('sim/reset', Trigger)().success)
        self.assertTrue(rospy.ServiceProxy('enable', Trigger)().success)

    def run_test(self, *options):
        return subprocess.run(
            ['rosrun', 'anthrob_calib', 'anthrob_health_test', '__ns:=/anthrob', '_model:=anthrob/II',
             '_out:=' + self.folder, '_lock_step:=true', *options],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)

    def read(self, name):
        with open(os.path.join(self.folder, name)) as file:
            return file.read()

    def test_figures_are_those_of_the_robot_and_are_kept(self):
        turns = []
        rospy.Subscriber('spherical_joint_states', SphericalJointStates,
                         lambda m: turns.append(abs(m.orientation[0].w)), queue_size=10000)
        done = self.run_test()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('11 tendons: test 1 of the 5', done.stdout)
        rows = list(csv.DictReader(self.read('health.csv').splitlines()))
        self.assertEqual(len(rows), 11 * 8)
        value = {(row['muscle'], row['quantity']): float(row['value']) for row in rows}
        self.assertAlmostEqual(value['brachialis', 'resistance'], 4.81, delta=0.4)
        self.assertAlmostEqual(value['lateral_deltoid', 'force_offset'], 0.0, delta=0.2)
        self.assertGreater(value['biceps_brachii', 'stiffness'], 1000.0)
        self.assertGreater(min(turns), 0.9998)  # cos of half of 2 degrees
        report = json.loads(self.read('health.json'))
        self.assertEqual(len(report['tendons']), 11)
        self.assertIn('<h1>11 tendons', self.read('health.html'))
        # What was recorded gives the same figures again.
        again = os.path.join(self.folder, 'again')
        judged = subprocess.run(
            ['rosrun', 'anthrob_calib', 'anthrob_health', 'judge', '--model', 'anthrob/II', '--in',
             os.path.join(self.folder, 'last_test'), '--history', again, '--time', '2026-12-01'],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(judged.returncode, 0, judged.stdout)
        with open(os.path.join(again, 'health.csv')) as file:
            for row in csv.DictReader(file):
                was = value[row['muscle'], row['quantity']]
                self.assertAlmostEqual(float(row['value']), was, delta=1e-6 * abs(was) + 1e-9, msg=str(row))

    def test_an_arm_that_is_not_at_rest_is_left_alone(self):
        self.assertTrue(rospy.ServiceProxy('sim/set_state', SetState)(joint_name=['elbow'], joint_position=[0.6]).success)
        sent = []
        rospy.Subscriber('muscle_command', MuscleCommand, sent.append)
        done = self.run_test()
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r'elbow: \d+ degrees from rest; expected an arm that hangs')
        self.assertEqual(sent, [])
        self.assertEqual(os.listdir(self.folder), [])

    def test_motors_that_are_off_stay_off(self):
        self.assertTrue(rospy.ServiceProxy('disable', Trigger)().success)
        done = self.run_test()
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn('is not enabled; call enable first', done.stdout)

    def test_a_joint_that_is_pushed_ends_the_test(self):
        pushed, asked = threading.Event(), []

        def push(message):
            asked.append(message)
            if not pushed.is_set():
                pushed.set()
                rospy.ServiceProxy('sim/apply_wrench', ApplyWrench)(
                    link='forearm', force=Vector3(30.0, 0.0, 0.0), duration=rospy.Duration(60.0))

        rospy.Subscriber('muscle_command', MuscleCommand, push, queue_size=10000)
        done = self.run_test()
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r'degrees from where it was: the test ended after')
        self.assertFalse(os.path.exists(os.path.join(self.folder, 'health.csv')))
        # Let out, again and again.
        self.assertTrue(all(max(message.reference) < 0.0 for message in asked[-20:]), asked[-1])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'health', Health)
