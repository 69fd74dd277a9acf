#!/usr/bin/env python3
"""usage: count_tests.py RESULTS [--registered FILE] [--status N]

Adds up JUnit results: lists failures and skipped tests, and ends with `N passed, N failed`. A registered test without a
result counts as failed, and so does a run that ended with a status other than 0."""
import argparse
import json
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def cases(folder):
    for file in sorted(folder.rglob('*.xml')):
        try:
            root = ElementTree.parse(file).getroot()
        except ElementTree.ParseError:
            yield file.stem, 'result file', 'not readable: the test program crashed'
            continue
        found = list(root.iter('testcase'))
        for case in found:
            name = '%s.%s' % (case.get('classname', ''), case.get('name', ''))
            problem = case.find('failure')
            if problem is None:
                problem = case.find('error')
            skipped = case.find('skipped') is not None or case.get('status') == 'notrun'
            text = None if problem is None else (problem.get('message') or problem.text or 'failed')
            # rostest says once more of a whole program what the program's own file says of its tests.
            if text is None and file.name.startswith('rostest-'):
                continue
            yield file.stem, name, 'SKIPPED' if skipped and text is None else text
        for _ in range(unnamed_failures(root)):
            yield file.stem, 'a subtest', 'failed: see build/test.log'
        if not found:
            yield file.stem, 'no test case', 'the test program crashed or was killed'


def unnamed_failures(root):
    """Of Python's subtests, which suites count and no test case shows."""
    total = 0
    for suite in root.iter('testsuite'):
        named = sum(case.find('failure') is not None or case.find('error') is not None for case in suite.findall('testcase'))
        total += max(0, int(suite.get('failures', 0)) + int(suite.get('errors', 0)) - named)
    return total


def missing(registered):
    """Results that nobody wrote. For some of them catkin wrote another file, which says so."""
    for test in json.loads(registered.read_text())['tests']:
        command = test['command']
        runner = [pathlib.Path(word).name for word in command].index('run_tests.py')
        result = pathlib.Path(command[runner + 1])
        if not result.exists() and not result.with_name('MISSING-' + result.name).exists():
            yield result.stem, 'no result', 'the test did not run: see build/test.log'


def arguments():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('results', type=pathlib.Path)
    parser.add_argument('--registered', type=pathlib.Path)  # what ctest --show-only=json-v1 says
    parser.add_argument('--status', type=int, default=0)
    return parser.parse_args()


def main():
    options = arguments()
    found = list(cases(options.results))
    if options.registered:
        found += missing(options.registered)
    if options.status:
        found.append(('run_tests', 'the run', 'ended with %d: see build/test.log' % options.status))
    passed, failed, skipped = 0, 0, 0
    for program, name, problem in found:
        if problem is None:
            passed += 1
        elif problem == 'SKIPPED':
            skipped += 1
            print('skipped: %s: %s' % (program, name))
        else:
            failed += 1
            print('FAILED: %s: %s: %s' % (program, name, problem.strip().splitlines()[0]))
    if passed + failed == 0:
        print('no test results in %s: see build/test.log' % options.results)
        failed = 1
    if skipped:
        print('%d skipped' % skipped)
    print('%d passed, %d failed' % (passed, failed))
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
