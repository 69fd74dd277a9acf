#!/usr/bin/env python3
"""Nodes that wait for a clock which nobody has say so, and what time set back means to a player of postures."""
import os
import subprocess
import tempfile
import time
import unittest

import rospkg
import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from rosgraph_msgs.msg import Clock

CONFIG = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config')
RIG = os.path.join(CONFIG, 'two_muscle_rig', 'model_I.yaml')
ANTHROB = os.path.join(CONFIG, 'anthrob')
POSTURES = '''
postures:
  - {name: in, hold: 1.0, references: {flexor: 0.5, extensor: -0.5}}
  - {name: out, hold: 1000.0, references: {flexor: -0.5, extensor: 0.5}}
'''


def file_of(text):
    file = tempfile.NamedTemporaryFile('w+', suffix='.yaml')
    file.write(text)
    file.flush()
    return file


def command_line(package, program, parameters):
    return ['rosrun', package, program] + ['_%s:=%s' % p for p in parameters.items()]


class RosTime(unittest.TestCase):

    def start(self, package, program, **parameters):
        """@return a file that grows by what the node says"""
        said = tempfile.NamedTemporaryFile('w+')
        node = subprocess.Popen(command_line(package, program, parameters), stdout=said, stderr=subprocess.STDOUT)

        def stop():
            node.terminate()
            node.wait()
        self.addCleanup(stop)
        return said

    def postures(self):
        file = file_of(POSTURES)
        self.addCleanup(file.close)
        return file.name

    def run_driver(self, **parameters):
        return subprocess.run(command_line('anthrob_driver', 'anthrob_driver', dict(
            hardware=os.path.join(ANTHROB, 'hardware.yaml'), can='vcan_nowhere', **parameters)),
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60)

    def test_a_driver_without_time_is_refused(self):
        done = self.run_driver()
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('/use_sim_time is true and nobody has published /clock', done.stdout)
        # The clock of slow units comes from them, and they may come later.
        self.assertNotIn('/use_sim_time', self.run_driver(pace=0.5).stdout)

    def test_who_waits_for_time_says_so(self):
        tier1 = os.path.join(ANTHROB, 'model_I_tier1.yaml')
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        nodes = {
            'player': self.start('anthrob_control', 'anthrob_posture_player', model=RIG, postures=self.postures()),
            'controller': self.start('anthrob_control', 'anthrob_computed_force', model=tier1,
                                     settings=os.path.join(ANTHROB, 'control_tier1.yaml')),
            'recorder': self.start('anthrob_recorder', 'anthrob_recorder', model=tier1, out=os.path.join(folder.name, 'out'),
                                   protocol=os.path.join(ANTHROB, 'record_tier1_equilibria.yaml')),
            'tendons': self.start('anthrob_sim', 'anthrob_tendons', model=RIG),
        }
        end = time.time() + 60
        for name, said in nodes.items():
            while 'waiting for /clock' not in open(said.name).read():
                self.assertLess(time.time(), end, name + ': ' + open(said.name).read())
                time.sleep(0.1)

    def test_postures_begin_anew_where_time_was_set_back(self):
        heard = []
        rospy.Subscriber('muscle_command', MuscleCommand,
                         lambda m: heard.append(dict(zip(m.name, m.reference))['flexor']))
        clock = rospy.Publisher('/clock', Clock, queue_size=1)
        states = rospy.Publisher('muscle_states', MuscleStates, queue_size=1)
        enabled = MuscleStates(name=['flexor', 'extensor'], ecu_state=[MuscleStates.ENABLED] * 2, position=[0.3, 0.3],
                               **{field: [0.0, 0.0] for field in ('velocity', 'current', 'force')})
        self.start('anthrob_control', 'anthrob_posture_player', model=RIG, postures=self.postures())

        def let_pass(t, wanted):
            """Time from t on, until the last command heard is for this."""
            del heard[:]
            end = time.time() + 60
            while not heard or heard[-1] != wanted:
                self.assertLess(time.time(), end, heard)
                clock.publish(Clock(clock=rospy.Time(t)))
                enabled.header.stamp = rospy.Time(t)
                states.publish(enabled)
                t += 0.01
                time.sleep(0.01)
            return t

        let_pass(let_pass(100.0, 0.5), -0.5)
        t = let_pass(1.0, 0.5)
        # From where the robot stands, at 1 rad/s.
        after = heard[heard.index(next(way for way in heard if way > 0.0)):]
        self.assertGreaterEqual(after[0], 0.3)
        self.assertGreater(len([way for way in after if way < 0.5]), 5)
        let_pass(t, -0.5)


if __name__ == '__main__':
    rospy.init_node('ros_time_test')
    rostest.rosrun('anthrob_tests', 'ros_time', RosTime)
