#!/usr/bin/env python3
"""Prints build/bench.json as a table: ours, MuJoCo's, their ratio in the same run."""
import json
import sys

ROWS = [
    ('skeleton step', 'skeleton', 'mujoco_skeleton'),
    ('+ one straight muscle (4 points)', 'one_muscle/straight', 'mujoco_one_muscle/straight'),
    ('+ one cylinder-wrapped muscle', 'one_muscle/cylinder', 'mujoco_one_muscle/cylinder'),
    ('whole arm, 11 muscles, model I', 'whole_arm/I', 'mujoco_arm/I'),
    ('whole arm, 11 muscles, model II', 'whole_arm/II', 'mujoco_arm/II'),
]


def main():
    with open(sys.argv[1]) as file:
        results = json.load(file)
    medians = {b['run_name']: b['cpu_time'] for b in results['benchmarks'] if b.get('aggregate_name') == 'median'}
    context = results['context']
    print('%d CPUs at %d MHz; microseconds a step of 1 ms, medians of one run' %
          (context['num_cpus'], context['mhz_per_cpu']))
    print('%-36s %9s %9s %7s' % ('', 'ours', 'MuJoCo', 'ratio'))
    for label, ours, peer in ROWS:
        a, b = medians.get(ours), medians.get(peer)
        if label.startswith('+') and a is not None:
            # What the muscle adds to the skeleton.
            a -= medians['skeleton']
            b = None if b is None else b - medians['mujoco_skeleton']
        cells = ['%9.2f' % x if x is not None else '%9s' % '-' for x in (a, b)]
        ratio = '%7.2f' % (a / b) if a is not None and b else '%7s' % '-'
        print('%-36s %s %s %s' % (label, cells[0], cells[1], ratio))
    print('MuJoCo has no motors, gears, viscoelastic rings or tendon friction.')


if __name__ == '__main__':
    main()
