#!/usr/bin/python3
"""The blind test of discovery: effects of the catalogue, pairs, nulls and things that it does not know, hidden in
virtual robots; discovery sees recordings and a model only, and a third program compares its reports with the truth.

Every case leaves its result under build/study/discovery/ and is not done again; what was interrupted goes on. Writes
build/study/discovery.json and .html, docs/studies/discovery.md and, what it was made from, docs/studies/discovery.json.
Another --seed than 1 is another study, of other cases: discovery_seed_2 and so on in these names. Slices may run on
several hosts: bring their reports/ and sealed/ together and run with --summary, or one after the other, each with the
docs/studies/discovery.json of the one before and --adopt.
"""

import argparse
import glob
import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import time

from _study import (OUT, OneLineParser, commit, html_page, html_table, load, load_published, machine, markdown_facts,
                    markdown_table, must, of_the_study, refuse, run, say, several, start, write)

MAKER = "devel/lib/anthrob_virtual_robot/anthrob_blind_case"
DISCOVER = "devel/lib/anthrob_calib/anthrob_discover"
SCORE = "src/anthrob_virtual_robot/scripts/anthrob_score"
MODEL = "config/anthrob/model_I.yaml"
ROUNDS = {"effect": 2}  # each law so often, every time at another place
COUNTS = {"null": 60, "pair": 12, "wrapped": 1}
KINDS = ["effect", "null", "pair", "outside", "wrapped"]
MOST_EFFECTS = {"wrapped": 12}
DOCUMENTS = "docs/studies"
DRAWN = ["kind", "effects", "change", "slow", "stated_noise", "noise_memory"]  # of a truth, what tells what was asked
TOLD = ["id", "place", "probability", "shows_in", "left", "parameters", "rivals"]  # of a named effect, what scoring needs


SPENT = ["spent_s", "processor_s"]  # files that outlive an interruption


def clocks():
    """Seconds now: of the clock, of the processors that ended steps have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.time(), used.ru_utime + used.ru_stime


def study_name(options):
    return "discovery" if options.seed == 1 else f"discovery_seed_{options.seed}"


def document(options):
    return f"{DOCUMENTS}/{study_name(options)}.md"


def published_file(options):
    return f"{DOCUMENTS}/{study_name(options)}.json"


def laws(kind):
    out = subprocess.run([MAKER, "--list"], capture_output=True, text=True, check=True).stdout
    return sum(line.split()[0] == kind for line in out.splitlines())


class Case:
    """One robot with something, or nothing, hidden in it."""

    def __init__(self, kind, number, count, options):
        self.kind = kind
        self.number = number
        self.name = f"{kind}_{number:02d}"
        self.turn = number / count  # kinds take turns, so that a part of the study tells of all
        self.options = options
        folder = f"{options.out}/{study_name(options)}"
        self.data = f"{folder}/cases/{self.name}"
        self.truth = f"{folder}/sealed/{self.name}.json"
        self.report = f"{folder}/reports/{self.name}"
        self.log = f"{folder}/logs/{self.name}.log"

    def done(self):
        return os.path.exists(f"{self.report}/study.json")

    def failed(self):
        """Ended without a report the last time: a wrong answer, until it is done again."""
        return not self.done() and os.path.exists(f"{self.report}/failed")

    def state(self):
        return "done" if self.done() else "failed" if self.failed() else "begun" if os.path.exists(self.truth) else ""

    def make(self):
        """Whether there is such a robot. The truth is written last; of a case that was done only the model is left. A
        case is of one program: what another one began is begun anew."""
        program, made_by = commit(), f"{self.data}.made_by"
        begun = os.path.exists(self.truth) and os.path.exists(f"{self.data}/test_0")
        if begun and os.path.exists(made_by) and load(made_by) == program:
            return True
        for folder in self.data, self.report:
            shutil.rmtree(folder, ignore_errors=True)
        made = run([MAKER, "--kind", self.kind, "--case", str(self.number), "--seed",
                    str(self.options.seed), "--model", MODEL, "--out", self.data, "--truth", self.truth], self.log)
        if made == 0:
            write(made_by, as_json(program))
        return made == 0

    def examine(self):
        command = [DISCOVER, "--model", f"{self.data}/model.yaml",
                   "--train", *sorted(glob.glob(f"{self.data}/train_*")),
                   "--test", f"{self.data}/test_0", "--repeat", f"{self.data}/repeat_0",
                   "--out", self.report, "--jobs", str(self.options.jobs)]
        if self.kind in MOST_EFFECTS:
            command += ["--max-effects", str(MOST_EFFECTS[self.kind])]
        begin, before = clocks(), self.spent()
        try:
            return run(command, self.log)
        finally:
            os.makedirs(self.report, exist_ok=True)
            for file, earlier, since, now in zip(SPENT, before, begin, clocks()):
                write(f"{self.report}/{file}", str(earlier + now - since))

    def spent(self):
        """Seconds of discovery so far, of runs that were interrupted, too: of the clock, of processors."""
        files = [f"{self.report}/{file}" for file in SPENT]
        return [float(load(file)) if os.path.exists(file) else 0.0 for file in files]

    def put_away(self):
        """The recordings; the report's model extends the case's."""
        for recording in glob.glob(f"{self.data}/*/"):
            shutil.rmtree(recording)

    def carry_out(self):
        os.makedirs(os.path.dirname(self.log), exist_ok=True)
        begin, asked = time.time(), commit()
        if not self.make():
            say(f"{self.name} could not be made: see {self.log}")
            return
        made = time.time()
        failed = f"{self.report}/failed"
        if self.examine() != 0:
            say(f"{self.name} gave no report: see {self.log}")
            os.makedirs(self.report, exist_ok=True)
            write(failed, "")
            return
        if os.path.exists(failed):
            os.remove(failed)
        spent, processor = self.spent()
        facts = {"commit": asked, "machine": machine(), "jobs": self.options.jobs,
                 "making_s": made - begin, "discovery_s": spent, "processor_s": processor}
        write(f"{self.report}/study.json", as_json(facts))
        if not self.options.keep:
            self.put_away()

    def facts(self):
        return load(f"{self.report}/study.json")

    def published(self):
        """Truth, answer and circumstances, as far as scoring needs them; None before there is an answer."""
        if not self.done() and not self.failed():
            return None
        truth = load(self.truth)
        drawn = {key: truth[key] for key in DRAWN if key in truth}
        if self.failed():
            return rounded({"truth": drawn, "failed": True})
        report = load(f"{self.report}/report.json")
        hidden = {(one["id"], one["place"].split("/")[0]) for one in truth["effects"]}
        answer = {key: report.get(key) for key in ("verdict", "runtime_s", "gap")}
        if report.get("alternatives"):
            answer["alternatives"] = report["alternatives"]
        answer["effects"] = [{key: one.get(key) for key in TOLD} for one in report.get("effects") or []]
        if report.get("improbable"):
            answer["improbable"] = report["improbable"]
        for key in "visible", "not_visible":
            answer[key] = [one for one in report.get(key) or []
                           if (one["id"], (one.get("place") or "").split("/")[0]) in hidden]
        return rounded({"truth": drawn, "report": answer, "facts": self.facts()})

    def adopt(self, published):
        """Takes an answer from elsewhere for its own, or that there was none."""
        files = {self.truth: published["truth"]}
        if published.get("failed"):
            files[f"{self.report}/failed"] = ""
        else:
            files[f"{self.report}/report.json"] = published["report"]
            files[f"{self.report}/study.json"] = published["facts"]
        for file, content in files.items():
            os.makedirs(os.path.dirname(file), exist_ok=True)
            write(file, content and as_json(content))


def rounded(value):
    """Numbers with six digits: enough to score by."""
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def as_json(value):
    return json.dumps(value, indent=2) + "\n"


def all_cases(options):
    cases = []
    for kind in KINDS:
        count = COUNTS.get(kind) or ROUNDS.get(kind, 1) * laws(kind)
        cases += [Case(kind, number, count, options) for number in range(count)]
    return sorted(cases, key=lambda case: (case.turn, KINDS.index(case.kind)))


def chosen(cases, options):
    if options.only:
        cases = [case for case in cases if case.kind in options.only]
    if options.case:
        unknown = set(options.case) - {case.name for case in cases}
        if unknown:
            refuse(f"no case {' '.join(sorted(unknown))}; --list tells them")
        cases = [case for case in cases if case.name in options.case]
    share, shares = options.slice
    return cases[share - 1::shares]


def seconds_of(case):
    facts = case.facts()
    return facts["making_s"] + facts["discovery_s"]


def time_left(cases):
    """Hours, guessed from what cases of the same kind took; None before the first."""
    took = {case: seconds_of(case) for case in cases if case.done()}
    if not took:
        return None
    left = 0.0
    for case in cases:
        if case not in took:
            alike = [s for other, s in took.items() if other.kind == case.kind]
            left += statistics.mean(alike or took.values())
    return left / 3600


def score(options):
    """What the third program says of all reports that are there; None if there is none."""
    folder = f"{options.out}/{study_name(options)}"
    if not os.path.isdir(f"{folder}/sealed"):
        return None
    must([SCORE, "--truths", f"{folder}/sealed", "--reports", f"{folder}/reports",
          "--out", f"{folder}/score.json"], f"{folder}/score.log")
    return load(f"{folder}/score.json")


def facts_of(cases, options):
    done = [case.facts() for case in cases if case.done()]
    minutes = [facts["discovery_s"] / 60 for facts in done]
    processor = [facts["processor_s"] / 3600 for facts in done if "processor_s" in facts]
    failed = sum(case.failed() for case in cases)
    return {
        "cases": f"{len(done)} of {len(cases)}" + (f", and {failed} that gave no report" if failed else ""),
        "commit": several(facts["commit"] for facts in done),
        "seed": options.seed,
        "machine": several(facts["machine"] for facts in done),
        "threads a case": several(facts["jobs"] for facts in done),
        "time": f"{sum(minutes) / 60:.1f} h of discovery, median {statistics.median(minutes):.1f}, "
                f"longest {max(minutes):.1f} minutes a case"
                + (f"; {sum(processor):.1f} h of processors in {len(processor)} cases" if processor else ""),
    }


def rate_rows(result):
    return [[row["label"], row["said"], row["asked"]] for row in result["rates"]]


def confusion_rows(result):
    rows = []
    for hidden, answers in sorted(result["confusion"].items()):
        answers = sorted(answers.items(), key=lambda item: -item[1])
        rows.append([hidden, ", ".join(f"{name} {count}" for name, count in answers)])
    return rows


def case_rows(result):
    for case in result["cases"]:
        floors, probability = case["floors"], case["probability"]
        yield [case["name"], ", ".join(case["hidden"]) if case["kind"] != "wrapped" else "all wrapped",
               "" if floors is None else f"{floors:.1f}", case["verdict"], ", ".join(case["named"]),
               "" if probability is None else f"{probability:.2f}"]


RATES = ["what", "measured, 95 % interval", "asked"]
CONFUSION = ["hidden", "answers"]
CASES = ["case", "hidden", "change [floors]", "verdict", "named", "probability"]


def markdown(result, facts, options):
    lines = ["# Study: discovery on blind cases", "",
             f"Written by `./catkin_ws.sh study discovery --seed {options.seed}` from",
             f"[these answers]({study_name(options)}.json); what a case is:",
             "[the virtual robot](../virtual_robot.md). `--adopt` takes them for done and goes on with the others.", ""]
    lines += markdown_facts(facts)
    for title, head, rows in (("Rates", RATES, rate_rows(result)),
                              ("Confusion", CONFUSION, confusion_rows(result)),
                              ("Cases", CASES, case_rows(result))):
        lines += ["", f"## {title}", ""] + markdown_table(head, rows)
    return "\n".join(lines) + "\n"


def page(result, facts):
    body = "<h2>Rates</h2>" + html_table(RATES, rate_rows(result))
    body += "<h2>Confusion</h2>" + html_table(CONFUSION, confusion_rows(result))
    body += "<h2>Cases</h2>" + html_table(CASES, case_rows(result))
    return html_page("Discovery on blind cases", facts, body)


def summarise(cases, options):
    """Whether there was something to tell of."""
    result = score(options)
    if result is None or not any(case.done() for case in cases):
        return False
    facts = facts_of(cases, options)
    write(f"{options.out}/{study_name(options)}.json", as_json({"facts": facts, **result}))
    write(f"{options.out}/{study_name(options)}.html", page(result, facts))
    if of_the_study(options):
        os.makedirs(DOCUMENTS, exist_ok=True)
        write(document(options), markdown(result, facts, options))
        publish(cases, options)
    return True


def publish(cases, options):
    """A line a case, so that a reader sees what is new."""
    lines = [f"{json.dumps(case.name)}: {json.dumps(case.published())}"
             for case in sorted(cases, key=lambda case: case.name) if case.done() or case.failed()]
    write(published_file(options), "{\n" + ",\n".join(lines) + "\n}\n")


def adopt(cases, options):
    published = load_published(published_file(options))
    for case in cases:
        if case.name in published and not case.done() and not case.failed():
            case.adopt(published[case.name])


def a_slice(text):
    share, _, shares = text.partition("/")
    share, shares = int(share), int(shares)
    if not 1 <= share <= shares:
        raise argparse.ArgumentTypeError(f"{text}: expected k/n with 1 <= k <= n")
    return share, shares


def arguments():
    parser = OneLineParser(prog="catkin_ws.sh study discovery", description=__doc__,
                           formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--slice", type=a_slice, default=(1, 1), metavar="K/N", help="every N-th case, from the K-th")
    parser.add_argument("--only", nargs="+", choices=KINDS, help="these kinds")
    parser.add_argument("--case", nargs="+", metavar="NAME", help="these cases")
    parser.add_argument("--list", action="store_true", help="tells the cases and how far they are")
    parser.add_argument("--summary", action="store_true", help="only scores the reports that are there")
    parser.add_argument("--adopt", action="store_true", help=f"takes the cases of {DOCUMENTS}/*.json for done")
    parser.add_argument("--keep", action="store_true", help="keeps recordings")
    parser.add_argument("--seed", type=int, default=1, help="of everything that is drawn")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="threads of a case")
    parser.add_argument("--out", default=OUT, help=f"elsewhere than in {OUT}, {DOCUMENTS} stay as they are")
    return parser.parse_args()


def carry_out(cases, everything, options):
    for case in cases:
        if case.done():
            continue
        left = time_left(cases)
        say(f"{case.name}, {sum(c.done() for c in cases)} of {len(cases)} done" +
            ("" if left is None else f", {left:.1f} h left"))
        case.carry_out()
        summarise(everything, options)
    without = [case.name for case in cases if not case.done()]
    summarise(everything, options)
    if without:
        sys.exit(f"study: without a report: {' '.join(without)}")
    say(f"{options.out}/{study_name(options)}.html" + (f", {document(options)}" if of_the_study(options) else ""))


def main():
    options = arguments()
    everything = all_cases(options)
    cases = chosen(everything, options)
    if options.adopt:
        adopt(everything, options)
    if options.list:
        for case in cases:
            print(f"{case.name:<12} {case.state()}")
        return
    if options.summary:
        if not summarise(everything, options):
            refuse("no case is done yet")
        return
    carry_out(cases, everything, options)


if __name__ == "__main__":
    start(main)
