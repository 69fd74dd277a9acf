#!/usr/bin/env python3
"""What ./catkin_ws.sh test says at its end: of results that are made up."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
SCRIPT = os.path.join(TOP, 'scripts', 'count_tests.py')
GOOD = '<testcase name="good" classname="Suite"/>'
BAD = '<testcase name="bad" classname="Suite"><failure message="1 is not 2"/></testcase>'
SKIPPED = '<testcase name="off" classname="Suite"><skipped/></testcase>'


class Count(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, 'package', name)

    def result(self, name, *cases, suite=''):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), 'w') as file:
            file.write('<testsuites><testsuite %s>%s</testsuite></testsuites>' % (suite, ''.join(cases)))

    def register(self, *names):
        """As ctest lists tests that catkin runs."""
        tests = [{'name': name, 'command': ['env.sh', 'python3', '/catkin/run_tests.py', self.path(name), '--return-code',
                                            'program --gtest_output=xml:' + self.path(name)]} for name in names]
        with open(os.path.join(self.folder, 'tests.json'), 'w') as file:
            json.dump({'tests': tests}, file)
        return '--registered', os.path.join(self.folder, 'tests.json')

    def expect(self, last, *lines, arguments=()):
        run = subprocess.run([sys.executable, SCRIPT, self.folder, *arguments], stdout=subprocess.PIPE, encoding='utf-8')
        said = run.stdout.splitlines()
        self.assertEqual(said[-1], last, run.stdout)
        for line in lines:
            self.assertIn(line, said)
        self.assertEqual(run.returncode, 0 if last.endswith(' 0 failed') else 1)

    def test_a_subtest_that_failed_counts(self):
        """rosunit tells of it in the suite's count only."""
        self.result('rosunit-one.xml', GOOD, GOOD, suite='failures="1" errors="0"')
        self.expect('2 passed, 1 failed', 'FAILED: rosunit-one: a subtest: failed: see build/test.log')
        self.result('rosunit-one.xml', GOOD, BAD, suite='failures="1" errors="0"')
        self.expect('1 passed, 1 failed', 'FAILED: rosunit-one: Suite.bad: 1 is not 2')

    def test_adds_up_all_files(self):
        self.result('gtest-one.xml', GOOD, GOOD, SKIPPED)
        self.result('gtest-two.xml', GOOD)
        self.expect('3 passed, 0 failed', '1 skipped', 'skipped: gtest-one: Suite.off')

    def test_names_what_failed(self):
        self.result('gtest-one.xml', GOOD, BAD)
        self.expect('1 passed, 1 failed', 'FAILED: gtest-one: Suite.bad: 1 is not 2')

    def test_what_is_no_result_has_failed(self):
        self.result('gtest-empty.xml')
        self.result('gtest-cut.xml', GOOD, '<testcase')
        self.expect('0 passed, 2 failed', 'FAILED: gtest-empty: no test case: the test program crashed or was killed',
                    'FAILED: gtest-cut: result file: not readable: the test program crashed')

    def test_nothing_at_all_has_failed(self):
        self.expect('0 passed, 1 failed')

    def test_a_test_without_a_result_has_failed(self):
        self.result('gtest-one.xml', GOOD)
        self.expect('1 passed, 1 failed', 'FAILED: gtest-two: no result: the test did not run: see build/test.log',
                    arguments=self.register('gtest-one.xml', 'gtest-two.xml'))
        self.result('gtest-two.xml', GOOD)
        self.expect('2 passed, 0 failed', arguments=self.register('gtest-one.xml', 'gtest-two.xml'))

    def test_what_catkin_itself_misses_counts_once(self):
        self.result('MISSING-gtest-one.xml', BAD)
        self.expect('0 passed, 1 failed', arguments=self.register('gtest-one.xml'))

    def test_a_run_that_did_not_end_well_has_failed(self):
        self.result('gtest-one.xml', GOOD)
        self.expect('1 passed, 1 failed', 'FAILED: run_tests: the run: ended with 2: see build/test.log',
                    arguments=('--status', '2'))
        self.expect('1 passed, 0 failed', arguments=('--status', '0'))

    def test_rostest_counts_only_where_it_failed(self):
        self.result('rosunit-node.xml', GOOD, GOOD)
        self.result('rostest-tests_node.xml', GOOD)
        self.expect('2 passed, 0 failed')
        self.result('rostest-tests_node.xml', BAD)
        self.expect('2 passed, 1 failed')
        self.result('rostest-tests_node.xml')
        self.expect('2 passed, 1 failed')


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'count_tests', '__main__')
