#!/usr/bin/python3
"""Computes rest, mounts and the camera's pose for targets.yaml and rig.yaml, from recordings of a ball joint that
anthrob_mocap_offline has tracked (docs/mocap.md, steps 6 and 7).

    mocap_rest.py REST.csv
    mocap_rest.py REST.csv --turn TURN1.csv X1 Y1 Z1 --turn TURN2.csv X2 Y2 Z2

REST.csv: the robot holds still where the URDF has it at zero. TURN.csv: the child link holds still, turned from rest
about the axis (X, Y, Z) of its own frame, right-handed, by any angle from 5 to 175 degrees. With two or more turns
about different axes the script also determines child_mount and the parent's mount. Quaternions are [w, x, y, z],
lengths are in metres."""
import argparse
import csv
import itertools
import math
import re
import sys

try:
    import numpy
except ImportError:
    sys.exit('mocap_rest.py: needs the package python3-numpy')

LEAST_TURN, MOST_TURN = 5.0, 175.0  # [deg] smaller ones have no clear axis; half a turn has no clear sign
LEAST_ANGLE = 15.0                  # [deg] between two axes that are different
STILL, STILL_PLACE = 1.0, 0.01      # [deg], [m] noise and sway of a robot that is held still, more than that moved
MOST_MISFIT = 15.0                  # [deg] between a given axis and the measured one


class BadInput(Exception):
    pass


# ---- quaternions and vectors ----

def product(a, b):
    """First b, then a."""
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def inverse(q):
    return [q[0], -q[1], -q[2], -q[3]]


def rotate(q, v):
    return product(product(q, [0.0, *v]), inverse(q))[1:]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def of_rpy(roll, pitch, yaw):
    """The quaternion of <origin rpy="roll pitch yaw"> in a URDF."""
    about_x = [math.cos(roll / 2), math.sin(roll / 2), 0.0, 0.0]
    about_y = [math.cos(pitch / 2), 0.0, math.sin(pitch / 2), 0.0]
    about_z = [math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)]
    return product(about_z, product(about_y, about_x))


def turn_degrees(q):
    """Angle of the rotation, 0 to 180."""
    return 2.0 * math.degrees(math.atan2(math.sqrt(sum(x * x for x in q[1:])), abs(q[0])))


def degrees_between(a, b):
    """Angle between two unit vectors."""
    cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return math.degrees(math.atan2(math.sqrt(sum(x * x for x in cross)), sum(x * y for x, y in zip(a, b))))


def mean(quaternions):
    """Of rotations that are close together, whatever the signs of their quaternions."""
    q = numpy.array(quaternions)
    return numpy.linalg.eigh(q.T @ q)[1][:, -1].tolist()


def mostly(values):
    """What 95 of 100 do not exceed."""
    return sorted(values)[int(0.95 * (len(values) - 1))]


# ---- recordings ----

class Recording:
    """What anthrob_mocap_offline saw while the robot held still: means over all pairs that show both targets."""

    def __init__(self, file, parent, child):
        self.file = file
        rows = read_rows(file, parent, child)
        parents = [q for q, _, _ in rows]
        relative = [product(inverse(q), child_q) for q, _, child_q in rows]
        self.parent = mean(parents)                                          # in the camera
        self.place = [sum(p[i] for _, p, _ in rows) / len(rows) for i in range(3)]  # of the parent in the camera [m]
        self.child = mean(relative)                                          # in the parent
        moved = [turn_degrees(product(inverse(self.child), q)) for q in relative]
        print('# %s: %d pairs, at most %.2f degrees from their mean' % (file, len(rows), max(moved)))
        turned = [turn_degrees(product(inverse(self.parent), q)) for q in parents]
        away = [math.dist(self.place, p) for _, p, _ in rows]
        if mostly(moved) > STILL or mostly(turned) > STILL or mostly(away) > STILL_PLACE:
            raise BadInput('%s: the child moved by %.1f degrees in the parent, the parent by %.1f degrees and %.1f mm '
                           'before the cameras: expected a recording in which both hold still (%g degrees, %g mm)' %
                           (file, mostly(moved), mostly(turned), 1e3 * mostly(away), STILL, 1e3 * STILL_PLACE))


def read_rows(file, parent, child):
    """[(parent's quaternion, parent's position, child's quaternion)] of the pairs that show both targets."""
    try:
        with open(file, newline='', encoding='utf-8') as text:
            reader = csv.DictReader(text)
            check_columns(file, reader.fieldnames or [], parent, child)
            pairs, rows = 0, []
            for row in reader:
                pairs += 1
                if row[parent + '/valid'] == row[child + '/valid'] == '1':
                    where = '%s:%d' % (file, reader.line_num)
                    rows.append((quaternion_of(row, parent, where), numbers_of(row, parent, 'xyz', where),
                                 quaternion_of(row, child, where)))
    except OSError as error:
        raise BadInput('%s: cannot be read (%s)' % (file, error.strerror))
    except (UnicodeDecodeError, csv.Error):
        raise BadInput('%s: expected a CSV file written by anthrob_mocap_offline' % file)
    if not rows:
        raise BadInput('%s: none of the %d pairs shows both targets, %s and %s' % (file, pairs, parent, child))
    return rows


def check_columns(file, columns, parent, child):
    targets = [name[:-len('/qw')] for name in columns if name.endswith('/qw')]
    if not targets:
        raise BadInput('%s: expected a CSV file written by anthrob_mocap_offline' % file)
    for option, target in ('--parent', parent), ('--child', child):
        if target not in targets:
            raise BadInput('%s: no target %s; set %s to one of: %s' % (file, target, option, ', '.join(targets)))
    wanted = [target + '/' + name for target in (parent, child) for name in ('valid', 'qw', 'qx', 'qy', 'qz')]
    for column in wanted + [parent + '/' + name for name in 'xyz']:
        if column not in columns:
            raise BadInput('%s: no column %s' % (file, column))


def numbers_of(row, target, names, where):
    values = []
    for name in names:
        key = '%s/%s' % (target, name)
        try:
            values.append(float(row[key]))
        except (TypeError, ValueError):
            values.append(math.nan)
        if not math.isfinite(values[-1]):
            raise BadInput('%s: %s: expected a number, not %r' % (where, key, row[key] or ''))
    return values


def quaternion_of(row, target, where):
    q = numbers_of(row, target, ['qw', 'qx', 'qy', 'qz'], where)
    if abs(math.hypot(*q) - 1.0) > 1e-3:
        raise BadInput('%s: %s/qw, qx, qy, qz: expected a unit quaternion' % (where, target))
    return unit(q)


# ---- what the turns say ----

class Turn:
    def __init__(self, given, rest, parent, child):
        file, numbers = given[0], given[1:]
        try:
            axis = [float(number) for number in numbers]
        except ValueError:
            axis = [math.nan]
        if not all(map(math.isfinite, axis)) or not any(axis):
            raise BadInput('--turn %s: expected the axis as three numbers, not all 0' % ' '.join(given))
        self.file, self.axis = file, unit(axis)
        turn = product(inverse(rest.child), Recording(file, parent, child).child)
        self.degrees = turn_degrees(turn)
        if not LEAST_TURN <= self.degrees <= MOST_TURN:
            raise BadInput('%s: the child turned by %.1f degrees from rest: expected %g to %g' %
                           (file, self.degrees, LEAST_TURN, MOST_TURN))
        self.measured = unit([math.copysign(1.0, turn[0]) * x for x in turn[1:]])  # in the child's target frame


def different(axes):
    """Whether two of the axes are not parallel."""
    angles = [degrees_between(a, b) for a, b in itertools.combinations(axes, 2)]
    return any(LEAST_ANGLE <= angle <= 180.0 - LEAST_ANGLE for angle in angles)


def child_mount_of(turns):
    """The child's target frame in the child link, c: axis c = c measured for every turn, by least squares."""
    if len(turns) < 2 or not different([t.axis for t in turns]) or not different([t.measured for t in turns]):
        raise BadInput('--turn: expected two turns or more, about axes that differ by %g degrees or more' % LEAST_ANGLE)
    rows = []  # of a c - c b = 0, linear in c
    for turn in turns:
        a, b = [0.0, *turn.axis], [0.0, *turn.measured]
        rows += numpy.transpose([numpy.subtract(product(a, e), product(e, b)) for e in numpy.eye(4)]).tolist()
    mount = numpy.linalg.svd(rows)[2][-1].tolist()
    for turn in turns:
        misfit = degrees_between(turn.axis, rotate(mount, turn.measured))
        print('# %s: turned by %.1f degrees; the axis fits within %.2f degrees' % (turn.file, turn.degrees, misfit))
        if misfit > MOST_MISFIT:
            raise BadInput('%s: the given axis is %.0f degrees off the measured one: expected at most %g; check the '
                           'axes and their signs' % (turn.file, misfit, MOST_MISFIT))
    return mount


# ---- command line ----

def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('rest', metavar='REST.csv', help='poses.csv of the rest posture')
    parser.add_argument('--turn', nargs=4, action='append', default=[], metavar=('TURN.csv', 'X', 'Y', 'Z'),
                        help="poses.csv of a turn, and its axis in the child link's frame; give it for each turn")
    parser.add_argument('--parent', default='trunk', metavar='NAME',
                        help='target on the parent link (default: %(default)s)')
    parser.add_argument('--child', default='arm', metavar='NAME',
                        help='target on the child link (default: %(default)s)')
    parser.add_argument('--origin-rpy', nargs=3, type=float, default=[0.0] * 3, metavar=('R', 'P', 'Y'),
                        help='<origin rpy> of the floating joint in the URDF [rad] (default: 0 0 0)')
    parser.add_argument('--position', nargs=3, type=float, default=[0.0] * 3, metavar=('X', 'Y', 'Z'),
                        help="position of the parent's target in its link [m], as in mounts (default: 0 0 0)")
    parser.add_argument('--mount', nargs=4, type=float, default=[1.0, 0.0, 0.0, 0.0], metavar=('W', 'X', 'Y', 'Z'),
                        help="orientation of the parent's target in its link, used without --turn (default: 1 0 0 0)")
    parser.add_argument('--child-mount', nargs=4, type=float, default=[1.0, 0.0, 0.0, 0.0],
                        metavar=('W', 'X', 'Y', 'Z'),
                        help="orientation of the child's target in its link, used without --turn (default: 1 0 0 0)")
    parser.error = lambda message: parser.exit(2, f'{parser.prog}: {message} (see --help)\n')
    parser._negative_number_matcher = re.compile(r'^-\.?\d')  # argparse would take -1e-3 for an option
    options = parser.parse_args()
    for name in 'origin_rpy', 'position', 'mount', 'child_mount':
        if not all(map(math.isfinite, getattr(options, name))):
            parser.error('--%s: expected finite numbers' % name.replace('_', '-'))
    for name in 'mount', 'child_mount':
        if abs(math.hypot(*getattr(options, name)) - 1.0) > 1e-3:
            parser.error('--%s: expected a unit quaternion W X Y Z' % name.replace('_', '-'))
        setattr(options, name, unit(getattr(options, name)))
    if options.parent == options.child:
        parser.error('--parent, --child: expected two different targets')
    return options


def show(key, values, digits):
    print('%s: [%s]' % (key, ', '.join(str(round(x, digits) + 0.0) for x in values)))


def show_quaternion(key, q):
    show(key, q if q[0] >= 0.0 else [-x for x in q], 9)


def solve(options):
    rest_posture = Recording(options.rest, options.parent, options.child)
    mount, child_mount = options.mount, options.child_mount
    if options.turn:
        turns = [Turn(given, rest_posture, options.parent, options.child) for given in options.turn]
        child_mount = child_mount_of(turns)
    rest = product(rest_posture.child, inverse(child_mount))
    if options.turn:
        mount = product(of_rpy(*options.origin_rpy), inverse(rest))
    camera = product(mount, inverse(rest_posture.parent))
    position = [p - x for p, x in zip(options.position, rotate(camera, rest_posture.place))]
    show_quaternion('rest', rest)
    show_quaternion('child_mount, mounts.%s.orientation' % options.child, child_mount)
    show_quaternion('mounts.%s.orientation' % options.parent, mount)
    show_quaternion('camera.orientation', camera)
    show('camera.position', position, 4)


def main():
    options = arguments()
    try:
        solve(options)
    except BadInput as error:
        print('mocap_rest.py: %s' % error, file=sys.stderr)
        sys.exit(2)


if __name__ == '__main__':
    main()
