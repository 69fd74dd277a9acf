#!/usr/bin/python3
"""Blind study of discovery. Virtual robots hide one effect of the catalogue, two, none, or a law that the catalogue
lacks. Discovery gets only recordings and a model; a third program compares its reports with the truth.

Every case leaves its result under build/study/discovery/. The same command continues an interrupted study and does not
repeat finished cases. Writes build/study/discovery.json and .html, studies/discovery.md, and the answers behind
it, studies/discovery.json. A --seed other than 1 is a study of other cases; its files are named discovery_seed_2
and so on. Slices may run on several hosts. Either bring their reports/ and sealed/ together and run with --summary, or
run the slices one after the other with --adopt, each with the studies/discovery.json of the one before.
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

from _study import (OUT, OneLineParser, commit, html_page, load, load_published, machine, markdown_page, must,
                    of_the_study, refuse, run, say, several, start, whole, write)

MAKER = "devel/lib/anthrob_virtual_robot/anthrob_blind_case"
DISCOVER = "devel/lib/anthrob_discovery/anthrob_discover"
SCORE = "src/anthrob_virtual_robot/scripts/anthrob_score"
MODEL = "config/anthrob/model_I.yaml"
ROUNDS = {"effect": 2}  # cases per law, each at another place
COUNTS = {"null": 60, "pair": 12, "wrapped": 1}
KINDS = ["effect", "null", "pair", "outside", "wrapped"]
MOST_EFFECTS = {"wrapped": 12}
DOCUMENTS = "studies"
DRAWN = ["kind", "effects", "change", "slow", "stated_noise", "noise_memory"]  # of a truth: what was asked
TOLD = ["id", "place", "probability", "shows_in", "left", "parameters", "rivals"]  # of a named effect: to score it
SPENT = ["spent_s", "processor_s"]  # files that remain after an interruption


def clocks():
    """Seconds: of the clock now, and of processor time that all finished steps have used."""
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
        self.turn = number / count  # kinds take turns, so that a part of the study covers all
        self.options = options
        folder = f"{options.out}/{study_name(options)}"
        self.data = f"{folder}/cases/{self.name}"
        self.truth = f"{folder}/sealed/{self.name}.json"
        self.report = f"{folder}/reports/{self.name}"
        self.log = f"{folder}/logs/{self.name}.log"

    def done(self):
        return os.path.exists(f"{self.report}/study.json")

    def failed(self):
        """Whether the last run ended without a report: a wrong answer, until the case is done again."""
        return not self.done() and os.path.exists(f"{self.report}/failed")

    def state(self):
        return "done" if self.done() else "failed" if self.failed() else "begun" if os.path.exists(self.truth) else ""

    def make(self):
        """Makes the robot and its recordings, unless they are there; False if that fails. The maker writes the truth
        last. A case belongs to one version of the program: what another one began is made again."""
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
        """Seconds of discovery so far, interrupted runs included: of the clock, of processor time."""
        files = [f"{self.report}/{file}" for file in SPENT]
        return [float(load(file)) if os.path.exists(file) else 0.0 for file in files]

    def put_away(self):
        """Deletes the recordings. The model stays, because the model in the report extends it."""
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
            say(f"{self.name} ended without a report: see {self.log}")
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
        """Truth, answer and circumstances, as far as scoring needs them; None if there is no answer."""
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
        """Takes over a published answer, or the fact that there was none."""
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
    """All numbers with six digits, which is enough for scoring."""
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
            refuse(f"no case {' '.join(sorted(unknown))}; --list shows all")
        cases = [case for case in cases if case.name in options.case]
    share, shares = options.slice
    return cases[share - 1::shares]


def seconds_of(case):
    facts = case.facts()
    return facts["making_s"] + facts["discovery_s"]


def time_left(cases):
    """Hours, estimated from finished cases of the same kind; None if no case is done."""
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
    """Scores of all reports that exist, by anthrob_score; None if no case was made."""
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
        "cases": f"{len(done)} of {len(cases)}" + (f", and {failed} that ended without a report" if failed else ""),
        "commit": several(facts["commit"] for facts in done),
        "seed": options.seed,
        "machine": several(facts["machine"] for facts in done),
        "threads a case": several(facts["jobs"] for facts in done),
        "time": f"{sum(minutes) / 60:.1f} h in total; per case {statistics.median(minutes):.1f} minutes in the "
                f"median, {max(minutes):.1f} at most"
                + (f"; processor time {sum(processor):.1f} h for {len(processor)} of the cases" if processor else ""),
    }


FACTS = {  # words of the pages for the facts of the JSON file
    "cases": "cases answered",
    "commit": "program versions (commits) that answered",
    "seed": "seed",
    "machine": "computers",
    "threads a case": "threads per case",
    "time": "time by the clock",
}
SECTIONS = {  # of the rates
    "One effect hidden": "Robots with one effect of the catalogue.",
    "All muscles wrapped": "Robots whose muscles all wrap round surfaces, where the model has straight lines. Discovery"
                           " counts as right if it first names the surface of any of them.",
    "Two effects hidden": "Robots with two effects of the catalogue.",
    "Nothing hidden": "Robots that differ from their model in ordinary parameters and noise only.",
    "Law outside the catalogue": "Robots with a law that the catalogue lacks, so that every name is wrong.",
    "Held-out gap": "How well the corrected model fits the held-out recording. The rows about the gap count all robots"
                    " with effects of the catalogue. A share of 0 means that nothing is left above the floor, 1 that"
                    " nothing is gained; a negative share means that the gap ends below the floor. The rows about"
                    " channels count all answers that name an effect.",
    "Wrong names": "Robots with one or two effects of the catalogue.",
}
RATES = {  # of anthrob_score, by its label: section (None: that of the row before), words of the page
    "correct": ("One effect hidden", "effect named first, or in the class of what is named first"),
    "of all, invisible too": (None, "the same, if effects reported as invisible count as missed"),
    "named first": ("One effect hidden", "effect named first"),
    "inside a class": ("One effect hidden", "effect only in the class of what is named first"),
    "right place": ("One effect hidden", "effect named first or in the class, at its place"),
    "said invisible": ("One effect hidden", "effect reported as invisible"),
    "below 3 floors": ("One effect hidden", "effect that changes no channel by 3 floors"),
    "parameter error [%]": ("One effect hidden", "error of the size [%], if named first at its place"),
    "covered by ci95": ("One effect hidden", "95 % interval of the report holds the true size"),
    "wrapping surface": ("All muscles wrapped", "surface found"),
    "its radius [%]": ("All muscles wrapped", "error of its radius [%]"),
    "both of two named": ("Two effects hidden", "both named, each at its place"),
    "one inside a class": ("Two effects hidden", "both named, but one of them only in a class"),
    "and nothing else": ("Two effects hidden", "both named, and nothing else"),
    "one said invisible": ("Two effects hidden", "missed effect reported as invisible"),
    "false on nothing": ("Nothing hidden", "false alarm: another verdict than `no_missing_effect`"),
    "unexplained, as is": ("Law outside the catalogue", "verdict `unexplained`, the right answer"),
    "confidently wrong": ("Law outside the catalogue", "an effect named with a probability of 0.9 or more"),
    "gap left held out": ("Held-out gap", "share of the gap that is left"),
    "no gap to begin with": ("Held-out gap", "no gap left for effects: ordinary parameters close it"),
    "a channel worse": ("Held-out gap", "a channel more than 5 % worse than without the named effects"),
    "and above its floor": ("Held-out gap", "a channel more than 5 % worse, and above its floor"),
    "and not by chance": ("Held-out gap", "a channel more than 5 % worse, above its floor, and by three standard errors"),
    "more named than hidden": ("Wrong names", "more effects named than hidden"),
    "a false one certainly": ("Wrong names", "a wrong effect or place named with a probability of 0.9 or more"),
}
KEY = {
    "*channel*, *floor*, *gap*": "a channel is a measured quantity, such as the force of one muscle. Its floor is its"
                                 " noise and the error of the simulation's own numerics. The gap is the root mean"
                                 " square difference between simulation and recording, in floors. Where the change"
                                 " that an effect makes is given in floors, a floor is the error of the channel's"
                                 " sensor alone.",
    "*held out*": "of the test recording, which was not used to fit anything.",
    "*effect*, *place*": "what the model lacks and where it acts, for example `joint_coulomb @ elbow`; see the"
                         " [catalogue](../docs/effects.md).",
    "*verdict*": "`effects_found`: at least one effect explains the held-out recording better, by more than chance."
                 " `no_missing_effect`: no effect is named and no gap is certain. `unexplained`: a gap is certain, and"
                 " no effect of the catalogue closes enough of it; effects may be named all the same, mostly with a low"
                 " probability. `missing`: the program ended without a report, which counts as wrong.",
    "*named first*": "the first effect in the report, if the verdict is `effects_found`.",
    "*class*": "effects that the report cannot tell apart: a named one and its rivals with a probability of 0.05 or"
               " more, at most three in all.",
    "*reported as invisible*": "the effect is not named, and the report says that an effect of its size would be too"
                               " small to show in these recordings. Such cases are left out of the rates of found"
                               " effects, unless a row says otherwise.",
}
RATE_HEAD = ["result", "measured", "target"]
ANSWER_HEAD = ["hidden", "answer (number of cases)"]
CASE_HEAD = ["case", "hidden", "change [floors]", "verdict", "named", "probability of the first"]


def rate_parts(result):
    """A heading, a sentence and a table for every kind of robot."""
    rows, title = {}, "Other"
    for row in result["rates"]:
        section, name = RATES.get(row["label"], (None, row["label"]))
        title = section or title
        rows.setdefault(title, []).append([name, row["said"], target(row["asked"])])
    for title, table in rows.items():
        yield from [f"### {title}", *filter(None, [SECTIONS.get(title)]), (RATE_HEAD, table)]


def target(asked):
    """asked: 90 % -> at least 90 %; asked: 88-99 % -> 88-99 %"""
    words = asked.removeprefix("asked: ")
    return f"at least {words}" if words != asked and "-" not in words else words


def answer_rows(result):
    for hidden, answers in sorted(result["confusion"].items()):
        kind, _, law = hidden.rpartition(": ")
        note = {"outside": " (not in the catalogue)", "wrapped": " at every muscle"}.get(kind, "")
        answers = sorted(answers.items(), key=lambda item: -item[1])
        yield [law + note, ", ".join(f"{name} ({count})" for name, count in answers)]


def case_rows(result):
    for case in result["cases"]:
        hidden = "wrapping_surface @ every muscle" if case["kind"] == "wrapped" else ", ".join(case["hidden"])
        floors, probability = case["floors"], case["probability"]
        yield [case["name"], hidden or "nothing", "" if floors is None else f"{floors:.1f}", case["verdict"],
               ", ".join(case["named"]), "" if probability is None else f"{probability:.2f}"]


def page(result, facts, options):
    """Parts of the page, see markdown_page()."""
    return [
        "Does [discovery](../docs/discovery.md) find what a model lacks, and is it silent where nothing is missing?"
        " Each case is a [virtual robot](virtual_robot.md) in which something may be hidden that its model lacks."
        " Discovery gets recordings and the model, but not the truth. Another program then compares its answer with"
        " the truth.",
        f"This page is written by `./catkin_ws.sh study discovery --seed {options.seed}` from"
        f" [these answers]({study_name(options)}.json). With `--adopt`, the command takes them as done and continues"
        " with the other cases. What went right and wrong in every seed is described in"
        " [notes.md](notes.md).",
        "## Who answered", {FACTS[key]: value for key, value in facts.items()},
        "If there are several versions, later ones may have been changed because of what earlier ones had answered.",
        "## Terms", KEY,
        "## Rates",
        "A rate is given as number of cases/all cases = share [95 % interval], a median with its 95 % interval in"
        " brackets if there are enough values.",
        *rate_parts(result),
        "## Answers by hidden effect",
        "The answer of a case is the effect that is named first, or the verdict if that is not `effects_found`. A case"
        " with two effects stands in the row of its first one; it may well be right to name the other one first.",
        (ANSWER_HEAD, list(answer_rows(result))),
        "## All cases",
        "`effect_NN` hides one effect, `pair_NN` two, `null_NN` nothing, `outside_NN` a law that the catalogue lacks."
        " In `wrapped_NN`, every muscle wraps round a surface. *Change*: by how many floors the hidden effects change"
        " the channel that they change most.",
        (CASE_HEAD, list(case_rows(result)))]


def summarise(cases, options):
    """Scores the reports and writes all files; False if there is no report."""
    result = score(options)
    if result is None or not any(case.done() for case in cases):
        return False
    facts = facts_of(cases, options)
    write(f"{options.out}/{study_name(options)}.json", as_json({"facts": facts, **result}))
    title, parts = f"Blind study of discovery, seed {options.seed}", page(result, facts, options)
    write(f"{options.out}/{study_name(options)}.html", html_page(title, parts))
    if of_the_study(options):
        os.makedirs(DOCUMENTS, exist_ok=True)
        write(document(options), markdown_page(title, parts))
        publish(cases, options)
    return True


def publish(cases, options):
    """Writes one line per case, so that a diff shows what is new."""
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
    parser.add_argument("--slice", type=a_slice, default=(1, 1), metavar="K/N",
                        help="only every N-th case, from the K-th")
    parser.add_argument("--only", nargs="+", choices=KINDS, help="only these kinds of cases")
    parser.add_argument("--case", nargs="+", metavar="NAME", help="only these cases")
    parser.add_argument("--list", action="store_true", help="list the cases and their state")
    parser.add_argument("--summary", action="store_true", help="only score the reports that exist")
    parser.add_argument("--adopt", action="store_true", help=f"take the cases in {DOCUMENTS}/*.json as done")
    parser.add_argument("--keep", action="store_true", help="keep the recordings of finished cases")
    parser.add_argument("--seed", type=int, default=1, help="seed of all random numbers")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count(), help="threads per case")
    parser.add_argument("--out", default=OUT, help=f"folder of the results; if not {OUT}, {DOCUMENTS} stays as it is")
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
            refuse("no case is done: run without --summary, or add --adopt to use the published cases")
        return
    carry_out(cases, everything, options)


if __name__ == "__main__":
    start(main)
