#!/usr/bin/env python3
"""The calibration node beside a simulator that is stepped, so that the machine may be slow."""
import math
import shutil
import tempfile
import unittest

import numpy
import rosgraph
import rospy
import rostest
from anthrob_msgs.msg import Gap, MuscleCommand, MuscleStates
from anthrob_msgs.srv import Predict, Step, TakeModel
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from waiting import wait_for

STEPS = 5         # of 1 ms from one state to the next, 200 Hz as of a robot
CATCH_UP = 100000000  # [ns] by which the twin may be behind
LONG_ENOUGH = 13  # [s] two for settling, ten for the window
FLOORS = 3.0      # less than what the node warns of


class Twin(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.gaps, cls.muscles, cls.joints, cls.frames, cls.statuses = [], [], [], set(), {}
        rospy.Subscriber('gap', Gap, cls.gaps.append)
        rospy.Subscriber('twin/muscle_states', MuscleStates, cls.muscles.append)
        rospy.Subscriber('twin/joint_states', JointState, cls.joints.append)
        rospy.Subscriber('/tf', TFMessage, lambda m: cls.frames.update(t.child_frame_id for t in m.transforms))
        rospy.Subscriber('/diagnostics', DiagnosticArray, lambda m: cls.statuses.update((s.name, s) for s in m.status))
        cls.command = rospy.Publisher('muscle_command', MuscleCommand, queue_size=10, tcp_nodelay=True)
        cls.step = rospy.ServiceProxy('sim/step', Step, persistent=True)
        cls.step.wait_for_service(30)
        wait_for(lambda: cls.command.get_num_connections() and '/two_muscle_rig: twin' in cls.statuses, 30, 'both nodes')
        cls.now = cls.step(steps=STEPS).stamp

    def drive(self, duration, references=None):
        """With sines, or with references that stay, in lock-step."""
        end = self.now + rospy.Duration(duration)
        while self.now < end:
            t = self.now.to_sec()
            command = MuscleCommand(name=['flexor', 'extensor'], mode=[MuscleCommand.POSITION] * 2,
                                    reference=references or [1.0 + 0.3 * math.sin(2.0 * t), 1.0 + 0.3 * math.cos(1.5 * t)])
            command.header.stamp = self.now
            self.command.publish(command)
            done = type(self).step(steps=STEPS, command_stamp=self.now)
            self.assertTrue(done.success, done.message)
            type(self).now = done.stamp
            if done.stamp.to_nsec() % CATCH_UP == 0:  # the simulator does not wait for those who listen
                wait_for(lambda: self.joints and self.joints[-1].header.stamp.to_nsec() > done.stamp.to_nsec() - CATCH_UP,
                         60, 'the twin')

    def value(self, key):
        values = {v.key: v.value for v in self.statuses['/two_muscle_rig: twin'].values}
        return values.get(key)

    def last_gap(self):
        """The report of the last whole second, by window, channel and feed."""
        wait_for(lambda: self.gaps and self.gaps[-1].header.stamp > self.now - rospy.Duration(1.1), 60, 'the gap until now')
        gap = self.gaps[-1]
        return gap, numpy.array(gap.gap).reshape(len(gap.window), len(gap.channel), len(gap.feed))

    def expect_one_floor(self):
        gap, values = self.last_gap()
        told = values[1][numpy.isfinite(values[1])]
        self.assertEqual(told.size, 2 * (4 + 2 + 2) + 3)
        self.assertLess(told.max(), FLOORS, list(zip(gap.channel, values[1])))
        return gap, values

    def test_1_right_model(self):
        self.drive(LONG_ENOUGH)
        gap, values = self.expect_one_floor()
        self.assertEqual(gap.window, (1.0, 10.0, 60.0))
        self.assertEqual(gap.feed, ['commands', 'voltages', 'positions', 'postures'])
        self.assertEqual(gap.channel, ['flexor/force', 'flexor/position', 'flexor/current', 'extensor/force',
                                       'extensor/position', 'extensor/current', 'hinge/position'])
        self.assertEqual(gap.unit, ['N', 'rad', 'A', 'N', 'rad', 'A', 'rad'])
        floor = numpy.array(gap.floor).reshape(len(gap.channel), len(gap.feed))
        rms = numpy.array(gap.rms).reshape(values.shape)
        numpy.testing.assert_allclose(rms[1] / floor, values[1])
        self.assertTrue(numpy.isnan(values[1][1][2]))  # the flexor's position is imposed
        self.assertTrue(numpy.isnan(values[2]).all())  # not half a minute yet
        self.assertEqual(self.statuses['/two_muscle_rig: twin'].message, 'in step')

    def test_2_twin_is_where_the_robot_is(self):
        robot = {}
        rospy.Subscriber('joint_states', JointState, lambda m: robot.update({m.header.stamp: m.position[0]}))
        self.drive(1.0)
        wait_for(lambda: self.joints and self.joints[-1].header.stamp > self.now - rospy.Duration(0.1), 30, 'the twin')
        common = [(robot[j.header.stamp], j.position[0]) for j in self.joints if j.header.stamp in robot]
        self.assertGreater(len(common), 30)
        for measured, simulated in common:
            self.assertAlmostEqual(measured, simulated, delta=0.002)
        self.assertEqual(self.muscles[-1].name, ['flexor', 'extensor'])
        self.assertEqual(set(self.muscles[-1].ecu_state), {MuscleStates.ENABLED})
        self.assertLessEqual({'twin/base', 'twin/arm'}, self.frames)

    def test_3_nothing_moves_the_robot(self):
        node = '/two_muscle_rig/calibrator'
        published, _, services = rosgraph.Master('/twin_test').getSystemState()
        own = {topic for topic, nodes in published if node in nodes}
        states = {'/two_muscle_rig/twin/' + name for name in ('muscle_states', 'joint_states', 'spherical_joint_states')}
        jobs = {f'/two_muscle_rig/{job}/{topic}' for job in ('calibrate', 'discover', 'health/test')
                for topic in ('feedback', 'result', 'status')}
        self.assertEqual(own - {'/rosout'}, states | jobs | {'/two_muscle_rig/gap', '/two_muscle_rig/health', '/tf', '/diagnostics'})
        self.assertEqual({s for s, nodes in services if node in nodes},
                         {node + '/get_loggers', node + '/set_logger_level', '/two_muscle_rig/predict', '/two_muscle_rig/twin/take_model'})

    def test_3_prediction(self):
        ask = rospy.ServiceProxy('predict', Predict)
        references = [1.5, 1.2]
        command = MuscleCommand(name=['flexor', 'extensor'], mode=[MuscleCommand.POSITION] * 2, reference=references)
        said = ask(command=command, duration=1.0, rate=20.0)
        self.assertTrue(said.success and said.safe, said)
        self.assertEqual([len(said.muscle_states), len(said.joint_states), len(said.spherical_joint_states)], [20] * 3)
        self.assertAlmostEqual((said.joint_states[-1].header.stamp - self.now).to_sec(), 1.0, delta=0.1)
        robot = {}
        rospy.Subscriber('joint_states', JointState, lambda m: robot.update({m.header.stamp: m.position[0]}))
        self.drive(1.0, references)
        for state in said.joint_states:
            near = min(robot, key=lambda stamp: abs((stamp - state.header.stamp).to_sec()))
            self.assertAlmostEqual(robot[near], state.position[0], delta=0.01)
        # The motor may not follow, the joint has a stop.
        said = ask(command=MuscleCommand(name=['flexor', 'extensor'], mode=[MuscleCommand.VOLTAGE] * 2, reference=[12.0, 0.0]),
                   duration=10.0)
        self.assertTrue(said.success)
        self.assertFalse(said.safe)
        self.assertEqual(len(said.joint_states), 1)
        self.assertRegex(' '.join(said.warnings), r'flexor: force of .* N, beyond 100 N from|hinge: position of .* rad, beyond')
        for wrong, expected in ((dict(duration=0.0), 'duration: 0 s: expected'), (dict(duration=1.0, rate=1e9), 'rate: '),
                                (dict(duration=1.0, command=MuscleCommand(name=['x'], mode=[1], reference=[0.0])), "command: ")):
            said = ask(**wrong)
            self.assertFalse(said.success or said.safe)
            self.assertIn(expected, said.message)

    def test_4_pause(self):
        wait_for(lambda: self.statuses['/two_muscle_rig: twin'].message.startswith('stands still'), 20, 'a pause that is seen')
        self.assertEqual(self.statuses['/two_muscle_rig: twin'].level, 0)
        self.drive(1.0)
        self.last_gap()
        wait_for(lambda: self.statuses['/two_muscle_rig: twin'].message == 'in step', 20, 'the end of the pause')
        self.assertEqual(self.value('commands_starts'), '1')

    def test_5_reset(self):
        self.assertTrue(rospy.ServiceProxy('sim/reset', Trigger)().success)
        self.drive(0.5)
        wait_for(lambda: self.value('commands_starts') == '2', 20, 'a new start')
        self.assertEqual(self.value('postures_starts'), '2')
        self.assertIn(self.value('last_loss'), ['flexor jumped', 'extensor jumped', 'hinge jumped'])
        self.drive(LONG_ENOUGH)
        self.expect_one_floor()
        self.assertEqual(self.value('commands_starts'), '2')

    def test_6_another_model(self):
        take = rospy.ServiceProxy('twin/take_model', TakeModel)
        for model, expected in (('anthrob/II', 'a model of another robot: expected the muscles and joints of'),
                                ('/no/such.yaml', '/no/such.yaml')):
            said = take(model=model)
            self.assertFalse(said.success)
            self.assertIn(expected, said.message)
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        right = rospy.get_param('calibrator/model')
        with open(folder + '/soft.yaml', 'w') as file:
            file.write('extends: %s\nsprings: {rubber: {modulus: 0.6e6}}\n' % right)
        self.assertTrue(take(model=folder + '/soft.yaml').success)
        self.drive(LONG_ENOUGH)
        wait_for(lambda: self.statuses['/two_muscle_rig: twin: flexor'].message.endswith('spring or tendon'), 60, 'the soft spring')
        self.assertTrue(take(model=right).success)
        self.drive(LONG_ENOUGH)
        self.expect_one_floor()


if __name__ == '__main__':
    rospy.init_node('twin_test')
    rostest.rosrun('anthrob_tests', 'twin', Twin)
