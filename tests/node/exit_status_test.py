#!/usr/bin/env python3
"""Exit statuses that docs/files.md promises, where no test of a single package sees them."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rosgraph
import rospkg
import rostest

ROOT = os.path.dirname(os.path.realpath(rospkg.RosPack().get_path('anthrob_bringup') + '/config'))
CONFIG = os.path.join(ROOT, 'config', 'anthrob')


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)


def program(package, name):
    return run('catkin_find', '--first-only', '--libexec', package, name).stdout.strip()


class ExitStatus(unittest.TestCase):

    def refused(self, *command):
        done = run(*command)
        self.assertEqual(done.returncode, 2, '%s: %s' % (command, done.stderr))
        self.assertNotIn('Traceback', done.stderr)
        return done.stderr

    def script(self, name, *arguments):
        said = self.refused(sys.executable, os.path.join(ROOT, 'scripts', name), *arguments)
        self.assertEqual(said.count('\n'), 1, said)
        return said

    def test_scripts(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, 'out')
            self.assertIn('--joints 0: expected 1 to', self.script('make_torso.py', '--joints', '0', '--out', out))
            self.assertIn('--muscles -1: expected', self.script('make_torso.py', '--muscles', '-1', '--out', out))
            self.assertIn("invalid int value: 'many'", self.script('make_torso.py', '--joints', 'many', '--out', out))
            self.assertIn('arguments are required: OUT', self.script('save_pairs.py'))
            self.assertIn('unrecognized arguments: --bogus', self.script('study/discovery.py', '--bogus'))
            self.assertFalse(os.path.exists(out))
            self.assertIn('required: BAG', self.script('mocap_agreement.py'))
            self.assertIn('nowhere.bag', self.script('mocap_agreement.py', folder + '/nowhere.bag'))
            model = os.path.join(ROOT, 'config', 'driven_axis', 'model_I.yaml')
            self.assertIn('required: DATA.csv', self.script('emps_check.py', model))
            self.assertIn('nowhere.csv', self.script('emps_check.py', model, folder + '/nowhere.csv'))
            other = os.path.join(CONFIG, 'model_I.yaml')
            data = os.path.join(folder, 'data.csv')
            open(data, 'w').close()
            self.assertIn('expected a model of', self.script('emps_check.py', other, data))
            more = os.path.join(folder, 'model_more.yaml')
            with open(more, 'w') as file:
                file.write('extends: %s\neffects:\n- {id: joint_coulomb_asymmetric, place: axis}\n' % model)
            self.assertIn('joint_coulomb_asymmetric: expected', self.script('emps_check.py', more, data))

    def test_workspace(self):
        workspace = os.path.join(ROOT, 'catkin_ws.sh')
        self.assertIn("unknown command 'biuld'", self.refused(workspace, 'biuld'))

    def test_output_that_cannot_be_written(self):
        for command in (program('anthrob_sim', 'anthrob_effects'), '--format', 'json'), (
                program('anthrob_sim', 'anthrob_muscles'), '--robot', 'anthrob', '--model', 'I'):
            with open('/dev/full', 'w') as full:
                done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn('standard output: cannot be written', done.stderr)

    def test_version(self):
        version = rospkg.RosPack().get_manifest('anthrob_core').version
        for package, name in (('calib', 'calibrate'), ('calib', 'identify'), ('calib', 'virtual_rig'), ('control', 'gains'),
                              ('discovery', 'discover'), ('driver', 'can_check'), ('driver', 'driver'), ('emulator', 'emulator'),
                              ('mocap', 'mocap_offline'), ('recording', 'compare'), ('sim', 'muscles'), ('sim', 'simulator'),
                              ('virtual_robot', 'blind_case')):
            done = run(program('anthrob_' + package, 'anthrob_' + name), '--version')
            self.assertEqual((done.returncode, done.stdout), (0, 'anthrob_%s %s\n' % (name, version)), done.stderr)

    def test_models_by_name(self):
        named = run(program('anthrob_sim', 'anthrob_effects'), '--model', 'driven_axis/I')
        file = os.path.join(ROOT, 'config', 'driven_axis', 'model_I.yaml')
        self.assertEqual((named.returncode, named.stdout), (0, run(program('anthrob_sim', 'anthrob_effects'), '--model', file).stdout))
        said = self.refused(program('anthrob_sim', 'anthrob_effects'), '--model', 'anthrob/IX')
        self.assertIn('model IX: no file', said)
        self.assertIn('this robot has: ', said)

    def test_folder_for_a_file(self):
        said = self.refused(program('anthrob_sim', 'anthrob_replay'), '--model', CONFIG, '--in', CONFIG, '--out', '/tmp/none')
        self.assertIn(CONFIG + ': expected a YAML file, not a folder', said)

    def test_muscles(self):
        muscles = program('anthrob_sim', 'anthrob_muscles')
        for robot, option, value in (('anthrob', '--joint', 'elbow=9'), ('two_muscle_rig', '--position', 'flexor=1e9'),
                                     ('anthrob', '--joint', 'shoulder=1,1,0,0')):
            said = self.refused(muscles, '--robot', robot, '--model', 'I', option, value)
            self.assertEqual(said.count('\n'), 1, said)
            self.assertIn(value.split('=')[0], said)
        file = os.path.join(CONFIG, 'model_I.yaml')
        by_path, by_name = run(muscles, '--model', file), run(muscles, '--robot', 'anthrob', '--model', 'I')
        self.assertEqual((by_path.returncode, by_path.stdout), (0, by_name.stdout), by_path.stderr)
        self.assertIn('no such file', self.refused(muscles, '--model', file + '.yaml'))

    def test_virtual_robot(self):
        with tempfile.TemporaryDirectory() as folder:
            nowhere = os.path.join(folder, 'model_I.yaml')
            said = self.refused(program('anthrob_virtual_robot', 'anthrob_blind_case'), '--model', nowhere,
                                '--out', folder + '/out', '--truth', folder + '/truth.json')
            self.assertIn(nowhere, said)
            for out, truth in ((folder + '/out/', folder + '/out/truth.json'), (folder + '/out', folder + '/x/../out/t.json')):
                said = self.refused(program('anthrob_virtual_robot', 'anthrob_blind_case'), '--model', nowhere,
                                    '--out', out, '--truth', truth)
                self.assertIn('expected a file outside --out', said)
            os.makedirs(folder + '/out/train_1')
            said = self.refused(program('anthrob_virtual_robot', 'anthrob_blind_case'), '--model', nowhere,
                                '--out', folder + '/out', '--truth', folder + '/truth.json')
            self.assertIn('holds train_1', said)
            os.makedirs(folder + '/truths')
            os.makedirs(folder + '/reports/a')
            for file in '/truths/a.json', '/reports/a/report.json':
                with open(folder + file, 'w') as text:
                    text.write('{')
            said = self.refused(program('anthrob_virtual_robot', 'anthrob_score'), '--truths', folder + '/truths',
                                '--reports', folder + '/reports')
            self.assertIn('a.json', said)

    def interrupt(self, package, name, *parameters):
        """A node whose robot never comes. @return its exit status"""
        node = name + '_that_waits'
        process = subprocess.Popen([program(package, name), '__name:=' + node, '__ns:=nowhere'] + list(parameters),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            self.until_it_waits('/nowhere/' + node, process)
            process.send_signal(signal.SIGINT)
            return process.wait(timeout=30)
        finally:
            process.kill()
            process.wait()

    def until_it_waits(self, node, process):
        """For what it waits for stands behind its publications and subscriptions."""
        master = rosgraph.Master('/exit_status')
        while process.poll() is None:
            publishers, subscribers, _ = master.getSystemState()
            if any(node in nodes for topic, nodes in publishers + subscribers
                   if 'muscle_command' in topic or 'camera_info' in topic):
                return
            time.sleep(0.1)
        self.fail('%s ended by itself with %s' % (node, process.returncode))

    def test_what_has_an_end_says_that_it_did_not_get_there(self):
        model = '_model:=' + os.path.join(CONFIG, 'model_I.yaml')
        postures = '_postures:=' + os.path.join(CONFIG, 'demo_postures.yaml')
        self.assertEqual(self.interrupt('anthrob_control', 'anthrob_posture_player', model, postures), 130)
        self.assertEqual(self.interrupt('anthrob_control', 'anthrob_hold_posture', model, postures,
                                        '_posture:=flexed'), 130)

    def test_what_runs_until_it_is_stopped_is_done(self):
        targets = '_targets:=' + os.path.join(CONFIG, 'mocap', 'targets.yaml')
        self.assertEqual(self.interrupt('anthrob_mocap', 'anthrob_mocap', targets), 0)


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'exit_status', ExitStatus)
