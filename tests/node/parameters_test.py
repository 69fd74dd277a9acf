#!/usr/bin/env python3
"""A parameter of the wrong type is refused by every node that reads some: the default must not be taken without a word."""
import itertools
import os
import subprocess
import unittest

import rospkg
import rostest

CONFIG = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob')


names = itertools.count()


def run(package, program, *parameters):
    # Parameters outlive a node: each has a name of its own.
    arguments = ['__name:=node_%d' % next(names)] + ['_%s:=%s' % p for p in parameters]
    return subprocess.run(['rosrun', package, program] + arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=40)


class Parameters(unittest.TestCase):

    def check(self, package, program, good, wrong):
        for name, value in wrong:
            with self.subTest('%s: %s:=%s' % (program, name, value)):
                done = run(package, program, *good, (name, value))
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertRegex(done.stdout, 'parameter ~%s: .*expected' % name)

    def test_simulator(self):
        self.check('anthrob_sim', 'anthrob_simulator', [('model', os.path.join(CONFIG, 'model_I.yaml'))],
                   [('auto_enable', 'no'), ('auto_enable', '0'), ('paused', '1'), ('rate', 'fast'), ('rate', '.nan'),
                    ('state_rate', '[500]'), ('step', '1 ms'), ('step', '0.0'), ('command_timeout', '.inf'), ('model', '7')])

    def test_driver(self):
        self.check('anthrob_driver', 'anthrob_driver', [('hardware', os.path.join(CONFIG, 'hardware.yaml'))],
                   [('rate', 'fast'), ('realtime', '1'), ('command_timeout', '.nan'), ('check_stamps', '1'),
                    ('first_step', '.nan'),
                    # Before the bus is opened: no interface is needed to be told.
                    ('model', os.path.join(CONFIG, 'model_I_tier1.yaml'))])

    def test_controller_and_recorder(self):
        model = ('model', os.path.join(CONFIG, 'model_I_tier1.yaml'))
        self.check('anthrob_control', 'anthrob_computed_force',
                   [model, ('settings', os.path.join(CONFIG, 'control_tier1.yaml'))],
                   [('lock_step', '1'), ('steps', '2.5'), ('steps', '0')])
        self.check('anthrob_record', 'anthrob_recorder',
                   [model, ('protocol', os.path.join(CONFIG, 'record_tier1_equilibria.yaml')), ('out', '/nowhere')],
                   [('out', 'relative'), ('lock_step', '1'), ('steps', 'many'), ('enable', '1'), ('approach_speed', '0')])

    def test_player(self):
        self.check('anthrob_control', 'anthrob_posture_player',
                   [('model', os.path.join(CONFIG, 'model_I.yaml')),
                    ('postures', os.path.join(CONFIG, 'demo_postures.yaml'))],
                   [('approach_speed', 'slow'), ('approach_speed', '-1.0')])

    def test_motion_capture(self):
        self.check('anthrob_mocap', 'anthrob_mocap', [],
                   [('sync_tolerance', 'short'), ('joint_tf', '1'), ('settings', '1')])


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'parameters', Parameters)
