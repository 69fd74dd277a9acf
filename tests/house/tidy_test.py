#!/usr/bin/env python3
"""scripts/tidy.sh sees a finding that is made on purpose, in files that changed and in no others."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import rosunit

TOP = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..'))
GOOD = 'int twice(int a) {\n  return 2 * a;\n}\n'
# An integer is divided, and its half is lost, before it becomes a double: bugprone-integer-division.
BAD = 'double half(int a) {\n  const double whole = 1.0;\n  return whole + a / 2;\n}\n'


@unittest.skipUnless(shutil.which('clang-tidy') and shutil.which('git'), 'clang-tidy or git is not installed')
class Tidy(unittest.TestCase):
    """A workspace whose first commit holds good.cpp and old.cpp, the second of which has a finding."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.path.realpath(folder.name)
        os.makedirs(os.path.join(self.folder, 'scripts'))
        shutil.copy(os.path.join(TOP, 'scripts', 'tidy.sh'), os.path.join(self.folder, 'scripts'))
        shutil.copy(os.path.join(TOP, '.clang-tidy'), self.folder)
        self.write('.gitignore', '/build/\n')
        self.compiled('good.cpp', 'old.cpp', 'new.cpp')
        self.write('good.cpp', GOOD)
        self.write('old.cpp', BAD)
        self.git('init', '-q', '-b', 'main')
        self.commit()

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)

    def compiled(self, *names):
        commands = [{'directory': self.folder, 'command': 'c++ -std=gnu++17 -c %s/%s' % (self.folder, name),
                     'file': '%s/%s' % (self.folder, name)} for name in names]
        self.write('build/compile_commands.json', json.dumps(commands, indent=2))

    def git(self, *arguments):
        subprocess.run(['git', '-c', 'user.name=test', '-c', 'user.email=test@anthrob.invalid', *arguments], cwd=self.folder,
                       check=True)

    def commit(self):
        self.git('add', '-A')
        self.git('commit', '-q', '-m', 'one')

    def run_script(self, **environment):
        """Status, what was said, and per file None, 'failure' or 'skipped'."""
        kept = {key: value for key, value in os.environ.items() if not key.startswith(('ANTHROB_TIDY_', 'GIT_'))}
        run = subprocess.run([os.path.join(self.folder, 'scripts', 'tidy.sh'), os.path.join(self.folder, 'tidy.xml')],
                             env={**kept, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding='utf-8')
        cases = ElementTree.parse(os.path.join(self.folder, 'tidy.xml')).getroot().iter('testcase')
        return run.returncode, run.stdout, {case.get('name'): case[0].tag if len(case) else None for case in cases}

    def test_a_finding_names_file_and_line(self):
        self.write('new.cpp', BAD)
        self.commit()
        status, said, cases = self.run_script()
        self.assertEqual((status, cases), (1, {'new.cpp': 'failure'}), said)
        self.assertIn('/new.cpp:3:', said)
        self.assertIn('bugprone-integer-division', said)

    def test_a_finding_before_the_commit(self):
        self.write('good.cpp', BAD)
        self.write('new.cpp', GOOD)
        self.write('not_compiled.cpp', BAD)
        self.git('commit', '-q', '--allow-empty', '-m', 'two')
        status, said, cases = self.run_script()
        self.assertEqual((status, cases), (1, {'good.cpp': 'failure', 'new.cpp': None}), said)

    def test_files_that_are_compiled_as_one_are_looked_at_one_by_one(self):
        one = self.folder + '/build/Unity/unity_0_cxx.cxx'
        self.write('build/Unity/unity_0_cxx.cxx', ''.join('#include "%s/%s.cpp"\n' % (self.folder, name)
                                                          for name in ('good', 'old', 'new')))
        self.write('build/compile_commands.json', json.dumps(
            [{'directory': self.folder, 'command': 'c++ -std=gnu++17 -c ' + one, 'file': one}], indent=2))
        self.write('new.cpp', BAD.replace('half', 'a_half'))
        self.commit()
        status, said, cases = self.run_script()
        self.assertEqual((status, cases), (1, {'new.cpp': 'failure'}), said)
        self.assertIn('/new.cpp:3:', said)

    def test_a_branch_counts_from_where_it_left(self):
        self.git('update-ref', 'refs/remotes/origin/main', 'HEAD')
        for name in ('new.cpp', 'good.cpp'):
            self.write(name, GOOD + '\n')
            self.commit()
        self.assertEqual(self.run_script()[::2], (0, {'good.cpp': None, 'new.cpp': None}))
        self.assertEqual(self.run_script(ANTHROB_TIDY_BASE='HEAD~1')[::2], (0, {'good.cpp': None}))
        self.assertEqual(self.run_script(ANTHROB_TIDY_FILES='1')[::2],
                         (0, {'good.cpp': None, '1 more files that changed earlier': 'skipped'}))

    def test_left_out_without_history(self):
        self.assertEqual(self.run_script()[::2], (0, {'no history to compare with': 'skipped'}))
        shutil.rmtree(os.path.join(self.folder, '.git'))
        self.assertEqual(self.run_script()[::2], (0, {'no history to compare with': 'skipped'}))


if __name__ == '__main__':
    rosunit.unitrun('anthrob_tests', 'tidy_script', 'tidy_test')
