"""A rig of two muscles, recorded by conventions that are not the simulator's: late, held, averaged, filtered, counted,
by another clock, with a wrong sign or unit, under another control law. The motion is that of anthrob_replay; everything
between robot and file is made here."""

import csv
import math
import os
import random

import numpy

from _bench import hash_of, log_uniform, write_texts

TICK = 1e-3     # of the controllers, and step of the simulation [s]
RATE = 200.0    # of rows [Hz]
SECONDS = 20.0  # of a recording
ROBOT = "two_muscle_rig"
MUSCLES = ["flexor", "extensor"]
KINDS = ["voltage", "position", "current", "force", "joint"]  # position: with its velocity
NOISE = {"voltage": 5e-3, "position": 1e-4, "velocity": 5e-3, "current": 4e-3, "force": 0.05, "joint": 5e-4}  # SI
RANGE = {"position": 2.0 * math.pi, "force": 100.0, "joint": 2.0 * math.pi}  # of a converter or encoder
GAIN, DAMPING = 6.0, 0.5  # of the rig's position control [V/rad, Vs/rad]
RUNS = {"train": ["run_1", "run_2"], "test": ["run_3"], "repeat": ["run_1_again"]}

# What may be hidden: place, parameter, smallest and largest size.
HIDDEN = {
    "joint_coulomb": ("hinge", "torque", 0.1, 0.3),
    "joint_offset_torque": ("hinge", "torque", 0.15, 0.4),
    "payload": ("arm", "mass", 0.1, 0.3),
    "tendon_elasticity": ("flexor", "compliance", 3e-4, 8e-4),
    "series_resistance": ("extensor", "resistance", 0.6, 1.5),
    "force_sensor_gain": ("extensor", "gain", 1.06, 1.15),
    "gear_efficiency": ("flexor", "loss", 0.15, 0.3),
}


class Convention:
    """One way in which recordings are not the simulator's."""

    def __init__(self, what, kind, value, column=None):
        self.what, self.kind, self.value, self.column = what, kind, value, column

    def __str__(self):
        number = "" if self.value is None else f" {self.value:.4g}"
        return f"{self.what} {self.column or self.kind}{number}"


# By what, as report.json calls it: kinds of channels, and how the value is drawn.
CONVENTIONS = {
    "tick_phase": (["voltage"], lambda draw: None),
    "delay": (["voltage", "position", "current", "force", "joint"], lambda draw: draw.uniform(0.0, 0.02)),
    "hold": (["force", "joint", "position"], lambda draw: draw.uniform(15.0, 120.0)),
    "average": (["force", "joint", "position", "current"], lambda draw: draw.uniform(0.002, 0.02)),
    "filter": (["force", "joint", "current"], lambda draw: log_uniform(draw, 0.002, 0.02)),
    "count": (["position", "force", "joint"], lambda draw: draw.randint(10, 20)),
    "clock": (["joint"], lambda draw: draw.choice([-1.0, 1.0]) * draw.uniform(0.25, 0.5)),
    "drift": (["joint"], lambda draw: draw.choice([-1.0, 1.0]) * draw.uniform(50.0, 100.0)),
    "sign": (["position", "velocity", "current", "force", "joint"], lambda draw: None),
    "unit": (["position", "velocity", "current", "force", "joint"], lambda draw: draw.choice([1e3, 1e-3])),
    "controller": (["voltage"], lambda draw: None),
}


def drawn(draw, what):
    kinds, value = CONVENTIONS[what]
    kind = draw.choice(kinds)
    columns = ["hinge/position"] if kind == "joint" else [f"{muscle}/{kind}" for muscle in MUSCLES]
    return Convention(what, kind, value(draw), draw.choice(columns) if what in ("sign", "unit") else None)


def references(draw):
    """Rows of the controllers' ticks: time, flexor, extensor [s, rad]."""
    t = numpy.arange(0.0, SECONDS + 0.1, TICK)
    motion = sum(draw.uniform(0.15, 0.5) * numpy.sin(2.0 * math.pi * (draw.uniform(0.1, 1.2) * t + draw.random()))
                 for _ in range(4))
    level, until = numpy.zeros_like(t), 1.0
    while until < t[-1]:  # moves of 0.15 s
        s = numpy.clip((t - until) / 0.15, 0.0, 1.0)
        level += (draw.uniform(-0.6, 0.6) - level[-1]) * s**2 * (3.0 - 2.0 * s)
        until += draw.uniform(1.0, 3.0)
    common = 1.8 + 0.4 * numpy.sin(2.0 * math.pi * (0.07 * t + draw.random()))
    motion = 0.4 * numpy.clip((t - 0.5) / 0.5, 0.0, 1.0) * (motion + level)
    return numpy.column_stack([t, common + motion, common - motion])


def write_commands(folder, rows):
    os.makedirs(folder, exist_ok=True)
    write_texts(folder, {"meta.yaml": f"robot: {ROBOT}\nkind: trajectory\n"})
    with open(os.path.join(folder, "commands.csv"), "w") as out:
        out.write("t," + ",".join(f"{muscle}/mode,{muscle}/reference" for muscle in MUSCLES) + "\n")
        out.writelines(f"{t:.3f}," + ",".join(f"POSITION,{value:.9g}" for value in values) + "\n" for t, *values in rows)


def read_columns(folder):
    """By name: values at every tick."""
    columns = {}
    for table in "muscles.csv", "joints.csv":
        with open(os.path.join(folder, table)) as text:
            names, *rows = csv.reader(text)
        for name, values in zip(names, numpy.array(rows, dtype=float).T):
            columns[name] = values
    return columns


def shifted(values, late):
    """Late by so much [s]; the first value before that."""
    t = numpy.arange(len(values)) * TICK
    return numpy.interp(t - late, t, values)


def averaged(values, width):
    """Over the time before [s]."""
    sums = numpy.concatenate([[0.0], numpy.cumsum(values) * TICK])
    t = numpy.arange(len(values)) * TICK
    ends = t + TICK
    return (numpy.interp(ends, numpy.arange(len(sums)) * TICK, sums) -
            numpy.interp(numpy.maximum(ends - width, 0.0), numpy.arange(len(sums)) * TICK, sums)) / numpy.minimum(width, ends)


def filtered(values, time_constant):
    """y' = (u - y) / tau."""
    out, y, share = numpy.empty_like(values), values[0], 1.0 - math.exp(-TICK / time_constant)
    for i, value in enumerate(values):
        y += share * (value - y)
        out[i] = y
    return out


class Recorder:
    """Writes data sets under some conventions."""

    def __init__(self, conventions, seed):
        self.conventions = conventions
        self.seed = seed

    def value(self, what, kind):
        return next((c.value for c in self.conventions if c.what == what and c.kind == kind), None)

    def has(self, what):
        return any(c.what == what for c in self.conventions)

    def commanded(self, rows):
        """What must be commanded so that the voltages are those of this recorder's control law."""
        if not self.has("controller"):
            return rows
        out = rows.copy()  # a derivative of the error is one of the measurement, and of the reference beside it
        out[1:, 1:] += DAMPING / GAIN * numpy.diff(rows[:, 1:], axis=0) / TICK
        return out

    def column(self, name, values, times, noise):
        """Values of a channel in the rows at these times [s]."""
        own = name.split("/")[1] if name != "hinge/position" else "joint"
        kind = "position" if own == "velocity" else own
        late = self.value("delay", kind) or 0.0
        if own == "voltage" and self.has("tick_phase"):
            late -= TICK
        values = shifted(values, late)
        for what, how in ("average", averaged), ("filter", filtered):
            if self.value(what, kind):
                values = how(values, self.value(what, kind))
        rate = self.value("hold", kind)
        taken = times if rate is None else numpy.maximum(0.0, numpy.floor(times * rate + 1e-9) / rate)
        out = numpy.interp(taken, numpy.arange(len(values)) * TICK, values)
        frames = numpy.unique(taken, return_inverse=True)[1]
        out += NOISE[own] * noise.standard_normal(frames.max() + 1)[frames]
        bits = self.value("count", kind)
        if bits and own in RANGE:
            count = RANGE[own] / 2**bits
            out = numpy.round(out / count) * count
        for convention in self.conventions:
            if convention.column == name:
                out = -out if convention.what == "sign" else out * convention.value
        return out

    def write(self, name, clean, rows, folder):
        """A data set. @param clean columns by tick   @param rows of references that the controllers were meant to follow"""
        os.makedirs(folder, exist_ok=True)
        times = numpy.arange(0.0, SECONDS - 0.05, 1.0 / RATE)
        noise = numpy.random.default_rng(hash_of(f"{self.seed}/{name}"))
        tables = {
            "muscles.csv": [f"{muscle}/{own}" for muscle in MUSCLES for own in ("position", "velocity", "current", "voltage",
                                                                              "force")],
            "joints.csv": ["hinge/position"],
        }
        for table, names in tables.items():
            columns = [self.column(column, clean[column], times, noise) for column in names]
            stamps = times
            if table == "joints.csv":
                stamps = times * (1.0 + 1e-6 * (self.value("drift", "joint") or 0.0)) + (self.value("clock", "joint") or 0.0)
            kept = stamps >= 0.0
            numpy.savetxt(os.path.join(folder, table), numpy.column_stack([stamps, *columns])[kept], "%.9g", ",",
                          header=",".join(["t", *names]), comments="")
        write_commands(folder, rows[rows[:, 0] < times[-1]])
        write_texts(folder, {"meta.yaml": f"robot: {ROBOT}\nkind: trajectory\nrate: {RATE:g}\n"})


class Case:
    """Number of a seed: what is hidden, by what conventions it is recorded."""

    def __init__(self, seed, number, alone, effect):
        draw = random.Random(f"conventions {seed}/{number}")
        self.seed, self.number = seed, number
        names = list(CONVENTIONS)
        asked = [names[number % len(names)]] if alone else draw.sample(names, 3)
        self.conventions = [drawn(draw, what) for what in asked]
        self.effect = draw.choice(list(HIDDEN)) if effect else None
        place, parameter, low, high = HIDDEN.get(self.effect, ("", "", 1.0, 1.0))
        self.place, self.parameter, self.size = place, parameter, log_uniform(draw, low, high)
        self.name = f"{number:02d}_{'+'.join(asked)}_{self.effect or 'none'}"

    def model(self, rig):
        """The model of the robot that is recorded."""
        hidden = f"\neffects: [{{id: {self.effect}, place: {self.place}, {self.parameter}: {self.size:.9g}}}]" if self.effect else ""
        return f"extends: {rig}{hidden}\n"
