#!/usr/bin/env python3
"""What the mocap node says to images it cannot use, to a camera that is pulled and comes back, and at the end of a
recording."""
import os
import shutil
import subprocess
import tempfile
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import SphericalJointStates
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import Image
from tf2_msgs.msg import TFMessage


CONFIG = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__)))),
                      'config', 'anthrob', 'mocap')


class Watch:
    """The last diagnosis of a mocap node, with the time of its arrival."""

    def __init__(self, name):
        self.name, self.level, self.message, self.values = name, None, '', {}
        self.subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, self.on_array, queue_size=100)

    def on_array(self, array):
        for status in array.status:
            if status.name == self.name:
                self.level, self.message = status.level, status.message
                self.values = {v.key: v.value for v in status.values}

    def wait(self, condition, seconds):
        start = time.time()
        while time.time() < start + seconds:
            if self.level is not None and condition(self):
                return time.time() - start
            time.sleep(0.02)
        raise AssertionError('last diagnosis after %.1f s: %s %r' % (seconds, self.level, self.message))

    def wait_for_error(self, part, seconds=20):
        return self.wait(lambda w: w.level == 2 and part in w.message, seconds)


def image(stamp, pixels, encoding='mono8', width=648, height=488, size=None):
    """The picture, at the left of each row whatever the encoding: who did not look at that would find the markers."""
    bytes_per_pixel = {'mono8': 1, 'mono16': 2, 'bgr8': 3}[encoding]
    message = Image(width=width, height=height, encoding=encoding, step=width * bytes_per_pixel)
    message.header.stamp = stamp
    rows = [pixels[648 * y:648 * y + width] for y in range(height)]
    message.data = b''.join(row + bytes(message.step - width) for row in rows)[:size]
    return message


class MocapInput(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.watch = Watch('/anthrob: mocap')
        cls.states = []
        cls.subscriber = rospy.Subscriber('/anthrob/spherical_joint_states', SphericalJointStates, cls.states.append)
        cls.publishers = [rospy.Publisher('/anthrob/mocap/%s/image_raw' % side, Image, queue_size=4)
                          for side in ['left', 'right']]
        end = time.time() + 30
        while time.time() < end and not all(p.get_num_connections() for p in cls.publishers):
            time.sleep(0.05)
        cls.pixels = cls.draw()

    @classmethod
    def draw(cls):
        """Both pictures of the arm at rest (rig.yaml)."""
        rest = TransformStamped(child_frame_id='humerus')
        rest.header.frame_id = 'base'
        rest.transform.translation = Vector3(0.0, -0.21778888860545664, 0.19)
        rest.transform.rotation = Quaternion(x=0.298236838, y=0.641135546, z=0.641135546, w=0.298236838)
        cls.tf = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.tf.publish(TFMessage([rest]))
        return [rospy.wait_for_message('/scene/mocap/%s/image_raw' % side, Image, 30).data for side in ['left', 'right']]

    def publish(self, stamp, left=None, right=None, delay=0.0):
        if left is not False:
            self.publishers[0].publish(image(stamp, self.pixels[0], **(left or {})))
        if right is not False:
            self.publishers[1].publish(image(stamp + rospy.Duration(delay), self.pixels[1], **(right or {})))
        time.sleep(0.03)

    def stream(self, part, ahead=0, stamp=None, **how):
        """Publishes pairs until the node says what is wrong with them."""
        end = time.time() + 20
        while time.time() < end:
            now = rospy.Time.now()
            self.publish(rospy.Time(now.secs + ahead, now.nsecs) if stamp is None else stamp, **how)
            if self.watch.level == 2 and part in self.watch.message:
                break
        self.watch.wait_for_error(part, 1)
        self.assertNotIn('\n', self.watch.message)

    def test_bad_images(self):
        self.watch.wait_for_error('no images')
        self.stream('no images from the right camera', right=False)
        self.stream('unsynchronised pair', delay=0.007)
        # A clock that is wrong: 68 years ahead no difference of times can be said.
        self.stream('left image: stamp ', ahead=2**31 + 100)
        self.stream('left image: encoding mono16: expected mono8', left={'encoding': 'mono16'})
        self.stream('right image: encoding bgr8: expected mono8', right={'encoding': 'bgr8'})
        self.stream('right image: 647x487 pixels: expected 648x488', right={'width': 647, 'height': 487})
        self.stream('left image: 100 bytes: truncated', left={'size': 100})
        self.stream('image: stamp 0: expected the time of the exposure', stamp=rospy.Time(0, 0))
        still = rospy.Time.now()
        self.stream('image: stamp %d.' % still.secs, stamp=still)
        self.assertEqual(self.states, [])
        # Nothing but that was wrong with them.
        end = time.time() + 20
        while time.time() < end and not self.states:
            self.publish(rospy.Time.now())
        self.assertEqual(self.states[0].name, ['shoulder'])

    def test_stamps_are_the_pictures(self):
        shown, sent = [], []
        subscriber = rospy.Subscriber('/anthrob/mocap/debug_image', Image, shown.append)
        end = time.time() + 20
        while time.time() < end and len(shown) < 3:
            sent.append(rospy.Time.now())
            self.publish(sent[-1])
        subscriber.unregister()
        self.assertGreaterEqual(len(shown), 3)
        self.assertLessEqual({m.header.stamp for m in shown}, set(sent))

    def track_folder(self, pixels, height=488, status=0, rate=60):
        """What the node prints that tracks six copies of a pair from files."""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        for side, picture in zip(['left', 'right'], pixels):
            os.mkdir(os.path.join(folder, side))
            for i in range(6):
                with open(os.path.join(folder, side, '%06d.pgm' % i), 'wb') as file:
                    file.write(b'P5\n648 %d\n255\n' % height + picture[:648 * height])
        done = subprocess.run(['rosrun', 'anthrob_mocap', 'anthrob_mocap', '__ns:=/recorded', '_source:=folder',
                               '_left:=' + os.path.join(folder, 'left'), '_right:=' + os.path.join(folder, 'right'),
                               '_rate:=%g' % rate, '_calibration:=' + CONFIG, '_targets:=' + os.path.join(CONFIG, 'targets.yaml')],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=60)
        self.assertEqual(done.returncode, status, done.stdout)
        return done.stdout

    def test_end_of_a_recording(self):
        watch = Watch('/recorded: mocap')
        self.assertIn('left and right images are swapped', self.track_folder(self.pixels[::-1]))
        self.assertIn('rate', watch.values)
        self.assertNotIn('exposure_to_result_ms', watch.values)
        said = self.track_folder(self.pixels)
        for finding in 'swapped', 'no pose', 'pixels', 'most_points', 'never':
            self.assertNotIn(finding, said)

    def test_a_recording_without_a_joint_says_so(self):
        self.assertIn('joint shoulder was seen, but in the end never twice', self.track_folder(self.pixels, rate=5))
        # One target is in the upper half of the picture, the other is not.
        said = self.track_folder([p[:648 * 240] + bytes(648 * 248) for p in self.pixels])
        self.assertRegex(said, 'target (scapula|humerus) was never seen')
        self.assertIn('joint shoulder was never seen', said)
        self.assertIn('648x487 pixels: expected 648x488', self.track_folder(self.pixels, height=487, status=2))

    def test_pulled_camera(self):
        watch = Watch('/cameras: mocap')
        watch.wait_for_error('right camera')
        camera = self.start_camera()
        try:
            watch.wait(lambda w: w.level != 2 and float(w.values['rate']) > 2.0, 40)
            camera.kill()
            camera.wait()
            # Within 1 s on an idle machine: half a second of silence, half a second between reports.
            noticed = watch.wait(lambda w: w.level == 2 and 'right camera' in w.message, 5)
            print('pulled camera diagnosed after %.2f s' % noticed)
            camera = self.start_camera()
            watch.wait(lambda w: w.level != 2 and float(w.values['rate']) > 2.0, 60)
        finally:
            camera.kill()
            camera.wait()

    @staticmethod
    def start_camera():
        return subprocess.Popen(['rosrun', 'anthrob_mocap', 'fake_gv_camera'])


if __name__ == '__main__':
    rospy.init_node('mocap_input_test')
    rostest.rosrun('anthrob_tests', 'mocap_input', MocapInput)
