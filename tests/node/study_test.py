#!/usr/bin/env python3
"""The studies with stand-ins for their programs: what they run, in which order, how they continue, what they write."""
import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy
import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
sys.path.insert(0, os.path.join(TOP, 'scripts', 'study'))
import _bench  # noqa: E402
import _recorder  # noqa: E402
import _servo  # noqa: E402
import _study  # noqa: E402
import axes  # noqa: E402
import calibration  # noqa: E402
import conventions  # noqa: E402
import discovery  # noqa: E402
import fuzz  # noqa: E402
import health  # noqa: E402
import real  # noqa: E402
import rules  # noqa: E402
import soak  # noqa: E402
import threads  # noqa: E402

# Hides "law" everywhere; lists three laws.
MAKER = '''#!/bin/sh
[ "$1" = --list ] && { echo "effect   a: 1"; echo "effect   b: 2"; echo "outside  c: 3"; exit; }
mkdir -p "${10}/test_0" "$(dirname "${12}")"
touch "${10}/model.yaml"
echo "made ${10}" >> calls
echo '{"kind": "'$2'", "effects": [{"id": "law", "place": "elbow", "parameters": {"x": 1.0}, "sizes": ["x"]}]}' > "${12}"
'''
# Names "law", unless the file `status` says how it ends.
DISCOVER = '''#!/bin/sh
echo examined >> calls
[ -f status ] && exit "$(cat status)"
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"
echo '{"verdict": "effects_found", "runtime_s": 1, "effects": [{"id": "law", "place": "elbow", "probability": 1,
  "parameters": {"x": {"value": 1.1, "ci95": [0.9, 1.2]}}}]}' > "$2/report.json"
'''


RECORDER = '''#!/bin/sh
echo recorded >> calls
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"
'''
# 12 deg off before, 2 deg after.
CALIBRATE = '''#!/bin/sh
echo calibrated >> calls
error=2
case "$*" in *--evaluate*) error=12;; esac
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"
errors='{"mean": {"after": {"joints_deg": {"shoulder": '$error', "elbow": 1.0}, "force_N": 3.0}}}'
echo '{"fitness": {"before": 9.0, "after": '$error'}, "optimiser": {"evaluations": 7}, "calibration": '$errors',
  "validation": '$errors'}' > "$2/result.json"
'''
# Accepts 600 of 1000 inputs; the reader of a file `crash_NAME` ends behind 2000.
FUZZER = '''#!/bin/sh
case "$*" in *--list*) echo stl; echo obj; exit;; esac
while [ $# -gt 0 ]; do
  case $1 in --work) work=$2;; --reader) reader=$2;; --first) first=$2;; --end) end=$2;; esac; shift
done
echo "$reader $first" >> calls
mkdir -p "$work/$reader"
echo damaged > "$work/$reader/mesh"
while [ $first -lt $end ]; do
  first=$((first + 1000))
  [ -f crash_$reader ] && [ $first -gt 2000 ] && { echo "SEGV in $reader" >&2; exit 139; }
  echo "$first 600 400 0.25"
done
'''
# Stands in for roslaunch: in a folder with a file `leak` it grows, in one with `short` it ends.
LAUNCHER = '''#!/usr/bin/python3
import os, time
kept = []
while not os.path.exists("short"):
    time.sleep(0.02)
    if os.path.exists("leak"):
        kept.append(b"x" * 100000)
'''


class Study(unittest.TestCase):
    """In a folder of its own, with programs of its own."""

    study_of = None

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        patches = [mock.patch.object(_study, 'OUT', 'out')]
        patches += [mock.patch.object(self.study_of, name, value) for name, value in self.programs().items()]
        for patch in patches:
            patch.start()
            self.addCleanup(patch.stop)

    def programs(self):
        raise NotImplementedError

    def program(self, name, text):
        with open(name, 'w') as file:
            file.write(text)
        os.chmod(name, 0o755)
        return os.path.join(self.folder, name)

    def study(self, *arguments):
        with mock.patch.object(sys, 'argv', ['study', '--out', 'out', *arguments]):
            self.study_of.main()

    def calls(self):
        with open('calls') as file:
            return len(file.readlines())

    def told(self):
        """The page that the study writes into the documents."""
        with open(f'studies/{self.study_of.__name__}.md') as file:
            return file.read()


class FuzzStudy(Study):
    study_of = fuzz

    def programs(self):
        tool = self.program('fuzzer', FUZZER)
        return {'program': lambda out: os.makedirs(os.path.join(out, 'fuzz'), exist_ok=True) or tool}

    def calls(self):
        with open('calls') as file:
            return file.read().split('\n')[:-1]

    def test_it_goes_on_where_it_stopped(self):
        self.study('--inputs', '2000')
        self.assertEqual(self.calls(), ['stl 0', 'obj 0'])
        self.study('--inputs', '2000')
        self.assertEqual(self.calls(), ['stl 0', 'obj 0'])
        self.study('--inputs', '3000')
        self.assertEqual(self.calls()[2:], ['stl 2000', 'obj 2000'])
        self.assertIn('| stl | 3000 | 1800 | 1200 | 0.25 |', self.told())

    def test_what_ended_a_reader_is_kept_and_the_others_go_on(self):
        open('crash_stl', 'w').close()
        with self.assertRaises(SystemExit) as ended:
            self.study('--inputs', '3000')
        self.assertEqual(ended.exception.code, 1)
        with open('out/fuzz/found/stl_2000/said.txt') as said, open('out/fuzz/found/stl_2000/mesh') as mesh:
            self.assertEqual((said.read(), mesh.read()), ('SEGV in stl\n', 'damaged\n'))
        self.assertIn('| stl | 2000 |', self.told())
        self.assertIn('| obj | 3000 |', self.told())
        self.assertIn('found: out/fuzz/found/stl_2000', self.told())

    def test_a_reader_that_is_not_there(self):
        with self.assertRaises(SystemExit) as ended:
            self.study('--reader', 'step')
        self.assertEqual(ended.exception.code, 2)


CONVERTER = '''#!/bin/sh
[ "$1" = --columns ] && echo "converted $3" >> calls || echo converted >> calls
while [ $# -gt 1 ]; do shift; done
mkdir -p "$1"
'''
# Names "law" at an elbow, or what the file `named` in the folder of the model says.
EXAMINER = '''#!/bin/sh
echo "examined $*" >> calls
named=$(cat "$(dirname "$2")/named" 2>/dev/null || echo law)
[ "$named" = refused ] && { echo "anthrob_discover: too short" >&2; exit 2; }
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"
echo '{"verdict": "effects_found", "improbable": [], "remarks": [], "alternatives":
  [{"id": "single", "place": "elbow", "instead_of": []}], "gap": {"test": {"before": 9, "recalibrated": 5.5, "after": 1.25}},
  "effects": [{"id": "'$named'", "place": "elbow", "probability": 0.97, "rivals": [{"id": "cousin", "place": "elbow"}],
  "parameters": {"x": {"value": 1.5, "ci95": [1.25, 1.75], "unit": "Nm"}, "v": {"value": 1, "known": true}}}]}' > "$2/report.json"
'''


class RealStudy(Study):
    study_of = real

    def programs(self):
        return {'CONVERT': self.program('converter', CONVERTER), 'DISCOVER': self.program('examiner', EXAMINER)}

    def case(self, name, text, named='law'):
        os.makedirs('data/' + name, exist_ok=True)
        for file, content in (('case.yaml', text), ('named', named), ('model_I.yaml', ''), ('a.csv', ''), ('m.yaml', '')):
            with open(os.path.join('data', name, file), 'w') as out:
                out.write(content)

    def run_all(self, *arguments):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.study('--data', 'data', '--jobs', '1', *arguments)
        return printed.getvalue().splitlines()

    BEGIN = ('model: model_I.yaml\nconvert: [{from: a.csv, columns: m.yaml, to: one}]\ntrain: [one/train]\ntest: [one/test]\n'
             'options: {max_effects: 2, effects: [law, b]}\n')

    def test_what_is_run_and_told(self):
        self.case('bench', self.BEGIN + 'expected: [{id: [other, law], place: elbow, sizes: {x: [1, 2]}}]\n')
        rows = self.run_all()
        self.assertRegex(rows[0], r'^bench \| other or law elbow \| law elbow \(0.97\) \| x 1.5 \[1.25, 1.75\] Nm \| '
                         r'9 / 5.5 / 1.25 \| \d+ s \| right$')
        with open('calls') as calls:
            told = calls.read().split('\n')
        self.assertEqual(told[0], 'converted data/bench/a.csv')
        self.assertIn('--model data/bench/model_I.yaml --train out/real/bench/data/one/train --test out/real/bench/data/one/test '
                      '--effects law b --max-effects 2 --out out/real/bench/found', told[1])
        self.assertEqual(self.run_all(), rows)  # from what is stored
        self.assertEqual(self.calls(), 2)
        self.case('bench', self.BEGIN + 'expected: [{id: law}]\n')
        self.run_all()
        self.assertEqual(self.calls(), 4)
        with open('out/real.md') as page:
            self.assertIn('- judged: 1 right', page.read())
        self.assertEqual(_study.load('out/real.json')[0]['verdict'], 'effects_found')

    def test_a_bag_needs_no_columns(self):
        self.case('bag', self.BEGIN.replace('columns: m.yaml, ', ''))
        self.assertEqual(len(self.run_all()), 1)
        with open('calls') as calls:
            self.assertEqual(calls.readline(), 'converted\n')

    def test_judgements(self):
        for name, expected, named, judged in (
                ('a', '[{id: law}]', 'other', 'wrong'), ('b', '[{id: cousin}]', 'law', 'in class'),
                ('c', '[{id: law, sizes: {x: [2, 3]}}]', 'law', 'wrong size'), ('d', '[{id: law, place: hip}]', 'law', 'wrong'),
                ('e', 'no_missing_effect', 'law', 'wrong'), ('f', '[{id: law}]', 'refused', 'failed'), ('g', 'null', 'law', ''),
                ('i', '[{id: single}]', 'law', 'in class'),
                ('h', '[{id: law}, {id: second}]', 'law', 'wrong')):
            self.case(name, self.BEGIN + 'expected: %s\n' % expected, named)
        rows = self.run_all()
        self.assertEqual([row.split(' | ')[-1].strip() for row in rows],
                         ['wrong', 'in class', 'wrong size', 'wrong', 'wrong', 'failed', '', 'wrong', 'in class'])
        self.assertIn('anthrob_discover: too short', rows[5])
        self.assertEqual(len(self.run_all('--case', 'c')), 1)

    def test_what_is_wrong_is_said_before_anything_runs(self):
        for text, said in ((self.BEGIN + 'expectd: x\n', 'case.yaml: expectd: x: expected one of the keys'),
                           ('model: m\ntest: [a]\n', 'case.yaml: train: None: expected a list of recordings'),
                           (self.BEGIN + 'expected: something\n', 'case.yaml: expected: something: expected no_missing_effect'),
                           (self.BEGIN + 'expected: [{place: x}]\n', 'expected.0.id: None: expected the id of an effect'),
                           (self.BEGIN + 'expected: [{id: a, sizes: {x: 3}}]\n', 'sizes.x: 3: expected [low, high]'),
                           (self.BEGIN.replace('to: one', 'to: ../one'), 'convert.0.to: ../one: expected the name'),
                           ('train: [', 'case.yaml: while parsing')):
            self.case('bench', text)
            heard = io.StringIO()
            with self.assertRaises(SystemExit) as ended, contextlib.redirect_stderr(heard):
                self.run_all()
            self.assertEqual(ended.exception.code, 2)
            self.assertIn(said, heard.getvalue())
            self.assertEqual(heard.getvalue().count('\n'), 1)
        self.assertFalse(os.path.exists('calls'))


# Names dry friction of 0.001 Nm; of rivals, the law that bends before it slides; or one law instead of two.
NAMER = '''#!/bin/sh
echo examined >> calls
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"
echo '{"verdict": "effects_found", "improbable": [], "remarks": [], "gap": {"test": {"before": 9, "recalibrated": 5, "after": 1}},
  "alternatives": [{"id": "joint_coulomb_asymmetric", "place": "axis", "instead_of": [{"id": "joint_coulomb"}, {"id": "b"}]}],
  "effects": [{"id": "joint_coulomb", "place": "axis", "probability": 0.9, "rivals": [{"id": "joint_presliding", "place": "axis"}],
  "parameters": {"torque": {"value": 0.001, "ci95": [0, 1e6], "unit": "Nm"}}}, {"id": "b", "place": "axis", "rivals": [],
  "parameters": {}}]}' > "$2/report.json"
'''


class AxesStudy(Study):
    study_of = axes

    def programs(self):
        patch = mock.patch.multiple(real, CONVERT=self.program('converter', CONVERTER),
                                    DISCOVER=self.program('namer', NAMER))
        patch.start()
        self.addCleanup(patch.stop)
        return {}

    def test_what_is_named_and_what_is_as_good(self):
        laws = ['none', 'joint_coulomb', 'joint_presliding', 'joint_coulomb_asymmetric', 'payload']
        words = [word for law in laws for word in ('--law', law)]
        self.study('--cases', '1', *words)
        rows = {row['law']: row for row in _study.load('out/axes.json')}
        self.assertEqual([rows[law]['named'] for law in laws], [False, True, False, False, False])
        self.assertEqual([rows[law]['in_class'] for law in laws], [False, False, True, True, False])
        self.assertEqual([rows[law]['more'] for law in laws], [0, 1, 1, 0, 2])
        self.assertTrue(rows['joint_coulomb']['holds'])
        self.assertFalse(os.path.exists('studies'))  # a part of the laws is no study
        self.assertFalse(os.path.exists('out/axes/seed_1/made/00_none'))
        self.study('--cases', '1', *words)
        with open('calls') as calls:
            self.assertEqual(calls.read().count('examined'), 5)

    def test_drives(self):
        self.study('--cases', '1', '--drives', '--law', 'joint_coulomb', '--law', 'gear_efficiency')
        rows = {row['law']: row for row in _study.load('out/drives.json')}
        self.assertEqual([rows[law]['named'] for law in ('joint_coulomb', 'gear_efficiency')], [True, False])
        self.assertIn('servo drive', open('out/drives.md').read())

    def test_a_servo_is_held_by_its_gain_and_its_gear(self):
        servo = _servo.Servo(1, 0, 'none')
        servo.goals = lambda _: [0.8] * int(_servo.SECONDS * servo.rate)
        t, joint, goal, motor, volts, current = numpy.array(servo.record('run_1')[-100:]).T
        torque = servo.weight * numpy.sin(joint)
        held = servo.constant * servo.ratio * volts / servo.ohm  # of the motor at rest; losses hold a part of the weight
        self.assertTrue((held <= torque / servo.efficiency + 0.02 * servo.weight).all())
        self.assertTrue((held >= torque * servo.efficiency - 0.02 * servo.weight).all())
        self.assertAlmostEqual(float(abs(volts - servo.gain * (goal - motor)).max()), 0.0,
                               delta=servo.gain * 2 * numpy.pi / 2**servo.bits + servo.volts / 500)
        self.assertAlmostEqual(float(abs(motor - joint).max()), 0.0, delta=4 * numpy.pi / 2**servo.bits)

    def test_a_bench_takes_what_its_parts_take(self):
        for law, more in (('none', lambda v, q: 0.0 * v), ('joint_coulomb', lambda v, q: numpy.sign(v)),
                          ('joint_quadratic_drag', lambda v, q: v * abs(v))):
            bench = _bench.Bench(2, 3, law)  # of 206 rows a second, 19 bits
            t, q, effort = bench.record('run_1').T
            v = numpy.gradient(q, t)
            parts = numpy.column_stack([numpy.gradient(v, t), v, numpy.sin(q), more(v, q)])
            moves = abs(v) > 0.2 * abs(v).max()
            found = numpy.linalg.lstsq(parts[moves], effort[moves], rcond=None)[0]
            self.assertAlmostEqual(found[1] / bench.viscous, 1.0, delta=0.1)
            for size in bench.truth.values():
                self.assertAlmostEqual(found[3] / size, 1.0, delta=0.1)


# Passes three tests; where there is a file `race`, the sanitizer finds two of a kind.
THREADED = '''#!/bin/sh
echo "[  PASSED  ] 3 tests."
[ ! -f race ] && exit
for i in 1 2; do echo "WARNING: ThreadSanitizer: data race (pid=$i)"; done
exit 66
'''


# A hinge and two muscles that do what sines do, at every tick.
REPLAYER = '''#!/usr/bin/python3
import math, os, sys
out = sys.argv[sys.argv.index("--out") + 1]
os.makedirs(out)
own = ["position", "velocity", "current", "voltage", "force"]
names = {"muscles": [f"{m}/{o}" for m in ("flexor", "extensor") for o in own], "joints": ["hinge/position"]}
for table, columns in names.items():
    with open(f"{out}/{table}.csv", "w") as file:
        file.write("t," + ",".join(columns) + "\\n")
        for i in range(20100):
            file.write(",".join([f"{i / 1000:.3f}"] + [f"{math.sin(i / 300):.6f}"] * len(columns)) + "\\n")
'''
# Names friction where something is hidden, and a delay of joints by foreign conventions.
ANSWERER = '''#!/usr/bin/python3
import json, os, sys
out = sys.argv[sys.argv.index("--out") + 1]
os.makedirs(out)
hidden = "effects" in open(os.path.join(os.path.dirname(out), "hidden.yaml")).read()
effects = [{"id": "joint_coulomb", "place": "hinge", "parameters": {}}] if hidden else []
late = "foreign" in out and os.path.exists("late")
held = [{"channel_kind": "joint position", "what": what, "source": "found"} for what in ["hold"] + ["delay"] * late]
json.dump({"verdict": "effects_found" if effects else "no_missing_effect", "gap": {}, "effects": effects,
           "measurement": held if "foreign" in out else [], "remarks": []}, open(out + "/report.json", "w"))
open("calls", "a").write("examined\\n")
'''


class ConventionsStudy(Study):
    study_of = conventions

    def programs(self):
        return {'REPLAY': self.program('replayer', REPLAYER), 'DISCOVER': self.program('answerer', ANSWERER)}

    def test_answers_are_compared_with_those_by_our_own_conventions(self):
        self.study('--cases', '4')
        rows = _study.load('out/conventions.json')
        self.assertEqual([row['right'] for row in rows], [True] * 4)
        self.assertEqual([row['ours'] for row in rows], ['', 'joint_coulomb@hinge'] * 2)
        self.assertEqual(self.calls(), 6)  # of nothing hidden, what is right is known
        self.study('--cases', '4')
        self.assertEqual(self.calls(), 6)
        self.assertRegex(self.told(), r'cases.*4')

    def test_a_delay_of_a_camera_is_right_only_where_there_is_one(self):
        open('late', 'w').close()
        self.study('--cases', '3')
        rows = _study.load('out/conventions.json')
        for row, asked in zip(rows, (_recorder.Case(1, i, True, i % 2 == 1) for i in range(3))):
            is_late = any(c.kind == 'joint' and c.what in ('delay', 'average', 'filter', 'clock') for c in asked.conventions)
            self.assertEqual(row['right'], is_late, row)

    def test_what_is_told(self):
        found = {'measurement': [{'channel_kind': 'position and force', 'what': 'delay', 'source': 'found'},
                                 {'channel_kind': 'current', 'what': 'unit', 'source': 'meta'}], 'effects': []}
        for what, kind, told in [('delay', 'force', True), ('average', 'force', True), ('delay', 'current', False),
                                 ('hold', 'force', False), ('unit', 'current', False)]:
            self.assertEqual(conventions.is_reported(_recorder.Convention(what, kind, 1.0), found), told, (what, kind))

    def test_a_recorder_does_what_it_is_asked_for(self):
        t = numpy.arange(20100) * _recorder.TICK
        ramp, times = 3.0 * t, numpy.arange(0.0, 19.9, 0.005)
        with mock.patch.object(_recorder, 'NOISE', dict.fromkeys(_recorder.NOISE, 0.0)):
            def column(*conventions):
                recorder = _recorder.Recorder([_recorder.Convention(*c) for c in conventions], 'x')
                return recorder.column('flexor/force', ramp, times, numpy.random.default_rng(1))[100:]
            after = times[100:]
            numpy.testing.assert_allclose(column(), 3.0 * after, atol=1e-9)
            numpy.testing.assert_allclose(column(('delay', 'force', 0.012)), 3.0 * (after - 0.012), atol=1e-9)
            numpy.testing.assert_allclose(column(('filter', 'force', 0.01)), 3.0 * (after - 0.01), atol=2e-3)
            numpy.testing.assert_allclose(column(('average', 'force', 0.01)), 3.0 * (after - 0.0045), atol=2e-3)
            numpy.testing.assert_allclose(column(('unit', 'force', 1e3, 'flexor/force')), 3000.0 * after, atol=1e-6)
            numpy.testing.assert_allclose(column(('unit', 'force', 1e3, 'extensor/force')), 3.0 * after, atol=1e-9)
            held = column(('hold', 'force', 40.0))
            self.assertEqual(len(numpy.unique(held)), len(numpy.unique(numpy.floor(after * 40.0 + 1e-9))))


# Names what is hidden, but nothing if much evidence is asked for, and friction where nothing is if little is. It does not
# simulate again what is in its journal.
JUDGE = '''#!/usr/bin/python3
import json, os, sys, time
out = sys.argv[sys.argv.index("--out") + 1]
option = sys.argv[sys.argv.index("--option") + 1] if "--option" in sys.argv else "judgement.merit.evidence=3"
evidence = float(option.split("=")[1]) if "evidence" in option else 3.0
os.makedirs(out, exist_ok=True)
if not os.path.exists(out + "/journal.bin"):
    open(out + "/journal.bin", "w").write("simulated")
    open("simulated", "a").write("once\\n")
    time.sleep(0.2)
os.remove(out + "/journal.bin")
law = "joint_coulomb" if "joint_coulomb" in out else ""
law = "" if evidence > 4.0 else "joint_viscous" if evidence < 1.0 and not law else law
effects = [{"id": law, "place": "axis", "rivals": [], "parameters": {"torque": {"value": 1.0, "ci95": [0, 2]}}}] if law else []
json.dump({"verdict": "effects_found" if law else "no_missing_effect", "alternatives": [], "effects": effects,
           "gap": {"test": {}}, "options": {"judgement": {"merit": {"evidence": 3.0}, "draws": 1}, "fit": {"phases": 8},
           "conclusion": {"most_remains": 0.9}}}, open(out + "/report.json", "w"))
open("calls", "a").write("asked\\n")
'''


# A robot at rest.
RESTING = '''#!/usr/bin/python3
import os, sys
out = sys.argv[sys.argv.index("--out") + 1]
os.makedirs(out)
tables = {"muscles": "t,brachialis/force", "joints": "t,elbow/position", "spherical_joints": "t,s/w,s/x,s/y,s/z"}
for table, head in tables.items():
    with open(f"{out}/{table}.csv", "w") as file:
        file.write(head + "\\n")
        for i in range(200):
            file.write(f"{i / 100}," + ("1,0,0,0" if "w" in head else "0") + "\\n")
'''
# Tells what grows in a tendon three days after it has begun, as friction.
DOCTOR = '''#!/usr/bin/python3
import json, os, sys
if sys.argv[1] == "commands":
    os.makedirs(sys.argv[sys.argv.index("--out") + 1])
    sys.exit()
folder = sys.argv[sys.argv.index("--history") + 1]
robot = json.load(open(os.path.join(os.path.dirname(folder), "robot.yaml")))
days = json.load(open("days")) if os.path.exists("days") else {}
for effect in robot["effects"]:
    days[effect["place"]] = days.get(effect["place"], 0) + 1
json.dump(days, open("days", "w"))
figure = {"quantity": "friction", "change": 3.0, "visible": 2.0, "limit": 6.0}
told = [muscle for muscle, count in days.items() if count > 3] + (["nobody"] if os.path.exists("false") else [])
os.makedirs(folder, exist_ok=True)
json.dump({"findings": [{"muscle": m, "quantities": ["friction"], "text": m} for m in told],
           "tendons": [{"muscle": m, "figures": [figure]} for m in days]}, open(folder + "/health.json", "w"))
open("calls", "a").write("judged\\n")
'''


class HealthStudy(Study):
    study_of = health

    def programs(self):
        self.program('model.yaml', json.dumps({'muscles': {m: {'rest_tendon_length': 0.2} for m in health.MUSCLES}}))
        return {'REPLAY': self.program('resting', RESTING), 'HEALTH': self.program('doctor', DOCTOR), 'MODEL': 'model.yaml'}

    def test_what_grows_is_told_by_the_right_figure_only(self):
        self.study('--robots', '1')
        self.assertEqual(self.calls(), health.DAYS)
        result, = _study.load('out/health.json')
        self.assertEqual(len(result['changes']), 3)
        for change, one in zip(result['changes'], result['judged']):
            self.assertEqual(one['day'], change['from'] + 4)
            self.assertEqual(one['right'], change['law'] == 'wearing motor')
            self.assertEqual((one['visible_sizes'], one['limits'], one['early']), (1.5, 0.5, False))
        self.assertEqual(result['others'], [])
        self.assertLess(result['moved_deg'], 0.1)  # of the potentiometer's noise
        self.study('--robots', '1')
        self.assertEqual(self.calls(), health.DAYS)
        self.assertRegex(self.told(), r'told of tendons in which nothing changes: 0 in 480 days')

    def test_what_is_not_there_is_counted(self):
        open('false', 'w').close()
        self.study('--robots', '1')
        self.assertRegex(self.told(), r'nothing changes: 60 in 480 days')
        self.assertIn('## Told, and not there', self.told())


class RulesStudy(Study):
    study_of = rules

    def programs(self):
        return {'CONVERT': self.program('converter', CONVERTER), 'DISCOVER': self.program('judge', JUDGE)}

    def test_answers_with_other_numbers(self):
        self.study('--benches', '2', '--rigs', '0')
        # Times 0.7, times 1.4 and without; shares have at most 1.
        self.assertEqual(rules.variations(_study.load('out/rules.json')[0]['options']), [
            'judgement.merit.evidence=2.1', 'judgement.merit.evidence=4.2', 'judgement.merit.evidence=1e-09',
            'conclusion.most_remains=0.63', 'conclusion.most_remains=1'])
        self.assertEqual(self.calls(), 2 * (3 + 6))  # three conversions each
        with open('simulated') as file:
            self.assertEqual(len(file.readlines()), 2)
        rows = [line.split('|')[1:-1] for line in self.told().splitlines() if line.startswith('| `')]
        self.assertEqual([[cell.strip() for cell in row] for row in rows], [
            ['`judgement.merit.evidence`', '4.2', '1', '0', '1'], ['`judgement.merit.evidence`', 'never', '1', '0', '1']])
        self.assertRegex(self.told(), r'right as it is: 2 of 2')
        self.assertIn('`conclusion.most_remains`.', self.told())
        self.study('--benches', '2', '--rigs', '0')
        self.assertEqual(self.calls(), 2 * (3 + 6))  # three conversions each

    def test_one_number_alone_is_no_study(self):
        self.study('--benches', '1', '--rigs', '0', '--option', 'judgement.merit.evidence=9')
        self.assertEqual(self.calls(), 3 + 2)
        self.assertFalse(os.path.exists('studies'))


class ThreadsStudy(Study):
    study_of = threads

    def programs(self):
        def build(_, folder):
            os.makedirs(os.path.join(folder, 'build'), exist_ok=True)
            for name in threads.TESTS:
                self.program(os.path.join(folder, 'build', name), THREADED)

        return {'build': build}

    def test_what_is_found_is_told_once(self):
        self.study('--tbb', 'tbb')
        self.assertRegex(self.told(), r'\| search \| 3 \| nothing \| \d+ \|')
        open('race', 'w').close()
        with self.assertRaises(SystemExit) as ended:
            self.study('--tbb', 'tbb')
        self.assertEqual(ended.exception.code, 1)
        self.assertRegex(self.told(), r'\| tracking \| 3 \| data race \| \d+ \|')

    def test_without_the_source_of_the_library(self):
        with self.assertRaises(SystemExit) as ended, mock.patch.object(threads, 'build', self.build):
            self.study('--tbb', 'nowhere')
        self.assertEqual(ended.exception.code, 2)

    build = staticmethod(threads.build)


class SoakStudy(Study):
    study_of = soak

    def programs(self):
        launcher = [self.program('launcher', LAUNCHER)]
        return {'SHELL': launcher, 'PERIOD': 0.05, 'SETTLED': 1.5, 'BUS': 'none', 'long_postures': lambda *_: 'postures.yaml',
                'long_protocol': lambda *_: 'protocol.yaml'}

    def test_what_stays_as_it_is(self):
        self.study('--hours', '0.0014')
        rows = [line for line in self.told().split('\n') if line.startswith('| arm: roslaunch')]
        self.assertEqual(len(rows), 2)

    def test_what_grows(self):
        open('leak', 'w').close()
        with self.assertRaises(SystemExit) as ended:
            self.study('--hours', '0.0014', '--part', 'recorder')
        self.assertEqual(ended.exception.code, 1)
        with open('out/soak.json') as file:
            (grown,) = json.load(file)['processes']
        # 0.1 MB every 0.02 s, or a little later
        self.assertGreater(grown['slope_MB_per_h'], 3000.0)
        self.assertLess(grown['slope_MB_per_h'], 18100.0)

    def test_what_ends_before_its_time(self):
        open('short', 'w').close()
        with self.assertRaises(SystemExit) as ended:
            self.study('--hours', '0.01')
        self.assertEqual(ended.exception.code, 2)
        self.assertFalse(os.path.exists('out/soak.json'))

    def test_a_pace_that_is_none(self):
        for word in ('0', '1.5', 'fast', 'nan'):
            with self.assertRaises(SystemExit) as ended:
                self.study('--pace', word)
            self.assertEqual(ended.exception.code, 2)

    def test_a_driver_without_a_bus(self):
        with self.assertRaises(SystemExit) as ended:
            self.study('--part', 'driver')
        self.assertEqual(ended.exception.code, 2)


class CalibrationStudy(Study):
    study_of = calibration

    def programs(self):
        return {'RECORDER': self.program('recorder', RECORDER),
                'TOOL': self.program('calibrate', CALIBRATE),
                'CONFIG': os.path.join(TOP, calibration.CONFIG)}

    def test_every_stage_is_done_once(self):
        self.study('--robots', '1', '--models', 'I')
        self.assertEqual(self.calls(), 2 + 2 * 4)
        self.study('--robots', '1', '--models', 'I')
        self.assertEqual(self.calls(), 2 + 2 * 4)
        self.study('--robots', '1', '--models', 'I', '--thorough')  # asks for more
        self.assertEqual(self.calls(), 2 + 2 * 2 * 4)
        self.assertIn('| I | tier1_statics | 12.0 / 1.0 / 3.0 | 2.0 / 1.0 / 3.0 | 6.0 |', self.told())

    def test_goes_on_elsewhere_with_what_is_published(self):
        self.study('--robots', '1', '--models', 'I')
        before = self.told()
        shutil.rmtree('out')  # another machine
        self.study('--adopt', '--robots', '1', '--models', 'I')
        self.assertEqual(self.calls(), 2 + 2 * 4)
        self.assertEqual(self.told(), before)
        self.study('--adopt', '--robots', '2', '--models', 'I')
        self.assertEqual(self.calls(), 2 * (2 + 2 * 4))
        self.assertIn('| yes: <= 5 deg | 1, 2 |', self.told())

    def test_a_study_elsewhere_leaves_the_document_alone(self):
        self.study('--robots', '1', '--models', 'I')
        before = self.told()
        self.study('--out', 'elsewhere', '--robots', '2', '--models', 'I')
        self.assertTrue(os.path.exists('elsewhere/calibration.html'))
        self.assertEqual(self.told(), before)

    def test_nothing_published_to_adopt(self):
        with self.assertRaises(SystemExit) as ended:
            self.study('--adopt')
        self.assertEqual(ended.exception.code, 2)

    def results(self):
        with open('studies/calibration.json') as file:
            return json.load(file)

    def test_every_result_tells_of_its_own_search(self):
        with mock.patch.object(calibration, 'machine', lambda: 'slow one'):
            self.study('--robots', '1', '2', '--models', 'I', 'II')
        self.assertIn('- Jacobians per search, at most: 8', self.told())
        with mock.patch.object(calibration, 'machine', lambda: 'fast one'):
            self.study('--robots', '1', '--models', 'I', '--optimiser', 'cmaes', '--runs', '2', '--share', '0.5')
        robots = self.results()
        by_cmaes, others = robots['1']['I'], [robots['1']['II'], robots['2']['I'], robots['2']['II']]
        for stage in calibration.STAGES:
            told = [by_cmaes[stage][key] for key in ('optimiser', 'searches', 'machine')]
            self.assertEqual(told, ["cmaes (0.5 of the thesis's generations)", 2, 'fast one'])
            for other in others:
                told = [other[stage][key] for key in ('optimiser', 'searches', 'machine')]
                self.assertEqual(told, ['least_squares', 1, 'slow one'])
        self.assertIn("- optimiser: cmaes (0.5 of the thesis's generations), least_squares", self.told())
        with open('out/calibration.json') as file:
            self.assertEqual(list(json.load(file)['table'][0]['robots']), ['1', '2'])

    def test_jacobians_are_those_of_least_squares(self):
        self.study('--robots', '1', '--models', 'I', '--optimiser', 'cmaes', '--runs', '1')
        self.assertNotIn('Jacobians', self.told())

    def test_another_virtual_robot_is_recorded_again(self):
        self.study('--robots', '1', '--models', 'I')
        with open('out/calibration/robot_1/data/old', 'w'):
            pass
        self.program('recorder', RECORDER + '# another one\n')
        self.study('--robots', '1', '--models', 'I')
        self.assertFalse(os.path.exists('out/calibration/robot_1/data/old'))
        self.assertEqual(self.calls(), 2 * (2 + 2 * 4))

    def test_what_cannot_be_simulated_to_its_end_is_left_out(self):
        null = 'errors=\'{"mean": {"before": null, "after": null}}\'\n'
        self.program('calibrate', re.sub('errors=.*\n', lambda _: null, CALIBRATE))
        self.study('--robots', '1', '--models', 'I')
        self.assertEqual(self.results(), {})

    def test_bad_input(self):
        for arguments in (['--runs', '0'], ['--optimiser', 'foo'], ['--share', '-1'], ['--share', 'nan'],
                          ['--share', '2'], ['--robots', '-1'], ['--robots', 'x'], ['--jobs', '0'], ['--models', 'IV']):
            errors = io.StringIO()
            with self.assertRaises(SystemExit) as ended, contextlib.redirect_stderr(errors):
                self.study(*arguments)
            self.assertEqual(ended.exception.code, 2, arguments)
            self.assertEqual(errors.getvalue().count('\n'), 1, errors.getvalue())
        self.assertFalse(os.path.exists('calls'))


class DiscoveryStudy(Study):
    study_of = discovery

    def programs(self):
        return {'MAKER': self.program('maker', MAKER), 'DISCOVER': self.program('discover', DISCOVER),
                'SCORE': os.path.join(TOP, discovery.SCORE)}

    def test_slices_are_all_cases_once_and_every_part_tells_of_all_kinds(self):
        with mock.patch.object(sys, 'argv', ['study']):
            options = discovery.arguments()
        cases = discovery.all_cases(options)
        names = [case.name for case in cases]
        self.assertEqual(len(names), 2 * 2 + 60 + 12 + 1 + 1)
        parts = []
        for k in range(1, 6):
            options.slice = (k, 5)
            parts += [case.name for case in discovery.chosen(cases, options)]
        self.assertEqual(sorted(parts), sorted(names))
        self.assertEqual({case.kind for case in cases[:8]}, set(discovery.KINDS))

    def test_a_case_is_done_once(self):
        self.study('--case', 'effect_01', 'null_00')
        self.assertEqual(self.calls(), 4)
        self.study('--case', 'effect_01', 'null_00')
        self.assertEqual(self.calls(), 4)
        with open('out/discovery.json') as file:
            result = json.load(file)
        self.assertEqual(result['effect']['first'], 1)
        self.assertEqual(result['null']['false'], 1)
        self.assertIn('2 of 78', result['facts']['cases'])
        self.assertIn('| effect named first | 1/1 = 100 %', self.told())
        self.assertIn('| effect named first or in the class, at its place | 1/1 = 100 %', self.told())
        self.assertEqual(os.listdir('out/discovery/cases/effect_01'), ['model.yaml'])

    def test_goes_on_elsewhere_with_what_is_published(self):
        self.study('--case', 'effect_01')
        before = self.told()
        shutil.rmtree('out')  # another machine
        self.study('--adopt', '--summary')
        self.assertEqual(self.told(), before)
        self.study('--adopt', '--case', 'effect_01', 'null_00')
        self.assertEqual(self.calls(), 4)  # effect_01 is not made again
        with open('studies/discovery.json') as file:
            self.assertEqual(list(json.load(file)), ['effect_01', 'null_00'])

    def test_another_seed_is_another_study(self):
        self.study('--case', 'effect_01')
        before = self.told()
        self.study('--seed', '2', '--case', 'effect_01')
        self.assertEqual(self.calls(), 4)
        self.assertEqual(self.told(), before)
        self.assertTrue(os.path.exists('out/discovery_seed_2.html'))
        shutil.rmtree('out')
        self.study('--seed', '2', '--adopt', '--case', 'effect_01')
        self.assertEqual(self.calls(), 4)
        with open('studies/discovery_seed_2.md') as file:
            self.assertIn('- seed: 2', file.read())

    def test_cases_elsewhere_leave_the_document_alone(self):
        self.study('--case', 'effect_01')
        before = self.told()
        self.study('--out', 'elsewhere', '--case', 'null_00')
        self.assertTrue(os.path.exists('elsewhere/discovery.html'))
        self.assertEqual(self.told(), before)
        with open('studies/discovery.json') as file:
            self.assertEqual(list(json.load(file)), ['effect_01'])
        self.study('--out', 'out/', '--case', 'null_00')  # the same folder
        self.assertNotEqual(self.told(), before)

    def test_nothing_published_to_adopt(self):
        with self.assertRaises(SystemExit) as ended:
            self.study('--adopt', '--case', 'effect_01')
        self.assertEqual(ended.exception.code, 2)

    def test_what_was_interrupted_or_failed_is_done_again(self):
        for status in '130', '1':
            with open('status', 'w') as file:
                file.write(status)
            with self.assertRaises(KeyboardInterrupt if status == '130' else SystemExit):
                self.study('--case', 'null_00')
            self.assertFalse(os.path.exists('out/discovery.json'))
        self.assertEqual(self.calls(), 3)  # made once
        os.remove('status')
        self.study('--case', 'null_00')
        self.assertTrue(os.path.exists('out/discovery.json'))

    def test_a_robot_that_cannot_be_made_ends_nobody_else(self):
        maker = os.path.join(self.folder, 'maker_of_some')
        self.program('maker_of_some', '#!/bin/sh\n[ "$2 $4" = "null 0" ] && exit 1\n' + MAKER.split('\n', 1)[1])
        with mock.patch.object(discovery, 'MAKER', maker), self.assertRaises(SystemExit) as ended:
            self.study('--case', 'null_00', 'effect_01')
        self.assertIn('without a report: null_00', str(ended.exception.code))
        with open('out/discovery.json') as file:
            result = json.load(file)
        self.assertEqual([case['name'] for case in result['cases']], ['effect_01'])
        self.assertEqual(result['missing'], [])  # it was not asked

    def test_a_case_without_a_report_counts_as_missing(self):
        self.study('--case', 'null_00')
        with open('status', 'w') as file:
            file.write('1')
        with self.assertRaises(SystemExit):
            self.study('--case', 'effect_01')
        with open('out/discovery.json') as file:
            self.assertEqual(json.load(file)['missing'], ['effect_01'])
        self.assertIn('| effect named first, or in the class of what is named first | 0/1 = 0 %', self.told())
        self.assertIn('- cases answered: 1 of ', self.told())
        self.assertIn(', and 1 that ended without a report', self.told())
        # Another host takes that over, too.
        shutil.rmtree('out')
        self.study('--adopt', '--summary')
        with open('out/discovery.json') as file:
            self.assertEqual(json.load(file)['missing'], ['effect_01'])
        self.assertIn(', and 1 that ended without a report', self.told())

    def test_times_are_of_all_runs_of_a_case(self):
        with open('status', 'w') as file:
            file.write('130')
        with self.assertRaises(KeyboardInterrupt):
            self.study('--case', 'null_00')
        with open('out/discovery/reports/null_00/spent_s') as file:
            self.assertGreater(float(file.read()), 0.0)
        with open('out/discovery/reports/null_00/spent_s', 'w') as file:
            file.write('3600.0')
        os.remove('status')
        self.study('--case', 'null_00')
        with open('out/discovery/reports/null_00/study.json') as file:
            facts = json.load(file)
        self.assertGreater(facts['discovery_s'], 3600.0)
        self.assertGreater(facts['processor_s'], 0.0)
        self.assertLess(facts['processor_s'], 10.0)
        self.assertIn('processor time 0.0 h for 1 of the cases', ' '.join(self.told().split()))

    def test_a_case_is_of_one_program(self):
        with open('status', 'w') as file:
            file.write('130')
        for program, made in ('one', 1), ('one', 1), ('two', 2):
            with mock.patch.object(discovery, 'commit', lambda: program), self.assertRaises(KeyboardInterrupt):
                self.study('--case', 'null_00')
            with open('calls') as file:
                self.assertEqual(file.read().count('made '), made, program)

    def test_every_rate_of_the_scores_has_words(self):
        with open(discovery.SCORE) as file:
            labels = re.findall(r"sheet\.(?:rate|median)\('([^']+)'", file.read())
        self.assertEqual({label.strip() for label in labels}, set(discovery.RATES))
        self.assertLessEqual({section for section, _ in discovery.RATES.values() if section}, set(discovery.SECTIONS))

    def test_rates_stand_in_the_section_of_what_was_hidden(self):
        rates = [{'label': label, 'said': said, 'asked': asked} for label, said, asked in (
            ('correct', 'a', 'asked: 90 %'), ('of all, invisible too', 'b', ''),
            ('both of two named', 'c', 'asked: 80 %'), ('of all, invisible too', 'd', ''),
            ('covered by ci95', 'e', 'asked: 88-99 %'), ('unheard of', 'f', ''))]
        parts = list(discovery.rate_parts({'rates': rates}))
        tables = {title: table for title, _, (_, table) in zip(*[iter(parts)] * 3)}
        one, two = tables.values()
        self.assertEqual(list(tables), ['### One effect hidden', '### Two effects hidden'])
        self.assertEqual([row[1:] for row in one], [['a', 'at least 90 %'], ['b', ''], ['e', '88-99 %'], ['f', '']])
        self.assertEqual([row[1:] for row in two], [['c', 'at least 80 %'], ['d', '']])

    def test_bad_input(self):
        for arguments in (['--case', 'nobody'], ['--slice', '3/2'], ['--slice', 'x'], ['--summary'], ['--jobs', '0']):
            with self.assertRaises(SystemExit) as ended:
                self.study(*arguments)
            self.assertEqual(ended.exception.code, 2, arguments)


class Pipes(unittest.TestCase):

    def test_a_reader_that_has_seen_enough(self):
        prints = 'import _study; _study.start(lambda: print("case\\n" * 100000, flush=True))'
        study = subprocess.Popen([sys.executable, '-c', prints], cwd=os.path.join(TOP, 'scripts', 'study'),
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(study.stdout.readline(), 'case\n')
        study.stdout.close()
        self.assertEqual(study.stderr.read(), '')
        study.stderr.close()
        self.assertEqual(study.wait(30), 1)


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'study', '__main__')
