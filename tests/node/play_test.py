#!/usr/bin/env python3
"""A recording is shown as if the robot were there: joints in tf, tendons as markers; its commands are not played."""
import math
import os
import signal
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, MuscleStates, PlayerState, SphericalJointStates
from anthrob_msgs.srv import Seek, SetRate
from geometry_msgs.msg import Quaternion, Vector3
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray
from waiting import wait_for

HALF = 0.2  # [rad] half of the shoulder's angle


def write_recording(file):
    """1 s of an arm at rest and 1 s of an arm that is held up, and commands."""
    with rosbag.Bag(file, 'w') as bag:
        for i in range(400):
            stamp = rospy.Time.from_sec(1000.0 + 0.005 * i)
            half = HALF if i >= 200 else 0.0
            elbow = JointState(name=['elbow'], position=[0.5])
            shoulder = SphericalJointStates(name=['shoulder'], angular_velocity=[Vector3()],
                                            orientation=[Quaternion(math.sin(half), 0.0, 0.0, math.cos(half))])
            muscles = MuscleStates(name=['brachialis'], force=[7.0])
            command = MuscleCommand(name=['brachialis'], mode=[MuscleCommand.VOLTAGE], reference=[1.0])
            for topic, message in (('joint_states', elbow), ('spherical_joint_states', shoulder),
                                   ('muscle_states', muscles), ('muscle_command', command)):
                message.header.stamp = stamp
                bag.write('/anthrob/' + topic, message, t=stamp)


def turned_by(turned):
    """[rad] from rest, of the last that was seen of the shoulder."""
    a, b = turned[0].transform.rotation, turned[-1].transform.rotation
    return 2.0 * math.acos(min(1.0, abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z)))


class Play(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.bag = os.path.join(self.folder.name, 'run.bag')
        write_recording(self.bag)
        self.addCleanup(rospy.set_param, '/use_sim_time', False)

    def launch(self, *asked):
        outside = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        launch = subprocess.Popen(['roslaunch', 'anthrob_bringup', 'play.launch', 'bag:=' + self.bag, 'rviz:=false', *asked], env=outside,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(launch.communicate)
        self.addCleanup(launch.send_signal, signal.SIGINT)
        return launch

    def test_ends_with_the_recording(self):
        launch = self.launch('loop:=false')
        said, _ = launch.communicate(timeout=60)
        self.assertEqual(launch.returncode, 0)
        self.assertNotIn('died', said)

    def test_joints_and_tendons_are_where_they_were(self):
        turned, drawn, commanded, stamps = [], [], [], []
        rospy.Subscriber('/tf', TFMessage, lambda m: turned.extend(t for t in m.transforms if t.child_frame_id == 'humerus'))
        rospy.Subscriber('muscle_paths', MarkerArray, drawn.append)
        rospy.Subscriber('muscle_command', MuscleCommand, commanded.append)
        rospy.Subscriber('joint_states', JointState, lambda m: stamps.append(m.header.stamp))
        self.launch()
        wait_for(lambda: turned and drawn, 40, 'shoulder and tendons')
        wait_for(lambda: abs(turned_by(turned) - 2.0 * HALF) < 1e-6, 10, 'the raised arm')
        self.assertEqual(len({marker.ns for marker in drawn[-1].markers}), 11)
        wait_for(lambda: any(b < a for a, b in zip(stamps, stamps[1:])), 20, 'the second time')
        drawn.clear()
        wait_for(lambda: drawn, 10, 'tendons once more')
        self.assertFalse(commanded)

    def test_every_message_is_played_once(self):
        played = []
        rospy.Subscriber('joint_states', JointState, lambda m: played.append(m.header.stamp.to_sec()), queue_size=1000)
        self.launch('loop:=false').communicate(timeout=60)
        whole = [round(0.005 * i, 4) for i in range(400)]
        self.assertGreater(len(played), 300)  # this node may connect late
        self.assertEqual([round(t - 1000.0, 4) for t in played], whole[-len(played):])

    def test_goes_to_any_place(self):
        turned, states = [], []
        rospy.Subscriber('/tf', TFMessage, lambda m: turned.extend(t for t in m.transforms if t.child_frame_id == 'humerus'))
        rospy.Subscriber('player/state', PlayerState, states.append)
        self.launch()
        wait_for(lambda: turned and states, 40, 'shoulder and player')
        self.assertEqual((states[-1].bag, round(states[-1].duration, 3)), (self.bag, 1.995))
        call = {name: rospy.ServiceProxy('player/' + name, kind) for name, kind in (('pause', SetBool), ('seek', Seek), ('set_rate', SetRate))}
        self.assertTrue(call['pause'](True).success)
        for position, turn in (1.5, HALF), (0.5, 0.0), (1.9, HALF):  # back, too, though the clock stands
            self.assertTrue(call['seek'](position).success)
            wait_for(lambda: abs(turned_by(turned) - 2.0 * turn) < 1e-6, 10, 'the shoulder at %s s' % position)
            self.assertTrue(states[-1].paused)
        self.assertTrue(call['set_rate'](0.1).success)
        wait_for(lambda: states[-1].rate == 0.1, 10, 'the rate')
        self.assertFalse(call['set_rate'](0.0).success)
        self.assertFalse(call['seek'](math.nan).success)

    def test_a_bag_of_another_robot_is_refused(self):
        said, _ = self.launch('robot:=two_muscle_rig', 'model:=I').communicate(timeout=60)
        self.assertIn("is of the robot 'anthrob'; expected one of 'two_muscle_rig'", said)

    def test_a_robot_that_is_there_is_left_alone(self):
        states = rospy.Publisher('muscle_states', MuscleStates, queue_size=1)
        self.addCleanup(states.unregister)
        launch = self.launch()
        said, _ = launch.communicate(timeout=60)
        self.assertIn('publishes /anthrob/muscle_states; stop it first', said)
        self.assertFalse(rospy.get_param('/use_sim_time'))


if __name__ == '__main__':
    rospy.init_node('play_test')
    rostest.rosrun('anthrob_tests', 'play', Play)
