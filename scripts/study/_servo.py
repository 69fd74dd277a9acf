"""A hinge with a servo drive on a bench, by its closed equation in steps of 50 us: motor, gear with losses, an arm that
hangs, a P controller whose goals come with the rows of the recording. Shares nothing with the simulator. Writes what a lab
would have: CSV files, a URDF, a model without what is hidden."""

import math
import os
import random

from _bench import CASE, GRAVITY, RUNS, hash_of, log_uniform, write_texts

FINE = 5e-5     # step of the closed equation [s]
TICK = 1e-3     # of the controller [s]
SECONDS = 20.0  # of a recording
LAWS = ["none", "joint_coulomb", "torque_constant", "transmission_elasticity", "transmission_ratio", "gear_efficiency",
        "motor_friction", "payload"]
SIZES = {"joint_coulomb": "torque", "torque_constant": "error", "transmission_elasticity": "compliance",
         "transmission_ratio": "error", "gear_efficiency": "loss", "motor_friction": "torque",
         "payload": "mass"}


class Servo:
    """Number `number` of a seed; what is hidden in it has a law of LAWS."""

    def __init__(self, seed, number, law):
        self.name = f"{number:02d}_{law}"
        self.law, self.seed, self.number = law, seed, number
        draw = random.Random(f"servo {seed}/{number}")
        self.volts = draw.choice([7.4, 12.0, 24.0])         # [V]
        self.ratio = log_uniform(draw, 20.0, 300.0)
        self.stall = log_uniform(draw, 1.0, 20.0)           # torque without losses [Nm]
        self.fastest = log_uniform(draw, 4.0, 15.0)         # [rad/s]
        self.constant = self.volts / self.fastest / self.ratio  # [Nm/A, Vs/rad]
        self.ohm = self.constant * self.ratio * self.volts / self.stall
        self.weight = self.stall * draw.uniform(0.08, 0.25)  # m g l [Nm]
        self.arm = log_uniform(draw, 0.08, 0.4)             # [m]
        self.mass = self.weight / GRAVITY / self.arm        # [kg]
        self.own = self.mass * self.arm**2 * draw.uniform(0.2, 0.6)  # about the centre of mass [kg m^2]
        self.rotor = (self.own + self.mass * self.arm**2) * log_uniform(draw, 0.1, 3.0)  # felt at the hinge
        self.efficiency = draw.uniform(0.65, 0.95)
        self.viscous = self.stall / self.fastest * draw.uniform(0.01, 0.05)
        self.gain = self.volts / draw.uniform(0.25, 0.6)    # [V/rad]
        self.damping = self.gain * draw.uniform(0.005, 0.02)
        self.rate = draw.choice([100.0, 125.0, 200.0, 250.0, 500.0])  # of rows [Hz]
        self.bits = draw.randint(12, 16)                    # of both encoders, per turn
        dose = log_uniform(draw, 0.3, 1.0)
        sign = draw.choice([-1.0, 1.0])
        self.truth = {
            "none": {},
            "joint_coulomb": {"torque": 0.5 * dose * self.weight},
            "torque_constant": {"error": 0.2 * dose * sign},
            "transmission_elasticity": {"compliance": 0.15 * dose / self.weight},
            "transmission_ratio": {"error": 0.1 * dose * sign},
            "gear_efficiency": {"loss": 0.4 * dose},
            "motor_friction": {"torque": 0.1 * dose * self.stall / self.ratio},
            "payload": {"mass": 0.5 * dose * self.mass},
        }[law]

    def hidden(self, name):
        return next(iter(self.truth.values())) if self.law == name else 0.0

    def goals(self, draw):
        """Goals of the rows [rad]: steps and three sines."""
        sines = [(draw.uniform(0.1, 0.35), draw.uniform(0.2, 2.0), draw.uniform(0.0, 2.0 * math.pi)) for _ in range(3)]
        goal, until, out = 0.0, 0.5, []
        for row in range(int(SECONDS * self.rate)):
            t = row / self.rate
            if t >= until:
                goal, until = draw.uniform(-0.8, 0.8), until + draw.uniform(0.5, 1.5)
            out.append(0.0 if t < 0.5 else goal + sum(a * math.sin(2.0 * math.pi * f * t + p) for a, f, p in sines))
        return out

    def record(self, name):
        """Rows of time, joint, goal, motor, voltage, current."""
        draw = random.Random(f"servo {self.seed}/{self.number}/{name.split('_again')[0]}")
        noise = random.Random(hash_of(f"servo {self.seed}/{self.number}/{self.law}/{name}"))
        turn = 1.0 + self.hidden("transmission_ratio")      # of the gear per turn of the joint
        constant = self.constant * self.ratio * turn * (1.0 + self.hidden("torque_constant"))
        rotor = self.rotor * turn**2
        efficiency = self.efficiency * (1.0 - self.hidden("gear_efficiency"))
        mass = self.mass + self.hidden("payload")           # at the centre of mass
        inertia, weight = self.own + mass * self.arm**2, mass * GRAVITY * self.arm
        rubbing = self.hidden("motor_friction") * self.ratio  # at the joint
        dry, compliance = self.hidden("joint_coulomb"), self.hidden("transmission_elasticity")
        count, pulse = 2.0 * math.pi / 2**self.bits, self.volts / 1000.0
        offsets = noise.random(), noise.random()
        q = u = motor = w = current = volts = 0.0           # the motor's at the joint
        rows = []
        per_row, per_tick = 1.0 / self.rate / FINE, round(TICK / FINE)
        goals = self.goals(draw)
        for step in range(int(SECONDS / FINE)):
            row = int(step / per_row + 1e-9)
            if step % per_tick == 0:
                wanted = self.gain * (goals[row] - motor * turn) - self.damping * w * turn
                volts = round(max(-self.volts, min(self.volts, wanted)) / pulse) * pulse
            if len(rows) <= row:
                seen = [(math.floor(x / count + o) - o + 0.5) * count for x, o in zip((q, motor * turn), offsets)]
                rows.append([row / self.rate, seen[0], goals[row], seen[1], volts,
                             current + 0.005 * self.volts / self.ohm * noise.gauss(0.0, 1.0)])
            current = (volts - constant * w) / self.ohm     # inductance is over within 0.2 ms
            drive, load = constant * current, weight * math.sin(q) + self.viscous * u
            if compliance == 0.0:
                u = moved(u, drive, load, rotor, inertia, efficiency, dry, rubbing)
                w = u
            else:
                twist = (motor - q) / compliance
                w = moved(w, drive, twist, rotor, 0.0, efficiency, 0.0)
                u = moved(u, twist, load, inertia, 0.0, 1.0, dry)
            q, motor = q + FINE * u, motor + FINE * w
        return rows

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        for name in RUNS:
            with open(os.path.join(folder, f"{name}.csv"), "w") as out:
                out.write("t,joint,goal,motor,voltage,current\n")
                out.writelines(",".join(f"{value:.9g}" for value in row) + "\n" for row in self.record(name))
        write_texts(folder, self.texts())

    def texts(self):
        return {
            "robot.urdf": f"""<robot name="bench"><link name="base"/>
<joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>
<link name="arm"><inertial><origin xyz="0 0 {-self.arm}"/><mass value="{self.mass:.9g}"/>
<inertia ixx="{self.own:.9g}" iyy="{self.own:.9g}" izz="{self.own:.9g}" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>
""",
            "model.yaml": f"""robot: robot.urdf
gravity: [0, 0, {-GRAVITY}]
actuators:
  motor:
    type: dc_motor
    motor: {{resistance: {self.ohm:.9g}, inductance: {1e-4 * self.ohm:.9g}, torque_constant: {self.constant:.9g},
            back_emf_constant: {self.constant:.9g}, rotor_inertia: {self.rotor / self.ratio**2:.9g}}}
    gear: {{law: load_direction, ratio: {self.ratio:.9g}, efficiency: {self.efficiency:.9g}, inertia: 0, friction_torque: 0}}
    power_stage: {{resistance: 0}}
    nominal_voltage: {self.volts}
controllers:
  servo:
    period: {TICK}
    voltage_limit: {self.volts}
    limits: {{position: 10, current: 100, force: 1000}}
    position: {{proportional: {self.gain:.9g}, derivative: {self.damping:.9g}, force_feedforward: 0}}
    current: {{proportional: 0, integral: 0}}
    force: {{proportional: 0, integral: 0, derivative: 0, force_feedforward: 0}}
joints:
  hinge:
    friction: {{static: 0, kinetic: 0, viscous: {self.viscous:.9g}, stribeck_velocity: 0.05}}
    drive: {{actuator: motor, controller: servo}}
""",
            "calibration.yaml": f"""parameters:
  - {{path: joints.hinge.friction.viscous, unit: Nms/rad, low: 0, high: {10 * self.viscous:.9g}, step: {0.2 * self.viscous:.9g}}}
""",
            "columns.yaml": """robot: bench
separator: ","
mode: POSITION
time: {column: t, scale: 1.0}
columns:
  - {from: joint, to: hinge/position}
  - {from: goal, to: hinge_drive/reference}
  - {from: motor, to: hinge_drive/position}
  - {from: voltage, to: hinge_drive/voltage}
  - {from: current, to: hinge_drive/current}
""",
            "case.yaml": CASE,
        }


def moved(speed, drive, load, rotor, inertia, efficiency, dry, rubbing=0.0):
    """Speed after a step: a drive with `rotor` and dry friction turns, through a gear with losses, what has `inertia` and
    takes `load` and dry friction. All at the joint."""
    for side in ([1.0, -1.0] if speed == 0.0 else [math.copysign(1.0, speed)]):
        against = load + side * dry
        for lost in 1.0 / efficiency, efficiency:           # what the gear makes of the load at the motor
            rate = (drive - side * rubbing - lost * against) / (rotor + lost * inertia)
            if ((inertia * rate + against) * side > 0.0) == (lost >= 1.0):
                break
        after = speed + FINE * rate
        if after * side > 0.0:
            return after
    return 0.0
