#!/usr/bin/env python3
"""The ROS contract of the simulator node: rates, commands, stops, lock-step, time."""
import math
import os
import subprocess
import tempfile
import threading
import time
import unittest

import rospkg
import rospy
import rostest
import yaml
from anthrob_msgs.msg import (
    ExternalWrenches, MomentArms, MuscleCommand, MusclePaths, MuscleStates, Quantities, SphericalJointStates, TendonPaths)
from anthrob_msgs.srv import (
    ApplyWrench, ApplyWrenchRequest, ChooseQuantities, SetRate, SetState, SetStateRequest, Snapshot, Step)
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, Quaternion, Vector3
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, MultiDOFJointState
from std_msgs.msg import Empty
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray
from malformed_commands import MALFORMED_COMMANDS
from waiting import wait_for

MUSCLES = ['lateral_deltoid', 'anterior_deltoid', 'posterior_deltoid', 'supraspinatus', 'infraspinatus',
           'teres_minor', 'teres_major', 'pectoralis_major', 'biceps_brachii', 'triceps_brachii', 'brachialis']
NAN = float('nan')


class Collector:
    """Keeps every message of a topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=10000, tcp_nodelay=True)

    def last(self):
        return self.messages[-1] if self.messages else None


class SimContract(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.states = Collector('muscle_states', MuscleStates)
        cls.joints = Collector('joint_states', JointState)
        cls.balls = Collector('spherical_joint_states', SphericalJointStates)
        cls.clock = Collector('/clock', Clock)
        cls.tf = Collector('/tf', TFMessage)
        cls.diagnostics = Collector('/diagnostics', DiagnosticArray)
        cls.paths = Collector('muscle_paths', MarkerArray)
        cls.solved = Collector('solved_paths', MusclePaths)
        cls.command = rospy.Publisher('muscle_command', MuscleCommand, queue_size=10, tcp_nodelay=True)
        cls.stop_topic = rospy.Publisher('emergency_stop', Empty, queue_size=1)
        for name in ['enable', 'home', 'disable', 'emergency_stop', 'clear_faults', 'sim/pause', 'sim/step', 'sim/reset',
                     'sim/set_state', 'sim/set_rate', 'sim/apply_wrench', 'sim/choose_quantities', 'sim/save', 'sim/restore']:
            rospy.wait_for_service(name, 30)
        cls.enable = rospy.ServiceProxy('enable', Trigger)
        cls.home = rospy.ServiceProxy('home', Trigger)
        cls.disable = rospy.ServiceProxy('disable', Trigger)
        cls.emergency_stop = rospy.ServiceProxy('emergency_stop', Trigger)
        cls.clear_faults = rospy.ServiceProxy('clear_faults', Trigger)
        cls.pause = rospy.ServiceProxy('sim/pause', SetBool)
        step = rospy.ServiceProxy('sim/step', Step)
        cls.step = staticmethod(lambda count, command=rospy.Time(): step(steps=count, command_stamp=command))
        cls.reset = rospy.ServiceProxy('sim/reset', Trigger)
        cls.set_state = rospy.ServiceProxy('sim/set_state', SetState)
        cls.set_rate = rospy.ServiceProxy('sim/set_rate', SetRate)
        cls.apply_wrench = rospy.ServiceProxy('sim/apply_wrench', ApplyWrench)
        cls.choose = rospy.ServiceProxy('sim/choose_quantities', ChooseQuantities)
        cls.save = rospy.ServiceProxy('sim/save', Snapshot)
        cls.restore = rospy.ServiceProxy('sim/restore', Snapshot)
        cls.wrenches = Collector('external_wrenches', ExternalWrenches)
        wait_for(lambda: cls.states.messages and cls.command.get_num_connections() > 0
                 and cls.stop_topic.get_num_connections() > 0, 30, 'connections')

    def setUp(self):
        self.unstepped = rospy.Time()
        self.pause(True)
        self.clear_faults()
        self.reset()
        self.enable()

    def send(self, names, modes, references):
        """Publishes a command; the node has it before it advances, or else does not advance."""
        self.unstepped += rospy.Duration(0, 1)
        command = MuscleCommand(name=names, mode=modes, reference=references)
        command.header.stamp = self.unstepped
        self.command.publish(command)

    def advance(self, steps):
        """Lock-step; returns the states after it."""
        answer = self.step(steps, self.unstepped)
        self.assertTrue(answer.success, answer.message)
        wait_for(lambda: self.states.last().header.stamp >= answer.stamp, 5, 'states after the step')
        return self.states.last()

    # ---- pushes ----

    def push(self, **request):
        return self.apply_wrench(ApplyWrenchRequest(**request))

    def pushed(self):
        return list(self.wrenches.last().link) if self.wrenches.messages else None

    def test_a_link_is_pushed_for_as_long_as_asked(self):
        self.disable()
        self.advance(10)
        before = self.joints.last().position[0]
        lift = dict(link='forearm', point=Point(z=-0.2), force=Vector3(y=-30.0))
        self.assertTrue(self.push(duration=rospy.Duration(0.3), **lift).success)
        self.assertTrue(self.push(link='humerus', torque=Vector3(x=0.1), duration=rospy.Duration(0.1)).success)
        self.advance(200)
        wait_for(lambda: self.pushed() == ['forearm'], 5, 'the push')
        acting = self.wrenches.last()
        self.assertEqual(acting.header.frame_id, 'world')
        self.assertEqual((acting.point[0].z, acting.wrench[0].force.y), (-0.2, -30.0))
        self.assertAlmostEqual(acting.left[0].to_sec(), 0.1, delta=1e-6)
        self.advance(100)
        wait_for(lambda: self.pushed() == [], 5, 'the end of the pushes')
        self.assertGreater(self.joints.last().position[0], before + 0.1)
        count = len(self.wrenches.messages)
        self.advance(20)
        self.assertEqual(len(self.wrenches.messages), count)

    def test_a_push_can_be_ended_and_ends_with_a_reset(self):
        for end in (lambda: self.push(link='forearm', point=Point(z=-0.2)), self.reset):
            self.push(link='forearm', point=Point(z=-0.2), force=Vector3(z=1.0), duration=rospy.Duration(1000))
            self.advance(1)
            wait_for(lambda: self.pushed() == ['forearm'], 5, 'the push')
            end()
            self.advance(1)
            wait_for(lambda: self.pushed() == [], 5, 'its end')

    def test_a_push_that_is_none_is_refused(self):
        second = rospy.Duration(1)
        for why, request in [("link 'elbow': unknown; expected one of world, base, ", dict(link='elbow', duration=second)),
                             ('force', dict(link='forearm', force=Vector3(x=float('nan')), duration=second)),
                             ('point', dict(link='forearm', point=Point(x=float('inf')), duration=second)),
                             ('torque', dict(link='forearm', torque=Vector3(y=1e12), duration=second)),
                             ('duration', dict(link='forearm', duration=rospy.Duration(-1)))]:
            answer = self.push(**request)
            self.assertFalse(answer.success)
            self.assertIn(why, answer.message)

    # ---- snapshots ----

    def state_after(self, steps):
        state, joints = self.advance(steps), self.joints
        wait_for(lambda: joints.last().header.stamp == state.header.stamp, 5, 'the joints of the same time')
        return state.header.stamp, state.position + joints.last().position + state.reference

    def test_a_snapshot_is_restored_and_goes_on_as_before(self):
        self.send(['lateral_deltoid', 'brachialis'], [0, 0], [6.0, 4.0])
        self.advance(200)
        self.push(link='forearm', force=Vector3(y=20.0), duration=rospy.Duration(0.1))
        self.assertTrue(self.save('lifted').success)
        first = self.state_after(150)
        self.reset()
        self.unstepped = rospy.Time()
        answer = self.restore('lifted')
        self.assertTrue(answer.success, answer.message)
        self.assertIn('lifted', answer.saved)
        again = self.state_after(150)
        self.assertGreater(again[0], first[0])  # time goes on
        for a, b in zip(first[1], again[1]):
            self.assertAlmostEqual(a, b, delta=1e-3)  # sensors have another noise

    def test_a_snapshot_enables_nothing(self):
        self.send(['lateral_deltoid'], [0], [6.0])
        self.assertEqual(self.advance(10).voltage[0], 6.0)
        self.assertTrue(self.save('pulls').success)
        self.emergency_stop()
        self.assertTrue(self.restore('pulls').success)
        state = self.advance(5)
        self.assertEqual(state.voltage[0], 0.0)
        self.assertEqual(set(state.ecu_state), {MuscleStates.STOPPING})

    def test_a_snapshot_that_is_none_is_refused(self):
        self.save('lifted')
        answer = self.restore('liftd')
        self.assertFalse(answer.success)
        self.assertIn("did you mean 'lifted'?", answer.message)
        self.assertFalse(self.save('').success)

    # ---- quantities ----

    def test_quantities_are_those_that_were_chosen(self):
        quantities = Collector('sim/quantities', Quantities)
        arms = Collector('moment_arms', MomentArms)
        every = self.choose([])
        self.assertTrue(every.success)
        self.assertEqual(every.chosen, [])
        chosen = ['elbow/position', 'brachialis/voltage', 'elbow/reaction/z', 'energy/elastic']
        self.assertLessEqual(set(chosen), set(every.available))
        self.assertTrue(self.choose(chosen).success)
        wait_for(lambda: quantities.subscriber.get_num_connections() > 0 and arms.subscriber.get_num_connections() > 0,
                 5, 'connections')
        self.send(['brachialis'], [0], [2.5])
        self.advance(100)
        wait_for(lambda: quantities.last() is not None
                 and quantities.last().header.stamp == self.joints.last().header.stamp, 5, 'quantities')
        values = dict(zip(quantities.last().name, quantities.last().value))
        self.assertEqual(list(quantities.last().name), chosen)
        self.assertAlmostEqual(values['elbow/position'], self.joints.last().position[0], delta=1e-2)
        self.assertEqual(values['brachialis/voltage'], 2.5)
        self.assertNotEqual(values['elbow/reaction/z'], 0.0)
        refused = self.choose(['elbow/positon'])
        self.assertFalse(refused.success)
        self.assertIn("did you mean 'elbow/position'?", refused.message)
        self.assertEqual(list(refused.chosen), chosen)
        wait_for(lambda: arms.last() is not None, 5, 'moment arms')
        self.assertEqual(list(arms.last().muscle), MUSCLES)
        self.assertEqual(list(arms.last().axis), ['shoulder_x', 'shoulder_y', 'shoulder_z', 'elbow'])
        brachialis = MUSCLES.index('brachialis')
        self.assertEqual(len(arms.last().arm), 4 * len(MUSCLES))
        self.assertEqual(arms.last().arm[4 * brachialis:4 * brachialis + 3], (0.0, 0.0, 0.0))
        self.assertGreater(arms.last().arm[4 * brachialis + 3], 5e-3)  # it flexes the elbow

    # ---- topics and rates ----

    def test_the_rate_can_be_changed(self):
        for factor in (-1.0, 1e-6, float('nan'), float('inf')):
            answer = self.set_rate(factor)
            self.assertFalse(answer.success)
            self.assertIn('expected 0', answer.message)
        self.addCleanup(self.set_rate, 1.0)
        self.assertTrue(self.set_rate(0.1).success)
        self.pause(False)
        time.sleep(0.2)
        begin, count = time.time(), len(self.clock.messages)
        time.sleep(2.0)
        passed = (self.clock.messages[-1].clock - self.clock.messages[count - 1].clock).to_sec()
        self.assertLess(passed / (time.time() - begin), 0.15)
        self.assertGreater(passed, 0.0)

    def test_publishes_states_and_clock_in_real_time(self):
        self.pause(False)
        time.sleep(0.5)
        n0, c0, t0 = len(self.states.messages), len(self.clock.messages), time.time()
        time.sleep(3.0)
        elapsed = time.time() - t0
        # Against the simulated time that passed, so that a busy machine does not matter.
        passed = (self.clock.messages[-1].clock - self.clock.messages[c0].clock).to_sec()
        self.assertGreaterEqual((len(self.states.messages) - n0) / passed, 200)
        self.assertGreaterEqual((len(self.clock.messages) - c0) / passed, 200)
        self.assertLess(passed / elapsed, 1.1)
        last = self.states.last()
        self.assertEqual(last.name, MUSCLES)
        for array in [last.position, last.velocity, last.current, last.voltage, last.force, last.reference,
                      last.mode, last.ecu_state]:
            self.assertEqual(len(array), 11)
        self.assertEqual(self.joints.last().name, ['elbow'])
        self.assertEqual(self.balls.last().name, ['shoulder'])
        self.assertGreaterEqual(self.balls.last().orientation[0].w, 0.0)
        frames = {(t.header.frame_id, t.child_frame_id) for m in self.tf.messages[-50:] for t in m.transforms}
        self.assertIn(('base', 'humerus'), frames)
        self.assertIn(('humerus', 'forearm'), frames)
        self.assertEqual([m.ns for m in self.paths.last().markers], MUSCLES)

    def test_solved_paths_are_what_is_drawn(self):
        self.advance(1)
        wait_for(lambda: self.solved.last() is not None and self.paths.last() is not None, 5, 'solved paths')
        self.assertEqual([m.name for m in self.solved.last().muscles], MUSCLES)
        drawn = {m.ns: m.points for m in self.paths.last().markers}
        contacts = 0
        for muscle in self.solved.last().muscles:
            points = drawn[muscle.name]
            length = sum(math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)) for a, b in zip(points, points[1:]))
            self.assertAlmostEqual(length, muscle.length, delta=1e-3)
            for contact in muscle.contacts:
                contacts += contact.touching
                for end in (contact.entry, contact.exit):
                    if contact.touching:
                        self.assertLess(min(math.dist((p.x, p.y, p.z), (end.x, end.y, end.z)) for p in points), 1e-4)
        self.assertGreater(contacts, 0)

    def test_tendons_are_told_by_link_to_who_asks_also_while_time_stands_still(self):
        self.advance(10)
        told = Collector('tendon_paths', TendonPaths)
        wait_for(lambda: len(told.messages) > 2, 5, 'tendons of a paused simulator')
        told.subscriber.unregister()
        self.assertEqual(told.last().header.stamp, self.clock.last().clock)
        self.assertEqual([path.name for path in told.last().muscles], MUSCLES)
        biceps = told.last().muscles[MUSCLES.index('biceps_brachii')]
        self.assertEqual((biceps.link[0], biceps.link[-1]), ('world', 'forearm'))
        self.assertEqual(len(biceps.link), len(biceps.point))

    def test_stamps_are_the_clock_and_grow(self):
        self.advance(10)
        self.advance(10)
        stamps = [m.header.stamp for m in self.states.messages]
        self.assertTrue(all(a <= b for a, b in zip(stamps, stamps[1:])))
        wait_for(lambda: self.clock.last().clock == self.states.last().header.stamp, 2, 'the same time')

    def test_ball_joints_in_the_message_of_ros(self):
        same = Collector('multi_dof_joint_states', MultiDOFJointState)
        wait_for(lambda: self.advance(1) and same.messages, 10, 'ball joints in the message of ROS')
        self.assertEqual(same.last().joint_names, self.balls.last().name)
        self.assertAlmostEqual(same.last().transforms[0].rotation.w, self.balls.last().orientation[0].w, delta=0.01)
        self.assertEqual(same.last().header.frame_id, 'world')

    def test_diagnostics_name_every_ecu(self):
        wait_for(lambda: self.diagnostics.last() is not None, 5, 'diagnostics')
        names = [s.name for s in self.diagnostics.last().status]
        self.assertIn('/anthrob: simulator', names)
        for i in range(1, 7):
            self.assertIn('/anthrob: ecu_%d' % i, names)
        values = {v.key for v in self.diagnostics.last().status[0].values}
        self.assertTrue({'real_time_factor', 'late_cycles', 'rejected_commands'} <= values)

    def test_a_path_point_inside_a_surface_is_reported(self):
        def paths():
            last = self.diagnostics.last()
            return next((s for s in last.status if s.name == '/anthrob: muscle paths'), None) if last else None
        wait_for(lambda: paths() is not None and paths().level == 0, 5, 'paths that are as they should be')
        # Flexed by 90 degrees, drawn across the chest by 34.
        self.assertTrue(self.set_state(
            ball_joint_name=['shoulder'],
            ball_joint_orientation=[Quaternion(w=0.6762, x=-0.6504, y=0.2067, z=-0.2775)]).success)
        wait_for(lambda: paths().level == 1 and paths().message ==
                 'posterior_deltoid: a path point lies 12.4 mm inside the cylinder on humerus (path.4)', 5, 'warning')
        self.reset()
        wait_for(lambda: paths().level == 0, 5, 'the warning to end')

    # ---- commands ----

    def test_a_command_moves_the_arm(self):
        before = self.balls.last().orientation[0].w
        for _ in range(20):
            self.send(['lateral_deltoid', 'supraspinatus'], [1, 1], [6.0, 3.0])
            self.advance(100)
        wait_for(lambda: self.balls.last().orientation[0].w < before - 1e-3, 2, 'a turned shoulder')
        state = self.states.last()
        self.assertGreater(state.position[0], 2.0)
        self.assertGreater(state.force[0], 3.0)
        self.assertEqual(state.reference[0], 6.0)
        self.assertEqual(state.mode[0], MuscleCommand.POSITION)
        self.assertEqual(state.ecu_state[0], MuscleStates.ENABLED)

    def test_a_subset_leaves_the_others_alone(self):
        self.send(['biceps_brachii', 'brachialis'], [1, 1], [0.5, 0.7])
        self.send(['brachialis'], [0], [2.0])
        state = self.advance(10)
        self.assertEqual(state.reference[MUSCLES.index('biceps_brachii')], 0.5)
        self.assertEqual(state.reference[MUSCLES.index('brachialis')], 2.0)
        self.assertEqual(state.mode[MUSCLES.index('brachialis')], MuscleCommand.VOLTAGE)
        self.assertEqual(state.voltage[MUSCLES.index('brachialis')], 2.0)

    def test_all_four_modes(self):
        for mode, reference in [(0, 3.0), (1, 0.4), (2, 0.5), (3, 10.0)]:
            for _ in range(10):
                self.send(['lateral_deltoid'], [mode], [reference])
                state = self.advance(200)
            self.assertEqual(state.mode[0], mode)
            if mode == 2:
                self.assertAlmostEqual(state.current[0], reference, delta=0.05)
            if mode == 3:
                self.assertAlmostEqual(state.force[0], reference, delta=0.5)

    def run_gains(self, *arguments):
        return subprocess.run(['rosrun', 'anthrob_control', 'anthrob_gains'] + list(arguments), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=60)

    def test_gains_from_the_command_line(self):
        before = self.run_gains()
        self.assertEqual(before.returncode, 0, before.stderr)
        self.assertEqual(len(before.stdout.splitlines()), 9 * len(MUSCLES))
        try:
            done = self.run_gains('lateral_deltoid/position_proportional=5.5', 'all/force_integral=0.625')
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn('lateral_deltoid/position_proportional=5.5\n', done.stdout)
            self.assertEqual(done.stdout.count('/force_integral=0.625\n'), len(MUSCLES))
            for wrong in 'lateral_deltoid', '/force_integral=1', 'lateral_deltoid/force_integral', 'nobody/force_integral=1', 'all/force_integral=x', \
                    'all/force_integral=-1':
                refused = self.run_gains(wrong)
                self.assertEqual(refused.returncode, 2, wrong)
                self.assertIn('expected', refused.stderr)
                self.assertEqual(refused.stderr.count('\n'), 1, refused.stderr)
            model = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob', 'model_II.yaml')
            with tempfile.TemporaryDirectory() as folder:
                file = os.path.join(folder, 'model_tuned.yaml')
                saved = self.run_gains('--model', model, '--save', file)
                self.assertEqual(saved.returncode, 0, saved.stderr)
                with open(file) as text:
                    content = yaml.safe_load(text)
            self.assertEqual(content['muscles'], {muscle: {'gains': dict(
                {'force_integral': 0.625}, **({'position_proportional': 5.5} if muscle == 'lateral_deltoid' else {}))}
                for muscle in MUSCLES})
            for over in model, os.path.join(os.path.dirname(model), 'model_I.yaml'):
                refused = self.run_gains('--model', model, '--save', over)
                self.assertEqual(refused.returncode, 2, refused.stderr)
                self.assertIn('expected another file', refused.stderr)
        finally:
            restored = self.run_gains(*before.stdout.splitlines())
        self.assertEqual(restored.stdout, before.stdout)
        nobody = self.run_gains('--robot', 'nobody')
        self.assertEqual(nobody.returncode, 1)
        self.assertIn('/nobody/gains: no robot answers', nobody.stderr)

    def test_malformed_commands_are_refused_whole(self):
        self.send(['lateral_deltoid'], [1], [0.8])
        good = self.advance(2)

        def rejected():
            values = {v.key: v.value for v in self.diagnostics.last().status[0].values}
            return int(values['rejected_commands']), values['last_rejection']

        time.sleep(1.2)
        before = rejected()[0]
        for names, modes, references in MALFORMED_COMMANDS:
            self.send(names, modes, references)
            state = self.advance(1)
            self.assertEqual(state.reference, good.reference)
            self.assertEqual(state.mode, good.mode)
        wait_for(lambda: rejected()[0] == before + len(MALFORMED_COMMANDS), 3, 'all rejections in diagnostics')
        self.assertIn('FORCE -1 N', rejected()[1])

    # ---- stops ----

    def test_a_script_that_starts_the_robot_starts_the_simulator(self):
        self.assertTrue(self.home().success)
        self.assertEqual(set(self.advance(490).ecu_state), {MuscleStates.ENABLED})
        # Commands are watched from there on.
        self.assertEqual(set(self.advance(20).ecu_state), {MuscleStates.STOPPING})
        self.assertTrue(self.enable().success)
        self.assertEqual(set(self.advance(1).ecu_state), {MuscleStates.ENABLED})

    def test_timeout_stops_and_a_fresh_command_resumes(self):
        self.send(['lateral_deltoid'], [0], [4.0])
        self.assertEqual(self.advance(450).voltage[0], 4.0)
        state = self.advance(100)
        self.assertEqual(state.voltage[0], 0.0)
        self.assertEqual(set(state.ecu_state), {MuscleStates.STOPPING})
        self.send(['biceps_brachii'], [0], [1.0])
        state = self.advance(10)
        self.assertEqual(set(state.ecu_state), {MuscleStates.ENABLED})
        self.assertEqual(state.voltage[MUSCLES.index('biceps_brachii')], 1.0)
        self.assertEqual(state.voltage[0], 0.0)  # the old reference is forgotten

    def check_stop_is_latched(self):
        state = self.advance(2)
        self.assertEqual(state.voltage[0], 0.0)
        self.assertEqual(set(state.ecu_state), {MuscleStates.STOPPING})
        self.send(['lateral_deltoid'], [0], [4.0])
        self.assertEqual(self.advance(20).voltage[0], 0.0)
        answer = self.enable()
        self.assertFalse(answer.success)
        self.assertIn('clear_faults', answer.message)
        self.assertTrue(self.clear_faults().success)
        self.send(['lateral_deltoid'], [0], [4.0])
        self.assertEqual(self.advance(20).voltage[0], 0.0)
        self.assertTrue(self.enable().success)
        self.assertEqual(self.advance(20).voltage[0], 0.0)  # no jump to an old reference
        self.send(['lateral_deltoid'], [0], [4.0])
        self.assertEqual(self.advance(20).voltage[0], 4.0)

    def test_emergency_stop_service_is_latched(self):
        self.send(['lateral_deltoid'], [0], [4.0])
        self.advance(10)
        self.assertTrue(self.emergency_stop().success)
        self.check_stop_is_latched()

    def test_emergency_stop_topic_is_latched(self):
        self.send(['lateral_deltoid'], [0], [4.0])
        self.advance(10)
        self.stop_topic.publish(Empty())
        # Long before the command would time out.
        wait_for(lambda: set(self.advance(1).ecu_state) == {MuscleStates.STOPPING}, 2, 'the stop')
        self.check_stop_is_latched()

    def test_disable(self):
        self.send(['lateral_deltoid'], [0], [4.0])
        self.advance(10)
        self.assertTrue(self.disable().success)
        self.assertEqual(self.advance(2).voltage[0], 0.0)
        self.send(['lateral_deltoid'], [0], [4.0])
        self.assertEqual(self.advance(2).voltage[0], 0.0)

    # ---- time ----

    def test_lock_step_advances_exactly(self):
        start = self.step(1).stamp
        for n in [1, 7, 1000]:
            stamp = self.step(n).stamp
            self.assertEqual((stamp - start).to_nsec(), n * 1000000)
            start = stamp
        answer = self.step(0)
        self.assertFalse(answer.success)
        self.assertIn('expected a number > 0', answer.message)

    def test_stops_are_heard_during_a_long_step(self):
        steps = threading.Thread(target=self.step, args=(100000,), daemon=True)
        steps.start()
        time.sleep(0.2)
        self.assertTrue(self.disable().success)
        answer = self.emergency_stop()
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(steps.is_alive(), 'the stop waited for the steps')
        steps.join(120)
        self.assertFalse(self.enable().success)
        self.assertTrue(self.clear_faults().success)
        self.assertTrue(self.enable().success)

    def test_lock_step_waits_for_its_command_whatever_another_clock_stamped(self):
        now = self.step(1).stamp
        ahead = MuscleCommand(name=['lateral_deltoid'], mode=[1], reference=[1.0])
        ahead.header.stamp = now + rospy.Duration(3600)
        self.command.publish(ahead)
        wait_for(lambda: self.step(1).success and self.states.last().reference[0] == 1.0, 5, 'the command ahead')
        answer = self.step(1, self.states.last().header.stamp)
        self.assertFalse(answer.success)
        self.assertIn('no muscle_command with the requested stamp', answer.message)

    def test_paused_time_stands_still(self):
        stamp = self.step(1).stamp
        time.sleep(0.3)
        self.assertEqual(self.step(1).stamp - stamp, rospy.Duration(0, 1000000))

    def test_paused_clock_is_repeated(self):
        stamp = self.step(1).stamp
        late = Collector('/clock', Clock)
        wait_for(lambda: len(late.messages) >= 2, 5, 'the clock of a simulator that is paused')
        self.assertEqual({m.clock for m in late.messages}, {stamp})
        late.subscriber.unregister()

    def shown_in_tf(self, child):
        """As tf2 keeps it: the newest stamp, and of equal stamps what came first."""
        newest = None
        for message in list(self.tf.messages):
            for transform in message.transforms:
                if transform.child_frame_id == child and (newest is None
                                                          or transform.header.stamp > newest.header.stamp):
                    newest = transform
        return newest.transform.rotation

    def test_what_is_placed_while_paused_shows_in_tf(self):
        def turned(child, rest, angle):
            turn = self.shown_in_tf(child)
            cosine = abs(turn.w * rest.w + turn.x * rest.x + turn.y * rest.y + turn.z * rest.z)
            return abs(2.0 * math.acos(min(1.0, cosine)) - angle) < 1e-3

        self.advance(100)
        self.reset()
        time.sleep(0.5)
        rest = {child: self.shown_in_tf(child) for child in ['humerus', 'forearm']}
        for elbow, shoulder in [(1.0, 0.4), (0.0, 0.0), (0.5, 0.2)]:
            before = self.clock.last().clock
            ball = Quaternion(w=math.cos(shoulder / 2), x=math.sin(shoulder / 2), y=0, z=0)
            answer = self.set_state(SetStateRequest(joint_name=['elbow'], joint_position=[elbow],
                                                    ball_joint_name=['shoulder'], ball_joint_orientation=[ball]))
            self.assertTrue(answer.success, answer.message)
            wait_for(lambda: turned('humerus', rest['humerus'], shoulder), 3, 'the shoulder in tf')
            wait_for(lambda: turned('forearm', rest['forearm'], elbow), 3, 'the elbow in tf')
            wait_for(lambda: self.clock.last().clock > before, 3, 'an instant of its own')
        self.reset()
        for child in rest:
            wait_for(lambda: turned(child, rest[child], 0.0), 3, child + ' at rest in tf')

    def test_reset_keeps_time_going(self):
        for _ in range(5):
            self.send(['lateral_deltoid'], [1], [6.0])
            self.advance(300)
        before = self.step(1).stamp
        self.assertTrue(self.reset().success)
        after = self.step(1).stamp
        self.assertGreater(after, before)
        wait_for(lambda: self.states.last().header.stamp == after, 2, 'states after reset')
        self.assertAlmostEqual(self.states.last().position[0], 0.0, delta=1e-3)
        wait_for(lambda: self.balls.last().orientation[0].w > 1 - 1e-6, 2, 'the shoulder at rest')

    def test_set_state(self):
        request = SetStateRequest()
        request.joint_name = ['elbow']
        request.joint_position = [1.0]
        request.ball_joint_name = ['shoulder']
        request.ball_joint_orientation = [Quaternion(w=math.cos(0.2), x=math.sin(0.2), y=0, z=0)]
        request.muscle_name = ['biceps_brachii']
        request.muscle_position = [2.0]
        answer = self.set_state(request)
        self.assertTrue(answer.success, answer.message)
        wait_for(lambda: abs(self.joints.last().position[0] - 1.0) < 1e-9, 2, 'the elbow')
        wait_for(lambda: abs(self.balls.last().orientation[0].w - math.cos(0.2)) < 1e-9, 2, 'the shoulder')
        wait_for(lambda: self.states.last().position[MUSCLES.index('biceps_brachii')] == 2.0, 2, 'the biceps')

    def test_set_state_restores_what_sank_into_a_stop(self):
        answer = self.set_state(SetStateRequest(joint_name=['elbow'], joint_position=[-0.0003]))
        self.assertTrue(answer.success, answer.message)

    def test_set_state_refuses_nonsense(self):
        cases = [
            (dict(joint_name=['knee'], joint_position=[0.0]), 'knee'),
            (dict(joint_name=['elbow'], joint_position=[9.0]), 'limits'),
            (dict(joint_name=['elbow'], joint_position=[NAN]), 'expected a finite'),
            (dict(joint_name=['elbow'], joint_position=[]), 'differ'),
            (dict(joint_name=['shoulder'], joint_position=[0.0]), 'shoulder'),
            (dict(ball_joint_name=['shoulder'], ball_joint_orientation=[Quaternion(w=0.5)]),
             '(0.5, 0, 0, 0): expected a unit quaternion'),
            (dict(muscle_name=['nobody'], muscle_position=[0.0]), 'nobody'),
            (dict(muscle_name=['brachialis'], muscle_position=[NAN]), 'finite'),
            (dict(muscle_name=['brachialis'], muscle_position=[1e6]), 'limits'),
        ]
        for fields, word in cases:
            answer = self.set_state(SetStateRequest(**fields))
            self.assertFalse(answer.success)
            self.assertIn(word, answer.message)


if __name__ == '__main__':
    rospy.init_node('sim_contract_test')
    rostest.rosrun('anthrob_tests', 'sim_contract', SimContract)
