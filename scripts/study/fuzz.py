#!/usr/bin/python3
"""Study of damaged files: gives hundreds of thousands of them to each reader of the suite, built with the address and
undefined-behaviour sanitizers. None may crash, hang for 10 s, or be refused without a line that says why.

The same command continues an interrupted study. What ended a reader is kept in build/study/fuzz/found/. Writes
build/study/fuzz.json and studies/fuzz.md.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time

from _study import (OUT, OneLineParser, commit, machine, markdown_page, must, of_the_study, refuse, say, start,
                    whole, write)

SOURCE = "tests/fuzz"
DOCUMENT = "studies/fuzz.md"
EVERY = 1000  # inputs between two notes of how far a reader has come


def arguments():
    parser = OneLineParser("study fuzz", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", type=whole(1), default=300000, help="of each reader (default: 300000)")
    parser.add_argument("--reader", action="append", default=[], help="only this one; may be given several times")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    return parser.parse_args()


def program(out):
    folder = os.path.join(out, "fuzz", "build")
    os.makedirs(folder, exist_ok=True)
    log = os.path.join(out, "fuzz", "build.log")
    say(f"building with sanitizers (log: {log})")
    must(["cmake", "-S", SOURCE, "-B", folder], log)
    must(["make", "-C", folder, f"-j{os.cpu_count()}"], log)
    return os.path.join(folder, "anthrob_fuzz")


class Course:
    """How far a reader has come: a line for each step: next input, accepted, refused, slowest [s]."""

    def __init__(self, out, reader):
        self.reader = reader
        self.file = os.path.join(out, "fuzz", reader + ".txt")
        self.next, self.accepted, self.refused, self.slowest = 0, 0, 0, 0.0
        if os.path.exists(self.file):
            with open(self.file) as lines:
                for line in lines:
                    self.add(line)

    def add(self, line):
        words = line.split()
        if len(words) == 4 and line.endswith("\n"):
            self.next = int(words[0])
            self.accepted += int(words[1])
            self.refused += int(words[2])
            self.slowest = max(self.slowest, float(words[3]))

    def note(self, line):
        self.add(line)
        with open(self.file, "a") as out:
            out.write(line)


def left(begin, done, wanted):
    seconds = (time.time() - begin) / max(done, 1) * (wanted - done)
    return f"{seconds / 60:.0f} min left" if seconds > 90 else f"{seconds:.0f} s left"


def process(tool, course, out, wanted):
    command = [tool, "--config", "config", "--work", os.path.join(out, "fuzz", "work"), "--reader", course.reader, "--first",
               str(course.next), "--end", str(wanted), "--every", str(EVERY)]
    with open(os.path.join(out, "fuzz", course.reader + "_said.txt"), "w") as said:
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=said, encoding="utf-8")


def keep(course, out):
    """The input that ended a reader, and what was said. @return their folder"""
    found = os.path.join(out, "fuzz", "found", f"{course.reader}_{course.next}")
    shutil.rmtree(found, ignore_errors=True)
    shutil.copytree(os.path.join(out, "fuzz", "work", course.reader), found)
    shutil.copy(os.path.join(out, "fuzz", course.reader + "_said.txt"), os.path.join(found, "said.txt"))
    return found


def examine(tool, course, out, wanted):
    """@return folder of what ended it; None if nothing did"""
    begin, first, told = time.time(), course.next, time.time()
    if course.next < wanted:
        with process(tool, course, out, wanted) as running:
            for line in running.stdout:
                course.note(line)
                if time.time() - told > 10:
                    told = time.time()
                    say(f"{course.reader}: {course.next} of {wanted}, {left(begin, course.next - first, wanted - first)}")
        if running.returncode != 0:
            return keep(course, out)
    say(f"{course.reader}: {course.next} inputs, {course.refused} refused, none too slow (at most {course.slowest:.2f} s)")
    return None


def page(courses, facts):
    head = ["reader", "inputs", "accepted", "refused", "slowest [s]"]
    rows = [[c.reader, str(c.next), str(c.accepted), str(c.refused), f"{c.slowest:.2f}"] for c in courses]
    return markdown_page("Damaged files", [
        "`./catkin_ws.sh study fuzz` damages sound files and gives them to the readers of the suite, all inputs of a reader "
        "in one process, built with the address and undefined-behaviour sanitizers. A reader must accept a file, or "
        "refuse it with one line, within 10 s.", (head, rows), facts])


def main():
    options = arguments()
    tool = program(options.out)
    work = os.path.join(options.out, "fuzz", "work")
    names = subprocess.run([tool, "--config", "config", "--work", work, "--list"], stdout=subprocess.PIPE, encoding="utf-8",
                           check=True).stdout.split()
    for name in options.reader:
        if name not in names:
            refuse(f"--reader {name}: expected one of: {' '.join(names)}")
    courses = [Course(options.out, name) for name in options.reader or names]
    found = list(filter(None, [examine(tool, course, options.out, options.inputs) for course in courses]))
    facts = {"commit": commit(), "machine": machine(), "found": ", ".join(found) or "nothing"}
    write(os.path.join(options.out, "fuzz.json"), json.dumps({
        **facts, "readers": {c.reader: {"inputs": c.next, "accepted": c.accepted, "refused": c.refused,
                                        "slowest_s": c.slowest} for c in courses}}, indent=2) + "\n")
    if of_the_study(options) and not options.reader:
        os.makedirs(os.path.dirname(DOCUMENT), exist_ok=True)
        write(DOCUMENT, page(courses, facts))
    for folder in found:
        say(f"a reader ended: see {folder}/said.txt")
    if found:
        sys.exit(1)


if __name__ == "__main__":
    start(main)
