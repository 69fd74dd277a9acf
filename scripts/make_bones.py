#!/usr/bin/env python3
"""Writes humerus.stl and scapula.stl of Anthrob: bones of its dimensions, because its CAD data is not public.

A bone is a loft: rings across an axis, each an ellipse whose centre and half-axes follow smooth curves through the
knots below, with dents that are only for the eye (a convex hull ignores them). Muscle insertions lie on the surface:
rings pass 0.15 mm below them. Dimensions that the thesis does not give were fitted such that the tendons of model III
have the rest lengths of Table C.9. The same input gives the same bytes.

usage: make_bones.py OUTPUT_FOLDER
"""
import math
import os
import struct
import sys

SIDES = 36  # corners of a ring

# Humerus frame: origin in the elbow, +y up to the shoulder at 220, x the elbow's axis, +z the flexor side. [mm]
# y: centre x, centre z, half-axis along x, half-axis along z
HUMERUS = [
    (-14.0, 0.0, 0.0, 19.0, 5.0),       # trochlea and capitulum
    (-9.0, 0.0, 0.0, 22.5, 10.0),
    (0.0, 0.0, 0.0, 25.5, 12.0),        # epicondyles
    (14.0, 0.0, -0.5, 22.0, 9.5),
    (32.0, 0.0, -0.5, 13.5, 8.5),
    (60.0, 0.0, 0.0, 9.8, 9.6),         # shaft
    (100.0, 0.0, 0.0, 10.0, 10.0),
    (132.0, 0.0, 0.0, 10.8, 10.8),
    (147.5, 0.0, 0.0, 12.58, 12.58),    # deltoids
    (152.0, -2.931, 2.133, 11.556, 11.556),  # pectoralis major
    (161.0, -0.583, 3.882, 19.250, 19.250),
    (170.2, 1.697, -0.995, 17.298, 17.298),  # teres minor
    (182.0, -2.776, -2.776, 18.950, 18.950),  # infraspinatus, teres major: the tubercles
    (192.2, -3.864, -3.328, 14.848, 14.848),  # supraspinatus
    (203.0, 2.914, -2.990, 13.537, 13.537),  # anatomical neck
]
HEAD_CENTER, HEAD_RADIUS = 220.0, 16.5
HEAD_FROM = 209.0  # above, rings are those of the head
# y, angle from x towards z [deg], depth, reach along y and across [mm]
HUMERUS_DENTS = [
    (196.0, 98.0, 2.2, 16.0, 4.0),      # groove of the biceps
    (-2.0, 90.0, 2.0, 9.0, 5.0),        # trochlea
    (14.0, -90.0, 3.0, 7.0, 7.0),       # fossa of the olecranon
    (16.0, 90.0, 2.0, 6.0, 7.0),        # fossa of the coronoid
    (110.0, -40.0, 0.7, 35.0, 4.0),     # groove of the radial nerve
]

# Base frame: -y lateral, +x anterior, z up. Rings across y. [mm]
# -y: centre x, centre z, half-axis along x, half-axis along z
SCAPULA = [
    (30.0, -4.0, 385.0, 5.0, 20.0),     # medial border
    (34.0, -4.0, 385.0, 6.0, 62.0),
    (60.0, -5.0, 392.0, 6.5, 56.0),     # blade
    (100.0, -5.0, 400.0, 8.0, 38.0),
    (140.0, -8.1, 406.0, 14.1, 22.0),   # root of the spine, behind
    (165.0, -11.2, 409.0, 19.2, 15.0),
    (183.0, -13.2, 410.0, 25.2, 17.0),
    (194.0, -11.75, 410.0, 28.25, 19.0),  # rim of the glenoid; its back bends the supraspinatus
    (197.0, -10.6, 410.0, 25.6, 17.0),
]
SCAPULA_DENTS = [
    (-90.0, 0.0, 3.0, 45.0, 20.0),      # subscapular fossa, in front
    (-80.0, 180.0, 2.5, 40.0, 14.0),    # infraspinous fossa, behind
]


def slopes(xs, ys):
    """Of a curve through the points that does not swing beyond them (Fritsch, Butland 1984)."""
    n = len(xs)
    h = [xs[i + 1] - xs[i] for i in range(n - 1)]
    d = [(ys[i + 1] - ys[i]) / h[i] for i in range(n - 1)]
    m = [d[0]] + [0.0] * (n - 2) + [d[-1]]
    for i in range(1, n - 1):
        if d[i - 1] * d[i] > 0.0:
            a, b = 2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]
            m[i] = (a + b) / (a / d[i - 1] + b / d[i])
    return m


class Curve:
    def __init__(self, xs, ys):
        self.xs, self.ys, self.ms = xs, ys, slopes(xs, ys)

    def __call__(self, x):
        i = max(0, min(len(self.xs) - 2, sum(1 for k in self.xs if k <= x) - 1))
        h = self.xs[i + 1] - self.xs[i]
        t = (x - self.xs[i]) / h
        return ((1 + 2 * t) * (1 - t) ** 2 * self.ys[i] + t * (1 - t) ** 2 * h * self.ms[i] +
                t * t * (3 - 2 * t) * self.ys[i + 1] - t * t * (1 - t) * h * self.ms[i + 1])


def places(knots, spacing):
    """Where rings go: on every knot, the rest evenly between, about `spacing(y)` apart."""
    rings = [knots[0]]
    for a, b in zip(knots, knots[1:]):
        pieces = max(1, round((b - a) / spacing(a)))
        rings += [a + (b - a) * (i + 1) / pieces for i in range(pieces)]
    return rings


def dented(radius, y, angle, dents):
    for at, direction, depth, along, across in dents:
        away = (angle - math.radians(direction) + math.pi) % (2.0 * math.pi) - math.pi
        if abs(away) < 0.5 * math.pi:
            arc = radius * away
            radius -= depth * math.exp(-((y - at) / along) ** 2 - (arc / across) ** 2)
    return radius


def ring(y, cx, cz, rx, rz, dents):
    points = []
    for i in range(SIDES):
        angle = 2.0 * math.pi * i / SIDES
        c, s = math.cos(angle), math.sin(angle)
        r = dented(rx * rz / math.hypot(rz * c, rx * s), y, angle, dents)
        points.append((cx + r * c, y, cz + r * s))
    return points


def loft(rings, first_pole, last_pole):
    """Triangles over rings in ascending y, closed by a pole at each end; facing outwards."""
    facets = []
    for i in range(SIDES):
        j = (i + 1) % SIDES
        facets.append((first_pole, rings[0][i], rings[0][j]))
        for a, b in zip(rings, rings[1:]):
            facets += [(a[i], b[i], b[j]), (a[i], b[j], a[j])]
        facets.append((rings[-1][i], last_pole, rings[-1][j]))
    return facets


def curves(knots):
    columns = list(zip(*knots))
    return [Curve(columns[0], column) for column in columns[1:]]


def humerus(knots=None):
    knots = knots or HUMERUS
    follow = curves(knots + [(HEAD_FROM, 0.0, 0.0) + 2 * (head_radius(HEAD_FROM),)])
    rings = [ring(y, *(f(y) for f in follow), HUMERUS_DENTS)
             for y in places([k[0] for k in knots] + [HEAD_FROM], lambda y: 2.7 if y < 147.0 else 4.6)]
    top = HEAD_CENTER + HEAD_RADIUS
    start = math.asin((HEAD_FROM - HEAD_CENTER) / HEAD_RADIUS)
    for i in range(1, 12):
        y = HEAD_CENTER + HEAD_RADIUS * math.sin(start + (0.5 * math.pi - start) * i / 12)
        rings.append(ring(y, 0.0, 0.0, head_radius(y), head_radius(y), []))
    return loft(rings, (0.0, knots[0][0] - 1.0, 0.0), (0.0, top, 0.0))


def head_radius(y):
    return math.sqrt(HEAD_RADIUS ** 2 - (y - HEAD_CENTER) ** 2)


def scapula(knots=None):
    knots = knots or SCAPULA
    knots = [(-k[0],) + k[1:] for k in reversed(knots)]
    follow = curves(knots)
    rings = [ring(y, *(f(y) for f in follow), SCAPULA_DENTS)
             for y in places([k[0] for k in knots], lambda y: 2.0)]
    return loft(rings, (knots[0][1], knots[0][0] + 2.5, knots[0][2]),  # the glenoid is hollow
                (knots[-1][1], knots[-1][0] + 2.0, knots[-1][2]))


def write_stl(file, name, facets):
    with open(file, 'wb') as out:
        out.write(('%s of Anthrob, metres' % name).encode().ljust(80, b'\0'))
        out.write(struct.pack('<I', len(facets)))
        for facet in facets:
            a, b, c = ([1e-3 * x for x in p] for p in facet)
            u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
            n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            size = math.sqrt(sum(x * x for x in n)) or 1.0
            out.write(struct.pack('<12fH', *(x / size for x in n), *a, *b, *c, 0))


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith('-'):
        print(__doc__.strip().splitlines()[-1], file=sys.stderr)
        return 2
    try:
        os.makedirs(sys.argv[1], exist_ok=True)
        for name, facets in (('humerus', humerus()), ('scapula', scapula())):
            write_stl(os.path.join(sys.argv[1], name + '.stl'), name, facets)
            print('%s.stl: %d facets' % (name, len(facets)))
    except OSError as error:
        print('make_bones.py: %s: %s' % (error.filename, error.strerror), file=sys.stderr)
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
