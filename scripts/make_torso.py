#!/usr/bin/env python3
"""Writes a synthetic robot of any size: an upper body with spine, neck, arms and hands, then legs.

    scripts/make_torso.py --joints 20 --muscles 100 --out config/torso_100

Joints come from a fixed list of ball joints and hinges, muscles go round the joints in turn, over nothing, cylinders,
spheres or a mesh. It copies no real machine: it serves to load something large and to measure how the cost grows with
its size.
"""
import argparse
import math
import os
import sys

BALL, HINGE = 'ball', 'hinge'
SURFACES = ['none', 'cylinder', 'sphere', 'none', 'none', 'cylinder', 'sphere', 'mesh']
KNOB = os.path.join('meshes', 'knob.obj')
KNOB_RINGS, KNOB_SIDES = 9, 20
GOLDEN_ANGLE = math.pi * (3.0 - math.sqrt(5.0))
RING = {'rest_length': 0.015, 'section_diameter': 0.005, 'modulus': 0.8129e6, 'strands': 2}
PRETENSION = 4.0        # [N]
SPINDLE_RADIUS = 0.0065  # [m]


class Joint:
    """A joint and the link it moves. All frames are parallel to the world at rest."""

    def __init__(self, name, kind, parent, link, origin, bone, mass, radius, axis=None, limits=None):
        self.name, self.kind, self.parent, self.link = name, kind, parent, link
        self.origin = origin    # [m] in the parent link
        self.bone = bone        # [m] from this joint to the link's far end
        self.mass, self.radius = mass, radius  # [kg], [m]
        self.axis, self.limits = axis, limits


def all_joints():
    """Up to 40 joints, parents first; the first 20 are the upper body."""
    joints = []
    below, height = 'pelvis', 0.08
    for i in range(1, 5):
        link = 'thorax' if i == 4 else 'vertebra_%d' % i
        joints.append(Joint('spine_%d' % i, BALL, below, link, (0, 0, height), (0, 0, 0.11), 3.0, 0.05))
        below, height = link, 0.11
    joints.append(Joint('neck', BALL, 'thorax', 'neck_bone', (0, 0, 0.13), (0, 0, 0.09), 0.8, 0.03))
    joints.append(Joint('nod', HINGE, 'neck_bone', 'head', (0, 0, 0.09), (0, 0, 0.16), 3.0, 0.06, (0, 1, 0), (-0.7, 0.7)))
    for side, s in (('left', 1), ('right', -1)):
        joints += [
            Joint(side + '_clavicle', BALL, 'thorax', side + '_shoulder_girdle', (0.02, 0.03 * s, 0.08), (0, 0.14 * s, 0), 0.6, 0.02),
            Joint(side + '_shoulder', BALL, side + '_shoulder_girdle', side + '_humerus', (0, 0.14 * s, 0), (0, 0, -0.28), 1.6, 0.03),
            Joint(side + '_elbow', HINGE, side + '_humerus', side + '_ulna', (0, 0, -0.28), (0, 0, -0.14), 0.6, 0.025, (0, -1, 0), (0.0, 2.3)),
            Joint(side + '_forearm', HINGE, side + '_ulna', side + '_radius', (0, 0, -0.14), (0, 0, -0.11), 0.5, 0.02, (0, 0, 1), (-1.2, 1.2)),
            Joint(side + '_wrist', HINGE, side + '_radius', side + '_hand', (0, 0, -0.11), (0, 0, -0.08), 0.4, 0.02, (1, 0, 0), (-1.0, 1.0)),
            Joint(side + '_thumb', HINGE, side + '_hand', side + '_thumb_bone', (0.03, 0, -0.03), (0.03, 0, -0.03), 0.06, 0.008, (0, 1, 0), (-0.8, 0.8)),
            Joint(side + '_fingers', HINGE, side + '_hand', side + '_finger_bones', (0, 0, -0.08), (0, 0, -0.07), 0.12, 0.01, (0, -1, 0), (0.0, 1.5)),
        ]
    for side, s in (('left', 1), ('right', -1)):
        joints += [
            Joint(side + '_hip', BALL, 'pelvis', side + '_femur', (0, 0.09 * s, -0.05), (0, 0, -0.4), 6.0, 0.05),
            Joint(side + '_knee', HINGE, side + '_femur', side + '_tibia', (0, 0, -0.4), (0, 0, -0.4), 3.0, 0.04, (0, 1, 0), (0.0, 2.3)),
            Joint(side + '_ankle', HINGE, side + '_tibia', side + '_foot', (0, 0, -0.4), (0.12, 0, -0.05), 1.0, 0.03, (0, 1, 0), (-0.7, 0.7)),
        ]
    for side in ('left', 'right'):
        for i, finger in enumerate(('index', 'middle', 'ring', 'little')):
            joints.append(Joint('%s_%s' % (side, finger), HINGE, side + '_finger_bones', '%s_%s_tip' % (side, finger),
                                (0.02 - 0.013 * i, 0, -0.07), (0, 0, -0.03), 0.02, 0.006, (0, -1, 0), (0.0, 1.4)))
        for name, parent, far, bone in (('thumb_end', 'thumb_bone', (0.03, 0, -0.03), (0.02, 0, -0.02)),
                                        ('heel', 'foot', (0.0, 0, -0.04), (-0.05, 0, -0.02)),
                                        ('toes', 'foot', (0.12, 0, -0.05), (0.05, 0, 0))):
            joints.append(Joint('%s_%s' % (side, name), HINGE, '%s_%s' % (side, parent), '%s_%s' % (side, name + '_bone'),
                                far, bone, 0.05, 0.008, (0, 1, 0), (-0.6, 0.6)))
    return joints


# ---- small vectors ----

def add(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(sum(x * x for x in a))


def unit(a):
    n = length(a)
    return tuple(x / n for x in a)


def across(direction):
    """A unit vector across `direction`."""
    other = (1, 0, 0) if abs(direction[0]) < 0.9 * length(direction) else (0, 1, 0)
    return unit(cross(direction, other))


def text(values):
    return '[%s]' % ', '.join('%.5f' % (v + 0.0) for v in values)


# ---- URDF ----

def inertia(mass, size, radius):
    """Of a cylinder along `size`, about its centre."""
    along, across_ = 0.5 * mass * radius ** 2, mass * (3 * radius ** 2 + length(size) ** 2) / 12.0
    d = unit(size)
    return [[across_ * (i == j) + (along - across_) * d[i] * d[j] for j in range(3)] for i in range(3)]


def rpy_along(direction):
    """Roll, pitch, yaw that turn z to `direction`."""
    d = unit(direction)
    return (0.0, math.acos(max(-1.0, min(1.0, d[2]))), math.atan2(d[1], d[0]) if abs(d[0]) + abs(d[1]) > 1e-12 else 0.0)


def link_xml(joint):
    middle = add((0, 0, 0), joint.bone, 0.5)
    m = inertia(joint.mass, joint.bone, joint.radius)
    numbers = lambda v: ' '.join('%.6g' % (x + 0.0) for x in v)
    return '''  <link name="%s">
    <inertial>
      <origin xyz="%s"/>
      <mass value="%g"/>
      <inertia ixx="%.6g" ixy="%.6g" ixz="%.6g" iyy="%.6g" iyz="%.6g" izz="%.6g"/>
    </inertial>
    <visual>
      <origin xyz="%s" rpy="%s"/>
      <geometry><cylinder radius="%g" length="%.6g"/></geometry>
      <material name="bone"/>
    </visual>
    <visual>
      <geometry><sphere radius="%g"/></geometry>
      <material name="joint"/>
    </visual>
  </link>
''' % (joint.link, numbers(middle), joint.mass, m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2], numbers(middle),
       numbers(rpy_along(joint.bone)), 0.6 * joint.radius, length(joint.bone), 0.7 * joint.radius)


def joint_xml(joint):
    kind = 'floating' if joint.kind == BALL else 'revolute'
    lines = ['  <joint name="%s" type="%s">' % (joint.name, kind), '    <parent link="%s"/>' % joint.parent,
             '    <child link="%s"/>' % joint.link, '    <origin xyz="%g %g %g"/>' % joint.origin]
    if joint.kind == HINGE:
        lines += ['    <axis xyz="%g %g %g"/>' % joint.axis,
                  '    <limit lower="%g" upper="%g" effort="0" velocity="0"/>' % joint.limits]
    return '\n'.join(lines + ['  </joint>', ''])


def urdf(name, joints):
    head = '''<?xml version="1.0"?>
<!-- Written by scripts/make_torso.py --joints %d: a synthetic robot to measure scaling. Metres, radians, kilograms. -->
<robot name="%s">
  <material name="bone"><color rgba="0.88 0.85 0.76 1"/></material>
  <material name="joint"><color rgba="0.45 0.50 0.58 1"/></material>

  <link name="world"/>
  <joint name="stand" type="fixed">
    <parent link="world"/>
    <child link="pelvis"/>
    <origin xyz="0 0 1"/>
  </joint>
  <link name="pelvis">
    <visual>
      <geometry><box size="0.12 0.24 0.14"/></geometry>
      <material name="joint"/>
    </visual>
  </link>

''' % (len(joints), name)
    return head + '\n'.join(joint_xml(j) + link_xml(j) for j in joints) + '</robot>\n'


# ---- muscles ----

class Muscle:
    def __init__(self, name, rings, points, surface):
        self.name = name
        self.rings = rings      # in parallel
        self.points = points    # (link, point in the link frame)
        self.surface = surface  # (index after which it comes, link, text) or None


def side_of(joint, k):
    """Unit vector from the joint to the side on which its k-th muscle runs."""
    if joint.kind == HINGE:
        side = cross(joint.axis, unit(joint.bone))
        if length(side) < 0.1:  # the hinge turns about its own bone: pull across it
            side = across(joint.axis)
        turn = (1 if k % 2 == 0 else -1)
        spread = 0.25 * (((k // 2) % 5) - 2)
        return unit(add(tuple(turn * x for x in unit(side)), joint.axis, spread))
    u, angle = across(joint.bone), GOLDEN_ANGLE * k
    v = cross(unit(joint.bone), u)
    return tuple(math.cos(angle) * x + math.sin(angle) * y for x, y in zip(u, v))


def surface_on(joint, kind, side, neighbours):
    """What a muscle runs over at a joint: as high as the line between its neighbours, which lie outside."""
    if kind == 'none':
        return None
    axis = joint.axis if joint.kind == HINGE else cross(side, unit(joint.bone))
    if length(cross(axis, side)) < 0.5:
        axis = cross(side, unit(joint.bone))
    away = [length(cross(p, unit(axis))) if kind == 'cylinder' else length(p) for p in neighbours]
    radius = min([1.45 * joint.radius] + [0.9 * a for a in away])
    if kind == 'sphere':
        return '{sphere: {center: [0.0, 0.0, 0.0], radius: %.5f, start: positive}, body: %s}' % (radius, joint.link)
    if kind == 'mesh':
        return '{mesh: {file: %s, scale: %.5f, chi: %s}, body: %s}' % (KNOB, radius, text(side), joint.link)
    return '{cylinder: {origin: [0.0, 0.0, 0.0], axis: %s, radius: %.5f, start: not_wrapping}, body: %s}' % (
        text(unit(axis)), radius, joint.link)


def lifted(point, side, height):
    """The point, moved along `side` until it stands at least that high above the joint at the origin."""
    return add(point, side, max(0.0, height - sum(a * b for a, b in zip(point, side))))


def make_muscle(index, joints):
    by_link = {j.link: j for j in joints}
    joint = joints[index % len(joints)]
    k = index // len(joints)
    side = side_of(joint, k)
    above = by_link.get(joint.parent)
    # Points in the parent's frame lie along the bone that leads to the joint.
    bone_above = joint.origin if length(joint.origin) > 0.02 else (0, 0, 0.05)
    out = 1.35 * joint.radius
    insertion_side = side
    twists = joint.kind == HINGE and abs(sum(a * b for a, b in zip(joint.axis, unit(joint.bone)))) > 0.9
    if twists:
        # The hinge turns about its own bone: insert a quarter turn round it.
        insertion_side = tuple((1 if k % 2 == 0 else -1) * x for x in cross(joint.axis, side))
    origin = (joint.parent, add(joint.origin, lifted(tuple(-0.75 * x for x in bone_above), side, 1.3 * out)))
    if above is not None and k % 5 == 4:  # over two joints
        origin = (above.parent, add(above.origin, lifted(add((0, 0, 0), joint.origin), side, 1.6 * out), 1.0))
    via = (joint.parent, add(joint.origin, lifted(tuple(-0.35 * x for x in bone_above), side, 1.1 * out)))
    insertion = (joint.link, lifted(tuple(0.45 * x for x in joint.bone), insertion_side, out))
    points = [origin, via, insertion]
    kind = 'none' if twists else SURFACES[(index + k) % len(SURFACES)]
    wrap = surface_on(joint, kind, side, [add(via[1], joint.origin, -1), insertion[1]])
    # What carries the body upright needs stiffer springs than gravity's own (m g h) against it.
    heavy = joint.mass >= 3.0 or joint.name.endswith('clavicle')
    return Muscle('%s_%d' % (joint.name, k + 1), 12 if heavy else 2, points, None if wrap is None else (1, wrap))


def rest_positions(joints):
    at = {'pelvis': (0, 0, 1)}
    for j in joints:
        at[j.link] = add(at[j.parent], j.origin)
    return at


def rest_length(muscle, at):
    places = [add(at[link], p) for link, p in muscle.points]
    return sum(length(add(b, a, -1)) for a, b in zip(places, places[1:]))


def model(joints, muscles, command):
    at = rest_positions(joints)
    lines = ['# Written by %s: a synthetic robot to measure scaling.' % command,
             '# Motor, gear, ring and gains are those of Anthrob\'s unit_a; geometry is made up. SI units, radians.', '',
             'robot: robot.urdf', 'gravity: [0.0, 0.0, -9.81]', '', 'joints:']
    for j in joints:
        scale = max(0.02, min(1.0, 4.0 * length(j.bone) * math.sqrt(j.mass)))
        lines += ['  %s:' % j.name]
        if j.kind == BALL:
            lines += ['    type: ball', '    center: [0.0, 0.0, 0.0]',
                      '    stop: {angle: 0.7, stiffness: %.3g, damping: %.3g}' % (400 * scale, 2 * scale)]
        else:
            lines += ['    stop: {stiffness: %.3g, damping: %.3g}' % (400 * scale, 1 * scale)]
        lines += ['    friction: {static: 0.0, kinetic: 0.0, viscous: %.3g, stribeck_velocity: 0.05}' % (0.4 * scale)]
    lines += ['', 'springs:', '  ring:', '    type: zener', '    rest_length: %g' % RING['rest_length'],
              '    section_diameter: %g' % RING['section_diameter'], '    strands: %d' % RING['strands'],
              '    modulus: %g' % RING['modulus'], '    arm_modulus: 137500', '    relaxation_time: 1.2886', '',
              'actuators:', '  unit:', '    type: dc_motor',
              '    motor: {resistance: 0.67, inductance: 5.73e-5, torque_constant: 0.0115, back_emf_constant: 0.0115, rotor_inertia: 1.05e-6}',
              '    gear: {law: current_sign, ratio: 128.0, efficiency: 0.59, inertia: 4.0e-8, steepness: 10.0, shift: 3.0, friction_torque: 0.0}',
              '    power_stage: {resistance: 0.12}', '    nominal_voltage: 12.0', '',
              'controllers:', '  pd:', '    period: 0.001', '    voltage_limit: 12.0',
              '    limits: {position: 30.0, current: 7.0, force: 200.0}',
              '    position: {proportional: 5.7296, derivative: 0.57296, force_feedforward: 0.005}',
              '    current: {proportional: 0.0, integral: 400.0}',
              '    force: {proportional: 0.5, integral: 1.0, derivative: 0.57296, force_feedforward: 0.005}', '',
              '']
    if not muscles:
        return '\n'.join(lines + ['muscles: {}']) + '\n'
    lines += ['eyelet_friction: {law: smooth_stribeck, static: 0.195, kinetic: 0.156, stribeck_velocity: 0.001, steepness: 10.0}',
              '', 'muscles:']
    area = math.pi / 4 * RING['section_diameter'] ** 2
    for i, m in enumerate(muscles):
        stiffness = m.rings * RING['strands'] * RING['modulus'] * area / RING['rest_length']
        tendon = rest_length(m, at) - RING['rest_length'] - PRETENSION * m.rings / stiffness
        lines += ['  %s:' % m.name, '    actuator: unit', '    controller: pd', '    ecu: ecu_%d' % (i // 2 + 1),
                  '    spindle_radius: %g' % SPINDLE_RADIUS, '    rest_tendon_length: %.6f' % tendon,
                  '    spring: {kind: ring, quantity: %d, segment: 0}' % m.rings, '    force_sensor_segment: 0', '    path:']
        for n, (link, point) in enumerate(m.points):
            lines.append('      - {point: %s, body: %s}' % (text(point), link))
            if m.surface and m.surface[0] == n:
                lines.append('      - %s' % m.surface[1])
    return '\n'.join(lines) + '\n'


# ---- a mesh ----

def knob():
    """The end of a bone, of radius one: two condyles side by side in a Wavefront file."""
    points = [(0.0, 0.0, -0.9)]
    for i in range(1, KNOB_RINGS + 1):
        height, reach = -math.cos(math.pi * i / (KNOB_RINGS + 1)), math.sin(math.pi * i / (KNOB_RINGS + 1))
        for k in range(KNOB_SIDES):
            angle = 2.0 * math.pi * k / KNOB_SIDES
            radius = reach * (1.0 - 0.08 * math.cos(2.0 * angle))
            points.append((radius * math.cos(angle), radius * math.sin(angle), 0.9 * height))
    points.append((0.0, 0.0, 0.9))
    at = lambda ring, k: 2 + ring * KNOB_SIDES + k % KNOB_SIDES
    facets = []
    for k in range(KNOB_SIDES):
        facets.append((1, at(0, k + 1), at(0, k)))
        for ring in range(KNOB_RINGS - 1):
            facets += [(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)), (at(ring, k), at(ring + 1, k + 1), at(ring + 1, k))]
        facets.append((at(KNOB_RINGS - 1, k), at(KNOB_RINGS - 1, k + 1), len(points)))
    lines = ['# Written by scripts/make_torso.py.', 'o knob']
    lines += ['v %.5f %.5f %.5f' % tuple(x + 0.0 for x in p) for p in points]
    return '\n'.join(lines + ['f %d %d %d' % f for f in facets]) + '\n'


def write(path, content):
    with open(path + '.part', 'w') as file:
        file.write(content)
    os.replace(path + '.part', path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--joints', type=int, default=20, help='number of joints (default: %(default)s)')
    parser.add_argument('--muscles', type=int, default=100, help='number of muscles (default: %(default)s)')
    parser.add_argument('--out', required=True, help='folder to write; its name becomes the name of the robot')
    parser.error = lambda message: parser.exit(2, f'{parser.prog}: {message} (see --help)\n')
    args = parser.parse_args()
    joints = all_joints()
    if not 1 <= args.joints <= len(joints):
        parser.error('--joints %d: expected 1 to %d' % (args.joints, len(joints)))
    if args.muscles < 0:
        parser.error('--muscles %d: expected 0 or more' % args.muscles)
    joints = joints[:args.joints]
    muscles = [make_muscle(i, joints) for i in range(args.muscles)]
    os.makedirs(os.path.join(args.out, os.path.dirname(KNOB)), exist_ok=True)
    name = os.path.basename(os.path.normpath(args.out))
    command = 'scripts/make_torso.py --joints %d --muscles %d' % (args.joints, args.muscles)
    write(os.path.join(args.out, 'robot.urdf'), urdf(name, joints))
    write(os.path.join(args.out, KNOB), knob())
    write(os.path.join(args.out, 'model_II.yaml'), model(joints, muscles, command))


if __name__ == '__main__':
    main()
