#!/usr/bin/env python3
"""The actions `calibrate` and `discover`: what they tell on the way and in the end, and that nothing is lost whatever is
interrupted, killed or full: the same goal goes on, and comes to the same bits."""
import json
import math
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import actionlib
import rosgraph
import rospkg
import roslib.packages
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from anthrob_msgs.msg import (CalibrateAction, CalibrateActionResult, CalibrateGoal, DiscoverAction, DiscoverGoal, Health, HealthTestAction,
                              HealthTestGoal)

from discover_test import record
from waiting import wait_for

PATIENCE = 200  # [s] of wall time, on a machine that does other things
CONFIG = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config')
ROBOT = '/two_muscle_rig'


def program(package, name):
    return roslib.packages.find_node(package, name)[0]


def record_rig(folder, flexor):
    """An equilibrium of the rig, as smooth as no robot is: bits need no truth."""
    os.makedirs(folder)
    with open(os.path.join(folder, 'meta.yaml'), 'w') as file:
        file.write('robot: two_muscle_rig\nkind: equilibrium\nstart: {settle_s: 1.0}\n')
    with open(os.path.join(folder, 'muscles.csv'), 'w') as file:
        file.write('t,hinge/position,' + ','.join('%s/%s' % (muscle, quantity) for muscle in ('flexor', 'extensor')
                                                  for quantity in ('reference', 'position', 'force')) + '\n')
        for k in range(301):
            t = 0.005 * k
            done = 0.0 if t < 0.5 else 1.0 - math.exp(-(t - 0.5) / 0.1)
            change = (flexor - 1.0) * done
            values = [t, 0.2 * change]
            for reference, sign in ((flexor, 1.0), (2.0 - flexor, -1.0)):
                values += [1.0 if t < 0.5 else reference, 1.0 + sign * change, 20.0 + 5.0 * sign * change]
            file.write(','.join('%.6f' % value for value in values) + '\n')


CALIBRATION = """model: %s
recordings: equilibria
simulate: {settle: 0.5, motion: 1.0}
optimiser: {method: evolution_strategy, parents: 2, offspring: 8, generations: %d, seed: 3}
parameters:
  - {path: muscles.*.rest_tendon_length, unit: m, range: 0.006, step: 0.001}
  - {path: muscles.*.spindle_radius, unit: m, low: 0.006, high: 0.0075, step: 0.0002}
"""


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


def children_of(pid):
    with open('/proc/%d/task/%d/children' % (pid, pid)) as file:
        return [int(child) for child in file.read().split()]


def lives(pid):
    try:
        with open('/proc/%d/stat' % pid) as file:
            return file.read().rsplit(')', 1)[1].split()[0] != 'Z'
    except FileNotFoundError:
        return False


class Jobs(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('jobs_test')
        cls.folder = os.path.join(tempfile.mkdtemp(), 'my jobs')
        os.makedirs(cls.folder)
        for index, flexor in enumerate((0.4, 1.6, 2.0)):
            record_rig(os.path.join(cls.folder, 'runs', 'E%d' % index), flexor)
        with open(os.path.join(cls.folder, 'calibrate.yaml'), 'w') as file:
            file.write(CALIBRATION % (os.path.join(CONFIG, 'two_muscle_rig', 'model_II.yaml'), 25))
        for name, second in (('one', 2.9), ('two', 4.3)):
            record(os.path.join(cls.folder, name), second)
        # What nobody has interrupted.
        done = subprocess.run([program('anthrob_calib', 'anthrob_calibrate'), '--config', cls.path('calibrate.yaml'), '--data',
                               cls.path('runs'), '--out', cls.path('uninterrupted'), '--brief'],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0, done.stdout

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(os.path.dirname(cls.folder))

    @classmethod
    def path(cls, *names):
        return os.path.join(cls.folder, *names)

    def setUp(self):
        self.start_node()

    def start_node(self, *parameters, before=()):
        self.node = subprocess.Popen([*before, program('anthrob_calib', 'anthrob_calibrator'), '__ns:=' + ROBOT, *parameters])
        self.addCleanup(self.end_node, self.node)
        self.calibrator = actionlib.SimpleActionClient(ROBOT + '/calibrate', CalibrateAction)
        self.discoverer = actionlib.SimpleActionClient(ROBOT + '/discover', DiscoverAction)
        for client in (self.calibrator, self.discoverer):
            self.assertTrue(client.wait_for_server(rospy.Duration(30)))

    @staticmethod
    def end_node(node):
        children = children_of(node.pid) if node.poll() is None else []
        node.terminate()
        node.wait()
        wait_for(lambda: not any(lives(child) for child in children), PATIENCE, 'children that end with the node')

    def calibration(self, out, jobs=1):
        """One thread, so that it can be interrupted on a machine of any number of cores."""
        return CalibrateGoal(config=self.path('calibrate.yaml'), data=self.path('runs'), out=self.path(out), jobs=jobs,
                             options=['--brief'])

    def send(self, goal, client=None):
        self.feedback = []
        (client or self.calibrator).send_goal(goal, feedback_cb=self.feedback.append)

    def finish(self, client=None):
        client = client or self.calibrator
        self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE)), self.feedback[-1:])
        return client.get_state(), client.get_result()

    def run_to_the_end(self, goal):
        self.send(goal)
        state, result = self.finish()
        self.assertEqual(state, GoalStatus.SUCCEEDED, result)
        return result

    def wait_until_underway(self):
        wait_for(lambda: any(f.share > 0.1 for f in self.feedback), PATIENCE, 'a tenth of the search')
        self.assertLess(self.feedback[-1].share, 0.9, 'too short a search to interrupt')

    def child(self):
        children = children_of(self.node.pid)
        self.assertEqual(len(children), 1)
        return children[0]

    def expect_as_uninterrupted(self, out):
        for name in ('result.json', 'model.yaml', 'report.html', 'journal.txt'):
            self.assertEqual(content(self.path(out), name), content(self.path('uninterrupted'), name), name)

    def test_calibrate(self):
        self.send(self.calibration('done', jobs=2))
        wait_for(lambda: self.feedback, PATIENCE, 'feedback')
        self.assertEqual(os.getpriority(os.PRIO_PROCESS, self.child()),
                         min(19, os.getpriority(os.PRIO_PROCESS, self.node.pid) + 10))
        state, result = self.finish()
        self.assertEqual(state, GoalStatus.SUCCEEDED, result)
        self.assertTrue(result.success)
        self.assertRegex(result.headline, '^(usable|look at these parameters): .*fitness .* -> ')
        self.assertEqual(result.files, [self.path('done', name) for name in ('model.yaml', 'report.html', 'result.json')])
        self.assertEqual((result.exit_code, result.error), (0, ''))
        with open(result.log) as log:
            self.assertIn("--data '%s'" % self.path('runs'), log.readline())
        self.expect_as_uninterrupted('done')
        shares = [f.share for f in self.feedback]
        self.assertEqual(shares, sorted(shares))
        self.assertEqual((self.feedback[-1].stage, shares[-1], self.feedback[-1].seconds_left), ('done', 1.0, 0.0))
        stages = [f.stage for f in self.feedback]
        self.assertIn('searching', stages)
        searching = self.feedback[len(stages) - 1 - stages[::-1].index('searching')]
        self.assertRegex(searching.best, r'^fitness \d')
        self.assertGreater(searching.seconds_left, 0.0)

    def test_cancelled(self):
        self.send(self.calibration('cancelled'))
        self.wait_until_underway()
        self.calibrator.cancel_goal()
        state, result = self.finish()
        self.assertEqual(state, GoalStatus.PREEMPTED, result)
        self.assertFalse(result.success)
        self.assertEqual(result.exit_code, 130)
        self.assertRegex(result.headline, '^interrupted; the same goal goes on from there; not searched to the end: fitness ')
        self.assertIn(self.path('cancelled', 'model.yaml'), result.files)  # the best so far
        result = self.run_to_the_end(self.calibration('cancelled'))
        with open(result.log) as log:
            self.assertIn(' --resume\n', log.read())
        self.expect_as_uninterrupted('cancelled')

    def test_health_is_told_and_tested_by_a_program_of_its_own(self):
        history = self.path('health')
        os.makedirs(history)
        with open(os.path.join(history, 'health.csv'), 'w') as file:
            file.write('time,muscle,quantity,value,low,high,unit\n')
            for day in range(1, 21):
                stiffness = 1000.0 + day % 2 - 20.0 * max(0, day - 10)
                file.write('2026-11-%02d,flexor,stiffness,%g,990,1010,N/m\n' % (day, stiffness))
        self.end_node(self.node)
        self.start_node('_health:=' + history)
        told = rospy.wait_for_message(ROBOT + '/health', Health, 30)
        self.assertEqual((told.muscle, told.quantity, told.unit), (['flexor'], ['stiffness'], ['N/m']))
        self.assertRegex(told.warning[0], r'^flexor: its spring or tendon has become softer.*stiffness -1\d(\.\d)? %.* in .* days$')
        self.assertTrue(told.header.frame_id)
        client = actionlib.SimpleActionClient(ROBOT + '/health/test', HealthTestAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(30)))
        self.send(HealthTestGoal(), client)
        state, result = self.finish(client)
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertIn('model: missing', result.headline)
        # Nobody is there to be tested; meanwhile it goes first, as it commands.
        self.send(HealthTestGoal(model='two_muscle_rig/I'), client)
        wait_for(lambda: self.feedback, PATIENCE, 'feedback')
        self.assertEqual(os.getpriority(os.PRIO_PROCESS, self.child()), os.getpriority(os.PRIO_PROCESS, self.node.pid))
        client.cancel_goal()
        state, result = self.finish(client)
        self.assertEqual(state, GoalStatus.PREEMPTED, result)

    def test_killed_program(self):
        self.send(self.calibration('killed'))
        self.wait_until_underway()
        os.kill(self.child(), signal.SIGKILL)
        state, result = self.finish()
        self.assertEqual(state, GoalStatus.ABORTED, result)
        self.assertEqual((result.exit_code, result.error), (137, 'killed by signal 9 (Killed)'))
        self.assertIsNone(self.node.poll())
        self.run_to_the_end(self.calibration('killed'))
        self.expect_as_uninterrupted('killed')

    def test_killed_node(self):
        self.send(self.calibration('orphan'))
        self.wait_until_underway()
        child = self.child()
        self.node.kill()
        self.node.wait()
        wait_for(lambda: not lives(child), PATIENCE, 'a program that keeps what it has and ends')
        self.assertTrue(os.path.exists(self.path('orphan', 'model.yaml')))
        self.assertIn(b'interrupted; the best result so far is in ', content(self.path('orphan'), 'anthrob_calibrate.log'))
        self.start_node()
        self.run_to_the_end(self.calibration('orphan'))
        self.expect_as_uninterrupted('orphan')

    def test_stages(self):
        with open(self.path('stages.yaml'), 'w') as file:
            file.write('stages:\n' + ''.join(
                '  - {name: %s, config: calibrate.yaml, data: runs, options: [--brief, --generations, 8]}\n' % name
                for name in ('first', 'second')))
        goal = CalibrateGoal(pipeline=self.path('stages.yaml'), out=self.path('staged'))
        self.send(goal)
        wait_for(lambda: any(f.share > 0.3 for f in self.feedback), PATIENCE, 'the second run')
        program = self.child()
        self.node.kill()
        self.node.wait()
        wait_for(lambda: not lives(program), PATIENCE, 'the end of a program without a node')
        self.assertFalse(os.path.exists(self.path('staged', 'model.yaml')))
        self.start_node()
        result = self.run_to_the_end(goal)
        self.assertEqual(result.files, [self.path('staged', name) for name in ('model.yaml', 'pipeline.json')])
        self.assertRegex(result.headline, 'fitness .* -> ')
        self.assertTrue(any(f.stage.startswith('second, seed ') for f in self.feedback), self.feedback)
        shares = [f.share for f in self.feedback]
        self.assertEqual((shares, shares[-1]), (sorted(shares), 1.0))
        wrong = CalibrateGoal(pipeline=self.path('stages.yaml'), data=self.path('runs'), out=self.path('staged'))
        self.send(wrong)
        self.assertEqual(self.finish()[0], GoalStatus.REJECTED)

    def test_commands_no_robot(self):
        topics = [topic for topic, nodes in rosgraph.Master('jobs_test').getSystemState()[0] if ROBOT + '/calibrator' in nodes]
        self.assertIn(ROBOT + '/calibrate/feedback', topics)
        commands = {ROBOT + '/' + name for name in ('muscle_command', 'joint_effort_command', 'emergency_stop')}
        self.assertEqual(commands.intersection(topics), set())

    def test_a_full_disk(self):
        small = self.path('small')
        os.makedirs(small)
        inside = ['unshare', '-r', '-m', 'sh', '-c', 'mount -t tmpfs -o size=24k none "$0" && exec "$@"', small]
        if subprocess.run([*inside, 'true'], stderr=subprocess.DEVNULL).returncode:
            self.skipTest('no file system can be mounted here')
        self.end_node(self.node)
        self.start_node(before=inside)
        self.send(self.calibration('small/fit'))
        state, result = self.finish()
        self.assertEqual(state, GoalStatus.ABORTED, result)
        self.assertRegex(result.error, 'anthrob_calibrate: .*small/fit.*: No space left on device')
        self.assertEqual(result.exit_code, 1)

    def test_refused(self):
        for wrong, complaint in ((self.calibration('out', jobs=-1), 'jobs: -1: expected a whole number'),
                                 (CalibrateGoal(config='/c.yaml', data='/runs'), 'out: missing; expected a folder for the result'),
                                 (CalibrateGoal(config='/c.yaml', data='runs', out='/out'), 'data: runs: expected a whole path')):
            self.send(wrong)
            state, result = self.finish()
            self.assertEqual(state, GoalStatus.REJECTED)
            self.assertTrue(result.headline.startswith('calibrate: refused: ' + complaint), result.headline)
        self.assertFalse(os.path.exists(self.path('out')))

    def test_what_the_program_refuses(self):
        goal = self.calibration('out')
        goal.config = self.path('nowhere.yaml')
        self.send(goal)
        state, result = self.finish()
        self.assertEqual(state, GoalStatus.ABORTED, result)
        self.assertIn('anthrob_calibrate: ' + self.path('nowhere.yaml'), result.error)
        self.assertEqual((result.exit_code, result.headline), (2, result.error))

    def test_one_at_a_time(self):
        self.send(self.calibration('first'))
        self.wait_until_underway()
        second = actionlib.SimpleActionClient(ROBOT + '/calibrate', CalibrateAction)
        self.assertTrue(second.wait_for_server(rospy.Duration(30)))
        second.send_goal(self.calibration('second'))
        state, result = self.finish(second)
        self.assertEqual(state, GoalStatus.REJECTED, result)
        self.assertRegex(result.headline, 'busy with goal /.*-.*, which writes into %s: cancel it' % self.path('first'))
        self.assertEqual(self.calibrator.get_state(), GoalStatus.ACTIVE)
        self.assertEqual(len(children_of(self.node.pid)), 1)

    def test_from_a_terminal(self):
        """As docs/calibration.md has it."""
        results = []
        rospy.Subscriber(ROBOT + '/calibrate/result', CalibrateActionResult, results.append)
        goal = '{goal: {data: "%s", \\\n config: "%s", out: "%s", options: [--evaluate, --brief]}}' % (
            self.path('runs'), self.path('calibrate.yaml'), self.path('typed'))
        subprocess.run(['bash', '-c', "rostopic pub -1 %s/calibrate/goal anthrob_msgs/CalibrateActionGoal \"%s\"" % (
            ROBOT, goal.replace('"', '\\"'))], check=True, stdout=subprocess.DEVNULL)
        wait_for(lambda: results, PATIENCE, 'a result')
        self.assertEqual(results[0].status.status, GoalStatus.SUCCEEDED, results[0])
        self.assertRegex(results[0].result.headline, '^not searched to the end: fitness ')

    def discovery(self, out):
        return DiscoverGoal(model='driven_axis/I', train=[self.path('one')], test=[self.path('two')], out=self.path(out),
                            options=['--effects', 'joint_coulomb,joint_offset_torque'])

    def test_killed_discovery(self):
        subprocess.run([program('anthrob_discovery', 'anthrob_discover'), '--model', 'driven_axis/I', '--train', self.path('one'),
                        '--test', self.path('two'), '--out', self.path('whole'), '--effects', 'joint_coulomb,joint_offset_torque'],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.send(self.discovery('halves'), self.discoverer)
        journal = self.path('halves', 'journal.bin')
        wait_for(lambda: os.path.exists(journal) and os.path.getsize(journal) > 20000, PATIENCE, 'simulations')
        os.kill(self.child(), signal.SIGKILL)
        state, result = self.finish(self.discoverer)
        self.assertEqual((state, result.error), (GoalStatus.ABORTED, 'killed by signal 9 (Killed)'))
        self.send(self.discovery('halves'), self.discoverer)
        state, result = self.finish(self.discoverer)
        self.assertEqual(state, GoalStatus.SUCCEEDED, result)
        self.assertRegex(content(result.log), b'continuing with [1-9][0-9]* simulations of an interrupted run')
        answers = [json.loads(content(self.path(out, 'report.json'))) for out in ('halves', 'whole')]
        for answer in answers:
            del answer['runtime_s']
        self.assertEqual(*answers)

    def test_discover(self):
        self.send(self.discovery('found'), self.discoverer)
        state, result = self.finish(self.discoverer)
        self.assertEqual(state, GoalStatus.SUCCEEDED, result)
        self.assertEqual(result.headline, 'effects_found: joint_coulomb @ axis')
        self.assertEqual(result.files, [self.path('found', name) for name in ('model.yaml', 'report.html', 'report.json')])
        shares = [f.share for f in self.feedback]
        self.assertEqual(shares, sorted(shares))
        self.assertEqual((self.feedback[-1].stage, shares[-1]), ('done', 1.0))
        self.assertEqual(self.feedback[-1].best, 'joint_coulomb @ axis')
        self.assertTrue(any(0.0 < f.seconds_left < 600.0 for f in self.feedback))


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'jobs', Jobs)
