#!/usr/bin/env python3
"""Adds up JUnit results: lists failures, says what was skipped, ends with `N passed, N failed`."""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def cases(folder):
    for file in sorted(pathlib.Path(folder).rglob('*.xml')):
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
            yield file.stem, name, 'SKIPPED' if skipped and text is None else text
        if not found:
            yield file.stem, 'no test case', 'the test program crashed or was killed'


def main():
    passed, failed, skipped = 0, 0, 0
    for program, name, problem in cases(sys.argv[1]):
        if problem is None:
            passed += 1
        elif problem == 'SKIPPED':
            skipped += 1
            print('skipped: %s: %s' % (program, name))
        else:
            failed += 1
            print('FAILED: %s: %s: %s' % (program, name, problem.strip().splitlines()[0]))
    if passed + failed == 0:
        print('no test results in %s: see build/test.log' % sys.argv[1])
        failed = 1
    if skipped:
        print('%d skipped' % skipped)
    print('%d passed, %d failed' % (passed, failed))
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
