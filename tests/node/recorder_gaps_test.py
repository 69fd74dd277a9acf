#!/usr/bin/env python3
"""A recording in which something was not measured is made again, also where it ends with the visit. The robot is a table of
numbers that stands still, with a clock of its own: gaps are where they are meant to be, however busy the machine is."""
import math
import os
import shutil
import subprocess
import tempfile
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates, SphericalJointStates
from geometry_msgs.msg import Quaternion, Vector3
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

MUSCLES = ['lateral_deltoid', 'anterior_deltoid', 'posterior_deltoid', 'supraspinatus', 'infraspinatus',
           'teres_minor', 'teres_major', 'pectoralis_major']

# There and back; 0.3 s until it is settled, 0.9 s until it is over.
PROTOCOL = '''
protocol: trajectories
postures: %s/equilibria_tier1.yaml
rest: E0
visit: [E1]
settle: {actuator_velocity: 0.1, joint_velocity: 0.05, window: 0.3, timeout: 20.0}
hold: 0.9
average: 0.1
drift: {limit: 0.0524, redo: %d}
'''


class RecorderGaps(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        package = subprocess.check_output(['rospack', 'find', 'anthrob_bringup'], text=True).strip()
        self.config = os.path.join(package, 'config', 'anthrob')
        self.clock = rospy.Publisher('/clock', Clock, queue_size=10)
        self.muscles = rospy.Publisher('muscle_states', MuscleStates, queue_size=10)
        self.joints = rospy.Publisher('joint_states', JointState, queue_size=10)
        self.shoulder = rospy.Publisher('spherical_joint_states', SphericalJointStates, queue_size=10)
        self.aims, self.commands = [], []
        self.mode = MuscleCommand.POSITION
        rospy.Subscriber('muscle_command', MuscleCommand, self.on_command)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def on_command(self, command):
        """What lasts is an aim; on the way to the first one there is another reference every 20 ms."""
        self.commands.append((command.header.stamp.to_sec(), command.reference))
        if self.aims and self.aims[-1][1] == command.reference:
            return
        if self.aims and self.time - self.aims[-1][0] < 0.1:
            del self.aims[-1]
        self.aims.append((self.time, command.reference))

    def since(self, order):
        """[s] since the command to E0, to E1 or back to E0; negative before."""
        return self.time - self.aims[order][0] if len(self.aims) > order else -1.0

    def publish(self, force, shoulder):
        """What is measured at an instant, and then the instant."""
        zeros = [0.0] * len(MUSCLES)
        stamp = rospy.Time.from_sec(self.time)
        m = MuscleStates(name=MUSCLES, position=zeros, velocity=zeros, current=zeros, voltage=zeros,
                         force=[5.0] * 3 + [force] + [5.0] * 4, reference=zeros, mode=[self.mode] * len(MUSCLES),
                         ecu_state=[MuscleStates.ENABLED] * len(MUSCLES))
        m.header.stamp = stamp
        self.muscles.publish(m)
        if shoulder:
            s = SphericalJointStates(name=['shoulder'], orientation=[Quaternion(w=1)], angular_velocity=[Vector3()])
            s.header.stamp = stamp
            self.shoulder.publish(s)
        time.sleep(0.002)
        self.clock.publish(Clock(clock=stamp))
        time.sleep(0.003)

    def record(self, redo=0, lost=None, silent=None, order=2):
        """What the recorder says; `lost`: when a muscle's force is NaN, `silent`: when the shoulder is not seen,
        since that order."""
        def is_in(span):
            return span is not None and span[0] <= self.since(order) < span[1]

        protocol = os.path.join(self.folder, 'protocol.yaml')
        with open(protocol, 'w') as file:
            file.write(PROTOCOL % (self.config, redo))
        self.time, self.aims, self.commands = 1.0, [], []
        out = os.path.join(self.folder, 'out')
        process = subprocess.Popen(
            ['rosrun', 'anthrob_recorder', 'anthrob_recorder', '__ns:=/anthrob', '_model:=' +
             os.path.join(self.config, 'model_II_tier1.yaml'), '_protocol:=' + protocol, '_out:=' + out],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        end = time.time() + 50
        while process.poll() is None and time.time() < end:
            self.time += 0.005
            self.publish(math.nan if is_in(lost) else 5.0, not is_in(silent))
        if process.poll() is None:
            process.kill()
        output = process.communicate()[0]
        bags = [name for name in os.listdir(out) if name.endswith('.bag')]
        shutil.rmtree(out)
        return output, bags

    def test_all_measured(self):
        output, bags = self.record(redo=5)
        self.assertIn('all recorded', output)
        self.assertEqual(len(bags), 2)

    def test_the_first_posture_is_led_to(self):
        self.record()
        there = self.aims[0][1]
        way = self.commands[:[reference for _, reference in self.commands].index(there) + 1]
        self.assertEqual(way[0][1], (0.0,) * len(MUSCLES))  # where the motors stand
        self.assertGreater(max(there), 0.1)
        for (t, before), (u, after) in zip(way, way[1:]):
            self.assertLess(max(abs(b - a) for a, b in zip(before, after)), u - t + 1e-6)
        self.assertEqual([reference for _, reference in self.aims[1:]][1], there)  # then whole steps, there and back
        self.assertEqual(len(self.aims), 3)

    def test_a_force_that_is_no_number_is_not_measured(self):
        output, bags = self.record(lost=(0.2, 0.5))
        self.assertIn('supraspinatus was not measured for 0.3', output)
        self.assertEqual(bags, [])

    def test_a_joint_out_of_sight_for_a_while(self):
        output, bags = self.record(silent=(0.5, 0.9))
        self.assertIn('shoulder was not measured for 0.4', output)
        self.assertEqual(bags, [])

    def test_a_joint_out_of_sight_for_good(self):
        output, bags = self.record(silent=(0.5, 1e9))
        self.assertIn('the robot is silent: joint shoulder', output)
        self.assertEqual(bags, [])

    def test_a_robot_that_refuses_all_commands(self):
        self.mode = MuscleCommand.VOLTAGE  # enabled, but without a zero, say
        output, bags = self.record()
        self.assertIn('does not follow the references of lateral_deltoid', output)
        self.assertEqual(bags, [])

    def test_what_is_not_seen_has_not_settled(self):
        output, bags = self.record(silent=(0.1, 0.7), order=0)
        self.assertIn('all recorded', output)
        self.assertEqual(len(bags), 2)
        self.assertGreater(self.aims[1][0] - self.aims[0][0], 0.7 + 0.9 - 0.05)  # seen again, then a lead of 0.9 s


if __name__ == '__main__':
    rospy.init_node('recorder_gaps_test')
    rostest.rosrun('anthrob_tests', 'recorder_gaps', RecorderGaps)
