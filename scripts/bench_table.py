#!/usr/bin/env python3
"""Joins the results of several benchmark programs into one file and prints them as tables."""
import argparse
import json
import os

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


# Figure A.5 [ms], an Intel i7-860 of 2009; the thesis's steps and the stages that do their work here.
MOCAP_STEPS = [
    ('segmentation, undistortion', ['segmentation', 'undistortion'], '3.46'),
    ('matching, triangulation', ['matching', 'triangulation'], '0.7 with joint'),
    ('edges, labelling, pose', ['edges', 'labelling', 'pose'], '0.14'),
    ('joint', ['joint'], ''),
    ('all', ['total'], '4.3'),
    ('all, processor time', ['processor'], ''),
]


def print_mocap_latency(row, medians):
    print('\n%-36s %9s %9s %14s' % ('stereo pair 648x488, 10 markers,', 'median', '99 %', 'thesis'))
    print('%-36s %9s %9s %14s' % ('10 reflections, one core', '[us]', '[us]', '[ms]'))
    for label, stages, thesis in MOCAP_STEPS:
        middle, late = (sum(row[stage + end] for stage in stages) for end in ('_us', '_99_us'))
        print('%-36s %9.1f %9.1f %14s' % (label, middle, late, thesis))
    for label, name in (('threshold, connected components', 'segmentation'), ('threshold, contours, moments', 'contours')):
        print('%-36s %9.1f' % ('OpenCV: ' + label, medians['opencv_' + name]))


def print_mocap(benchmarks, medians):
    rows = {b['run_name']: b for b in benchmarks if b.get('aggregate_name') == 'median'}
    if 'track/targets:2/blobs:10' not in rows:
        return
    print_mocap_latency(rows['track/targets:2/blobs:10'], medians)
    sizes = sorted({tuple(int(part.split(':')[1]) for part in name.split('/')[1:3]) for name in rows if name.startswith('track/')})
    blobs = sorted({size[1] for size in sizes})
    print('\nstereo pairs a second on one core\n%22s' % 'targets, reflections:' + ''.join('%8d' % b for b in blobs))
    for targets in sorted({size[0] for size in sizes}):
        rates = [1e6 / medians['track/targets:%d/blobs:%d' % (targets, b)] for b in blobs]
        print('%22d' % targets + ''.join('%8.0f' % rate for rate in rates))


def print_chains(benchmarks):
    """Figure F.2: latency, throughput and time without and with threads, and the speed-up."""
    rows = {tuple(b['run_name'].split('/')[:2]): b for b in benchmarks if b.get('aggregate_name') == 'median'}
    lengths = sorted(int(length) for kind, length in (key for key in rows if len(key) == 2) if kind == 'sequential')
    if not lengths:
        return
    print('\n%7s %17s %17s %17s %9s' % ('stages', 'latency [ms]', 'packets a second', 'time [ms]', 'speed-up'))
    print('%7s' % '' + ' %8s %8s' % ('one', 'threads') * 3)
    for n in lengths:
        pair = [rows[kind, str(n)] for kind in ('sequential', 'threaded')]
        cells = [row[key] for key in ('latency_ms', 'packets_per_s', 'real_time') for row in pair]
        print('%7d' % n + ''.join(' %8.1f' % cell for cell in cells) + ' %9.2f' % (cells[4] / cells[5]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('all', metavar='ALL.json', help='file to write')
    parser.add_argument('parts', metavar='PART.json', nargs='+', help='results of Google Benchmark')
    parser.error = lambda message: parser.exit(2, f'{parser.prog}: {message} (see --help)\n')
    arguments = parser.parse_args()
    try:
        results = join(arguments.all, arguments.parts)
    except (OSError, ValueError) as error:
        parser.error(error)
    medians = {b['run_name']: b['cpu_time'] for b in results['benchmarks'] if b.get('aggregate_name') == 'median'}
    context = results['context']
    print('%d CPUs at %d MHz; medians of one run' % (context['num_cpus'], context['mhz_per_cpu']))
    print_peers(medians)
    print_scaling(medians)
    print_meshes(results['benchmarks'])
    print_mocap(results['benchmarks'], medians)
    print_chains(results['benchmarks'])
    print()
    print_parallel(results['benchmarks'])


if __name__ == '__main__':
    main()
