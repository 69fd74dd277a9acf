#!/usr/bin/env python3
"""README, docs/ and studies/: every command in them is one that this workspace has, with options, arguments, topics and files
that exist; links and anchors lead somewhere; README is short, and no number in it stands without a test or a command behind it.
Nothing is run but --help."""
import functools
import glob
import os
import re
import shlex
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

import roslib.packages
import rospkg
import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
REFERENCE = ['files', 'ros', 'effects', 'ecu_protocol', 'physics', 'discovery_method', 'architecture']  # pages to look things up
OURS = re.compile(r'\.?/?(?:catkin_ws\.sh|scripts/\S+|devel/lib/\S+)$|ros[a-z]+$')
OTHERS = {'ANTHROB', 'FAULT', 'MODEL', 'apt', 'bash', 'build/episodes', 'cansend', 'catkin_make', 'cd', 'cmake', 'cp', 'docker', 'ip',
          'mkdir', 'modprobe', 'mpirun', 'mv', 'python3', 'sleep', 'source', 'taskset', 'tail', 'until', 'xvfb-run',
          '/usr/lib/collada_urdf/collada_to_urdf'}
MADE = ('studies/discovery.json', 'studies/discovery.md', 'studies/discovery_seed_2.md')  # by a study, under its default name
TUTORIAL = ('my_arm', 'mybot', 'my_controller')  # what the reader makes
NAMES = r'Debian 12|ROS 1|BSD 3-clause|GPL 3|C\+\+17'  # digits that are no numbers


def read(file):
    with open(os.path.join(TOP, file)) as text:
        return text.read()


def pages():
    files = ['README.md'] + sorted(glob.glob('docs/*.md', root_dir=TOP)) + sorted(glob.glob('studies/*.md', root_dir=TOP))
    return {file: read(file) for file in files}


def prose_and_blocks(text):
    """Lines of prose, and blocks of code as (language, lines); indented blocks have no language."""
    prose, blocks, fence = [], [], None
    for line in text.splitlines():
        if line.lstrip().startswith('```'):
            fence = line.strip('` ') if fence is None else None
            if fence is not None:
                blocks.append((fence, []))
        elif fence is not None:
            blocks[-1][1].append(line)
        elif line.startswith('    ') and (not prose[-1].strip() or prose[-1] == '<code>' or prose[-1].startswith('#')):
            if prose[-1] != '<code>':
                blocks.append(('', []))
            blocks[-1][1].append(line.strip())
            prose.append('<code>')
        else:
            prose.append(line)
    return prose, blocks


def first_word(command):
    return re.split(r'[\s=]', command, maxsplit=1)[0]


def is_ours(word):
    return bool(OURS.match(word))


def commands_of(block):
    """Whole commands, without comments; lines that print or compute something are left out."""
    joined, inside = [], False
    for line in block:
        if inside:
            joined[-1] += ' ' + line.strip()
        else:
            joined.append(line.strip())
        inside = joined[-1].endswith('\\')
        if inside:
            joined[-1] = joined[-1][:-1]
    for line in joined:
        line = re.sub(r'(^|\s)# .*', '', line).strip()
        for command in re.split(r' && |; ', line):
            command = command.strip().rstrip('&').strip()
            if command:
                yield command


def inline_commands(prose):
    text = ' '.join(line for line in prose if line != '<code>')
    for code in re.findall(r'`([^`]+)`', text):
        if is_ours(first_word(code)):
            yield re.sub(r'\s+', ' ', code)


def anchors(text):
    """As GitHub makes them."""
    found = []
    for line in prose_and_blocks(text)[0]:
        if re.match('#+ ', line):
            title = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', line.lstrip('#').strip().replace('`', ''))
            slug = re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-')
            found.append(slug if slug not in found else '%s-%d' % (slug, sum(f.startswith(slug) for f in found)))
    return found


@functools.lru_cache(maxsize=None)
def help_of(*command):
    done = subprocess.run([*command, '--help'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=60,
                          cwd=TOP, stdin=subprocess.DEVNULL)
    return done.stdout


@functools.lru_cache(maxsize=None)
def launch_arguments(package, file):
    root = ElementTree.parse(os.path.join(rospkg.RosPack().get_path(package), 'launch', file)).getroot()
    return {arg.get('name') for arg in root.findall('arg') if arg.get('value') is None}


def told_names():
    """Names of topics and services that the pages explain."""
    return set(re.findall(r'`([a-z_]+(?:/[a-z_]+)*)`', read('docs/ros.md') + read('docs/mocap.md')))


class Command:
    """One command of a page; wrong() says what is not so."""

    def __init__(self, text):
        self.text = text
        self.words = shlex.split(re.sub(r'\$\(rospack find anthrob_bringup\)|\$PWD', '.', text).replace('...', ''))
        while self.words and re.match(r'[A-Z_]+=', self.words[0]):
            self.words.pop(0)
        for before in ('until', 'xvfb-run', 'scripts/with_vcan.sh', 'mpirun'):
            if before in self.words[:1]:
                ours = [i for i, word in enumerate(self.words) if i and is_ours(word)]
                self.words = self.words[ours[0]:] if ours else self.words[:1]

    def wrong(self):
        try:
            done = subprocess.run(['bash', '-n', '-c', re.sub(r'^until .*|^do .*|^done', ':', self.text)], stderr=subprocess.PIPE)
        except ValueError as error:
            return [str(error)]
        if done.returncode:
            return [done.stderr.decode()]
        if not self.words:
            return []
        check = {'rosrun': self.rosrun, 'roslaunch': self.roslaunch, 'rosservice': self.rosservice, 'rostopic': self.topics,
                 'rosbag': self.topics}.get(self.words[0])
        if self.words[0].endswith('catkin_ws.sh'):
            check = self.workspace
        elif self.words[0].startswith(('scripts/', './scripts/')):
            check = self.script
        elif self.words[0].startswith('devel/lib/'):
            check = self.built
        return ([] if check is None else list(check())) + list(self.files())

    def options(self, told, words):
        for word in words:
            option = re.match(r'(--[a-z][\w-]*)', word)
            if option and option.group(1) != '--help' and not re.search(r'(?<![\w-])%s(?![\w-])' % option.group(1), told):
                yield 'no option %s' % option.group(1)

    def files(self):
        for before, word in zip(self.words, self.words[1:]):
            file = word.split(':=')[-1].replace('./', '')
            if re.match(r'(?:config|docs|launch|scripts|src|tests)/', file) and before != '--save' and \
                    not any(name in file for name in TUTORIAL) and not glob.glob(os.path.join(TOP, file)):
                yield 'no file %s' % file

    def workspace(self):
        words = self.words[1:]
        if words and words[0].islower() and not re.search(r'^  %s\b' % words[0], help_of('./catkin_ws.sh'), re.MULTILINE):
            yield 'no command %s' % words[0]
        elif words[:1] == ['study'] and len(words) > 1 and words[1].islower():
            if not os.path.isfile(os.path.join(TOP, 'scripts', 'study', words[1] + '.py')):
                yield 'no study %s' % words[1]
            else:
                yield from self.options(help_of('scripts/study/%s.py' % words[1]), words[2:])
        elif words[:1] == ['sim']:
            yield from self.arguments('anthrob_bringup', 'sim.launch', words[1:])

    def rosrun(self):
        if len(self.words) < 3 or not self.words[1].islower() or not self.words[2].islower() or self.words[1] in TUTORIAL:
            return
        found = roslib.packages.find_node(*self.words[1:3]) if self.words[1] in rospkg.RosPack().list() else []
        if not found:
            yield 'no program %s in a package %s' % (self.words[2], self.words[1])
            return
        told, words = help_of(found[0]), self.words[3:]
        if words and re.search(r'^\s+%s\b' % re.escape(words[0]), told, re.MULTILINE):
            told += help_of(found[0], words[0])
        yield from self.options(told, words)
        for word in words:
            parameter = re.match(r'(_[a-z]\w*):=', word)
            if parameter and not re.search(r'\b%s\b' % parameter.group(1), told):
                yield 'no parameter %s' % parameter.group(1)

    def roslaunch(self):
        words = [word for word in self.words[1:] if not word.startswith('-') and not word.isdigit() and word != 'PORT']
        if len(words) < 2 or words[1] in ('FILE', 'FILE.launch'):
            return
        try:
            yield from self.arguments(words[0], words[1], words[2:])
        except (OSError, rospkg.ResourceNotFound):
            yield 'no launch file %s in %s' % (words[1], words[0])

    def arguments(self, package, file, words):
        known = launch_arguments(package, file)
        for name in [word.split(':=')[0] for word in words if ':=' in word]:
            if not name.startswith('__') and not name.isupper() and name not in known:
                yield '%s has no argument %s' % (file, name)

    def script(self):
        if not os.access(os.path.join(TOP, self.words[0]), os.X_OK):
            yield 'no script %s' % self.words[0]
        elif self.words[0].endswith('.py'):
            yield from self.options(help_of(self.words[0]), self.words[1:])

    def built(self):
        package, program = self.words[0].split('/')[2:4]
        declared = os.path.join(TOP, 'src', package, 'CMakeLists.txt')
        made = read(declared) if os.path.isfile(declared) else ''
        # anthrob_tests() names a package's test program after it.
        if program not in made and not (program == package + '_test' and 'anthrob_tests(' in made):
            yield 'no program %s in %s' % (program, package)

    def rosservice(self):
        if self.words[1:2] == ['call'] and len(self.words) > 2:
            yield from self.named(self.words[2])

    def topics(self):
        words = iter(self.words[1:])
        for word in words:
            if word.startswith('/') and word not in ('/diagnostics', '/tf') and not word.startswith('/cam/'):
                yield from self.named(word)
            kind = re.fullmatch(r'anthrob_msgs/(\w+)', word)
            action = re.fullmatch(r'anthrob_msgs/(\w+)Action(Goal|Result|Feedback)?', word)
            source = 'action/%s.action' % action.group(1) if action else kind and 'msg/%s.msg' % kind.group(1)
            if source and not os.path.isfile(os.path.join(TOP, 'src', 'anthrob_msgs', source)):
                yield 'no message %s' % word

    def named(self, name):
        parts = name.strip('/').split('/')
        if not any('/'.join(parts[1:end]) in told_names() for end in range(2, len(parts) + 1)):  # the rest is a field
            yield '%s is not in docs/ros.md' % name


class Documents(unittest.TestCase):

    def every_command(self):
        for file, text in pages().items():
            prose, blocks = prose_and_blocks(text)
            for language, block in blocks:
                if language in ('', 'bash', 'sh'):
                    for command in commands_of(block):
                        yield file, command, is_ours(first_word(command))
            for command in inline_commands(prose):
                yield file, command, True

    def test_commands(self):
        seen = 0
        for file, command, ours in self.every_command():
            word = first_word(command)
            with self.subTest(file + ': ' + command):
                if ours or word in OTHERS or word.split('_')[0] in OTHERS:
                    seen += 1
                    self.assertEqual(Command(command).wrong(), [])
                else:  # an output or a formula
                    self.assertIsNone(re.match(r'\./|\w+ .* --[a-z]|ros[a-z]* |catkin', command), 'no such command')
        self.assertGreater(seen, 150)

    def test_wrong_commands_are_found(self):
        for command in ('./catkin_ws.sh demonstrate', './catkin_ws.sh study calibrations', './catkin_ws.sh study discovery --sead 14',
                        './catkin_ws.sh sim modle:=II', 'rosrun anthrob_sim anthrob_mussels', 'rosrun anthrob_sin anthrob_muscles',
                        'rosrun anthrob_sim anthrob_muscles --robots anthrob',
                        'rosrun anthrob_sim anthrob_replay --model config/anthrob/model_IV.yaml',
                        'rosrun anthrob_control anthrob_posture_player _posture:=FILE', 'roslaunch anthrob_bringup simulate.launch',
                        'roslaunch anthrob_bringup sim.launch modle:=II', 'rosservice call /anthrob/enabled',
                        'rostopic echo /anthrob/muscle_state', 'rostopic pub /anthrob/muscle_command anthrob_msgs/MuscleCommands',
                        'scripts/save_pair.py boards', 'scripts/save_pairs.py boards --bags run.bag', 'devel/lib/anthrob_sim/no_test',
                        'rostopic pub /anthrob/calibrate/goal anthrob_msgs/CalibratedActionGoal', 'rosbag record -O "run.bag'):
            with self.subTest(command):
                try:
                    self.assertNotEqual(Command(command).wrong(), [])
                except ValueError:  # of an open quotation mark
                    pass

    def test_links(self):
        seen = 0
        texts = {**pages(), 'CHANGELOG.md': read('CHANGELOG.md')}
        for file, text in texts.items():
            for target in re.findall(r'\]\(([^)\s]+)\)', re.sub(r'`[^`]*`', '', '\n'.join(prose_and_blocks(text)[0]))):
                if target.startswith(('http:', 'https:')):
                    continue
                seen += 1
                path, _, anchor = target.partition('#')
                path = os.path.normpath(os.path.join(os.path.dirname(file), path)) if path else file
                with self.subTest(file + ': ' + target):
                    self.assertTrue(os.path.exists(os.path.join(TOP, path)))
                    if anchor:
                        self.assertIn(anchor, anchors(texts[path]))
        self.assertGreater(seen, 200)

    def test_files_that_are_named(self):
        for file, text in pages().items():
            for name in re.findall(r'`((?:config|docs|launch|scripts|src|studies|tests)/[\w./-]+)`', text):
                with self.subTest(file + ': ' + name):
                    self.assertTrue(any(part in name for part in TUTORIAL) or os.path.exists(os.path.join(TOP, name)) or
                                    name in MADE or re.search(r'/model_mine|/R/|_tuned', name))

    def test_pages_that_sources_name(self):
        seen = 0
        for folder in 'src', 'scripts', 'config', 'launch', 'tests':
            for root, _, files in os.walk(os.path.join(TOP, folder)):
                for file in files:
                    if file.endswith(('.h', '.cpp', '.py', '.sh', '.yaml', '.launch', '.srv', '.msg', '.xml')):
                        for name in re.findall(r'\b(?:docs|studies)/\w+\.md', read(os.path.join(root, file))):
                            seen += 1
                            with self.subTest(os.path.join(root, file) + ': ' + name):
                                self.assertTrue(name in MADE or os.path.isfile(os.path.join(TOP, name)))
        self.assertGreater(seen, 20)

    def test_length(self):
        self.assertLessEqual(read('README.md').count('\n'), 150)
        self.assertLessEqual(read('CHANGELOG.md').count('\n'), 60)
        manual = [text for file, text in pages().items()
                  if not file.startswith('studies') and os.path.basename(file)[:-3] not in REFERENCE]
        self.assertGreater(len(manual), 10)
        self.assertLessEqual(sum(len(text.split()) for text in manual), 45000)

    def test_numbers_in_readme_have_a_command_or_a_test(self):
        self.assertEqual(list(self.bare_numbers(read('README.md'))), [])
        self.assertEqual(len(list(self.bare_numbers('It took 14 minutes.\n\nOn Debian 12.\n'))), 1)
        self.assertEqual(len(list(self.bare_numbers('    enable      # takes 3 s\n'))), 1)
        self.assertEqual(list(self.bare_numbers('It took 14\nminutes. <!-- measured: ./catkin_ws.sh test -->\n')), [])
        self.assertEqual(len(list(self.bare_numbers('It took 14 minutes. <!-- measured: ./catkin_ws.sh tets -->\n'))), 1)
        self.assertEqual(len(list(self.bare_numbers('It took 14 minutes. <!-- tested: tests/node/none_test.py -->\n'))), 1)

    def bare_numbers(self, text):
        """Paragraphs and comments of commands with a number, but without a marker that names a command or a test."""
        for paragraph in re.split(r'\n\s*\n', text):
            lines = [re.sub(r'^    [^#]*(?:\w#[^#]*)*', '', line) for line in paragraph.splitlines()]  # of a command its comment
            said = re.sub(r'`[^`]*`|\]\([^)]*\)|<!--.*?-->|"\([\d.]+\)"', '', ' '.join(lines))
            said = re.sub(NAMES, '', re.sub(r'^\d+\. ', '', said))
            if not re.search(r'\d', said):
                continue
            marker = re.search(r'<!-- (measured|tested): ([^,>]*?)(?:,[^>]*)? -->', paragraph)
            if not marker or (marker.group(1) == 'measured' and Command(marker.group(2)).wrong()) or \
                    (marker.group(1) == 'tested' and not os.path.isfile(os.path.join(TOP, marker.group(2)))):
                yield paragraph


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'documents', Documents)
