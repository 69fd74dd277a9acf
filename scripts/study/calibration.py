#!/usr/bin/python3
"""The study of chapter 8: models I, II, III calibrated tier by tier against virtual robots.

Every step leaves its result under build/study/calibration/ and is not done again; what was
interrupted goes on. Writes build/study/calibration.json and .html, docs/studies/calibration.md and, what it was made
from, docs/studies/calibration.json: with --adopt, on another machine, the robots and models in it are done already.
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

from _study import (OUT, OneLineParser, commit, html_page, html_table, load, load_published, machine, markdown_facts,
                    markdown_table, must, of_the_study, say, several, start, write)

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
CONFIG = "config/anthrob/calibration"
DOCUMENT = "docs/studies/calibration.md"
PUBLISHED = "docs/studies/calibration.json"
JACOBIANS = {"statics": 8, "dynamics": 4}  # most, of least squares; dynamics start from statics' result


def search(stage, model, options):
    """How a stage is searched: Ceres, or the thesis's evolution strategy with a share of its generations."""
    if options.optimiser == "least_squares":
        return ["--optimiser", "least_squares", "--generations", str(JACOBIANS[stage.split("_")[1]])]
    return ["--optimiser", options.optimiser] + generations(stage, model, options.share)


def generations(stage, model, share):
    """Of the configuration, or a share of it."""
    if share >= 1:
        return []
    with open(f"{CONFIG}/{stage}_{model}.yaml") as text:
        for line in text:
            if line.strip().startswith("generations:"):
                full = int(line.split(":")[1].split("#")[0])
                return ["--generations", str(max(1, round(full * share)))]
    sys.exit(f"study: {stage}_{model}.yaml names no generations")


def search_words(options):
    whole = options.share >= 1 or options.optimiser == "least_squares"
    return [] if whole else [f"({options.share} of the thesis's generations)"]


def searches(options):
    """A stage; least squares knows no chance."""
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
        if os.path.exists(f"{self.data}/complete"):
            return
        say(f"robot {self.seed}: recording")
        for tier in "12":
            must([RECORDER, "--seed", str(self.seed), "--tier", tier, "--model",
                  "config/anthrob/model_II.yaml", "--out", f"{self.data}/tier{tier}"], self.log)
        write(f"{self.data}/complete", commit() + "\n")

    def step(self, stage, model, name, start, more):
        """One run of anthrob_calibrate, unless the same was done before."""
        out = f"{self.folder}/{model}/{stage}/{name}"
        more = more + ([] if self.options.thorough else ["--brief"])
        key = fingerprint(more, f"{CONFIG}/{stage}_{model}.yaml", f"{self.data}/complete",
                          f"{start}/result.json" if start else None, *robot_files())
        spent = 0.0
        if os.path.exists(f"{out}/step.json"):
            before = load(f"{out}/step.json")
            if before["key"] != key:
                say(f"robot {self.seed}: model {model}, {stage}, {name}: something has changed, anew")
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
            facts = {"key": key, "commit": commit(), "done": done,
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
        """Result from elsewhere, or None."""
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
            with open(f"{self.folder}/{model}/{stage}/best", "w") as text:
                text.write(os.path.basename(start) + "\n")
            summarise(self.options)

    def result(self, stage, model):
        """Errors before and after, None if the stage has not been done."""
        folder = f"{self.folder}/{model}/{stage}"
        if not os.path.exists(f"{folder}/best"):
            return self.adopted(stage, model)
        best = f"{folder}/{open(f'{folder}/best').read().strip()}"
        result = load(f"{best}/result.json")
        before = load(f"{folder}/uncalibrated/result.json")["calibration"]
        if not (before and result["calibration"] and result["validation"]):
            say(f"robot {self.seed}: model {model}, {stage}: some recording cannot be simulated in full: left out")
            return None
        out = {
            "before": errors(before["mean"]["after"]),
            "after": errors(result["calibration"]["mean"]["after"]),
            "fitness": [result["fitness"]["before"], result["fitness"]["after"]],
            "evaluations": result["optimiser"]["evaluations"],
            "seconds": load(f"{best}/step.json")["seconds"],
            "commit": load(f"{best}/step.json")["commit"],
            "machine": machine(),
            "optimiser": " ".join([self.options.optimiser] + search_words(self.options)),
            "searches": searches(self.options),
        }
        out["validation"] = errors(result["validation"]["mean"]["after"])
        return out


def robot_files():
    """What the models that are calibrated are made of."""
    return sorted(glob.glob("config/anthrob/model_*.yaml") + glob.glob("config/anthrob/*.urdf"))


def fingerprint(more, *files):
    """Of what a step depends on: its options, and the files it reads."""
    digest = hashlib.sha256(" ".join(more).encode())
    for file in files:
        if file:
            with open(file, "rb") as content:
                digest.update(content.read())
    return digest.hexdigest()[:16]


def errors(mean):
    joints = mean["joints_deg"]
    return [joints["shoulder"], joints.get("elbow"), mean["force_N"]]


def median(lists):
    """Of lists of numbers or None, place by place."""
    return [None if None in column else statistics.median(column) for column in zip(*lists)]


def text(values):
    return " / ".join(f"{v:.1f}" for v in values if v is not None)


def collect(options):
    table = []
    for model in MODELS:
        for index, stage in enumerate(STAGES):
            done = {}
            for seed in sorted({*options.robots, *map(int, options.adopted)}):
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


def head():
    return ["model", "stage", "before", "after", "factor", "thesis before", "thesis after",
            "thesis factor", "reached", "robots", "minutes"]


def reached(entry):
    """The shoulder's error falls by the thesis's factor, or to so many degrees."""
    enough = ENOUGH[entry["stage"].split("_")[1]]
    if entry["after"][0] <= enough:
        return f"<= {enough:.0f} deg"
    return "factor" if entry["factor"] >= entry["thesis"]["factor"] else "no"


def rows(table):
    for e in table:
        minutes = statistics.median(r["seconds"] for r in e["robots"].values()) / 60
        yield [e["model"], e["stage"], text(e["before"]), text(e["after"]), f"{e['factor']:.1f}",
               text(e["thesis"]["before"]), text(e["thesis"]["after"]),
               f"{e['thesis']['factor']:.1f}", reached(e), ", ".join(map(str, e["robots"])),
               f"{minutes:.1f}"]


def markdown(table, facts):
    lines = ["# Study: calibration against virtual robots", "",
             "Written by `./catkin_ws.sh study calibration` from [these results](calibration.json). Errors are means",
             "over runs, medians over robots (named by their seeds): shoulder [deg] / elbow [deg] / muscle force [N];",
             "thesis: Tables C.12 and D.1, of the real robot. `--adopt` takes the results for done and goes on with",
             "other robots.", ""]
    lines += markdown_facts(facts) + [""] + markdown_table(head(), rows(table))
    held_out = [[e["model"], e["stage"][4],
                 text(median([r["validation"] for r in e["robots"].values()]))]
                for e in table if e["stage"].endswith("dynamics")]
    lines += ["", "## Held-out trajectories", "",
              "A tour through several postures, never fitted; medians over robots.", ""]
    lines += markdown_table(["model", "tier", "error of the calibrated model"], held_out)
    return "\n".join(lines) + "\n"


def page(table, facts):
    body = "<p>shoulder [deg] / elbow [deg] / force [N]</p>" + html_table(head(), rows(table))
    return html_page("Calibration against virtual robots", facts, body)


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
    write(f"{options.out}/calibration.json", json.dumps({"facts": facts, "table": table}, indent=2))
    write(f"{options.out}/calibration.html", page(table, facts))
    if of_the_study(options):
        os.makedirs("docs/studies", exist_ok=True)
        write(DOCUMENT, markdown(table, facts))
        write(PUBLISHED, json.dumps(published(table), indent=1) + "\n")


def published(table):
    """Results by robot, model and stage."""
    robots = {}
    for entry in table:
        for seed, result in entry["robots"].items():
            robots.setdefault(str(seed), {}).setdefault(entry["model"], {})[entry["stage"]] = result
    return robots


def main():
    parser = OneLineParser(prog="catkin_ws.sh study calibration", description=__doc__,
                           formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, nargs="+", default=[1, 2, 3], help="seeds")
    parser.add_argument("--models", nargs="+", default=MODELS, choices=MODELS)
    parser.add_argument("--optimiser", default="least_squares", help="or evolution_strategy, cmaes, ...")
    parser.add_argument("--runs", type=int, default=2, help="searches a stage by chance; the better one survives")
    parser.add_argument("--share", type=float, default=1.0, help="of the thesis's generations")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--thorough", action="store_true", help="errors of parameters, too, in each report")
    parser.add_argument("--adopt", action="store_true", help=f"takes the results of {PUBLISHED} for done")
    parser.add_argument("--out", default=OUT, help=f"elsewhere than in {OUT}, {DOCUMENT} stays as it is")
    options = parser.parse_args()
    options.adopted = load_published(PUBLISHED) if options.adopt else {}
    for seed in options.robots:
        for model in options.models:
            Robot(seed, options).calibrate(model)
    summarise(options)
    say(f"done: {options.out}/calibration.html" + (f", {DOCUMENT}" if of_the_study(options) else ""))


if __name__ == "__main__":
    start(main)
