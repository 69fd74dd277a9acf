#!/usr/bin/python3
"""Study of threads: builds what runs on several of them with the thread sanitizer, and runs its tests. The library that
hands out the work has to be built with it as well, from its source: --tbb is a folder with that of oneTBB, such as
`apt-get source onetbb` makes. Writes build/study/threads.json and studies/threads.md.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import time

from _study import (OUT, OneLineParser, commit, machine, markdown_page, must, of_the_study, refuse, say, several, start,
                    write)

SOURCE = "tests/threads"
DOCUMENT = "studies/threads.md"
# Of each program, the tests that use threads.
TESTS = {"search": "DrivenAxis.SameBits*:Problem*.*", "tracking": "-*DoesNotGrow*:*DeathTest*"}
FOUND = re.compile(r"WARNING: ThreadSanitizer: ([\w -]+?) \(")
RAN = re.compile(r"\[  PASSED  \] (\d+) test")


def arguments():
    parser = OneLineParser("study threads", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tbb", metavar="FOLDER", required=True, help="source of oneTBB")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    return parser.parse_args()


def build(options, folder):
    if not os.path.exists(os.path.join(options.tbb, "src", "tbb")):
        refuse(f"--tbb {options.tbb}: expected the source of oneTBB, with a folder src/tbb")
    log = os.path.join(folder, "build.log")
    say(f"building with the thread sanitizer (log: {log})")
    must(["cmake", "-S", SOURCE, "-B", os.path.join(folder, "build"), f"-DTBB_SOURCE={os.path.abspath(options.tbb)}"], log)
    must(["make", "-C", os.path.join(folder, "build"), f"-j{os.cpu_count()}"], log)


def examine(program, tests, folder):
    """Runs tests of a program. @return what the page says of it"""
    say(f"{program} ...")
    begin = time.time()
    done = subprocess.run([os.path.join(folder, "build", program), f"--gtest_filter={tests}"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", errors="replace",
                          env={**os.environ, "TSAN_OPTIONS": "exitcode=66"})
    write(os.path.join(folder, f"{program}.txt"), done.stdout)
    ran = RAN.search(done.stdout)
    found = FOUND.findall(done.stdout)
    if done.returncode not in (0, 66) or not ran:
        found.append(f"ended with {done.returncode}")
    return {"program": program, "tests": int(ran.group(1)) if ran else 0, "found": found, "time_s": time.time() - begin}


def page(results, facts):
    rows = [[r["program"], str(r["tests"]), several(r["found"]) or "nothing", f"{r['time_s']:.0f}"] for r in results]
    return markdown_page("Threads", [
        "`./catkin_ws.sh study threads` runs the tests of what uses several threads under the thread sanitizer: calibration "
        "and discovery (search), motion capture (tracking). The driver's thread is not among them: it needs a kernel "
        "with CAN.",
        (["program", "tests passed", "found", "time [s]"], rows), facts])


def main():
    options = arguments()
    folder = os.path.join(options.out, "threads")
    os.makedirs(folder, exist_ok=True)
    build(options, folder)
    results = [examine(program, tests, folder) for program, tests in TESTS.items()]
    facts = {"commit": commit(), "machine": machine()}
    write(os.path.join(options.out, "threads.json"), json.dumps({**facts, "programs": results}, indent=2) + "\n")
    if of_the_study(options):
        os.makedirs(os.path.dirname(DOCUMENT), exist_ok=True)
        write(DOCUMENT, page(results, facts))
    for result in results:
        say(f"{result['program']}: {result['tests']} tests, {several(result['found']) or 'nothing'} found")
    if any(result["found"] for result in results):
        sys.exit(1)


if __name__ == "__main__":
    start(main, continues=False)
