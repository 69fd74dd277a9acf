#!/usr/bin/env python3
"""The posture player leads the muscles to the first posture, and ends where somebody stops the motors: the next enable
finds nobody who takes up a posture."""
import os
import subprocess
import tempfile
import threading
import unittest

import rospkg
import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from std_srvs.srv import Trigger

CONFIG = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob')


class PosturePlayer(unittest.TestCase):

    def call(self, name):
        rospy.wait_for_service(name, 60)
        answer = rospy.ServiceProxy(name, Trigger)()
        self.assertTrue(answer.success, answer.message)

    def start(self, postures=os.path.join(CONFIG, 'demo_postures.yaml'), namespace=None):
        return subprocess.Popen(
            ['rosrun', 'anthrob_control', 'anthrob_posture_player', '__ns:=' + (namespace or rospy.get_namespace()),
             '__name:=player',
             '_model:=' + os.path.join(CONFIG, 'model_I.yaml'),
             '_postures:=' + postures],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def ends(self, player):
        output = player.communicate(timeout=60)[0]
        self.assertEqual(player.returncode, 1, output)
        self.assertEqual(output.count('is not enabled; call enable, then start the player again'), 1, output)

    def test_1_motors_that_were_not_enabled(self):
        rospy.wait_for_message('muscle_states', MuscleStates, 60)
        self.ends(self.start())

    def test_2_a_stop(self):
        commanded = threading.Event()
        commands = rospy.Subscriber('muscle_command', MuscleCommand, lambda _: commanded.set())
        self.call('enable')
        player = self.start()
        self.assertTrue(commanded.wait(60), 'no command')
        self.call('emergency_stop')
        self.ends(player)
        self.call('clear_faults')
        self.call('enable')
        commanded.clear()
        self.assertFalse(commanded.wait(2.0), 'somebody commands')
        self.assertEqual(commands.get_num_connections(), 0)

    def test_3_the_first_posture_is_far_away(self):
        measured = rospy.wait_for_message('muscle_states', MuscleStates, 60)
        where = dict(zip(measured.name, measured.position))
        there = {name: position + 1.0 for name, position in where.items()}
        commands, arrived = [], threading.Event()

        def hear(message):
            commands.append((message.header.stamp.to_sec(), dict(zip(message.name, message.reference))))
            if all(abs(commands[-1][1][name] - there[name]) < 1e-6 for name in there):
                arrived.set()
        rospy.Subscriber('muscle_command', MuscleCommand, hear, queue_size=1000)
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
            file.write('postures: [{name: far, hold: 0.1, references: {%s}}]\n'
                       % ', '.join('%s: %.9f' % way for way in there.items()))
            file.flush()
            player = self.start(file.name)
            self.assertTrue(arrived.wait(60), commands[-1:])
            self.assertEqual(player.wait(60), 0, player.stdout.read())
        for name in there:
            # The first ones may be lost until everybody is connected.
            self.assertAlmostEqual(commands[0][1][name], where[name], delta=0.4)
        for (t, before), (u, after) in zip(commands, commands[1:]):
            for name in there:
                self.assertLess(abs(after[name] - before[name]), 1.0 * (u - t) + 1e-6, name)

    def test_4_the_namespace_of_no_robot(self):
        player = self.start(namespace='/nowhere')
        killer = threading.Timer(60, player.kill)
        killer.start()
        said = next((line for line in player.stdout if 'waiting for' in line), 'nothing')
        killer.cancel()
        player.terminate()
        player.communicate(timeout=60)
        self.assertIn('waiting for /nowhere/muscle_states, which nobody publishes', said)
        self.assertIn('__ns:=/anthrob', said)


if __name__ == '__main__':
    rospy.init_node('posture_player_test')
    rostest.rosrun('anthrob_tests', 'posture_player', PosturePlayer)
