#!/usr/bin/python3
"""Study of the rules by which discovery judges: what would its answers be with another threshold, or without a rule? Cases
are benches of a driven joint (scripts/study/_bench.py) and a rig of two muscles (scripts/study/_recorder.py). Each is
answered once; what was simulated for that is kept, so that asking again with one number of docs/discovery_method.md times
0.7, times 1.4, or at a value at which its rule does nothing, takes little time.

The same command continues an interrupted study. Writes build/study/rules.json, and the page rules.md there and in studies/.
"""

import argparse
import concurrent.futures
import json
import os
import shutil
import threading
import time

import _bench
import axes
import conventions
from _recorder import RUNS, Case as RigCase
from _study import (OUT, OneLineParser, commit, load, machine, markdown_page, must, of_the_study, run, say, several, start,
                    whole, write)
from real import CONVERT, DISCOVER

PUBLISHED = "studies"
# Groups of numbers that judge: steps 6, 7, 8 and 10 of the method.
JUDGING = ["judgement", "hypotheses.comparison", "search", "conclusion"]
FACTORS = [0.7, 1.4]
SHARE = 1.0        # that a share has at most
NOTHING, ALWAYS = 1e-9, 1e9
# Where a rule does nothing.
WITHOUT = {
    "judgement.faint_gap": NOTHING,
    "judgement.merit.evidence": NOTHING,
    "judgement.merit.significance": NOTHING,
    "judgement.merit.faint_significance": NOTHING,
    "judgement.merit.share_of_present": NOTHING,
    "judgement.merit.share_of_first": NOTHING,
    "judgement.trust.even_odds": SHARE,
    "judgement.trust.even_odds_spoilt": SHARE,
    "judgement.trust.at_limit": SHARE,
    "judgement.trust.spoilt": ALWAYS,
    "judgement.trust.improbable": NOTHING,
    "hypotheses.comparison.most_of_it": SHARE,
    "hypotheses.comparison.all_of_it": SHARE,
    "search.common_law.probability": SHARE,
    "search.law_elsewhere.fewest": 1000,
    "search.final_comparison.comes_near": SHARE,
    "search.mentioned": SHARE,
    "conclusion.most_remains": SHARE,
    "conclusion.least_left": NOTHING,
    "conclusion.least_effort": NOTHING,
}
STOP = threading.Event()  # no further question
HEAD = ["number", "value", "other answers", "better", "worse"]


class Stored:
    """A case whose recordings and simulations are kept."""

    def __init__(self, name, options):
        self.name, self.options = name, options
        self.folder = os.path.join(options.out, "rules", f"seed_{options.seed}", name)
        self.file = os.path.join(self.folder, "answers.json")
        self.log = os.path.join(self.folder, "log.txt")
        self.journal = os.path.join(self.folder, "journal.bin")
        self.out = os.path.join(self.folder, "found")

    def begin(self):
        """Files of a case that another program has answered are made anew."""
        stored = load(self.file) if os.path.exists(self.file) else {}
        if stored.get("commit") == commit():
            return stored
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        self.make()
        return {"commit": commit(), "answers": {}}

    def ask(self, option, stored):
        """The answer with NAME=NUMBER; with an empty option, as it is."""
        if option in stored["answers"]:
            return
        shutil.rmtree(self.out, ignore_errors=True)
        os.makedirs(self.out)
        if os.path.exists(self.journal):
            shutil.copy(self.journal, os.path.join(self.out, "journal.bin"))
        words = [*self.question(), "--out", self.out, "--jobs", "1", *(["--option", option] if option else [])]
        begin = time.time()
        status = self.run_and_keep(words) if not option else run(words, self.log)
        report = load(os.path.join(self.out, "report.json")) if status == 0 else {"verdict": "failed"}
        stored["options"] = stored.get("options") or report.get("options")
        stored["answers"][option] = {
            "verdict": report["verdict"], "time_s": time.time() - begin,
            "effects": sorted(f"{effect['id']}@{effect['place']}" for effect in report.get("effects", [])),
            "right": status == 0 and self.is_right(report)}
        write(self.file, json.dumps(stored, indent=1))

    def run_and_keep(self, words):
        """Another name of the journal, which discovery deletes at its end."""
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            running = pool.submit(run, words, self.log)
            written = os.path.join(self.out, "journal.bin")
            while not running.done():
                if os.path.exists(written) and not os.path.exists(self.journal):
                    os.link(written, self.journal)
                time.sleep(0.005)
            return running.result()

    def answer_all(self, options_of):
        stored = self.begin()
        self.ask("", stored)
        for option in options_of(stored["options"]):
            if STOP.is_set():
                raise KeyboardInterrupt
            self.ask(option, stored)
        return stored


class StoredBench(Stored):

    def __init__(self, number, options):
        self.bench = _bench.Bench(options.seed, number // len(_bench.LAWS), _bench.LAWS[number % len(_bench.LAWS)])
        super().__init__(self.bench.name, options)

    def make(self):
        made = os.path.join(self.folder, "made")
        self.bench.write(made)
        for name in _bench.RUNS:
            must([CONVERT, "--columns", f"{made}/columns.yaml", f"{made}/{name}.csv", f"{self.folder}/{name}"],
                 self.log)

    def question(self):
        made = os.path.join(self.folder, "made")
        train, test, repeat = (os.path.join(self.folder, name) for name in _bench.RUNS)
        return [DISCOVER, "--model", f"{made}/model.yaml", "--train", train, "--test", test, "--repeat", repeat]

    def is_right(self, report):
        judged = axes.judged(self.bench, {**report, "time_s": 0.0})
        return (judged["named"] or judged["in_class"]) and judged["more"] <= 0


class StoredRig(Stored):

    def __init__(self, number, options):
        self.case = RigCase(options.seed, number, True, number % 2 == 1)
        self.case.conventions, self.case.name = [], f"rig_{number:02d}_{self.case.effect or 'none'}"
        super().__init__(self.case.name, options)

    def make(self):
        asked = conventions.Asked(self.case, self.options)
        asked.folder, asked.log = self.folder, self.log
        asked.record()

    def question(self):
        words = [DISCOVER, "--model", os.path.join(self.folder, "model.yaml")]
        for use, runs in RUNS.items():
            words += [f"--{use}", *(os.path.join(self.folder, "own", name) for name in runs)]
        return words

    def is_right(self, report):
        named = {effect["id"] for effect in report["effects"]}
        return named == ({self.case.effect} if self.case.effect else set()) and report["verdict"] != "unexplained"


def numbers_in(options, group=""):
    """All numbers of report.json's options, by name. Lists stay."""
    for name, value in options.items():
        if isinstance(value, dict):
            yield from numbers_in(value, f"{group}{name}.")
        elif isinstance(value, (int, float)):
            yield f"{group}{name}", value


def variations(options):
    """NAME=NUMBER of all that is tried."""
    tried = []
    for name, value in numbers_in(options):
        if not any(name.startswith(f"{group}.") for group in JUDGING):
            continue
        others = [factor * value for factor in FACTORS]
        if isinstance(value, int):
            others = [max(1, round(other)) for other in others]
        elif value <= SHARE:
            others = [min(SHARE, other) for other in others]
        others += [WITHOUT[name]] if name in WITHOUT else []
        tried += [f"{name}={other:.6g}" for other in dict.fromkeys(others) if other != value]
    return tried


def table(results):
    """A line for each variation of which any answer is another one, and the names of all others."""
    rows, same = [], {}
    for option in variations(results[0]["options"]):
        pairs = [(result["answers"][""], result["answers"][option]) for result in results]
        changed = sum((a["effects"], a["verdict"]) != (b["effects"], b["verdict"]) for a, b in pairs)
        better, worse = (sum(pair[i]["right"] and not pair[1 - i]["right"] for pair in pairs) for i in (1, 0))
        name, value = option.split("=")
        shown = {f"{NOTHING:g}": "never", f"{ALWAYS:g}": "never"}.get(f"{float(value):g}", value)
        if changed:
            rows.append([f"`{name}`", shown, changed, better, worse])
        else:
            same.setdefault(name, []).append(shown)
    whole_names = [name for name in same if not any(row[0] == f"`{name}`" for row in rows)]
    return rows, whole_names


def page(results, options, programs):
    rows, same = table(results)
    asked = [result["answers"][""] for result in results]
    return markdown_page("Rules that judge", [
        "`./catkin_ws.sh study rules` asks discovery again with each number that judges (steps 6, 7, 8 and 10 of the method) "
        "times 0.7 and 1.4, and at a value at which its rule does nothing (*never*, 1 for a share, 1000 for a count). *Other "
        "answers*: cases in which other effects are named or the verdict is another one. *Better*, *worse*: right only then, "
        "or no longer. Cases are benches of a driven joint, of ten laws with nothing among them, and a rig of two muscles.",
        {"cases": len(results), "right as it is": f"{sum(answer['right'] for answer in asked)} of {len(asked)}",
         "variations": len(variations(results[0]["options"])), "seed": options.seed, "program": several(programs),
         "machine": machine()},
        (HEAD, [[str(cell) for cell in row] for row in rows]),
        "## No other answer, whatever was tried", ", ".join(f"`{name}`" for name in same) + "."])


def arguments():
    parser = OneLineParser("study rules", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--benches", type=whole(0), default=40, help="cases of a driven joint (default: 40)")
    parser.add_argument("--rigs", type=whole(0), default=10, help="cases of two muscles (default: 10)")
    parser.add_argument("--option", action="append", default=[], help="try only this NAME=NUMBER; may be given several times")
    parser.add_argument("--seed", type=whole(0), default=7, help="of the cases (default: 7)")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count(), help="cases at a time (default: all cores)")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    options = parser.parse_args()
    if options.benches + options.rigs == 0:
        parser.error("--benches 0 --rigs 0: expected a case")
    return options


def main():
    options = arguments()
    cases = [StoredRig(number, options) for number in range(options.rigs)]  # they take longest
    cases += [StoredBench(number, options) for number in range(options.benches)]
    results = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        try:
            for case, result in zip(cases, pool.map(
                    lambda case: case.answer_all(lambda known: options.option or variations(known)), cases)):
                results.append(result)
                say(f"{len(results)} of {len(cases)}: {case.name}: {'right' if result['answers']['']['right'] else 'wrong'}")
        except KeyboardInterrupt:
            STOP.set()
            pool.shutdown(cancel_futures=True)
            raise
    if options.option:
        return
    text = page(results, options, {result["commit"] for result in results})
    write(f"{options.out}/rules.json", json.dumps(results, indent=1))
    write(f"{options.out}/rules.md", text)
    if of_the_study(options):
        os.makedirs(PUBLISHED, exist_ok=True)
        write(f"{PUBLISHED}/rules.md", text)


if __name__ == "__main__":
    start(main)
