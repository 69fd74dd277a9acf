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
from anthrob_msgs.msg import MuscleCommand, MuscleStates, SphericalJointStates
from geometry_msgs.msg import Quaternion, Vector3
from sensor_msgs.msg import JointState
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

        def turned_by():
            """[rad] from rest, of the last that was seen of the shoulder."""
            a, b = turned[0].transform.rotation, turned[-1].transform.rotation
            return 2.0 * math.acos(min(1.0, abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z)))
        wait_for(lambda: abs(turned_by() - 2.0 * HALF) < 1e-6, 10, 'the raised arm')
        self.assertEqual(len({marker.ns for marker in drawn[-1].markers}), 11)
        wait_for(lambda: any(b < a for a, b in zip(stamps, stamps[1:])), 20, 'the second time')
        drawn.clear()
        wait_for(lambda: drawn, 10, 'tendons once more')
        self.assertFalse(commanded)

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
