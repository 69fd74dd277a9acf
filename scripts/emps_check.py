#!/usr/bin/python3
"""Evaluates a model of the EMPS drive as the authors of its data do: force residual, and replay in closed loop.

MODEL.yaml: what anthrob_discover wrote for config/driven_axis. DATA.csv: t, u_vir [V], force [N], position [m], reference [m] and,
where there are any, pulses [V] that were added to the controller's output, 1 kHz (Janot, Gautier, Brunot 2019). The force
residual is filtered (zero phase, 100 Hz for the position, 40 Hz for the force) and thinned to 80 Hz; the replay simulates the
drive's own controller.
"""
import argparse
import math
import os
import sys

import yaml

try:
    import numpy
except ImportError:
    numpy = None  # said once the command line is right

STEP = 1e-3                        # [s] of the data
FORCE_CONSTANT = 35.15065188       # [N/V]
KP, KV, LIMIT = 160.18, 243.45, 10.0
KNOWN = ('joint_coulomb', 'joint_offset_torque', 'joint_presliding', 'joint_ripple')  # effects that residual and replay have
BEND = 1e-4                        # [m] of presliding that is taken as Coulomb friction: motions are of decimetres
FINER = 20                         # steps of the replay in one of the data


def refuse(what):
    print('emps_check.py: %s' % what, file=sys.stderr)
    sys.exit(2)


def load_model(file):
    """Keys of the file over those of the files it extends."""
    with open(file) as text:
        own = yaml.safe_load(text)
    if 'extends' not in own:
        return own
    if not isinstance(own['extends'], str):
        refuse('%s: extends: expected the name of one file' % file)
    base = load_model(os.path.join(os.path.dirname(os.path.abspath(file)), own['extends']))

    def over(low, high):
        if not isinstance(low, dict) or not isinstance(high, dict):
            return high
        return {key: over(low[key], high[key]) if key in low and key in high else high.get(key, low.get(key))
                for key in {**low, **high}}
    return over(base, own)


def numbers_of(model):
    """Mass [kg], viscous [Ns/m], Coulomb [N] and offset friction [N], ripple: its terms [rad/m, N, N]."""
    if 'axis' not in model.get('joints', {}):
        refuse('expected a model of config/driven_axis, with the joint axis')
    effects = {effect['id']: effect for effect in model.get('effects') or []}
    for unknown in sorted(set(effects) - set(KNOWN)):
        refuse('effects: %s: expected only %s' % (unknown, ', '.join(KNOWN)))
    presliding = effects.get('joint_presliding', {})
    if presliding.get('distance', 0.0) > BEND:
        refuse('joint_presliding: distance: %g: expected at most %g m, which counts as Coulomb friction' % (presliding['distance'], BEND))
    return (95.1089, model['joints']['axis']['friction']['viscous'],
            effects.get('joint_coulomb', {}).get('torque', 0.0) + presliding.get('torque', 0.0),
            -effects.get('joint_offset_torque', {}).get('torque', 0.0), terms_of(effects.get('joint_ripple', {})))


def terms_of(ripple):
    numbers = [key.split('_')[1] for key in ripple if key.startswith('periods_')]
    return [(2.0 * math.pi * ripple['periods_' + k], ripple.get('sine_' + k, 0.0), ripple.get('cosine_' + k, 0.0)) for k in numbers]


def ripple_at(terms, position):
    """Force that it adds [N]."""
    return sum(sine * numpy.sin(rate * position) + cosine * numpy.cos(rate * position) for rate, sine, cosine in terms)


def lowpass(values, corner):
    """Butterworth of fourth order forwards and backwards, ends continued by reflection."""
    pad = 2000
    long = numpy.concatenate([2 * values[0] - values[pad:0:-1], values, 2 * values[-1] - values[-2:-pad - 2:-1]])
    gain = 1 / (1 + (numpy.fft.rfftfreq(len(long), STEP) / corner) ** 8)
    return numpy.fft.irfft(numpy.fft.rfft(long) * gain, len(long))[pad:-pad]


def force_residual(numbers, force, position):
    mass, viscous, coulomb, offset, terms = numbers
    velocity = numpy.gradient(lowpass(position, 100), STEP)
    acceleration = numpy.gradient(velocity, STEP)
    model = mass * acceleration + viscous * velocity + coulomb * numpy.sign(velocity) + offset - ripple_at(terms, position)
    return lowpass(force - model, 40)[200:-200:12]


def replay(numbers, position, reference, pulses):
    """Positions and forces of the drive under its controller."""
    mass, viscous, coulomb, offset, terms = numbers
    q, v = position[0], (position[1] - position[0]) / STEP
    before = mean_before = q
    positions, forces = [], []
    for k in range(len(position)):
        mean = 0.5 * (q + before)
        rate = (mean - mean_before) / STEP if k else 0.0
        mean_before, before = mean, q
        volts = KV * (KP * (reference[k] - q) - rate) + pulses[k]
        force = FORCE_CONSTANT * min(LIMIT, max(-LIMIT, volts))
        positions.append(q)
        forces.append(force)
        for _ in range(FINER):
            drive = force - offset - viscous * v + ripple_at(terms, q)
            if v == 0.0 and abs(drive) <= coulomb:
                break
            faster = v + STEP / FINER * (drive - coulomb * numpy.sign(v if v != 0.0 else drive)) / mass
            v = 0.0 if v * faster < 0.0 and abs(drive) <= coulomb else faster
            q += STEP / FINER * v
    return numpy.array(positions), numpy.array(forces)


def rms(values):
    return float(numpy.sqrt(numpy.mean(values ** 2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('model', metavar='MODEL.yaml')
    parser.add_argument('data', metavar='DATA.csv', nargs='+')
    parser.error = lambda message: parser.exit(2, f'{parser.prog}: {message} (see --help)\n')
    arguments = parser.parse_args()
    for file in [arguments.model] + arguments.data:
        if not os.path.isfile(file):
            refuse('%s: no such file' % file)
    try:
        numbers = numbers_of(load_model(arguments.model))
        if numpy is None:
            refuse('numpy is missing: apt-get install python3-numpy')
        recordings = [(file, numpy.genfromtxt(file, delimiter=',', skip_header=1)) for file in arguments.data]
    except (OSError, ValueError, yaml.YAMLError) as error:
        refuse(' '.join(str(error).split()))
    for file, data in recordings:
        if data.ndim != 2 or data.shape[1] < 5 or len(data) <= 400 or not numpy.isfinite(data).all():
            refuse('%s: expected more than 400 rows of t, u_vir, force, position, reference, all numbers' % file)
    print('viscous %.1f Ns/m, Coulomb %.2f N, offset %.2f N, ripple of %d terms' % (*numbers[1:4], len(numbers[4])))
    for file, data in recordings:
        force, position, reference = data[:, 2], data[:, 3], data[:, 4]
        pulses = data[:, 5] if data.shape[1] > 5 else numpy.zeros(len(data))
        positions, forces = replay(numbers, position, reference, pulses)
        print('%s: force residual %.2f N; replay in closed loop off by %.2f um, %.2f N rms' %
              (os.path.basename(file), rms(force_residual(numbers, force, position)),
               1e6 * rms((positions - position)[200:-200]), rms((forces - force)[200:-200])))


if __name__ == '__main__':
    main()
