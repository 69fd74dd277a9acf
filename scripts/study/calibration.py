#!/usr/bin/python3
"""Study of calibration: calibrates models I, II and III against virtual robots, tier by tier, as in chapter 8 of the
thesis.

Every step leaves its result under build/study/calibration/. The same command continues an interrupted study and does
not repeat finished steps. Writes build/study/calibration.json and .html, studies/calibration.md, and the results
behind it, studies/calibration.json. With --adopt, also on another machine, what is in this file counts as done.
"""

import argparse
import hashlib
import glob
import json
import os
import shutil
import statistics
import sys
import time

from _study import (OUT, OneLineParser, commit, html_page, load, load_published, machine, markdown_page, must,
                    of_the_study, say, several, start, whole, write)

MODELS = ["I", "II", "III"]
STAGES = ["tier1_statics", "tier1_dynamics", "tier2_statics", "tier2_dynamics"]
DATA = {
    "tier1_statics": "tier1/equilibria",
    "tier1_dynamics": "tier1/trajectories",
    "tier2_statics": "tier2/equilibria",
    "tier2_dynamics": "tier2/trajectories",
}
# Tables C.12 and D.1 of the thesis: shoulder [deg], elbow [deg] or None, force [N].
BEFORE = {
    "I": [(21.9, None, 5.0), (15.2, None, 4.4), (14.3, 4.4, 3.1), (8.7, 5.1, 2.9)],
    "II": [(15.6, None, 5.4), (11.5, None, 4.3), (13.0, 5.1, 2.7), (7.5, 5.8, 2.7)],
    "III": [(11.3, None, 5.3), (8.7, None, 4.1), (10.4, 4.8, 2.7), (6.3, 5.6, 2.7)],
}
AFTER = {
    "I": [(4.5, None, 6.0), (9.9, None, 4.0), (6.7, 2.4, 3.3), (7.1, 2.2, 2.9)],
    "II": [(3.7, None, 5.5), (6.6, None, 3.7), (4.1, 1.2, 3.0), (4.0, 2.5, 2.7)],
    "III": [(4.3, None, 5.2), (6.6, None, 3.6), (5.9, 1.8, 3.3), (5.0, 1.7, 2.6)],
}
ENOUGH = {"statics": 5.0, "dynamics": 7.0}  # [deg]
RECORDER = "devel/lib/anthrob_virtual_robot/anthrob_virtual_robot"
TOOL = "devel/lib/anthrob_calib/anthrob_calibrate"
ROBOT = "config/anthrob"
CONFIG = "config/anthrob/calibration"
DOCUMENT = "studies/calibration.md"
PUBLISHED = "studies/calibration.json"
OPTIMISERS = ["least_squares", "evolution_strategy", "cmaes", "sade", "bee_colony"]
JACOBIANS = {"statics": 8, "dynamics": 4}  # at most, of least squares; dynamics start from the result of statics


def search(stage, model, options):
    """Options of a search: least squares, or another optimiser with a share of the thesis's generations."""
    if options.optimiser == "least_squares":
        return ["--optimiser", "least_squares", "--generations", str(JACOBIANS[stage.split("_")[1]])]
    return ["--optimiser", options.optimiser] + generations(stage, model, options.share)


def generations(stage, model, share):
    """Option for the share of the configured generations; none if it is all of them."""
    if share >= 1:
        return []
    with open(f"{CONFIG}/{stage}_{model}.yaml") as text:
        for line in text:
            if line.strip().startswith("generations:"):
                full = int(line.split(":")[1].split("#")[0])
                return ["--generations", str(max(1, round(full * share)))]
    sys.exit(f"study: {CONFIG}/{stage}_{model}.yaml: key generations is missing; --share needs it")


def share_of(options):
    """Share of the thesis's generations that a search may take; None if it is not counted in generations."""
    return None if options.optimiser == "least_squares" else options.share


def search_words(facts):
    """Optimiser of a step, with its share of the thesis's generations if that is not all of them."""
    share = facts.get("share")
    return facts["optimiser"] + ("" if share is None or share >= 1 else f" ({share} of the thesis's generations)")


def searches(options):
    """How many per stage: least squares draws no random numbers, so one is enough."""
    return 1 if options.optimiser == "least_squares" else options.runs


class Robot:
    """One virtual robot and what was calibrated against it."""

    def __init__(self, seed, options):
        self.seed = seed
        self.options = options
        self.folder = f"{options.out}/calibration/robot_{seed}"
        self.data = f"{self.folder}/data"
        self.log = f"{self.folder}/study.log"
        os.makedirs(self.folder, exist_ok=True)

    def record(self):
        made_of = fingerprint([], *recorder_files())
        complete = f"{self.data}/complete"
        if os.path.exists(complete):
            with open(complete) as text:
                if text.read().strip() == made_of:
                    return
            say(f"robot {self.seed}: its recordings are of another virtual robot, recording again")
            shutil.rmtree(self.data)
        say(f"robot {self.seed}: recording")
        for tier in "12":
            must([RECORDER, "--seed", str(self.seed), "--tier", tier, "--model",
                  f"{ROBOT}/model_II.yaml", "--out", f"{self.data}/tier{tier}"], self.log)
        write(complete, made_of + "\n")

    def step(self, stage, model, name, start, more):
        """Runs anthrob_calibrate once, unless the same run is already done."""
        out = f"{self.folder}/{model}/{stage}/{name}"
        more = more + ([] if self.options.thorough else ["--brief"])
        key = fingerprint(more, f"{CONFIG}/{stage}_{model}.yaml", f"{self.data}/complete",
                          f"{start}/result.json" if start else None, *robot_files())
        spent = 0.0
        if os.path.exists(f"{out}/step.json"):
            before = load(f"{out}/step.json")
            if before["key"] != key:
                say(f"robot {self.seed}: model {model}, {stage}, {name}: its inputs have changed, starting again")
                shutil.rmtree(out)
            elif before["done"]:
                return out
            else:
                spent = before["seconds"]
        os.makedirs(out, exist_ok=True)
        command = [TOOL, "--config", f"{CONFIG}/{stage}_{model}.yaml", "--data",
                   f"{self.data}/{DATA[stage]}", "--out", out, "--jobs", str(self.options.jobs)] + more
        command += ["--validation", f"{self.data}/{stage[:5]}/validation"]
        if start:
            command += ["--start", f"{start}/result.json"]
        if os.path.exists(f"{out}/journal.txt"):
            command.append("--resume")
        begin = time.time()

        def note(done):
            facts = {"key": key, "commit": commit(), "machine": machine(), "optimiser": self.options.optimiser,
                     "share": share_of(self.options), "done": done,
                     "seconds": round(spent + time.time() - begin, 1)}
            write(f"{out}/step.json", json.dumps(facts, indent=2) + "\n")

        try:
            must(command, self.log)
        except BaseException:
            note(False)
            raise
        note(True)
        return out

    def adopted(self, stage, model):
        """Published result of a stage (with --adopt), or None."""
        return self.options.adopted.get(str(self.seed), {}).get(model, {}).get(stage)

    def calibrate(self, model):
        if all(self.adopted(stage, model) for stage in STAGES):
            return
        self.record()
        start = None
        for stage in STAGES:
            say(f"robot {self.seed}: model {model}, {stage}")
            self.step(stage, model, "uncalibrated", None, ["--evaluate"])
            runs = []
            for k in range(1, searches(self.options) + 1):
                more = ["--seed", str(k)] + search(stage, model, self.options)
                runs.append(self.step(stage, model, f"{self.options.optimiser}_{k}", start, more))
            start = min(runs, key=lambda r: load(f"{r}/result.json")["fitness"]["after"])
            facts = {**load(f"{start}/step.json"), "searches": len(runs)}
            write(f"{start}/step.json", json.dumps(facts, indent=2) + "\n")
            write(f"{self.folder}/{model}/{stage}/best", os.path.basename(start) + "\n")
            summarise(self.options)

    def result(self, stage, model):
        """Errors before and after; None if the stage is not done."""
        folder = f"{self.folder}/{model}/{stage}"
        if not os.path.exists(f"{folder}/best"):
            return self.adopted(stage, model)
        best = f"{folder}/{open(f'{folder}/best').read().strip()}"
        result = load(f"{best}/result.json")
        before = mean_after(load(f"{folder}/uncalibrated/result.json")["calibration"])
        after, held_out = mean_after(result["calibration"]), mean_after(result["validation"])
        if not (before and after and held_out):
            say(f"robot {self.seed}: model {model}, {stage}: left out, some recording cannot be simulated to its end")
            return None
        # A step of an earlier version of this program tells less of itself.
        facts = {"machine": machine(), "optimiser": os.path.basename(best).rsplit("_", 1)[0], "searches": 1,
                 **load(f"{best}/step.json")}
        return {
            "before": errors(before),
            "after": errors(after),
            "fitness": [result["fitness"]["before"], result["fitness"]["after"]],
            "evaluations": result["optimiser"]["evaluations"],
            "seconds": facts["seconds"],
            "commit": facts["commit"],
            "machine": facts["machine"],
            "optimiser": search_words(facts),
            "searches": facts["searches"],
            "validation": errors(held_out),
        }


def robot_files():
    """Files of which the calibrated models are made."""
    return sorted(glob.glob(f"{ROBOT}/model_*.yaml") + glob.glob(f"{ROBOT}/*.urdf"))


def recorder_files():
    """Files of which the recordings of virtual robots are made: programs, their settings, the model."""
    programs = glob.glob(RECORDER) + sorted(glob.glob("devel/lib/libanthrob_virtual_robot*.so")
                                            + glob.glob("devel/lib/libanthrob_reference*.so"))
    settings = sorted(glob.glob(f"{ROBOT}/virtual_robot*.yaml") + glob.glob(f"{ROBOT}/equilibria_*.yaml"))
    return programs + settings + robot_files()


def fingerprint(more, *files):
    """Hash of everything a step depends on: its options and the files that it reads."""
    digest = hashlib.sha256(" ".join(more).encode())
    for file in files:
        if file:
            with open(file, "rb") as content:
                digest.update(content.read())
    return digest.hexdigest()[:16]


def mean_after(errors_of_runs):
    """Mean errors with the numbers that were found; None if the recordings could not be simulated."""
    return errors_of_runs and errors_of_runs["mean"]["after"]


def errors(mean):
    joints = mean["joints_deg"]
    return [joints["shoulder"], joints.get("elbow"), mean["force_N"]]


def median(lists):
    """Element by element of several lists; None where one of them has None."""
    return [None if None in column else statistics.median(column) for column in zip(*lists)]


def text(values):
    return " / ".join(f"{v:.1f}" for v in values if v is not None)


def seeds_of(options):
    """Robots with results: of this command, of earlier ones in the same folder, adopted ones."""
    folders = map(os.path.basename, glob.glob(f"{options.out}/calibration/robot_*"))
    earlier = {int(name[len("robot_"):]) for name in folders if name[len("robot_"):].isdigit()}
    return sorted({*options.robots, *map(int, options.adopted), *earlier})


def collect(options):
    table = []
    seeds = seeds_of(options)
    for model in MODELS:
        for index, stage in enumerate(STAGES):
            done = {}
            for seed in seeds:
                result = Robot(seed, options).result(stage, model)
                if result:
                    done[seed] = result
            if not done:
                continue
            entry = {
                "model": model,
                "stage": stage,
                "robots": done,
                "before": median([r["before"] for r in done.values()]),
                "after": median([r["after"] for r in done.values()]),
                "thesis": {"before": BEFORE[model][index], "after": AFTER[model][index]},
            }
            entry["factor"] = entry["before"][0] / entry["after"][0]
            entry["thesis"]["factor"] = BEFORE[model][index][0] / AFTER[model][index][0]
            table.append(entry)
    return table


HEAD = ["model", "stage", "error before", "error after", "factor", "thesis: before", "thesis: after", "thesis: factor",
        "target reached", "robots", "minutes"]
FACTS = {  # words of the pages for the facts of the JSON file
    "commit": "program versions (commits) that calibrated",
    "optimiser": "optimiser",
    "searches a stage": "searches per stage",
    "Jacobians a search, at most": "Jacobians per search, at most",
    "machine": "computers",
    "notes": "notes",
}
ABOUT = [
    "How close does calibration bring a model to its robot? Here the robots are"
    " [virtual](virtual_robot.md#a-robot-to-be-calibrated): each is model II with parameters of its own and with"
    " properties that the models lack, such as tendons that stretch."
    " [Models I, II and III](../docs/simulator.md#models-i-ii-and-iii) of Anthrob"
    " are calibrated against every robot in four stages, as in chapter 8 of the thesis. The table compares the errors"
    " before and after with those that the thesis measured on the real robot.",
    "This page is written by `./catkin_ws.sh study calibration` from [these results](calibration.json). With `--adopt`,"
    " the command takes these results as done and continues with other robots.",
]
KEY = {
    "*stage*": "tier 1 is Anthrob without its forearm, tier 2 with it; *statics* fits equilibria, *dynamics* fits"
               " trajectories. Each stage starts from the result of the one before.",
    "*error*": "the mean difference between simulated and recorded robot. Tier 1: shoulder [deg] / muscle force [N];"
               " tier 2: shoulder [deg] / elbow [deg] / muscle force [N]. Means over the recordings of a robot, then"
               " medians over robots.",
    "*before*, *after*": "of the uncalibrated model; of the model that this stage has calibrated.",
    "*factor*": "the shoulder's error before, divided by that after.",
    "*thesis*": "the same numbers from Tables C.12 and D.1 of the [thesis](../README.md#sources-and-licence).",
    "*target reached*": f"\"yes: <= {ENOUGH['statics']:.0f} deg\" (statics) or \"yes: <= {ENOUGH['dynamics']:.0f} deg\""
                        " (dynamics) if the shoulder's error after calibration is that small; otherwise"
                        " \"yes: factor\" if the factor is at least the thesis's, or \"no\".",
    "*robots*": "the seeds of the virtual robots.",
    "*minutes*": "time of the stage's search by the clock (of the best one, if there are several); median over robots.",
}


def reached(entry):
    """Target: the shoulder's error falls to so many degrees, or by the thesis's factor."""
    enough = ENOUGH[entry["stage"].split("_")[1]]
    if entry["after"][0] <= enough:
        return f"yes: <= {enough:.0f} deg"
    return "yes: factor" if entry["factor"] >= entry["thesis"]["factor"] else "no"


def rows(table):
    for e in table:
        minutes = statistics.median(r["seconds"] for r in e["robots"].values()) / 60
        yield [e["model"], e["stage"], text(e["before"]), text(e["after"]), f"{e['factor']:.1f}",
               text(e["thesis"]["before"]), text(e["thesis"]["after"]),
               f"{e['thesis']['factor']:.1f}", reached(e), ", ".join(map(str, e["robots"])),
               f"{minutes:.1f}"]


def page(table, facts):
    """Parts of the page, see markdown_page()."""
    held_out = [[e["model"], e["stage"][4], text(median([r["validation"] for r in e["robots"].values()]))]
                for e in table if e["stage"].endswith("dynamics")]
    return ABOUT + [
        "## Circumstances", {FACTS[key]: value for key, value in facts.items()},
        "## Terms and columns", KEY,
        "## Recordings that were fitted", (HEAD, rows(table)),
        "## Held-out recordings",
        "A tour through several postures, recorded but never fitted. Errors as above, of the model after the dynamics"
        " stage of the tier.",
        (["model", "tier", "error after"], held_out)]


def summarise(options):
    table = collect(options)
    done = [result for entry in table for result in entry["robots"].values()]
    facts = {
        "commit": several(result["commit"] for result in done),
        "optimiser": several(result["optimiser"] for result in done),
        "searches a stage": several(result["searches"] for result in done),
        "Jacobians a search, at most": ", ".join(f"{n} ({kind})" for kind, n in JACOBIANS.items()),
        "machine": several(result["machine"] for result in done),
        "notes": several(result["note"] for result in done if "note" in result) or "none",
    }
    if not any(result["optimiser"] == "least_squares" for result in done):
        del facts["Jacobians a search, at most"]
    write(f"{options.out}/calibration.json", json.dumps({"facts": facts, "table": table}, indent=2))
    title = "Study of calibration with virtual robots"
    write(f"{options.out}/calibration.html", html_page(title, page(table, facts)))
    if of_the_study(options):
        os.makedirs("studies", exist_ok=True)
        write(DOCUMENT, markdown_page(title, page(table, facts)))
        write(PUBLISHED, json.dumps(published(table), indent=1) + "\n")


def published(table):
    """Results by robot, model and stage."""
    robots = {}
    for entry in table:
        for seed, result in entry["robots"].items():
            robots.setdefault(str(seed), {}).setdefault(entry["model"], {})[entry["stage"]] = result
    return robots


def fraction(word):
    """Type of an option: a number above 0, at most 1."""
    try:
        number = float(word)
    except ValueError:
        number = 0.0
    if not 0 < number <= 1:
        raise argparse.ArgumentTypeError(f"{word}: expected a number above 0, at most 1")
    return number


def main():
    parser = OneLineParser(prog="catkin_ws.sh study calibration", description=__doc__,
                           formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=whole(0), nargs="+", default=[1, 2, 3], help="seeds of the virtual robots")
    parser.add_argument("--models", nargs="+", default=MODELS, choices=MODELS, help="models to calibrate")
    parser.add_argument("--optimiser", default="least_squares", choices=OPTIMISERS, help="search method")
    parser.add_argument("--runs", type=whole(1), default=2, help="searches per stage with different"
                        " random numbers, if not least_squares; the best one counts")
    parser.add_argument("--share", type=fraction, default=1.0,
                        help="share of the thesis's generations, if not least_squares")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count(), help="threads")
    parser.add_argument("--thorough", action="store_true", help="reports also hold the errors of the parameters")
    parser.add_argument("--adopt", action="store_true", help=f"take the results in {PUBLISHED} as done")
    parser.add_argument("--out", default=OUT, help=f"folder of the results; if not {OUT}, {DOCUMENT} stays as it is")
    options = parser.parse_args()
    options.adopted = load_published(PUBLISHED) if options.adopt else {}
    for seed in options.robots:
        for model in options.models:
            Robot(seed, options).calibrate(model)
    summarise(options)
    say(f"done: {options.out}/calibration.html" + (f", {DOCUMENT}" if of_the_study(options) else ""))


if __name__ == "__main__":
    start(main)
