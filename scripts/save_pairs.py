#!/usr/bin/python3
"""Saves pairs of images as the commands of motion capture read them: OUT/left/000000.png, OUT/right/000000.png, ...,
and OUT/times.csv with the time of each pair [s].

    save_pairs.py OUT --bag BAG [--topics LEFT RIGHT] [--tolerance S] [--every N]
    save_pairs.py OUT --cameras LEFT RIGHT [--rate HZ] [--count N] [--exposure S]

With --bag, two images (sensor_msgs/Image, mono8) make a pair if their stamps are equal or differ by at most the
tolerance. With --cameras, the script triggers two GenICam cameras together, until it has N pairs or you press Ctrl-C;
this needs the packages python3-gi and gir1.2-aravis-0.8."""
import argparse
import os
import pathlib
import signal
import statistics
import struct
import sys
import time
import zlib


def png(width, height, rows):
    """An 8-bit grey PNG of rows of bytes."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    header = struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)
    packed = zlib.compress(b''.join(b'\0' + row for row in rows), 1)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', packed) + chunk(b'IEND', b'')


def encoded(width, height, step, data):
    return png(width, height, [data[y * step:y * step + width] for y in range(height)])


class BadImage(Exception):
    pass


stop_asked = []  # number of the signal (Ctrl-C, a closed terminal, ...): after the pair that is being written


class Pairs:
    """The folder that is written to."""

    def __init__(self, out):
        self.out, self.times = pathlib.Path(out), []
        self.length = 0  # [bytes] of times.csv
        for side in ('left', 'right'):
            (self.out / side).mkdir(parents=True, exist_ok=True)
            if any((self.out / side).iterdir()):
                raise ValueError('%s: expected an empty folder' % (self.out / side))

    def add(self, stamp, left, right):
        """stamp: text [s]; images: PNG"""
        files = [self.out / side / ('%06d.png' % len(self.times)) for side in ('left', 'right')]
        parts = [self.out / (side + '.part') for side in ('left', 'right')]
        try:
            for part, image in zip(parts, (left, right)):
                part.write_bytes(image)
            # Before its pictures: readers accept a time without pictures, but no picture without a time.
            with open(self.out / 'times.csv', 'a' if self.times else 'w', encoding='ascii') as times:
                times.write('%s%d,%s\n' % ('' if self.times else 'index,t\n', len(self.times), stamp))
            for part, file in zip(parts, files):
                part.replace(file)
        except OSError:
            # The last line may be torn.
            if self.times:
                os.truncate(self.out / 'times.csv', self.length)
            else:
                (self.out / 'times.csv').unlink(missing_ok=True)
            for file in parts + files:
                file.unlink(missing_ok=True)  # no half of a pair
            raise
        self.times.append(stamp)
        self.length = (self.out / 'times.csv').stat().st_size

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.times:
            print('%d pairs in %s' % (len(self.times), self.out))


def of_message(image, topic):
    where = '%s: image stamped %.6f s: ' % (topic, image.header.stamp.to_sec())
    if image.encoding not in ('mono8', '8UC1'):
        raise BadImage('%sencoding %s: expected mono8' % (where, image.encoding))
    if image.step < image.width or len(image.data) < image.step * image.height:
        raise BadImage('%s%d bytes: truncated' % (where, len(image.data)))
    return encoded(image.width, image.height, image.step, image.data)


def matched(messages, topics, tolerance, leave_out):
    """Yields pairs (left, right) whose stamps are within the tolerance; images without a partner are left out.
    leave_out is called with topic and reason for each image whose stamp cannot be used."""
    waiting, intervals, last = {topic: [] for topic in topics}, [], {}
    for topic, image, _ in messages:
        if stop_asked:
            return
        # Of stamps that stand still nobody knows which belong together.
        if image.header.stamp.is_zero() or image.header.stamp == last.get(topic):
            leave_out(topic, '%s: image stamped %.6f s: expected the time of the exposure, after the previous stamp'
                      % (topic, image.header.stamp.to_sec()))
            continue
        others = waiting[topics[1 - topics.index(topic)]]
        if topic in last and image.header.stamp > last[topic]:
            intervals = (intervals + [(image.header.stamp - last[topic]).to_nsec()])[-9:]
        last[topic] = image.header.stamp
        # Wider than half a period it would bring together images one period apart.
        widest = 1e9 * tolerance
        if intervals:
            widest = min(widest, 0.5 * statistics.median(intervals))

        def distance(other):
            return abs((other.header.stamp - image.header.stamp).to_nsec())
        partner = min(others, key=distance, default=None)
        if partner is None or distance(partner) > widest:
            waiting[topic] = waiting[topic][-30:] + [image]
            continue
        del others[:others.index(partner) + 1]
        waiting[topic].clear()
        yield (image, partner) if topic == topics[0] else (partner, image)


def save_bag(arguments):
    import rosbag
    try:
        save_images(arguments, rosbag.Bag(arguments.bag))
    except rosbag.ROSBagException as error:
        raise ValueError('%s: cannot be read as a bag (%s)' % (arguments.bag, error))


def any_stamped(unstamped, bag, topics):
    """Whether both topics have images whose stamps can be used."""
    count = bag.get_type_and_topic_info().topics
    return all(count[topic].message_count > unstamped.get(topic, 0) for topic in topics)


def save_images(arguments, bag):
    images = [name for name, what in bag.get_type_and_topic_info().topics.items()
              if what.msg_type == 'sensor_msgs/Image']
    for topic in arguments.topics:
        if topic not in images:
            raise ValueError('%s: no images on topic %s; image topics of this bag: %s' %
                             (arguments.bag, topic, ', '.join(sorted(images)) or 'none'))
    bad, unstamped, pairs, last = [], {}, 0, None

    def leave_out(why):
        bad.append(why)
        print('left out: %s' % why, file=sys.stderr)

    def leave_out_for_stamp(topic, why):
        unstamped[topic] = unstamped.get(topic, 0) + 1
        if unstamped[topic] == 1:
            leave_out(why)
    with Pairs(arguments.out) as folder:
        messages = bag.read_messages(topics=arguments.topics)
        for i, (left, right) in enumerate(matched(messages, arguments.topics, arguments.tolerance, leave_out_for_stamp)):
            if stop_asked:
                break
            pairs += 1
            if i % arguments.every:
                continue
            # Whoever reads the folder wants times that increase.
            if last and left.header.stamp <= last:
                leave_out_for_stamp(arguments.topics[0], '%s: image stamped %.6f s: expected a time after that of the '
                                    'last pair, %.6f s' % (arguments.topics[0], left.header.stamp.to_sec(), last.to_sec()))
                continue
            stamp = '%d.%09d' % (left.header.stamp.secs, left.header.stamp.nsecs)
            try:
                folder.add(stamp, of_message(left, arguments.topics[0]), of_message(right, arguments.topics[1]))
                last = left.header.stamp
            except BadImage as error:
                leave_out(error)
    for topic, count in unstamped.items():
        if count > 1:
            print('left out: %s: %d more images for their stamps' % (topic, count - 1), file=sys.stderr)
    if stop_asked:
        return
    if bad and not folder.times and (pairs or not any_stamped(unstamped, bag, arguments.topics)):
        raise ValueError('%s: no pair of two usable images' % arguments.bag)
    if not folder.times:
        raise ValueError('%s: no pair with stamps within %g s of each other: try a larger --tolerance'
                         % (arguments.bag, arguments.tolerance))


class Camera:
    def __init__(self, aravis, name, exposure):
        self.name = name
        self.camera = aravis.Camera.new(name)
        # From the corner, as the node sets it: pixels of another region would be another camera's.
        _, _, width, height = self.camera.get_region()
        self.camera.set_region(0, 0, width, height)
        self.camera.set_pixel_format(aravis.PIXEL_FORMAT_MONO_8)
        # Another program may have left it at one picture.
        self.camera.set_acquisition_mode(aravis.AcquisitionMode.CONTINUOUS)
        # Else the camera refuses the exposure, or changes it again.
        if self.camera.is_exposure_auto_available():
            self.camera.set_exposure_time_auto(aravis.Auto.OFF)
        if self.camera.is_gain_auto_available():
            self.camera.set_gain_auto(aravis.Auto.OFF)
        self.camera.set_exposure_time(1e6 * exposure)
        self.camera.set_trigger('Software')
        self.stream = self.camera.create_stream(None, None)
        for _ in range(4):
            self.stream.push_buffer(aravis.Buffer.new_allocate(self.camera.get_payload()))
        self.good = aravis.BufferStatus.SUCCESS
        self.camera.start_acquisition()

    def trigger(self):
        for late in iter(self.stream.try_pop_buffer, None):
            self.stream.push_buffer(late)
        self.camera.software_trigger()

    def picture(self):
        """None if none came within a second."""
        buffer = self.stream.timeout_pop_buffer(1000000)
        if buffer is None:
            return None
        image = None
        if buffer.get_status() == self.good:
            width = buffer.get_image_width()
            image = encoded(width, buffer.get_image_height(), width, buffer.get_data())
        self.stream.push_buffer(buffer)
        return image


def save_cameras(arguments):
    try:
        import gi
        gi.require_version('Aravis', '0.8')
        from gi.repository import Aravis, GLib
    except (ImportError, ValueError) as error:
        raise ImportError('--cameras needs the packages python3-gi and gir1.2-aravis-0.8 (%s)' % error)
    Aravis.enable_interface('Fake')
    try:
        cameras = [Camera(Aravis, name, arguments.exposure) for name in arguments.cameras]
        began = time.time() - time.monotonic()  # a clock that is set back must not set back the times
        with Pairs(arguments.out) as folder:
            while len(folder.times) < arguments.count and not stop_asked:
                now = began + time.monotonic()
                for camera in cameras:
                    camera.trigger()
                left, right = [camera.picture() for camera in cameras]
                if left and right:
                    folder.add('%.6f' % now, left, right)
                else:
                    print('no image from %s' % cameras[0 if not left else 1].name, file=sys.stderr)
                time.sleep(max(0.0, now + 1.0 / arguments.rate - began - time.monotonic()))
    except GLib.Error as error:
        raise OSError('cameras %s: %s' % (', '.join(arguments.cameras), error.message))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('out', metavar='OUT',
                        help='folder to write to; its left/ and right/ must be empty or absent')
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument('--bag', help='bag to read')
    source.add_argument('--cameras', nargs=2, metavar=('LEFT', 'RIGHT'),
                        help='names of the cameras, as for mocap.launch source:=aravis')
    parser.add_argument('--topics', nargs=2, metavar=('LEFT', 'RIGHT'),
                        default=['/anthrob/mocap/left/image_raw', '/anthrob/mocap/right/image_raw'],
                        help='image topics of the bag (default: mocap/.../image_raw of the robot anthrob)')
    parser.add_argument('--tolerance', type=float, default=0.0, metavar='S',
                        help='[s] largest difference between the stamps of a pair (default: 0, equal stamps)')
    parser.add_argument('--every', type=int, default=1, metavar='N', help='save only every Nth pair of the bag')
    parser.add_argument('--rate', type=float, default=30.0, metavar='HZ',
                        help='[Hz] pairs a second taken with --cameras (default: %(default)s)')
    parser.add_argument('--count', type=int, default=600, metavar='N',
                        help='number of pairs taken with --cameras (default: %(default)s)')
    parser.add_argument('--exposure', type=float, default=0.0005, metavar='S',
                        help='[s] exposure of --cameras (default: %(default)s)')
    parser.error = lambda message: parser.exit(2, f'{parser.prog}: {message} (see --help)\n')
    arguments = parser.parse_args()
    for name in ('every', 'count', 'rate', 'exposure'):
        if not getattr(arguments, name) > 0:
            parser.error('--%s: expected a number above 0' % name)
    if not arguments.tolerance >= 0:
        parser.error('--tolerance: expected a number of 0 or more')
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda number, _: stop_asked.append(number))
    try:
        (save_bag if arguments.bag else save_cameras)(arguments)
    except (ImportError, OSError, ValueError) as error:
        print('save_pairs.py: %s' % error, file=sys.stderr)
        # Devices and disks that fail are no bad input; files that are not there are.
        sys.exit(1 if isinstance(error, OSError) and not isinstance(error, FileNotFoundError) else 2)
    if stop_asked:
        sys.exit(128 + stop_asked[0])


if __name__ == '__main__':
    main()
