#!/usr/bin/env python3
"""Every launch file can be read, with what it asks for, and the programs it starts are there. (roslaunch-check does not find the
package of files that are links.)"""
import glob
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import roslaunch.config
import roslaunch.core
import rospkg
import roslib.packages
import rostest


def launch_folder():
    return os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'launch')


def load(name, *asked):
    return roslaunch.config.load_config_default([(os.path.join(launch_folder(), name), list(asked))], None, assign_machines=False)


class LaunchFiles(unittest.TestCase):

    def test_name_programs_that_are_there(self):
        self.assertGreater(len(self.files()), 6)
        for file in self.files():
            with self.subTest(os.path.basename(file)):
                self.check(file)

    def files(self):
        return glob.glob(os.path.join(launch_folder(), '*.launch'))

    def check(self, file):
        asked = ['%s:=tier1' % arg.get('name') for arg in ElementTree.parse(file).getroot().findall('arg')
                 if arg.get('default') is None and arg.get('value') is None]
        if os.path.basename(file) == 'record.launch':
            asked.append('protocol:=tier1')  # or protocol_file
        self.check_programs(load(os.path.basename(file), *asked))

    def check_programs(self, config):
        self.assertFalse(config.config_errors)
        self.assertTrue(config.nodes)
        for node in config.nodes:
            self.assertTrue(roslib.packages.find_node(node.package, node.type), node.package + '/' + node.type)

    def test_back_ends_name_programs_that_are_there(self):
        files = glob.glob(os.path.join(launch_folder(), 'backend', '*'))
        self.assertEqual({os.path.basename(file) for file in files}, {'hardware.xml', 'emulated.xml', 'sim.xml'})
        for file in files:
            backend = os.path.basename(file)[:-len('.xml')]
            with self.subTest(backend):
                self.check_programs(load('robot.launch', 'backend:=' + backend, 'mocap:=true', 'hand:=true'))

    def test_every_argument_explains_itself(self):
        for file in self.files():
            for arg in ElementTree.parse(file).getroot().findall('arg'):
                with self.subTest(os.path.basename(file) + ' ' + arg.get('name')):
                    self.assertTrue(arg.get('value') is not None or arg.get('doc'))

    def test_a_back_end_that_does_not_exist_starts_nothing(self):
        for word in 'emulate', 'Sim', 'true', 'driver':
            with self.subTest(word), self.assertRaisesRegex(roslaunch.core.RLException, 'No such file.*/backend/%s.xml' % word):
                load('robot.launch', 'backend:=' + word)

    def test_words_that_are_no_truth_values_are_refused(self):
        for asked in ['robot.launch', 'mocap:=yes'], ['robot.launch', 'mocap:=virtual'], ['sim.launch', 'hand:=no'], \
                ['robot.launch', 'backend:=emulated', 'mocap:=yes'], ['robot.launch', 'backend:=sim', 'hand:=no'], \
                ['robot.launch', 'hand:=no']:
            with self.subTest(' '.join(asked)):
                with self.assertRaisesRegex(ValueError, asked[-1].split(':=')[1] + " is not a 'bool' type"):
                    load(*asked)

    def test_what_nodes_refuse_reaches_them(self):
        """Of the words of a launch file; that they refuse it is tested in parameters_test.py and refused_launch_test.py."""
        for asked, parameter, value in (
                (['sim.launch', 'mocap:=cameras'], 'simulator/mocap', 'cameras'),
                (['demo.launch', 'mocap:=cameras'], 'simulator/mocap', 'cameras'),
                (['robot.launch', 'backend:=sim', 'mocap:=cameras'], 'simulator/mocap', 'cameras'),
                (['robot.launch', 'backend:=emulated', 'can:=can0'], 'driver/can', 'can0'),
                (['robot.launch', 'backend:=emulated', 'can:=can0'], 'driver/emulated', True),
                (['robot.launch', 'can:=vcan0'], 'driver/emulated', False),
                (['robot.launch', 'backend:=hardware', 'homed:=true'], 'driver/homed', True),
                (['record.launch', 'out:=/tmp/1'], 'recorder/protocol', '')):
            with self.subTest(' '.join(asked)):
                config = load(*asked)
                self.assertEqual(config.params['/anthrob/' + parameter].value, value)
                by_name = {node.name: node for node in config.nodes}
                self.assertTrue(by_name[parameter.split('/')[0]].required)
        for backend in 'hardware', 'emulated':
            with self.subTest(backend), self.assertRaises(roslaunch.core.RLException):
                load('robot.launch', 'backend:=' + backend, 'homed:=perhaps')

    def test_controllers_know_how_fast_the_simulator_runs(self):
        for file, node in ('demo.launch', 'posture_player'), ('computed_force.launch', 'computed_force'):
            for rate in '0', '1.5', '-1', '0.2', '1', '1.0':
                with self.subTest(file + ' rate:=' + rate):
                    params = load(file, 'rate:=' + rate).params
                    self.assertEqual(params['/anthrob/simulator/rate'].value, float(rate))
                    self.assertEqual(params['/anthrob/%s/simulator_rate' % node].value, float(rate))
            with self.subTest(file + ' rate:=nan'):
                self.assertTrue(math.isnan(load(file, 'rate:=nan').params['/anthrob/%s/simulator_rate' % node].value))
            with self.subTest(file + ' rate:=fast'), self.assertRaises(roslaunch.core.RLException):
                load(file, 'rate:=fast')
        # An earlier launch may have left another one on the server.
        params = load('computed_force.launch', 'rate:=0', 'sim:=false').params
        self.assertEqual(params['/anthrob/computed_force/simulator_rate'].value, 1.0)

    def test_what_has_an_end_ends_its_launch(self):
        """And not as a process that has died."""
        for file, name in ('demo.launch', 'posture_player'), ('record.launch', 'recorder'), ('play.launch', 'player'), \
                ('record_zero_gravity.launch', 'recorder'):
            with self.subTest(file):
                nodes = load(file, 'out:=/tmp/1', 'bag:=/tmp/1', 'protocol:=1').nodes
                node, = [node for node in nodes if node.launch_prefix]
                self.assertEqual((node.name, node.required), (name, True))
                self.assertTrue(os.access(node.launch_prefix, os.X_OK), node.launch_prefix)

    def last_node(self):
        return next(node.launch_prefix for node in load('play.launch', 'bag:=/tmp/1').nodes if node.launch_prefix)

    def test_another_parent_than_roslaunch_is_left_alone(self):
        for status in 0, 3:
            self.assertEqual(subprocess.call([self.last_node(), 'sh', '-c', 'exit %d' % status], timeout=20), status)

    def run_under_roslaunch(self, program, meanwhile=lambda node: None):
        """The program as last node of something called roslaunch, which says its signals and the node's status. @return what it said"""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        with open(os.path.join(folder, 'roslaunch'), 'w') as file:
            file.write("""import os, signal, subprocess, sys, time
heard = []
signal.signal(signal.SIGINT, lambda *_: heard.append(True))
node = subprocess.Popen(sys.argv[1:], start_new_session=True)
while node.poll() is None:
    if heard:
        print('heard', flush=True)
        os.killpg(node.pid, signal.SIGINT)
        heard.clear()
    time.sleep(0.05)
print('status', node.returncode)
""")
        launch = subprocess.Popen([sys.executable, file.name, self.last_node(), 'sh', '-c', program], stdout=subprocess.PIPE, text=True)
        meanwhile(launch)
        return launch.communicate(timeout=30)[0]

    def test_the_last_node_ends_its_launch_if_it_did_not_fail(self):
        self.assertEqual(self.run_under_roslaunch('exit 0'), 'heard\nstatus 0\n')
        self.assertEqual(self.run_under_roslaunch('exit 3'), 'status 3\n')

    def test_an_interrupted_last_node_has_time_to_finish(self):
        def interrupt(launch):
            self.assertEqual(launch.stdout.readline(), 'up\n')
            launch.send_signal(signal.SIGINT)
        program = 'trap "sleep 0.5; echo finished; exit %d" INT; echo up; while :; do sleep 0.1; done'
        for status in 0, 130:
            self.assertEqual(self.run_under_roslaunch(program % status, interrupt), 'heard\nfinished\nstatus %d\n' % status)

    def test_names_that_are_numbers(self):
        for protocol in '1', '01', '1.50', 'true':
            recorder = load('record.launch', 'protocol:=' + protocol, 'out:=/tmp/1').params['/anthrob/recorder/protocol']
            self.assertTrue(recorder.value.endswith('/record_%s.yaml' % protocol), recorder.value)
        for name in 'record.launch', 'record_zero_gravity.launch':
            params = load(name, 'protocol:=1', 'model:=2', 'out:=/tmp/1').params
            self.assertTrue(params['/anthrob/recorder/robot_model'].value.endswith('/model_2.yaml'))

    def test_a_protocol_is_named_or_is_a_file(self):
        for asked, protocol, model in (
                (['protocol:=tier1_equilibria'], '/config/anthrob/record_tier1_equilibria.yaml', 'II_tier1'),
                (['protocol:=tier2_equilibria'], '/config/anthrob/record_tier2_equilibria.yaml', 'II'),
                (['protocol_file:=/a/separating_1.yaml'], '/a/separating_1.yaml', 'II'),
                (['protocol_file:=/a/tier1_mine.yaml'], '/a/tier1_mine.yaml', 'II_tier1'),
                (['protocol_file:=/tier1/record_tier1.yaml'], '/tier1/record_tier1.yaml', 'II_tier1'),
                (['protocol_file:=/tier1/mine.yaml'], '/tier1/mine.yaml', 'II'),
                (['protocol:=tier1', 'protocol_file:=/a/mine.yaml'], '/a/mine.yaml', 'II_tier1'),
                (['protocol:=mine', 'protocol_file:=/a/tier1.yaml'], '/a/tier1.yaml', 'II')):
            with self.subTest(' '.join(asked)):
                params = load('record.launch', 'out:=/tmp/1', *asked).params
                self.assertTrue(params['/anthrob/recorder/protocol'].value.endswith(protocol))
                self.assertTrue(params['/anthrob/recorder/model'].value.endswith('/model_%s.yaml' % model))

    def test_motion_capture_is_asked_for_by_the_same_words(self):
        for file in ['sim.launch'], ['demo.launch'], ['robot.launch', 'backend:=sim']:
            for word, wanted in {'true': True, 'virtual': True, 'false': False, 'none': False}.items():
                with self.subTest(' '.join(file) + ' mocap:=' + word):
                    nodes = [node.type for node in load(*file, 'mocap:=' + word).nodes]
                    self.assertEqual('anthrob_virtual_cameras' in nodes, wanted)
        for word, wanted in {'true': True, 'false': False, 'none': False}.items():
            nodes = [node.type for node in load('robot.launch', 'mocap:=' + word).nodes]
            self.assertEqual('anthrob_mocap' in nodes, wanted)

    def test_a_robot_without_its_forearm_has_its_own_wiring(self):
        for model, wanted in ('II', '/hardware.yaml'), ('I_tier1', '/hardware_tier1.yaml'):
            params = load('robot.launch', 'model:=' + model).params
            self.assertTrue(params['/anthrob/driver/hardware'].value.endswith('config/anthrob' + wanted))

    def test_cameras_of_the_robot(self):
        asked = dict(files='/a', calibration='/b', source='aravis', left='l', right='r')
        params = load('robot.launch', 'mocap:=true', *['mocap_%s:=%s' % pair for pair in asked.items()]).params
        for name in 'calibration', 'source', 'left', 'right':
            self.assertEqual(params['/anthrob/mocap/' + name].value, asked[name])
        self.assertEqual(params['/anthrob/mocap/targets'].value, '/a/targets.yaml')
        self.assertTrue(params['/anthrob/mocap/joint_tf'].value)

    def test_recordings_can_be_watched(self):
        for file, more in ('record.launch', 'protocol:=tier1_equilibria'), ('record_zero_gravity.launch', 'steps:=5'):
            for rviz in False, True:
                nodes = load(file, 'out:=/tmp/1', more, 'rviz:=%s' % rviz).nodes
                self.assertEqual('rviz' in [node.type for node in nodes], rviz, file)

    def test_hand_and_motion_capture_reach_every_back_end(self):
        for backend in 'hardware', 'emulated', 'sim':
            with self.subTest(backend):
                config = load('robot.launch', 'backend:=' + backend, 'hand:=true', 'mocap:=true')
                self.assertIn('name="fingers"', config.params['/anthrob/robot_description'].value)
                models = [node.args for node in config.nodes if node.package == 'anthrob_emulator']
                models += [p.value for name, p in config.params.items()
                           if name in ('/anthrob/simulator/model', '/anthrob/driver/model')]
                for model in models:
                    self.assertIn('model_II_hand.yaml', model)
                self.assertEqual(len(models), 2 if backend == 'emulated' else 1)
                seen = any(node.package == 'anthrob_mocap' for node in config.nodes)
                self.assertEqual(seen, backend != 'emulated')

    def test_a_twin_stands_beside_every_back_end(self):
        for backend in 'hardware', 'emulated', 'sim':
            with self.subTest(backend):
                for asked, count in ([], 0), (['twin:=true'], 1):
                    config = load('robot.launch', 'backend:=' + backend, 'model:=III', *asked)
                    twins = [node for node in config.nodes if node.type == 'anthrob_calibrator']
                    self.assertEqual([(node.namespace, node.name) for node in twins], [('/anthrob/', 'calibrator')] * count)
                self.assertTrue(config.params['/anthrob/calibrator/model'].value.endswith('/anthrob/model_III.yaml'))

    def test_emulated_units_know_a_zero_only_if_asked(self):
        for asked, homed in ([], 'false'), (['homed:=true'], 'true'):
            emulator, = [node for node in load('robot.launch', 'backend:=emulated', *asked).nodes
                         if node.package == 'anthrob_emulator']
            self.assertIn('--homed=' + homed, emulator.args)

    def test_a_robot_takes_no_first_step_that_is_far(self):
        for asked, step in ([], 0.5), (['backend:=hardware'], 0.5), (['backend:=emulated'], 0.0), (['first_step:=0'], 0.0), \
                (['backend:=emulated', 'first_step:=0.2'], 0.2):
            with self.subTest(' '.join(asked)):
                found = load('robot.launch', *asked).params['/anthrob/driver/first_step'].value
                self.assertEqual((found, type(found)), (step, float))

    def test_whose_time_it_is_is_said_by_every_back_end(self):
        for asked, simulated in (['backend:=hardware'], False), (['backend:=hardware', 'mocap:=true'], False), \
                (['backend:=emulated'], False), (['backend:=emulated', 'pace:=0.5'], True), (['backend:=sim'], True), \
                (['backend:=hardware', 'pace:=0.5'], False):
            with self.subTest(' '.join(asked)):
                self.assertIs(load('robot.launch', *asked).params['/use_sim_time'].value, simulated)

    def test_a_robot_may_be_anywhere(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        for urdf in 'robot.urdf', 'robot_tier1.urdf', 'robot_hand.urdf':
            with open(os.path.join(folder, urdf), 'w') as file:
                file.write('<robot name="mine"/>')
        for name in 'sim', 'robot', 'computed_force', 'demo', 'record', 'record_zero_gravity', 'mocap':
            with self.subTest(name):
                required = {'record': ['protocol:=p', 'out:=o'], 'record_zero_gravity': ['out:=o']}.get(name, [])
                backends = [['backend:=emulated'], ['mocap:=true']] if name == 'robot' else [[]]
                for backend in backends:
                    config = load(name + '.launch', 'robot:=mine', 'robot_folder:=' + folder, *required, *backend)
                    files = [str(p.value) for p in config.params.values()] + [node.args for node in config.nodes]
                    self.assertTrue([file for file in files if folder in file])
                    self.assertFalse([file for file in files if '/config/' in file])

    def check_types(self, launch, asked, node, expected, wrong):
        config = load(launch, *asked)
        for name, value in expected.items():
            found = config.params[node + '/' + name].value
            self.assertEqual((found, type(found)), (value, type(value)))
        for argument in wrong:
            with self.assertRaises(roslaunch.core.RLException):
                load(launch, argument)

    def test_parameters_of_the_driver_have_their_type(self):
        self.check_types('robot.launch', ['command_timeout:=1e-1', 'rate:=250', 'realtime:=true'], '/anthrob/driver',
                         {'command_timeout': 0.1, 'rate': 250.0, 'realtime': True, 'hand': False},
                         ['command_timeout:=soon', 'realtime:=perhaps'])

    def test_parameters_of_the_simulator_have_their_type(self):
        self.check_types('sim.launch', ['auto_enable:=0', 'paused:=1', 'step:=5e-4', 'rate:=2'], '/anthrob/simulator',
                         {'auto_enable': False, 'paused': True, 'step': 0.0005, 'rate': 2.0},
                         ['auto_enable:=no', 'paused:=please', 'rate:=fast'])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'launch_files', LaunchFiles)
