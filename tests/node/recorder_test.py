#!/usr/bin/env python3
"""Recording by protocol in lock-step: complete, interrupted and gone on with, refused."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import rosbag
import rostest
import yaml
from free_port import free_port
from waiting import wait_for

PROTOCOL = '''
protocol: %(protocol)s
postures: %(postures)s
rest: E0
visit: %(visit)s
settle: {actuator_velocity: 0.1, joint_velocity: 0.05, window: 0.3, timeout: 20.0}
hold: 0.5
average: 0.1
drift: {limit: %(limit)s, redo: 0}
'''


class Recorder(unittest.TestCase):

    def setUp(self):
        self.folder, self.port = tempfile.mkdtemp(), free_port()
        package = subprocess.check_output(['rospack', 'find', 'anthrob_bringup'], text=True).strip()
        self.values = {'protocol': 'equilibria', 'limit': 0.0524, 'visit': '[E1, E7]',
                       'postures': os.path.join(package, 'config/anthrob/equilibria_tier1.yaml')}

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def start(self, out, launch='record.launch', **values):
        """roslaunch with a roscore of its own."""
        # By its name, of the robot without forearm.
        with open(self.path('tier1_protocol.yaml'), 'w') as file:
            file.write(PROTOCOL % dict(self.values, **values))
        environment = dict(os.environ, ROS_MASTER_URI='http://localhost:' + self.port)
        return subprocess.Popen(
            ['roslaunch', '-p', self.port, 'anthrob_bringup', launch, 'out:=' + out,
             'protocol_file:=' + self.path('tier1_protocol.yaml')],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def record(self, out, **values):
        process = self.start(out, **values)
        try:
            return process.communicate(timeout=90)[0]
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)
            self.fail(process.communicate()[0])

    @staticmethod
    def messages(bag):
        """Everything in a bag, without the sequence numbers of publishers."""
        list_ = []
        for topic, message, stamp in rosbag.Bag(bag).read_messages():
            message.header.seq = 0
            list_.append((topic, stamp.to_nsec(), str(message)))
        return list_

    def check_same_run(self, a, b):
        """Equal but for the last instant, of which a bag that is closed may have got some topics and not others."""
        ends = [max(stamp for topic, stamp, _ in run if topic.endswith(name))
                for run in (a, b) for name in ('muscle_states', '/joint_states', 'spherical_joint_states')]
        common = [sorted(message for message in run if message[1] < min(ends)) for run in (a, b)]
        self.assertTrue(common[0] == common[1], 'the runs differ')
        self.assertGreater(len(common[0]), 0.98 * max(len(a), len(b)))

    def run_tool(self, *command):
        done = subprocess.run(['rosrun', *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout)

    def check_serves(self, bag):
        """What is recorded can be converted forth and back, replayed, and played under the robot's names."""
        folder, back, again = self.path('folder'), self.path('back.bag'), self.path('again')
        self.run_tool('anthrob_recording', 'anthrob_convert', bag, folder)
        self.run_tool('anthrob_recording', 'anthrob_convert', folder, back)
        self.assertEqual({topic for topic, _, _ in self.messages(back)}, {topic for topic, _, _ in self.messages(bag)})
        model = os.path.join(os.path.dirname(self.values['postures']), 'model_II_tier1.yaml')
        self.run_tool('anthrob_sim', 'anthrob_replay', '--model', model, '--in', folder, '--out', again)
        with open(os.path.join(again, 'meta.yaml')) as file:
            self.assertEqual(yaml.safe_load(file)['robot'], 'anthrob')
        environment = dict(os.environ, ROS_MASTER_URI='http://localhost:' + self.port)
        play = subprocess.Popen(['roslaunch', '-p', self.port, 'anthrob_bringup', 'play.launch', 'bag:=' + back, 'model:=II_tier1',
                                 'rviz:=false'], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

        def is_heard(name):  # an error as long as there is no master
            return not subprocess.run(['timeout', '20', 'rostopic', 'echo', '-n', '1', '/anthrob/' + name], env=environment,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode

        try:
            for name in 'joint_states', 'muscle_states':
                wait_for(lambda: is_heard(name), 60, name)
        finally:
            play.send_signal(signal.SIGINT)
            said = play.communicate(timeout=60)[0]
        self.assertNotIn('has died', said)

    def test_interrupted_and_gone_on_with(self):
        whole, parts = self.path('whole'), self.path('parts')
        output = self.record(whole)
        self.assertIn('all recorded', output)
        self.assertNotIn('REQUIRED process', output)
        self.assertNotIn('has died', output)
        complete = sorted(os.listdir(whole))
        self.assertEqual(complete, ['E1_run1.bag', 'E1_run1.yaml', 'E7_run1.bag', 'E7_run1.yaml', 'samples.csv',
                                    'session.yaml'])
        topics = {topic for topic, _, _ in self.messages(os.path.join(whole, 'E1_run1.bag'))}
        self.assertEqual(topics, {'/anthrob/' + name for name in (
            'muscle_command', 'muscle_states', 'joint_states', 'spherical_joint_states')})
        with open(os.path.join(whole, 'E7_run1.yaml')) as file:
            meta = yaml.safe_load(file)
        self.assertEqual((meta['kind'], meta['posture'], meta['from']), ('equilibrium', 'E7', 'E0'))
        self.assertEqual(len(meta['sample']['position']), 8)
        self.check_serves(os.path.join(whole, 'E7_run1.bag'))

        process = self.start(parts)
        end = time.time() + 60
        while not os.path.exists(os.path.join(parts, 'E1_run1.yaml')):
            self.assertLess(time.time(), end)
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertFalse([name for name in os.listdir(parts) if name.endswith('.part')])
        first = os.path.join(parts, 'E1_run1.bag')
        written = os.stat(first).st_mtime_ns
        # Half a recording, as a power cut leaves it.
        with open(os.path.join(parts, 'E7_run1.bag.part'), 'w') as file:
            file.write('#ROSBAG V2.0')
        self.assertIn('all recorded', self.record(parts))
        self.assertEqual(sorted(os.listdir(parts)), complete)
        self.assertEqual(os.stat(first).st_mtime_ns, written)
        # In lock-step the same run gives the same bits.
        self.check_same_run(self.messages(first), self.messages(os.path.join(whole, 'E1_run1.bag')))
        # Another protocol does not go into the same folder.
        self.assertIn('belongs to another protocol', self.record(parts, limit=0.06))

    def test_a_drifted_rest_posture_ends_the_session(self):
        out = self.path('drift')
        output = self.record(out, limit=1e-6)
        self.assertIn('the rest posture has drifted', output)
        self.assertFalse([name for name in os.listdir(out) if name.endswith(('.part', '.bag'))])

    def test_motors_that_are_stopped_end_the_session(self):
        out = self.path('stopped')
        # Long enough that the stop comes before the end however slowly it is called.
        process = self.start(out, visit=[f'E{k}' for k in range(1, 17)])
        end = time.time() + 60
        while not os.path.exists(os.path.join(out, 'E1_run1.bag.part')):
            self.assertLess(time.time(), end)
            time.sleep(0.02)
        subprocess.check_call(['rosservice', 'call', '/anthrob/emergency_stop'], stdout=subprocess.DEVNULL,
                              env=dict(os.environ, ROS_MASTER_URI='http://localhost:' + self.port))
        # Before a recording began, or in one.
        self.assertRegex(process.communicate(timeout=60)[0],
                         r'the motor of \w+ (is not enabled|stopped while it was recorded)')
        names = os.listdir(out)
        self.assertFalse([name for name in names if name.endswith('.part')])
        # A sample for each run that was complete before the stop came, and none beside them.
        complete = [name for name in names if name.endswith('.bag')]
        samples = []
        if 'samples.csv' in names:
            with open(os.path.join(out, 'samples.csv')) as file:
                samples = file.read().splitlines()[1:]
        self.assertEqual(len(samples), len(complete))

    def test_bad_input_is_one_line(self):
        for out, values, expected, status in [
                (self.path('a'), dict(protocol='dance'), 'expected equilibria, trajectories or zero_gravity', 2),
                (self.path('a'), dict(postures='nothing.yaml'), 'nothing.yaml', 2),
                ('/proc/nowhere/out', {}, 'cannot be created', 1)]:
            said = self.record(out, **values)
            self.assertRegex(said, r'REQUIRED process \[anthrob/recorder-\d+\] has died!\n.*exit code %d' % status)
            lines = [line for line in said.splitlines() if 'FATAL' in line]
            self.assertEqual(len(lines), 1, lines)
            self.assertIn(expected, lines[0])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'recorder', Recorder)
