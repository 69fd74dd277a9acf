#!/usr/bin/env python3
"""What scripts/save_pairs.py makes of a recording of two cameras."""
import os
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

import rosbag
import rospy
import rostest
from sensor_msgs.msg import Image

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
SCRIPT = os.path.join(TOP, 'scripts', 'save_pairs.py')
TOPICS = '/cam/left/image_raw', '/cam/right/image_raw'


def image(seconds, grey, encoding='mono8'):
    """3 x 2 pixels, rows of 4 bytes; each pixel another grey."""
    message = Image(width=3, height=2, step=4, encoding=encoding, data=bytes([grey, grey + 1, grey + 2, 0] * 2))
    message.header.stamp = rospy.Time.from_sec(seconds)
    return message


def pixels(file):
    """Of an 8-bit grey PNG without filters: rows of bytes."""
    with open(file, 'rb') as content:
        data = content.read()
    width, height = struct.unpack('>II', data[16:24])
    at, packed = 8, b''
    while at < len(data):
        length, kind = struct.unpack('>I4s', data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if kind == b'IDAT' else b''
        at += 12 + length
    raw = zlib.decompress(packed)
    return [raw[y * (width + 1) + 1:(y + 1) * (width + 1)] for y in range(height)]


class SavePairs(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def record(self, images):
        with rosbag.Bag(self.path('run.bag'), 'w') as bag:
            for side, message in images:
                bag.write(TOPICS[side], message, t=message.header.stamp)

    def command(self, *more):
        return [SCRIPT, self.path('out'), '--bag', self.path('run.bag'), '--topics', *TOPICS, *more]

    def save(self, *more):
        return subprocess.run(self.command(*more), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)

    def test_pairs_have_one_number_and_their_time(self):
        self.record([(0, image(1.0, 10)), (1, image(1.0, 20)), (0, image(2.0, 30)),     # no partner
                     (1, image(3.0, 40)), (0, image(3.0, 50))])
        done = self.save()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(sorted(os.listdir(self.path('out/left'))), ['000000.png', '000001.png'])
        self.assertEqual(pixels(self.path('out/left/000000.png')), [bytes([10, 11, 12])] * 2)
        self.assertEqual(pixels(self.path('out/right/000000.png')), [bytes([20, 21, 22])] * 2)
        self.assertEqual(pixels(self.path('out/left/000001.png')), [bytes([50, 51, 52])] * 2)
        with open(self.path('out/times.csv')) as times:
            self.assertEqual(times.read(), 'index,t\n0,1.000000000\n1,3.000000000\n')
        self.assertIn('expected an empty folder', self.save().stdout)

    def test_pictures_have_their_times_however_it_ends(self):
        self.record([(side, image(1.0 + i / 60, i % 200)) for i in range(3000) for side in (0, 1)])
        for ending, status in ((signal.SIGTERM, 128 + signal.SIGTERM), (signal.SIGKILL, -signal.SIGKILL)):
            shutil.rmtree(self.path('out'), ignore_errors=True)
            process = subprocess.Popen(self.command(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.addCleanup(process.stdout.close)
            while process.poll() is None and not os.path.exists(self.path('out/left/000020.png')):
                time.sleep(0.01)
            process.send_signal(ending)
            self.assertEqual(process.wait(30), status)
            pictures = len(os.listdir(self.path('out/left')))
            self.assertLess(pictures, 3000)
            self.assertLessEqual(pictures - len(os.listdir(self.path('out/right'))), 1)
            with open(self.path('out/times.csv')) as times:
                self.assertGreaterEqual(len(times.readlines()) - 1, pictures)

    def record_at_their_place(self, images):
        """In this order, whatever their stamps are."""
        with rosbag.Bag(self.path('run.bag'), 'w') as bag:
            for i, (side, message) in enumerate(images):
                bag.write(TOPICS[side], message, t=rospy.Time(1 + i))

    def test_a_recording_without_any_stamp_is_refused(self):
        self.record_at_their_place([(0, image(0.0, 1)), (1, image(0.0, 1)), (0, image(0.0, 1)), (1, image(0.0, 1))])
        done = self.save()
        self.assertEqual(done.returncode, 2, done.stdout)
        for topic in TOPICS:
            self.assertIn(topic + ': image stamped 0.000000 s: expected the time of the exposure', done.stdout)
        self.assertIn('run.bag: no pair of two usable images', done.stdout)

    def test_a_stamp_that_stands_still_costs_one_image(self):
        images = []
        for i, stamp in enumerate((1.0, 1.1, 1.2, 1.2, 1.3, 1.4)):
            images += [(0, image(stamp, 10 * i))] + ([(1, image(stamp, 10 * i))] if i != 3 else [])
        self.record_at_their_place(images)
        done = self.save()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.count('left out: '), 1, done.stdout)
        self.assertIn('left out: ' + TOPICS[0] + ': image stamped 1.200000 s: expected the time of the exposure',
                      done.stdout)
        self.assertEqual(len(os.listdir(self.path('out/left'))), 5)
        self.assertEqual(pixels(self.path('out/left/000002.png')), [bytes([20, 21, 22])] * 2)
        self.assertEqual(pixels(self.path('out/right/000003.png')), [bytes([40, 41, 42])] * 2)

    def test_times_increase_where_the_clock_was_set_back(self):
        stamps = (1.0, 1.25, 1.5, 1.125, 1.375, 1.75)
        self.record_at_their_place([(side, image(stamp, 10 * i)) for i, stamp in enumerate(stamps) for side in (0, 1)])
        done = self.save()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn(TOPICS[0] + ': image stamped 1.125000 s: expected a time after that of the last pair, 1.500000 s',
                      done.stdout)
        with open(self.path('out/times.csv')) as times:
            self.assertEqual(times.read(), 'index,t\n0,1.000000000\n1,1.250000000\n2,1.500000000\n3,1.750000000\n')
        self.assertEqual(pixels(self.path('out/right/000003.png')), [bytes([50, 51, 52])] * 2)

    def test_a_bad_stamp_does_not_hide_that_the_tolerance_is_too_small(self):
        self.record([(0, image(0.0, 1)), (0, image(1.0, 1)), (1, image(1.003, 1))])
        done = self.save()
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('try a larger --tolerance', done.stdout)

    def test_many_images_without_stamps_make_few_lines(self):
        self.record_at_their_place([(i % 2, image(0.0, i)) for i in range(20)])
        done = self.save()
        self.assertEqual(done.returncode, 2, done.stdout)
        for topic in TOPICS:
            self.assertIn('left out: %s: 9 more images for their stamps' % topic, done.stdout)
        self.assertEqual(done.stdout.count('left out: '), 4, done.stdout)
        self.assertIn('no pair of two usable images', done.stdout)

    def test_bad_images_are_left_out_and_named(self):
        self.record([(0, image(1.0, 1, 'rgb8')), (1, image(1.0, 1)), (0, image(2.0, 1)), (1, image(2.0, 1))])
        done = self.save()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('left out: ' + TOPICS[0] + ': image stamped 1.000000 s: encoding rgb8: expected mono8', done.stdout)
        with open(self.path('out/times.csv')) as times:
            self.assertEqual(times.read(), 'index,t\n0,2.000000000\n')

    def test_a_wide_tolerance_does_not_pair_one_period_apart(self):
        images = []
        for i in range(30):                              # left begins one period late
            images += [(0, image(1.0 + i / 60 - 0.001, i))] if i else []
            images += [(1, image(1.0 + i / 60, i))]
        self.record(images)
        done = self.save('--tolerance', '0.02')
        self.assertEqual(done.returncode, 0, done.stdout)
        wrong = 0
        for file in os.listdir(self.path('out/left')):
            wrong += pixels(self.path('out/left/' + file)) != pixels(self.path('out/right/' + file))
        self.assertLessEqual(wrong, 1)                   # the first, before a period was seen

    def test_what_cannot_be_a_pair_is_refused_in_one_line(self):
        for images, more, expected in (([(0, image(1.0, 1)), (1, image(1.004, 1))], [], 'no pair with stamps within 0 s'),
                                       ([(0, image(1.0, 1)), (1, image(1.5, 1))], ['--tolerance', '0.1'], 'no pair with stamps within 0.1 s'),
                                       ([(0, image(1.0, 1))], [], 'no images on topic ' + TOPICS[1])):
            self.record(images)
            done = self.save(*more)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stdout.count('\n'), 1, done.stdout)
            self.assertIn(expected, done.stdout)
            shutil.rmtree(self.path('out'), ignore_errors=True)
        done = self.save('--every', '0')
        self.assertEqual(done.returncode, 2)
        self.assertIn('--every: expected a number above 0', done.stdout)
        self.record([(0, image(1.0, 1)), (1, image(1.004, 1))])
        self.assertEqual(self.save('--tolerance', '0.005').returncode, 0)


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'save_pairs', SavePairs)
