#!/usr/bin/env python3
"""docs/your_data.md, command by command, with files that a program of no relation to the simulator writes."""
import json
import math
import os
import random
import unittest

import rostest
from documents_test import read
from tutorials_test import Tutorial, section

COULOMB = 0.12  # [Nm] that the model of the page lacks
INERTIA, WEIGHT, VISCOUS = 0.015, 0.5 * 9.81 * 0.15, 0.01  # [kg m^2, Nm, Nms/rad] of what anthrob_new writes
RATE, STEP = 100, 1e-4  # [Hz], [s]


def bench(goal, length, seed):
    """Rows (time, angle, current) of a position-controlled arm that hangs on a hinge with dry friction."""
    noise = random.Random(seed)
    angle = speed = 0.0
    rows = []
    for row in range(int(length * RATE)):
        torque = 0.5 * round((4.0 * (goal(row / RATE) - angle) - 0.2 * speed) / 0.5, 3)
        rows.append((row / RATE, math.degrees(angle) + noise.gauss(0.0, 0.005), torque / 0.5))
        for _ in range(round(1.0 / RATE / STEP)):
            push = torque - WEIGHT * math.sin(angle) - VISCOUS * speed
            if speed == 0.0 and abs(push) <= COULOMB:
                continue
            before = speed
            speed += STEP * (push - math.copysign(COULOMB, speed or push)) / INERTIA
            if before * speed < 0.0:
                speed = 0.0  # it stops before it turns back
            angle += STEP * speed
    return rows


def steps_and_sines(period):
    def goal(t):
        if t < 0.5 or t % 4.0 > 3.2:  # rests
            t = 0.0 if t < 0.5 else t - (t % 4.0 - 3.2)
        return 0.5 * math.sin(2.0 * math.pi * t / period) + 0.3 * math.sin(2.0 * math.pi * t / 0.83) * min(1.0, t)
    return goal


class YourData(Tutorial):

    def commands(self, page, title):
        return '\n'.join('\n'.join(lines) for language, lines in section(page, title) if not language)

    def test_the_page(self):
        page = read('docs/your_data.md')
        for name, period, seed in (('run_1', 3.1, 1), ('run_2', 2.3, 2), ('run_1_again', 3.1, 3)):
            rows = bench(steps_and_sines(period), 12.0, seed)
            self.write(name + '.csv', 't [s],angle [deg],current [A]\n' + ''.join('%.2f,%.4f,%.3f\n' % row for row in rows))
        self.run_here(self.commands(page, '## 1. A folder for the joint'))
        with open(os.path.join(self.folder, 'bench', 'columns.yaml')) as file:
            written = file.read()
        (told,) = [lines for language, lines in section(page, '## 2. What the columns are') if language == 'yaml']
        for line in told:
            self.assertIn(line.split('#')[0].strip(), written)
        self.run_here(self.commands(page, '## 2. What the columns are'))
        printed = self.run_here(self.commands(page, '## 3. Is it right?'))
        self.assertIn('hinge/position', printed)
        self.run_here(self.commands(page, '## 4. The answer'), timeout=500)
        with open(os.path.join(self.folder, 'found', 'report.json')) as file:
            report = json.load(file)
        self.assertEqual(report['verdict'], 'effects_found')
        first = report['effects'][0]
        laws = [first['id']] + [rival['id'] for rival in first['rivals']]
        self.assertIn('joint_coulomb', laws, first)
        self.assertEqual(first['place'], 'hinge')
        if first['id'] == 'joint_coulomb':
            self.assertAlmostEqual(first['parameters']['torque']['value'], COULOMB, delta=0.2 * COULOMB)
        self.assertTrue(os.path.exists(os.path.join(self.folder, 'found', 'report.html')))


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'your_data', YourData)
