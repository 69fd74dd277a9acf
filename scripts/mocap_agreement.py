#!/usr/bin/python3
"""Compares a ball joint measured by virtual cameras with the simulator's own."""
import argparse
import bisect
import math
import statistics
import sys

import rosbag

LONGEST_GAP = 5.0  # median periods of the simulated states; across longer ones a joint may have moved in any way


def refuse(what):
    print('mocap_agreement.py: %s' % what, file=sys.stderr)
    sys.exit(2)


def components(message, joint):
    q = message.orientation[joint]
    return q.w, q.x, q.y, q.z


def angle_deg(a, b):
    dot = abs(sum(x * y for x, y in zip(a, b))) / math.sqrt(sum(x * x for x in a) * sum(y * y for y in b))
    return 2.0 * math.degrees(math.acos(min(1.0, dot)))


def read(bag):
    """Measured and simulated joints, each as {joint: [(time, quaternion), ...]}."""
    seen, truth = {}, {}
    for topic, message, _ in bag.read_messages():
        parts = topic.split('/')
        if parts[-1] != 'spherical_joint_states':
            continue
        joints = truth if 'sim' in parts else seen
        for i, name in enumerate(message.name):
            joints.setdefault(name, []).append((message.header.stamp.to_sec(), components(message, i)))
    return seen, truth


def longest_gap(truth):
    """[s] between simulated states across which a joint is interpolated."""
    return LONGEST_GAP * statistics.median(b[0] - a[0] for a, b in zip(truth, truth[1:]))


def interpolated(truth, t, gap):
    """The true quaternion at time t, linear between its neighbours; None before the first state, after the last, and
    between two that are more than gap [s] apart."""
    i = bisect.bisect(truth, (t,))
    if i == 0 or i == len(truth):
        return None
    (t0, a), (t1, b) = truth[i - 1], truth[i]
    if t1 - t0 > gap:
        return None
    u = (t - t0) / (t1 - t0)
    return [x + u * (y - x) for x, y in zip(a, b)]


def report(name, seen, truth):
    gap = longest_gap(truth) if len(truth) > 1 else 0.0
    pairs = [(q, interpolated(truth, t, gap)) for t, q in seen]
    errors = sorted(angle_deg(q, p) for q, p in pairs if p)
    if not errors or len(seen) < 2:
        refuse('%s: expected two measurements or more, recorded while the simulated state was recorded, too' % name)
    motion = max(angle_deg(p, (1, 0, 0, 0)) for _, p in pairs if p)
    gaps = [b[0] - a[0] for a, b in zip(seen, seen[1:])]
    seconds = seen[-1][0] - seen[0][0]
    print('%s: %d measurements in %.1f s, %.1f a second, longest gap %.0f ms; motion up to %.1f deg' %
          (name, len(seen), seconds, (len(seen) - 1) / seconds, 1e3 * max(gaps), motion))
    print('%s: difference rms %.4f deg, median %.4f, 99 %% %.4f, worst %.4f' %
          (name, math.sqrt(sum(e * e for e in errors) / len(errors)), errors[len(errors) // 2],
           errors[int(0.99 * (len(errors) - 1))], errors[-1]))
    if len(errors) < len(pairs):
        print('%s: %d of %d measurements left out: no simulated states around them that are %.0f ms apart or less' %
              (name, len(pairs) - len(errors), len(pairs), 1e3 * gap))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('bag', metavar='BAG', help='bag of demo.launch mocap:=virtual, or any with '
                        'spherical_joint_states and sim/spherical_joint_states')
    parser.error = lambda message: parser.exit(2, f'{parser.prog}: {message} (see --help)\n')
    arguments = parser.parse_args()
    try:
        with rosbag.Bag(arguments.bag) as bag:
            seen, truth = read(bag)
    except (OSError, rosbag.ROSBagException) as error:
        refuse('%s: %s' % (arguments.bag, error))
    both = sorted(set(seen) & set(truth))
    if not both:
        refuse('%s: expected spherical_joint_states and sim/spherical_joint_states, with a joint in both' % arguments.bag)
    for name in both:
        report(name, seen[name], sorted(truth[name]))


if __name__ == '__main__':
    main()
