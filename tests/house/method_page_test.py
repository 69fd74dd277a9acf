#!/usr/bin/env python3
"""docs/discovery_method.md has the numbers of the options, and a change of either is seen.

That discovery prints the numbers of the headers is tested by options_test of anthrob_discovery."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import rosunit

TOP = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..'))
SCRIPT = os.path.join('scripts', 'method_page.py')
PAGE = os.path.join('docs', 'discovery_method.md')
OPTIONS = os.path.join('src', 'anthrob_discovery', 'src', 'options')


def read(*path):
    with open(os.path.join(TOP, *path), encoding='utf-8') as file:
        return file.read()


def imported():
    spec = importlib.util.spec_from_file_location('method_page', os.path.join(TOP, SCRIPT))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def check(top):
    return subprocess.run([sys.executable, os.path.join(top, SCRIPT), '--check'], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding='utf-8')


class Page(unittest.TestCase):

    def test_is_what_template_and_options_make(self):
        run = check(TOP)
        self.assertEqual(run.returncode, 0, run.stdout)

    def test_has_every_option_with_its_reason(self):
        declared = sum(len(re.findall(r'^    visit\("', read(OPTIONS, name), re.MULTILINE))
                       for name in os.listdir(os.path.join(TOP, OPTIONS)) if name.endswith('.h'))
        rows = re.findall(r'^\| `\w+` \| (.*) \|$', read(PAGE).split('## Numbers')[1], re.MULTILINE)
        groups = re.findall(r'^### ', read(PAGE).split('## Numbers')[1], re.MULTILINE)
        # Two members of LongerStepOptions are there twice; hypotheses and measurement have no numbers of their own.
        self.assertEqual(len(rows) + len(groups) + 2, declared + 2)
        for row in rows:
            self.assertRegex(row, r'^[-0-9][^|]* \| [^|]* \| [a-z`]', row)


class Values(unittest.TestCase):

    def setUp(self):
        self.page = imported()
        self.options, _ = self.page.options_of(self.page.declared(self.page.TOP / self.page.OPTIONS), 'Options')

    def test_literals_of_every_kind_are_read(self):
        text = 'struct Options {\n  /// [s] of\n  /// two lines\n  double a = 4.0 / 3.0;\n' \
               '  BOptions b = {2.0, 1e-4};  ///< one\n};\n' \
               '/// Told.\nstruct BOptions {\n  double c = 1.0;  ///< [nat] why\n  Share d = 0.5;  ///< of it\n' \
               '  std::array<double, 2> e = {1e-7, 4e5};\n};\n'
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'options.h'), 'w', encoding='utf-8') as file:
                file.write(text)
            tree, groups = self.page.options_of(self.page.declared(self.page.pathlib.Path(folder)), 'Options')
        self.assertEqual((tree.a, tree.b.c, tree.b.d, tree.b.e), (4 / 3, 2.0, 1e-4, [1e-7, 4e5]))
        self.assertEqual([(g.name, g.meaning) for g in groups], [('', ''), ('b', 'Told: one.')])
        self.assertEqual([(r.name, r.value, r.unit, r.meaning) for g in groups for r in g.rows],
                         [('a', '4 / 3', 's', 'of two lines'), ('c', '2', 'nat', 'why'), ('d', '0.0001', 'share', 'of it'),
                          ('e', '1e-7, 400 000', '', '')])

    def test_of_the_headers(self):
        self.assertEqual(self.options.hypotheses.scans.times, 4.0)
        self.assertEqual(self.options.fit.convergence.hopeless, 4.0 / 3.0)
        self.assertEqual(self.options.hypotheses.trials.doses, [1.0, 3.0, 10.0])

    def test_in_words(self):
        page = self.page
        self.assertEqual([page.part(v) for v in (0.5, 0.1, 0.4, 0.9, 1 / 3, 1e-4, 0.35)],
                         ['half', 'a tenth', 'two fifths', 'nine tenths', 'a third', 'a ten-thousandth', '0.35'])
        self.assertEqual([page.times(v) for v in (1.0, 2, 6.0, 2.5)], ['once', 'twice', 'six times', '2.5 times'])
        self.assertEqual([page.word(v) for v in (3.0, 20, 21, 0.7)], ['three', 'twenty', '21', '0.7'])
        self.assertEqual([page.out_of(0.95), page.out_of(0.976)], ['nineteen times out of twenty', '97.6 % of the time'])
        self.assertEqual([page.percent(v) for v in (0.0005, 1.02 - 1)], ['0.05 %', '2 %'])


class Changes(unittest.TestCase):
    """In a copy of what the page is made from."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = folder.name
        for name in SCRIPT, PAGE, PAGE + '.j2':
            os.makedirs(os.path.join(self.top, os.path.dirname(name)), exist_ok=True)
            shutil.copy(os.path.join(TOP, name), os.path.join(self.top, name))
        shutil.copytree(os.path.join(TOP, OPTIONS), os.path.join(self.top, OPTIONS))

    def replace(self, name, old, new):
        path = os.path.join(self.top, name)
        with open(path, encoding='utf-8') as file:
            text = file.read()
        self.assertEqual(text.count(old), 1, old)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text.replace(old, new))

    def line(self, part):
        """Of the committed page."""
        return 'docs/discovery_method.md:%d: ' % (1 + [part in line for line in read(PAGE).splitlines()].index(True))

    def test_none(self):
        self.assertEqual(check(self.top).returncode, 0)

    def test_of_a_header(self):
        self.replace(OPTIONS + '/conclusion.h', 'most_remains = 0.45', 'most_remains = 0.4')
        run = check(self.top)
        self.assertEqual(run.returncode, 1)
        self.assertIn(self.line('more than 0.45 of the squared gap'), run.stdout)
        self.assertIn(self.line('| `most_remains` | 0.45 |'), run.stdout)
        self.assertEqual(run.stdout.count('docs/discovery_method.md:'), 2, run.stdout)
        subprocess.run([sys.executable, os.path.join(self.top, SCRIPT)], check=True)
        self.assertEqual(check(self.top).returncode, 0)

    def test_of_the_page(self):
        self.replace(PAGE, 'more than 0.45', 'more than 0.5')
        run = check(self.top)
        self.assertEqual(run.returncode, 1)
        self.assertIn(self.line('more than 0.45'), run.stdout)

    def test_of_a_name_that_the_template_uses(self):
        self.replace(PAGE + '.j2', 'conclusion.most_remains', 'conclusion.most_left')
        run = check(self.top)
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stdout, r'docs/discovery_method\.md\.j2:[1-9]\d*: .*most_left')

    def test_of_a_value_that_is_no_number(self):
        self.replace(OPTIONS + '/conclusion.h', 'most_remains = 0.45', 'most_remains = kMost')
        run = check(self.top)
        self.assertEqual(run.returncode, 2)
        self.assertIn('conclusion.most_remains: kMost', run.stdout)


if __name__ == '__main__':
    rosunit.unitrun('anthrob_tests', 'method_page', 'method_page_test')
