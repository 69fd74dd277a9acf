#!/usr/bin/env python3
"""Simulator -> virtual cameras -> mocap: the same ball joint as the simulator's, on the same topic."""
import bisect
import math
import shutil
import subprocess
import tempfile
import time
import unittest

import rosbag
import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand, SphericalJointStates
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import Image, Imu
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray
from waiting import wait_for


class Collector:
    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=10000, tcp_nodelay=True)


def components(message):
    q = message.orientation[0]
    return q.w, q.x, q.y, q.z


def angle_deg(a, b):
    dot = abs(sum(x * y for x, y in zip(a, b))) / math.sqrt(sum(x * x for x in a) * sum(y * y for y in b))
    return 2.0 * math.degrees(math.acos(min(1.0, dot)))


def interpolated(times, messages, t):
    """The simulator's orientation between two of its states, 2 ms apart: straight is good enough."""
    i = bisect.bisect(times, t)
    if i == 0 or i == len(times):
        return None
    u = (t - times[i - 1]) / (times[i] - times[i - 1])
    return [a + u * (b - a) for a, b in zip(components(messages[i - 1]), components(messages[i]))]


class MocapVirtual(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.seen = Collector('spherical_joint_states', SphericalJointStates)
        cls.truth = Collector('sim/spherical_joint_states', SphericalJointStates)
        cls.diagnostics = Collector('/diagnostics', DiagnosticArray)
        cls.command = rospy.Publisher('muscle_command', MuscleCommand, queue_size=10)
        wait_for(lambda: cls.seen.messages and cls.truth.messages, 60, 'ball joints of camera and simulator')

    def test_joint_is_the_simulators(self):
        first = len(self.seen.messages)
        start, duration = rospy.get_time(), 8.0
        while rospy.get_time() < start + duration:
            # Deltoids pull the arm up and let it down again.
            pull = 2.5 * (1.0 - math.cos(2.0 * math.pi * (rospy.get_time() - start) / duration))
            self.command.publish(MuscleCommand(name=['lateral_deltoid', 'anterior_deltoid'], mode=[1, 1],
                                               reference=[pull, 0.5 * pull]))
            time.sleep(0.02)
        truth = list(self.truth.messages)
        times = [m.header.stamp.to_sec() for m in truth]
        errors, angles, stamps = [], [], []
        for message in self.seen.messages[first:]:
            self.assertEqual(message.name, ['shoulder'])
            self.assertGreaterEqual(message.orientation[0].w, 0.0)
            stamps.append(message.header.stamp.to_sec())
            expected = interpolated(times, truth, stamps[-1])
            if expected:
                errors.append(angle_deg(components(message), expected))
                angles.append(angle_deg(expected, (1, 0, 0, 0)))
        rms = math.sqrt(sum(e * e for e in errors) / len(errors))
        print('%d states, %.1f Hz, rms %.4f deg, worst %.4f deg, motion up to %.1f deg' %
              (len(errors), len(errors) / (stamps[-1] - stamps[0]), rms, max(errors), max(angles)))
        self.assertGreater(max(angles), 10.0)
        self.assertLess(rms, 0.2)
        self.assertEqual(stamps, sorted(set(stamps)))
        # 60 Hz on two idle cores; a busy machine may lose pictures but not invent any.
        self.assertGreater(len(errors), 10 * duration)

    def test_diagnostics(self):
        def tracking():  # in a second in which pictures came: without one it is well, too, but waiting
            for array in reversed(self.diagnostics.messages):
                for entry in array.status:
                    if entry.name == '/anthrob: mocap' and entry.message == 'tracking':
                        return entry
        wait_for(tracking, 20, 'mocap is well')
        status = tracking()
        self.assertEqual(status.level, 0)
        values = {v.key: v.value for v in status.values}
        for key in ['rate', 'processing_ms_median', 'exposure_to_result_ms', 'segmentation_us', 'labelling_us',
                    'humerus_availability', 'humerus_markers', 'residual_px', 'row_error_px']:
            self.assertIn(key, values)
        self.assertGreater(float(values['humerus_markers']), 2.9)
        self.assertLess(abs(float(values['row_error_px'])), 0.05)

    def test_everything_else_is_published(self):
        poses = Collector('mocap/targets/humerus', PoseWithCovarianceStamped)
        joints = Collector('mocap/joints/shoulder', Imu)
        markers = Collector('mocap/markers', MarkerArray)
        picture = Collector('mocap/debug_image', Image)
        tf = Collector('/tf', TFMessage)
        wait_for(lambda: poses.messages and joints.messages and markers.messages and picture.messages, 20, 'outputs')
        self.assertEqual(poses.messages[0].header.frame_id, 'mocap_camera')
        self.assertGreater(poses.messages[0].pose.covariance[35], 0.0)
        self.assertLess(poses.messages[0].pose.covariance[35], math.radians(0.2) ** 2)
        self.assertGreater(joints.messages[0].angular_velocity_covariance[0], 0.0)
        self.assertEqual(joints.messages[0].header.frame_id, 'humerus')  # whose axes they are in
        self.assertEqual(joints.messages[0].linear_acceleration_covariance[0], -1.0)
        self.assertGreaterEqual(len(markers.messages[-1].markers[0].points), 6)
        self.assertEqual((picture.messages[0].width, picture.messages[0].height), (2 * 648, 488))
        wait_for(lambda: any(t.child_frame_id == 'mocap/humerus' for m in tf.messages for t in m.transforms), 20, 'tf')

    def test_recording_is_replayed_whole(self):
        pictures = [Collector('mocap/%s/image_raw' % side, Image) for side in ['left', 'right']]
        wait_for(lambda: min(len(p.messages) for p in pictures) >= 150, 60, 'pictures')
        for p in pictures:
            p.subscriber.unregister()
        left, right = ({m.header.stamp: m for m in p.messages} for p in pictures)
        stamps = sorted(left.keys() & right.keys())
        folder = tempfile.mkdtemp()
        try:
            with rosbag.Bag(folder + '/run.bag', 'w') as bag:
                for stamp in stamps:
                    bag.write('/left', left[stamp], stamp)
                    bag.write('/right', right[stamp], stamp)
            parameters = {key: rospy.get_param('mocap/' + key) for key in ['targets', 'rig', 'calibration']}
            parameters.update(source='bag', bag=folder + '/run.bag', left='/left', right='/right')
            node = subprocess.Popen(['rosrun', 'anthrob_mocap', 'anthrob_mocap', '__ns:=replayed', '/tf:=/replayed/tf',
                                     '/tf_static:=/replayed/tf_static'] + ['_%s:=%s' % item for item in parameters.items()])
            time.sleep(1.0)  # who listens comes late
            poses = Collector('/replayed/mocap/targets/humerus', PoseWithCovarianceStamped)
            states = Collector('/replayed/spherical_joint_states', SphericalJointStates)
            self.assertEqual(node.wait(timeout=60), 0)
            time.sleep(0.5)
            print('%d pairs, %d poses, %d states' % (len(stamps), len(poses.messages), len(states.messages)))
            self.assertEqual([m.header.stamp for m in poses.messages], stamps)
            self.assertGreater(len(states.messages), 0.9 * len(stamps))
        finally:
            shutil.rmtree(folder)


if __name__ == '__main__':
    rospy.init_node('mocap_virtual_test')
    rostest.rosrun('anthrob_tests', 'mocap_virtual', MocapVirtual)
