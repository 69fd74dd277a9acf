"""A driven hinge on a bench, by its closed equation: it turns along given moves with a rest after each, and the effort is
what that takes. Shares nothing with the simulator. Writes what a lab would have: CSV files, a URDF, a model that knows
inertia, weight and viscous friction."""

import math
import os
import random

import numpy

GRAVITY = 9.81  # [m/s^2]
FINE = 5e-4     # step of the closed equation, at most [s]
SECONDS = 30.0  # of a recording
LAWS = ["none", "joint_coulomb", "joint_coulomb_asymmetric", "joint_presliding", "joint_lugre",
        "joint_quadratic_drag", "joint_effort_friction", "joint_ripple", "effort_gain", "payload"]
RUNS = ["run_1", "run_2", "run_1_again"]  # to fit, to judge, the repetition
CASE = "model: model.yaml\ncalibration: calibration.yaml\nconvert:\n" + "".join(
    f"  - {{from: {name}.csv, columns: columns.yaml, to: {name}}}\n" for name in RUNS) + """train: [run_1]
test: [run_2]
repeat: [run_1_again]
"""


def write_texts(folder, texts):
    """Files by name."""
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w") as out:
            out.write(text)


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


class Motion:
    """Moves of different lengths and heights, smooth up to the acceleration: q, v, a at the times t."""

    def __init__(self, draw, t):
        self.q, self.v, self.a = (numpy.zeros_like(t) for _ in range(3))
        begin, at = 0.2, 0.0
        while begin < t[-1]:
            length = log_uniform(draw, 0.35, 4.0)
            height = draw.uniform(0.3, 1.5) * (-1.0 if at > 0.0 else 1.0)
            s = numpy.clip((t - begin) / length, 0.0, 1.0)
            self.q += height * s**3 * (10.0 + s * (6.0 * s - 15.0))
            self.v += height / length * 30.0 * s**2 * (1.0 - s)**2
            self.a += height / length**2 * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)
            begin, at = begin + length + draw.uniform(0.2, 0.6), at + height
        self.moves = self.v != 0.0


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def dry_friction(draw, motion):
    """Over its size [1]: against the motion; at rest, what the controller happens to leave."""
    friction = numpy.sign(motion.v)
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[1], motion.moves, [1]]).astype(int)))
    for first, last in zip(edges[::2], edges[1::2]):
        friction[first:last] = draw.uniform(-1.0, 1.0)
    return friction


def bristles(motion, distance):
    """Dahl's z [1] along the motion."""
    z, out = 0.0, numpy.zeros_like(motion.q)
    for i, way in enumerate(numpy.diff(motion.q, prepend=motion.q[0])):
        side = 1.0 if way > 0.0 else -1.0
        if way != 0.0:
            z = side - (side - z) * math.exp(-abs(way) / distance)
        out[i] = z
    return out


def lugre(motion, p):
    """Friction over its size [1] along the motion: bristles with a Stribeck curve and a damping that falls with speed as
    exp(-v^2)."""
    z, out = 0.0, numpy.zeros_like(motion.q)
    for i, way in enumerate(numpy.diff(motion.q, prepend=motion.q[0])):
        speed = motion.v[i]
        slow = math.exp(-(speed / p["stribeck_velocity"])**2)
        level = 1.0 + (p["static_ratio"] - 1.0) * slow
        if way != 0.0:
            full = math.copysign(level, way)
            z = full - (full - z) * math.exp(-abs(way) / p["distance"] / level)
        out[i] = z + p["damping"] * slow * (speed - abs(speed) * z / level) / p["distance"]
    return out


class Bench:
    """Number `number` of a seed; what is hidden in it has a law of LAWS."""

    def __init__(self, seed, number, law):
        self.name = f"{number:02d}_{law}"
        self.law, self.seed, self.number = law, seed, number
        draw = random.Random(f"{seed}/{number}")
        self.inertia = log_uniform(draw, 1e-6, 1e2)      # [kg m^2]
        self.friction_share = log_uniform(draw, 0.05, 20.0)  # viscous over inertial effort
        self.bits = draw.randint(12, 20)                 # of the encoder, per turn
        self.rate = log_uniform(draw, 25.0, 1000.0)      # of rows [Hz]
        self.noise_share = log_uniform(draw, 0.005, 0.05)
        # Without a weight, these laws are hardly anything else than viscous friction.
        self.hangs = draw.random() < 0.5 or law in ("joint_effort_friction", "effort_gain", "payload")
        dose = log_uniform(draw, 0.15, 1.0)              # effort of what is hidden over all other
        motion = Motion(random.Random(f"{seed}/{number}/scale"), numpy.arange(0.0, SECONDS, FINE))
        inertial = self.inertia * rms(motion.a)
        self.viscous = self.friction_share * inertial / rms(motion.v)  # [Nms/rad]
        weight = draw.uniform(0.5, 2.0) * (1.0 + self.friction_share) * inertial
        self.weight = weight if self.hangs else 0.0      # m g l [Nm]
        self.arm = 0.3 * self.inertia * GRAVITY / weight  # of the centre of mass: 0.3 of the inertia is due to it [m]
        known = rms(self.known(motion))
        self.noise = self.noise_share * known            # [Nm]
        self.truth = self.hidden(draw, dose, known, motion)

    def known(self, motion):
        return self.inertia * motion.a + self.viscous * motion.v + self.weight * numpy.sin(motion.q)

    def hidden(self, draw, dose, known, motion):
        """Parameters of the law, named and in units as in the catalogue of effects."""
        size = dose * known
        distance = log_uniform(draw, max(0.002, 3.0 * self.count()), 0.05)
        periods, phase = draw.randint(7, 30), draw.uniform(0.0, 2.0 * math.pi)
        gain = math.exp(draw.choice([-1.0, 1.0]) * min(0.5, dose))
        ratio, share = draw.uniform(1.2, 2.0), log_uniform(draw, 0.1, 0.5)
        stribeck = {"static_ratio": ratio, "stribeck_velocity": min(0.9, share * rms(motion.v)),
                    "damping": log_uniform(draw, 0.002, 0.02)}
        return {
            "none": {},
            "joint_coulomb": {"torque": size},
            "joint_coulomb_asymmetric": {"forward": 1.3 * size, "backward": 0.6 * size},
            "joint_presliding": {"torque": size, "distance": distance},
            "joint_lugre": {"torque": size, "distance": distance, **stribeck},
            "joint_quadratic_drag": {"drag": size / rms(motion.v**2)},
            "joint_effort_friction": {"share": min(0.5, dose)},
            "joint_ripple": {"periods_1": periods, "sine_1": 1.4 * size * math.sin(phase),
                             "cosine_1": 1.4 * size * math.cos(phase)},
            "effort_gain": {"gain": gain},
            "payload": {"mass": dose * self.weight / GRAVITY / self.arm},
        }[self.law]

    def count(self):
        return 2.0 * math.pi / 2**self.bits  # [rad]

    def effort(self, draw, motion):
        """What the motion takes [Nm]."""
        known, p = self.known(motion), self.truth
        if self.law == "joint_coulomb":
            return known + p["torque"] * dry_friction(draw, motion)
        if self.law == "joint_coulomb_asymmetric":
            sliding = numpy.where(motion.v > 0.0, p["forward"], p["backward"])
            least = min(p.values())
            return known + numpy.where(motion.moves, numpy.sign(motion.v) * sliding,
                                       least * dry_friction(draw, motion))
        if self.law == "joint_presliding":
            return known + p["torque"] * bristles(motion, p["distance"])
        if self.law == "joint_lugre":
            return known + p["torque"] * lugre(motion, p)
        if self.law == "joint_quadratic_drag":
            return known + p["drag"] * motion.v * abs(motion.v)
        if self.law == "joint_effort_friction":  # u - share |u| sign(v) = known
            return known / (1.0 - p["share"] * numpy.sign(known) * dry_friction(draw, motion))
        if self.law == "joint_ripple":
            angle = p["periods_1"] * motion.q
            return known - p["sine_1"] * numpy.sin(angle) - p["cosine_1"] * numpy.cos(angle)
        if self.law == "effort_gain":
            return known / p["gain"]
        if self.law == "payload":  # at the centre of mass of a rod that hangs
            return known + p["mass"] * self.arm * (self.arm * motion.a + GRAVITY * numpy.sin(motion.q))
        return known

    def record(self, name):
        """Rows of time, position, effort. The effort of a row is held until the next one, as a drive does."""
        draw = random.Random(f"{self.seed}/{self.number}/{name.split('_again')[0]}")
        rows = int(SECONDS * self.rate)
        parts = max(2, math.ceil(1.0 / self.rate / FINE))
        motion = Motion(draw, (numpy.arange(rows * parts) + 0.5) / parts / self.rate)
        effort = self.effort(draw, motion).reshape(rows, parts).mean(axis=1)
        noise = numpy.random.default_rng(hash_of(f"{self.seed}/{self.number}/{self.law}/{name}"))
        effort += self.noise * noise.standard_normal(rows)
        q = Motion(random.Random(f"{self.seed}/{self.number}/{name.split('_again')[0]}"), numpy.arange(rows) / self.rate).q
        turned = (numpy.floor(q / self.count() + noise.random()) + 0.5) * self.count()
        return numpy.column_stack([numpy.arange(rows) / self.rate, turned, effort])

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        for name in RUNS:
            numpy.savetxt(os.path.join(folder, f"{name}.csv"), self.record(name), "%.9g", ",", header="t,angle,torque",
                          comments="")
        write_texts(folder, self.texts())

    def texts(self):
        arm = self.arm if self.hangs else 0.0
        mass = self.weight / GRAVITY / self.arm if self.hangs else 1.0
        own = self.inertia - mass * arm**2
        return {
            "robot.urdf": f"""<robot name="bench"><link name="base"/>
<joint name="axis" type="continuous"><parent link="base"/><child link="rotor"/><axis xyz="0 1 0"/></joint>
<link name="rotor"><inertial><origin xyz="0 0 {-arm}"/><mass value="{mass:.9g}"/>
<inertia ixx="{own:.9g}" iyy="{own:.9g}" izz="{own:.9g}" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>
""",
            "model.yaml": f"""robot: robot.urdf
gravity: [0, 0, {-GRAVITY if self.hangs else 0}]
joints:
  axis: {{driven: true, friction: {{static: 0, kinetic: 0, viscous: {self.viscous:.9g}, stribeck_velocity: 0.05}}}}
""",
            "calibration.yaml": f"""parameters:
  - {{path: joints.axis.friction.viscous, unit: Nms/rad, low: 0, high: {10 * self.viscous:.9g}, step: {0.2 * self.viscous:.9g}}}
""",
            "columns.yaml": """robot: bench
separator: ","
time: {column: t, scale: 1.0}
columns:
  - {from: angle, to: axis/position}
  - {from: torque, to: axis/effort}
""",
            "case.yaml": CASE,
        }


def hash_of(text):
    """The same on every machine."""
    value = 0
    for letter in text.encode():
        value = (value * 131 + letter) % (2**61 - 1)
    return value
