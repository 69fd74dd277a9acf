#!/usr/bin/env python3
"""Joins the results of several benchmark programs into one file and prints them as tables.

    bench_table.py ALL.json PART.json...
"""
import json
import os
import sys

ROWS = [
    ('skeleton step', 'skeleton', 'mujoco_skeleton'),
    ('+ one straight muscle (4 points)', 'one_muscle/straight', 'mujoco_one_muscle/straight'),
    ('+ one cylinder-wrapped muscle', 'one_muscle/cylinder', 'mujoco_one_muscle/cylinder'),
    ('whole arm, 11 muscles, model I', 'whole_arm/I', 'mujoco_arm/I'),
    ('whole arm, 11 muscles, model II', 'whole_arm/II', 'mujoco_arm/II'),
    ('+ one mesh-wrapped muscle', 'one_muscle/mesh', None),
    ('whole arm, 11 muscles, model III', 'whole_arm/III', None),
]


def join(target, parts):
    """One file in Google Benchmark's format: the first part's context, everybody's results."""
    joined = None
    for part in parts:
        with open(part) as file:
            results = json.load(file)
        if joined is None:
            joined = results
        else:
            joined['benchmarks'] += results['benchmarks']
    with open(target + '.part', 'w') as file:
        json.dump(joined, file, indent=1)
    os.replace(target + '.part', target)
    return joined


def print_peers(medians):
    print('%-36s %9s %9s %7s' % ('[us a step of 1 ms]', 'ours', 'MuJoCo', 'ratio'))
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


def sizes(medians, family):
    return sorted((int(name.split('/')[1]), time) for name, time in medians.items() if name.startswith(family + '/'))


def print_scaling(medians):
    muscles = sizes(medians, 'muscles')
    if muscles:
        print('\n20 joints, 40 degrees of freedom\n%9s %12s %16s' % ('muscles', 'us a step', 'us a muscle'))
        for count, time in muscles:
            share = '%16.2f' % ((time - muscles[0][1]) / count) if count else '%16s' % '-'
            print('%9d %12.1f %s' % (count, time, share))
    joints = sizes(medians, 'joints')
    if joints:
        print('\n40 muscles\n%9s %12s' % ('joints', 'us a step'))
        for count, time in joints:
            print('%9d %12.1f' % (count, time))


def print_meshes(benchmarks):
    rows = [b for b in benchmarks if b.get('aggregate_name') == 'median' and 'worst_us' in b]
    if not rows:
        return
    print('\n%-36s %9s %9s %9s %9s' % ('wrapping surface over 10 s [us]', 'median', 'worst', 'replaced', 'cold'))
    for b in rows:
        rates = ['%8.2f%%' % (100 * b[key]) if key in b else '%9s' % '-' for key in ('improved', 'cold')]
        print('%-36s %9.2f %9.2f %s %s' % ('/'.join(b['run_name'].split('/')[:2]), b['median_us'], b['worst_us'], *rates))


def print_parallel(benchmarks):
    for b in benchmarks:
        if b.get('aggregate_name') == 'median' and b['run_name'].startswith('parallel_arms'):
            print('%d simulation(s) of the arm at once: %.0f times real time in all' %
                  (b['threads'], b['steps_per_s'] * 1e-3))


def main():
    results = join(sys.argv[1], sys.argv[2:])
    medians = {b['run_name']: b['cpu_time'] for b in results['benchmarks'] if b.get('aggregate_name') == 'median'}
    context = results['context']
    print('%d CPUs at %d MHz; medians of one run' % (context['num_cpus'], context['mhz_per_cpu']))
    print_peers(medians)
    print_scaling(medians)
    print_meshes(results['benchmarks'])
    print()
    print_parallel(results['benchmarks'])


if __name__ == '__main__':
    main()
