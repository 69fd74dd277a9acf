#!/usr/bin/env python3
"""Files, programs and outputs of the tutorials in docs/ (your_robot, control, library, calibration), as they stand there."""
import math
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from documents_test import commands_of, prose_and_blocks, read
from sensor_msgs.msg import JointState
from waiting import wait_for


def section(page, title):
    """Blocks of the section (language, lines), the parts below it included."""
    level, lines, fenced = len(title) - len(title.lstrip('#')), [], False
    for line in page[page.index('\n' + title + '\n'):].splitlines()[2:]:
        fenced = fenced != line.startswith('```')
        if not fenced and re.match('#{1,%d} ' % level, line):
            break
        lines.append(line)
    return prose_and_blocks('\n' + '\n'.join(lines))[1]


def rows(text):
    return [line.split() for line in text.splitlines() if line.strip()]


class Tutorial(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_here(self, command, timeout=120):
        done = subprocess.run(['bash', '-e', '-c', command], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, timeout=timeout)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w') as file:
            file.write(text)


class Files(Tutorial):

    def write_robot(self):
        page = read('docs/your_robot.md')
        urdf, model = ('\n'.join(section(page, '## ' + name)[0][1]) + '\n' for name in ('robot.urdf', 'model_I.yaml'))
        self.write('my_arm/robot.urdf', urdf)
        self.write('my_arm/model_I.yaml', model)
        return page, model

    def compare(self, told, command):
        """Every row that the page shows is one that the command prints."""
        printed = rows(self.run_here(command.replace('--robot my_arm', '--robot ./my_arm')))
        for row in rows('\n'.join(told)):
            if row != ['...']:
                self.assertIn(row, printed)

    def test_muscles_of_a_robot_of_your_own(self):
        page, model = self.write_robot()
        (_, shown), = [block for block in section(page, '### Is it right?') if block[1][0].startswith('rosrun')]
        starts = [i for i, line in enumerate(shown) if line.startswith('rosrun')]
        self.assertEqual(len(starts), 2)
        for start, end in zip(starts, starts[1:] + [len(shown)]):
            self.compare(shown[start + 1:end], shown[start])

    def test_length_of_a_tendon(self):
        page, model = self.write_robot()
        self.write('my_arm/model_I.yaml', re.sub(r'rest_tendon_length: [\d.]+', 'rest_tendon_length: 0.1', model))
        blocks = section(page, '### How long is a tendon?')
        table, = [lines for _, lines in blocks if lines[0].startswith('muscle ')]
        self.compare(table, 'rosrun anthrob_sim anthrob_muscles --robot my_arm --model I')

    def test_a_ball_joint(self):
        page, model = self.write_robot()
        (_, urdf), (_, joint), (_, path), (_, table) = section(page, '### A ball joint')
        with open(os.path.join(self.folder, 'my_arm/robot.urdf')) as file:
            self.write('my_arm/robot.urdf', re.sub(r'  <joint name="shoulder".*?</joint>', '\n'.join(urdf), file.read(), flags=re.DOTALL))
        model = re.sub(r'  shoulder:\n.*?(?=  elbow:)', '\n'.join(joint) + '\n', model, count=1, flags=re.DOTALL)
        flexor = re.search(r'  shoulder_flexor:\n.*?(?=    path:)', model, re.DOTALL).group()
        for name, sign in ('abductor', ''), ('adductor', '-'):
            model += flexor.replace('flexor', name).replace('ecu_1', 'ecu_3')
            model += '\n'.join(path).replace('0.0, 0.0', '0.0, ' + sign + '0.0') + '\n'
        self.write('my_arm/model_I.yaml', model)
        self.compare(table, 'rosrun anthrob_sim anthrob_muscles --robot my_arm --model I')

    def test_rubber_of_the_two_muscle_rig(self):
        page = read('docs/your_robot.md')
        command, at_half, at_six = re.search(r'    (rosrun .*two_muscle_rig.*) +# ([\d.]+) N; ([\d.]+) N at 0.6', page).groups()
        for position, force in ('0.5', at_half), ('0.6', at_six):
            printed = self.run_here(command.replace('flexor=0.5', 'flexor=' + position))
            self.assertIn(force, [row[3] for row in rows(printed) if row[0] == 'flexor'])

    def test_components_on_rigs(self):
        blocks = section(read('docs/calibration.md'), '## Components on their rigs')
        (_, commands), (_, told) = blocks[:2]
        printed = self.run_here('\n'.join(commands_of(commands)), timeout=400)
        for line in told:
            self.assertIn(re.sub(r'\s+', ' ', line), re.sub(r'[ \t]+', ' ', printed))


class Programs(Tutorial):
    """In the simulator."""

    def setUp(self):
        super().setUp()
        self.seen = {}
        for topic, kind in ('muscle_states', MuscleStates), ('joint_states', JointState):
            rospy.Subscriber('/anthrob/' + topic, kind, self.see, callback_args=topic)
        wait_for(lambda: len(self.seen) == 2, 30.0, 'the simulator')

    def see(self, message, topic):
        self.seen[topic] = message

    def program(self, page, title, name):
        code, = [lines for language, lines in section(read(page), title) if language == 'python']
        self.write(name, '\n'.join(code) + '\n')
        return ['python3', name, '__ns:=/anthrob']

    def test_1_controller(self):
        page = read('docs/control.md')
        told = re.search(r'biceps went from ([\d.]+) to ([\d.]+) rad and the elbow from (\d+) to (\d+) degrees', page)
        low, high, bent_from, bent_to = (float(number) for number in told.groups())
        running = subprocess.Popen(self.program('docs/control.md', '### In Python', 'my_controller.py'), cwd=self.folder)
        self.addCleanup(running.wait)
        self.addCleanup(running.send_signal, signal.SIGINT)
        biceps, elbow = [], []
        begun = rospy.get_time()
        while rospy.get_time() < begun + 16.0:
            states, joints = self.seen['muscle_states'], self.seen['joint_states']
            biceps.append(states.position[states.name.index('biceps_brachii')])
            elbow.append(math.degrees(joints.position[joints.name.index('elbow')]))
            time.sleep(0.01)
        self.assertAlmostEqual(max(biceps), high, delta=0.05)
        self.assertAlmostEqual(max(elbow), bent_to, delta=1.0)
        self.assertLess(min(biceps), low + 0.05)
        self.assertLess(min(elbow), bent_from + 1.0)

    def test_2_lock_step(self):
        told = re.search(r'elbow ([\d.]+) rad, \d+ decisions', read('docs/library.md')).group(1)
        command = self.program('docs/library.md', '## From Python, in lock-step', 'lock_step.py')
        printed = re.findall(r'elbow ([\d.]+) rad', self.run_here(' '.join(command)))
        self.assertEqual(len(printed), 3)
        self.assertEqual(len(set(printed)), 1, printed)
        self.assertAlmostEqual(float(printed[0]), float(told), delta=1e-6)  # digits beyond are the computer's


if __name__ == '__main__':
    rospy.init_node('tutorials')
    rostest.rosrun('anthrob_tests', 'tutorials', '__main__')
