#!/usr/bin/env python3
"""The ROS contract, the same for every back end: topics, commands, stops. Runs unchanged on the simulator and on the
driver with emulated ECUs. Everything is in real time, or in a slower pace that ~pace tells; nothing here depends on how
fast the machine is."""
import math
import statistics
import threading
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates, SphericalJointStates
from anthrob_msgs.srv import Gains
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
import waiting
from back_end import BackEnd, all_begin_anew
from malformed_commands import MALFORMED_COMMANDS

MUSCLES = ['lateral_deltoid', 'anterior_deltoid', 'posterior_deltoid', 'supraspinatus', 'infraspinatus',
           'teres_minor', 'teres_major', 'pectoralis_major', 'biceps_brachii', 'triceps_brachii', 'brachialis']
NAN = float('nan')
VOLTAGE, POSITION, CURRENT, FORCE = 0, 1, 2, 3
PACE = 1.0  # seconds of the robot in a second of the wall clock
# A stop takes effect within milliseconds; the rest is for a machine that is busy with other things.
PATIENCE = 10.0


class Latest:
    """The last messages of a topic."""

    def __init__(self, topic, kind, keep=2000):
        self.messages, self.keep = [], keep
        self.subscriber = rospy.Subscriber(topic, kind, self.receive, queue_size=1000, tcp_nodelay=True)

    def receive(self, message):
        self.messages.append(message)
        if len(self.messages) > self.keep:
            del self.messages[:self.keep // 2]

    def last(self):
        return self.messages[-1] if self.messages else None


class Commander(threading.Thread):
    """Keeps a command fresh, as a controller does."""

    def __init__(self, publisher):
        super().__init__(daemon=True)
        self.publisher, self.message = publisher, None

    def run(self):
        while not rospy.is_shutdown():
            message = self.message
            if message:
                message.header.stamp = rospy.Time.now()
                self.publisher.publish(message)
            time.sleep(0.05)


def wait_for(condition, what, seconds=PATIENCE):
    """Seconds are the robot's."""
    waiting.wait_for(condition, seconds / PACE, what)


@all_begin_anew
class Contract(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.states = Latest('muscle_states', MuscleStates)
        cls.joints = Latest('joint_states', JointState)
        cls.balls = Latest('spherical_joint_states', SphericalJointStates)
        cls.tf = Latest('/tf', TFMessage)
        cls.diagnostics = Latest('/diagnostics', DiagnosticArray)
        cls.back_end = BackEnd()
        cls.publisher = rospy.Publisher('muscle_command', MuscleCommand, queue_size=10, tcp_nodelay=True)
        cls.stop_topic = rospy.Publisher('emergency_stop', Empty, queue_size=1)
        cls.services = {}
        for name in ['enable', 'home', 'disable', 'emergency_stop', 'clear_faults']:
            rospy.wait_for_service(name, 60)
            cls.services[name] = rospy.ServiceProxy(name, Trigger)
        rospy.wait_for_service('gains', 60)
        cls.gains = staticmethod(rospy.ServiceProxy('gains', Gains))
        wait_for(lambda: cls.states.messages and cls.publisher.get_num_connections() > 0
                 and cls.stop_topic.get_num_connections() > 0, 'connections', 60)
        cls.commander = Commander(cls.publisher)
        cls.commander.start()
        # By way of the node other_sender.
        cls.other = Commander(rospy.Publisher('other_command', MuscleCommand, queue_size=10, tcp_nodelay=True))
        cls.other.start()
        # Hardware is configured first.
        wait_for(lambda: cls.call('enable').success, 'the first enable', 30)
        cls.first_gains = cls.held_of(cls.gains([], [], []))
        wait_for(lambda: cls.diagnostics.last() is not None, 'diagnostics', 30)
        if cls.diagnostics.last().status[0].name == '/anthrob: driver':
            # Units that were just switched on have no zero. A busy machine may lose one meanwhile.
            cls.recover()

    @classmethod
    def recover(cls):
        cls.commander.message = cls.other.message = None
        wait_for(cls.home, 'home', 40)

    @classmethod
    def home(cls):
        return cls.call('clear_faults').success and cls.reset_gains() and all(
            cls.call(name).success for name in ['enable', 'home'])

    @classmethod
    def reset_gains(cls):
        """A test that ended early may have left others."""
        held = cls.held_of(cls.gains([], [], []))
        left = [(*key, value) for key, value in cls.first_gains.items() if held[key] != value]
        return cls.gains([c[0] for c in left], [c[1] for c in left], [c[2] for c in left]).success

    @staticmethod
    def held_of(answer):
        return dict(zip(zip(answer.held_muscle, answer.held_gain), answer.held_value))

    @classmethod
    def call(cls, name):
        return cls.services[name]()

    def start(self):
        self.commander.message = None
        self.call('disable')
        self.call('clear_faults')
        answer = self.call('enable')
        self.assertTrue(answer.success, answer.message)
        self.await_state(MuscleStates.ENABLED)

    def tearDown(self):
        self.commander.message = self.other.message = None

    def wait_for(self, condition, what, seconds=PATIENCE):
        wait_for(self.back_end.unless_lost(condition), what, seconds)

    def send(self, names, modes, references):
        """From now on, again and again."""
        self.commander.message = MuscleCommand(name=names, mode=modes, reference=references)

    def await_state(self, state):
        self.wait_for(lambda: set(self.states.last().ecu_state) == {state}, 'ECU state %d everywhere' % state)

    def await_value(self, field, muscle, value, delta=0.011):
        index = MUSCLES.index(muscle)
        self.wait_for(lambda: abs(getattr(self.states.last(), field)[index] - value) <= delta,
                      '%s of %s to be %g' % (field, muscle, value))

    def stays_still(self, seconds=0.3):
        end = time.time() + seconds / PACE
        while time.time() < end:
            # NaN: not measured this time.
            self.assertEqual({v for v in self.states.last().voltage if not math.isnan(v)} - {0.0}, set())
            time.sleep(0.005)

    def diagnosed(self, key):
        """What the back end's last diagnostics say."""
        self.wait_for(lambda: self.diagnostics.last() is not None, 'diagnostics')
        return {v.key: v.value for v in self.diagnostics.last().status[0].values}[key]

    # ---- topics ----

    def test_states_of_all_muscles_at_200_hz(self):
        self.wait_for(lambda: len(self.states.messages) >= 150, 'states of most of a second')
        messages = self.states.messages[-300:]
        stamps = [m.header.stamp.to_sec() for m in messages]
        self.assertTrue(all(a < b for a, b in zip(stamps, stamps[1:])), 'stamps grow, none comes twice')
        # Stamps are the robot's time whatever its pace. Over ten at once, for a slow robot's clock ticks coarsely, and
        # a busy machine loses some.
        self.assertLess(statistics.median(b - a for a, b in zip(stamps, stamps[10:])), 0.06)
        last = messages[-1]
        self.assertEqual(last.name, MUSCLES)
        for array in [last.position, last.velocity, last.current, last.voltage, last.force, last.reference,
                      last.mode, last.ecu_state]:
            self.assertEqual(len(array), len(MUSCLES))
        self.assertTrue(all(force >= 0.0 for force in last.force))

    def test_stamps_are_of_now(self):
        message = self.states.last()
        self.assertLess(abs((rospy.Time.now() - message.header.stamp).to_sec()), 1.0)

    def test_joints_and_frames(self):
        self.wait_for(lambda: self.joints.last() and self.balls.last(), 'joints')
        self.assertEqual(self.joints.last().name, ['elbow'])
        self.assertEqual(len(self.joints.last().position), 1)
        self.assertEqual(len(self.joints.last().velocity), 1)  # controllers want it
        self.assertEqual(self.balls.last().name, ['shoulder'])
        q = self.balls.last().orientation[0]
        self.assertGreaterEqual(q.w, 0.0)
        self.assertAlmostEqual(q.w**2 + q.x**2 + q.y**2 + q.z**2, 1.0, delta=1e-6)
        frames = lambda: {(t.header.frame_id, t.child_frame_id) for m in self.tf.messages for t in m.transforms}
        self.wait_for(lambda: {('base', 'humerus'), ('humerus', 'forearm')} <= frames(), 'frames of the arm')

    def test_no_frame_is_empty(self):
        self.wait_for(lambda: self.joints.last() and self.balls.last(), 'joints')
        for topic in self.states, self.joints, self.balls:
            self.assertEqual(topic.last().header.frame_id, 'world')

    def test_diagnostics_name_every_ecu(self):
        self.wait_for(lambda: self.diagnostics.last() is not None, 'diagnostics')
        names = [s.name for s in self.diagnostics.last().status]
        self.assertTrue(names[0] in ('/anthrob: simulator', '/anthrob: driver'))
        for i in range(1, 7):
            self.assertIn('/anthrob: ecu_%d' % i, names)
        keys = {v.key for v in self.diagnostics.last().status[0].values}
        self.assertTrue({'rejected_commands', 'last_rejection', 'command_age'} <= keys)

    # ---- commands ----

    def test_nothing_moves_before_enable(self):
        self.call('disable')
        self.await_state(MuscleStates.STOPPING)
        self.send(MUSCLES, [VOLTAGE] * 11, [4.0] * 11)
        time.sleep(0.2 / PACE)
        self.stays_still(1.0)
        # Nor does it look as if commands were taken.
        self.wait_for(lambda: self.diagnosed('last_rejection') == 'not enabled: call enable',
                      'the refusal in diagnostics')
        rejected = int(self.diagnosed('rejected_commands'))
        self.wait_for(lambda: int(self.diagnosed('rejected_commands')) > rejected, 'more refusals in diagnostics')

    def test_successes_say_what_happened(self):
        for name in 'enable', 'disable', 'emergency_stop', 'clear_faults', 'enable':
            reply = self.call(name)
            self.assertTrue(reply.success, reply.message)
            self.assertNotEqual(reply.message, '', name)
        self.assertNotEqual(self.gains([], [], []).message, '')

    def test_home_wants_enabled_motors(self):
        self.call('disable')
        self.await_state(MuscleStates.STOPPING)
        answer = self.call('home')
        self.assertFalse(answer.success)
        self.assertIn('call enable first', answer.message)
        self.stays_still()

    def test_a_command_moves_the_arm(self):
        before = self.balls.last().orientation[0].w
        self.send(['lateral_deltoid', 'supraspinatus'], [POSITION, POSITION], [6.0, 3.0])
        self.wait_for(lambda: abs(self.balls.last().orientation[0].w - before) > 1e-3, 'a turned shoulder', 30)
        self.wait_for(lambda: self.states.last().position[0] > 2.0 and self.states.last().force[0] > 3.0, 'a pull', 30)
        state = self.states.last()
        self.assertEqual(state.reference[0], 6.0)
        self.assertEqual(state.mode[0], POSITION)
        self.assertEqual(state.ecu_state[0], MuscleStates.ENABLED)
        self.send(['lateral_deltoid', 'supraspinatus'], [POSITION, POSITION], [0.0, 0.0])
        self.wait_for(lambda: abs(self.states.last().position[0]) < 0.5, 'the way back', 30)

    def test_a_subset_leaves_the_others_alone(self):
        self.send(['biceps_brachii', 'brachialis'], [POSITION, POSITION], [0.5, 0.7])
        self.await_value('reference', 'brachialis', 0.7)
        self.send(['brachialis'], [VOLTAGE], [0.5])
        # The mode first: the voltage of position control may pass 0.5 V by itself.
        self.await_value('mode', 'brachialis', VOLTAGE, 0)
        self.await_value('voltage', 'brachialis', 0.5)
        self.assertEqual(self.states.last().reference[MUSCLES.index('biceps_brachii')], 0.5)
        self.assertEqual(self.states.last().mode[MUSCLES.index('biceps_brachii')], POSITION)

    def test_all_four_modes(self):
        for mode, reference, field, delta in [(VOLTAGE, 1.0, 'voltage', 0.011), (POSITION, 1.0, 'position', 0.2),
                                              (CURRENT, 0.2, 'current', 0.1), (FORCE, 8.0, 'force', 1.0)]:
            self.send(['lateral_deltoid'], [mode], [reference])
            self.await_value('mode', 'lateral_deltoid', mode, 0)
            self.wait_for(lambda: abs(getattr(self.states.last(), field)[0] - reference) <= delta,
                          '%s of %g' % (field, reference), 30)

    def held(self, *changes):
        """All gains after these changes of (muscle, gain, value)."""
        answer = self.gains([c[0] for c in changes], [c[1] for c in changes], [c[2] for c in changes])
        self.assertTrue(answer.success, answer.message)
        return self.held_of(answer)

    def test_gains_are_changed_in_motion_and_read_back(self):
        before = self.held()
        self.assertEqual({muscle for muscle, _ in before}, set(self.states.last().name))
        self.assertEqual(len(before), 9 * len(self.states.last().name))
        self.send(['lateral_deltoid'], [POSITION], [1.0])
        self.wait_for(lambda: self.states.last().position[0] > 0.5, 'motion', 30)
        laws = ['position_proportional', 'position_derivative', 'position_force_feedforward']
        try:
            held = self.held(*[('lateral_deltoid', gain, 0.0) for gain in laws], ('', 'force_integral', 0.75))
            wanted = {key: 0.75 if key[1] == 'force_integral' else value for key, value in before.items()}
            wanted.update({('lateral_deltoid', gain): 0.0 for gain in laws})
            self.assertEqual(held, wanted)
            self.await_value('voltage', 'lateral_deltoid', 0.0)
            self.assertEqual(set(self.states.last().ecu_state), {MuscleStates.ENABLED})
        finally:
            after = self.held(*[key + (value,) for key, value in before.items() if key[1] in laws + ['force_integral']])
        self.assertEqual(after, before)
        self.wait_for(lambda: abs(self.states.last().position[0] - 1.0) < 0.2, 'the reference', 30)

    def test_gains_that_are_wrong_are_refused_whole(self):
        before = self.held()
        for muscle, gain, value in [('nobody', 'force_integral', 1.0), ('lateral_deltoid', 'voltage_limit', 1.0),
                                    ('lateral_deltoid', 'force_integral', -1.0), ('', 'force_integral', NAN)]:
            answer = self.gains(['lateral_deltoid', muscle], ['position_proportional', gain], [1.5, value])
            self.assertFalse(answer.success)
            self.assertIn('expected', answer.message)
            self.assertEqual(self.held(), before)

    def test_malformed_commands_are_refused_whole(self):
        self.send(['lateral_deltoid'], [POSITION], [0.8])
        self.await_value('reference', 'lateral_deltoid', 0.8)

        def rejected():
            return int(self.diagnosed('rejected_commands')), self.diagnosed('last_rejection')

        time.sleep(1.5 / PACE)
        before = rejected()[0]
        # Good commands go on: the bad ones must neither take effect nor keep the good ones from it.
        for names, modes, references in MALFORMED_COMMANDS:
            self.publisher.publish(MuscleCommand(name=names, mode=modes, reference=references))
            time.sleep(0.02)
            self.assertEqual(self.states.last().reference[0], 0.8)
            self.assertEqual(self.states.last().mode[0], POSITION)
        self.wait_for(lambda: rejected()[0] == before + len(MALFORMED_COMMANDS), 'all rejections in diagnostics')
        self.assertIn('FORCE -1 N', rejected()[1])

    def test_a_recording_moves_a_simulator_and_no_robot(self):
        self.wait_for(lambda: self.diagnostics.last() is not None, 'diagnostics')
        robot = self.diagnostics.last().status[0].name == '/anthrob: driver'
        self.wait_for(lambda: rospy.Time.now().to_sec() > 2.0, 'the third second')
        old = MuscleCommand(name=['lateral_deltoid'], mode=[VOLTAGE], reference=[0.7])
        old.header.stamp = rospy.Time(1)
        self.publisher.publish(old)
        if not robot:
            return self.await_value('reference', 'lateral_deltoid', 0.7)
        values = lambda: {v.key: v.value for v in self.diagnostics.last().status[0].values}
        self.wait_for(lambda: 'a recording' in values()['last_rejection'], 'the rejection')
        self.assertEqual(self.states.last().reference[0], 0.0)

    def test_a_muscle_has_one_sender(self):
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)
        self.other.message = MuscleCommand(name=['lateral_deltoid'], mode=[VOLTAGE], reference=[-1.0])
        me, other = rospy.get_name(), rospy.resolve_name('other_sender')

        def owner_and_refused():
            said = self.diagnosed('last_rejection')
            return next(((one, two) for one, two in ((me, other), (other, me))
                         if 'is commanded by %s; %s ' % (one, two) in said), None)

        self.wait_for(owner_and_refused, 'one of them to be refused', 30)
        # Mostly it is the other one; but this one may have been silent too long on a busy machine.
        owner, refused = owner_and_refused()
        {me: self.commander, other: self.other}[owner].message = None  # now the second may, and nothing stops in between
        self.await_value('voltage', 'lateral_deltoid', {me: 1.0, other: -1.0}[refused])
        self.assertEqual(set(self.states.last().ecu_state), {MuscleStates.ENABLED})

    # ---- stops ----

    def test_timeout_stops_until_enabled_again(self):
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)
        self.commander.message = None
        self.await_state(MuscleStates.STOPPING)
        self.await_value('voltage', 'lateral_deltoid', 0.0, 0)
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.stays_still(0.5)
        self.commander.message = None
        time.sleep(0.2 / PACE)
        self.assertTrue(self.call('enable').success)
        self.await_state(MuscleStates.ENABLED)
        self.stays_still()  # the old reference is forgotten
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)

    def test_enable_in_motion_does_not_switch_the_timeout_off(self):
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)
        self.commander.message = None
        answer = self.call('enable')
        self.assertTrue(answer.success)
        self.assertEqual(answer.message, 'already enabled')
        self.await_state(MuscleStates.STOPPING)

    def check_stop_is_latched(self):
        self.await_state(MuscleStates.STOPPING)
        self.stays_still()
        answer = self.call('enable')
        self.assertFalse(answer.success)
        self.assertIn('clear_faults', answer.message)
        self.stays_still()
        self.commander.message = None
        time.sleep(0.2 / PACE)
        self.assertTrue(self.call('clear_faults').success)
        self.await_state(MuscleStates.IDLE)
        self.stays_still()
        self.assertTrue(self.call('enable').success)
        self.await_state(MuscleStates.ENABLED)
        self.stays_still()  # no jump to an old reference
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)

    def test_emergency_stop_service_is_latched(self):
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)
        self.assertTrue(self.call('emergency_stop').success)
        self.check_stop_is_latched()

    def test_emergency_stop_topic_is_latched(self):
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)
        self.stop_topic.publish(Empty())
        self.check_stop_is_latched()

    def test_disable(self):
        self.send(['lateral_deltoid'], [VOLTAGE], [1.0])
        self.await_value('voltage', 'lateral_deltoid', 1.0)
        self.assertTrue(self.call('disable').success)
        self.await_state(MuscleStates.STOPPING)
        self.stays_still()


if __name__ == '__main__':
    rospy.init_node('contract_test')
    PACE = rospy.get_param('~pace', 1.0)
    rostest.rosrun('anthrob_tests', 'contract', Contract)
