#!/usr/bin/env python3
"""A parameter of the wrong type, or with a name that a node does not know, is refused by every node that reads some: the
default must not be taken without a word. And each tells by --help what it reads."""
import glob
import itertools
import os
import re
import subprocess
import unittest
from xml.etree import ElementTree

import rosgraph
import rospkg
import rostest

BRINGUP = rospkg.RosPack().get_path('anthrob_bringup')
CONFIG = os.path.join(BRINGUP, 'config', 'anthrob')
NODES = {
    'anthrob_calib': ['anthrob_calibrator', 'anthrob_health_test'],
    'anthrob_sim': ['anthrob_simulator', 'anthrob_tendons'],
    'anthrob_driver': ['anthrob_driver'],
    'anthrob_control': ['anthrob_computed_force', 'anthrob_hold_posture', 'anthrob_posture_player'],
    'anthrob_recorder': ['anthrob_player', 'anthrob_recorder'],
    'anthrob_mocap': ['anthrob_mocap', 'anthrob_virtual_cameras'],
    'anthrob_rviz': ['anthrob_touch'],
}


names = itertools.count()


def run(package, program, *parameters):
    # Parameters outlive a node: each has a name of its own.
    arguments = ['__name:=node_%d' % next(names)] + ['_%s:=%s' % p for p in parameters]
    return subprocess.run(['rosrun', package, program] + arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=40)


def keys_of(package, program):
    """As its --help tells them, of which no master knows."""
    nowhere = dict(os.environ, ROS_MASTER_URI='http://localhost:1')
    done = subprocess.run(['rosrun', package, program, '--help'], stdout=subprocess.PIPE, text=True, timeout=40,
                          env=nowhere, check=True)
    return set(re.findall(r'^  _(\w+) ', done.stdout, re.M))


class Parameters(unittest.TestCase):

    def test_help_tells_what_nodes_read(self):
        for package, programs in NODES.items():
            told = set().union(*(keys_of(package, program) for program in programs))
            folder = os.path.join(rospkg.RosPack().get_path(package), 'node', '*.cpp')
            source = ''.join(open(file).read() for file in glob.glob(folder))
            read = set(re.findall(r'(?:take|required|optional_text)\(\s*settings,\s*"(\w+)"', source))
            if 'required_model(settings)' in source:
                read.add('model')
            self.assertTrue(read, package)
            if 'Role::kCommander' in source:
                read.add('back_end')  # by run_node()
            self.assertEqual(told, read, package)

    def test_launch_files_give_what_nodes_know(self):
        known = {(package, program): keys_of(package, program) for package in NODES for program in NODES[package]}
        seen = set()
        for file in glob.glob(os.path.join(BRINGUP, 'launch', '**', '*.*'), recursive=True):
            if not file.endswith(('.launch', '.xml')):
                continue
            for node in ElementTree.parse(file).iter('node'):
                kind = (node.get('pkg'), node.get('type'))
                if kind in known:
                    seen.add(kind)
                    self.assertLessEqual({p.get('name') for p in node.iter('param')}, known[kind], file)
        self.assertEqual(set(known) - seen, {('anthrob_control', 'anthrob_hold_posture'), ('anthrob_calib', 'anthrob_health_test')})

    def test_misspelt(self):
        done = run('anthrob_sim', 'anthrob_simulator', ('model', os.path.join(CONFIG, 'model_I.yaml')), ('ratee', '2'))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stdout, '^parameter ~ratee: unknown; expected one of ~model, ')
        done = subprocess.run(['rosrun', 'anthrob_sim', 'anthrob_simulator', 'model_I.yaml'], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=40)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("argument 'model_I.yaml': expected _PARAMETER:=VALUE", done.stdout)

    def test_left_on_the_server(self):
        """By an older launch file, say: told of, but no reason to stay down."""
        name = '/node_%d' % next(names)
        rosgraph.Master('test').setParam(name + '/ratee', 2)
        done = subprocess.run(['rosrun', 'anthrob_sim', 'anthrob_simulator', '__name:=' + name[1:], '_model:=nowhere.yaml'],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=40)
        self.assertIn('parameter ~ratee: ignored', done.stdout)
        self.assertIn('rosparam delete %s/ratee' % name, done.stdout)
        self.assertIn('nowhere.yaml', done.stdout)
        self.assertEqual(done.returncode, 2, done.stdout)

    def test_of_an_earlier_run(self):
        """A known one that a former start has set stays on the master: told, unless this start sets it itself."""
        for package, program, key, value in (('anthrob_sim', 'anthrob_simulator', 'command_timeout', 0),
                                             ('anthrob_sim', 'anthrob_simulator', 'rate', '0,5'),
                                             ('anthrob_recorder', 'anthrob_recorder', 'steps', 3)):
            name = '/node_%d' % next(names)
            rosgraph.Master('test').setParam('%s/%s' % (name, key), value)
            start = ['rosrun', package, program, '__name:=' + name[1:], '_model:=nowhere.yaml']
            with self.subTest(key):
                said = subprocess.run(start, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=40).stdout
                self.assertIn('parameter ~%s: %s, from the parameter server, not from this command line' % (key, value), said)
                self.assertIn('rosparam delete %s/%s' % (name, key), said)
                for own in ('_%s:=%s' % (key, value), '__log:=/dev/null'):
                    said = subprocess.run(start + [own], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=40).stdout
                    self.assertNotIn('from the parameter server', said)

    def check(self, package, program, good, wrong):
        for name, value in wrong:
            with self.subTest('%s: %s:=%s' % (program, name, value)):
                done = run(package, program, *good, (name, value))
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertRegex(done.stdout, 'parameter ~%s: .*expected' % name)

    def test_calibrator(self):
        self.check('anthrob_calib', 'anthrob_calibrator', [('model', os.path.join(CONFIG, 'model_I.yaml'))],
                   [('feed', 'torques'), ('feed', '1'), ('rate', '0'), ('warn', 'much'), ('settle', '-1'),
                    ('largest_gap', '.nan'), ('floors', '3'), ('model', '7')])

    def test_health_test(self):
        self.check('anthrob_calib', 'anthrob_health_test', [('model', os.path.join(CONFIG, 'model_I.yaml')), ('out', '/tmp/health')],
                   [('largest_turn', '0'), ('lock_step', 'yes'), ('out', 'here')])

    def test_simulator(self):
        self.check('anthrob_sim', 'anthrob_simulator', [('model', os.path.join(CONFIG, 'model_I.yaml'))],
                   [('auto_enable', 'no'), ('auto_enable', '0'), ('paused', '1'), ('rate', 'fast'), ('rate', '.nan'),
                    ('state_rate', '[500]'), ('step', '1 ms'), ('step', '0.0'), ('command_timeout', '.inf'), ('model', '7'), ('mocap', 'cameras'), ('mocap', "''")])

    def test_driver(self):
        self.check('anthrob_driver', 'anthrob_driver', [('hardware', os.path.join(CONFIG, 'hardware.yaml'))],
                   [('rate', 'fast'), ('realtime', '1'), ('command_timeout', '.nan'), ('check_stamps', '1'),
                    ('first_step', '.nan'),
                    ('emulated', 'yes'), ('homed', '1'), ('homed', 'true'),
                    # Before the bus is opened: no interface is needed to be told.
                    ('model', os.path.join(CONFIG, 'model_I_tier1.yaml'))])

    def test_emulated_units_stay_off_the_bus_of_a_robot(self):
        done = run('anthrob_driver', 'anthrob_driver', ('hardware', os.path.join(CONFIG, 'hardware.yaml')), ('can', 'can0'),
                   ('emulated', 'true'))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('parameter ~can: can0: expected a virtual interface', done.stdout)

    def test_controller_and_recorder(self):
        model = ('model', os.path.join(CONFIG, 'model_I_tier1.yaml'))
        self.check('anthrob_control', 'anthrob_computed_force',
                   [model, ('settings', os.path.join(CONFIG, 'control_tier1.yaml'))],
                   [('lock_step', '1'), ('steps', '2.5'), ('steps', '0'), ('simulator_rate', '0'), ('simulator_rate', '1.5'),
                    ('simulator_rate', '-1'), ('simulator_rate', '.nan'), ('simulator_rate', 'fast')])
        self.check('anthrob_recorder', 'anthrob_recorder',
                   [model, ('protocol', os.path.join(CONFIG, 'record_tier1_equilibria.yaml')), ('out', '/nowhere')],
                   [('out', 'relative'), ('lock_step', '1'), ('steps', 'many'), ('enable', '1'), ('approach_speed', '0')])

    def test_player_of_recordings(self):
        self.check('anthrob_recorder', 'anthrob_player', [('bag', '/nowhere/run.bag')],
                   [('rate', 'fast'), ('rate', '0.0'), ('rate', '.nan'), ('loop', '1'), ('bag', '7')])

    def test_player(self):
        self.check('anthrob_control', 'anthrob_posture_player',
                   [('model', os.path.join(CONFIG, 'model_I.yaml')),
                    ('postures', os.path.join(CONFIG, 'demo_postures.yaml'))],
                   [('simulator_rate', '0'), ('simulator_rate', '1.5'), ('approach_speed', 'slow'), ('approach_speed', '-1.0'), ('back_end', '1')])

    def test_motion_capture(self):
        self.check('anthrob_mocap', 'anthrob_mocap', [],
                   [('sync_tolerance', 'short'), ('joint_tf', '1'), ('settings', '1')])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'parameters', Parameters)
