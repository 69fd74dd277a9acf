#!/usr/bin/python3
"""Study of conventions. A rig of two muscles is recorded late, held, averaged, filtered, counted, by another clock, with a
wrong sign or unit, under another control law: each alone, and three at a time (scripts/study/_recorder.py). Of each case
there are two: with nothing hidden, and with an effect. Every motion is also recorded by the simulator's own conventions:
what discovery says of that is what it should say.

The same command continues an interrupted study; what another version of the program has answered is asked again. Writes
build/study/conventions.json and studies/conventions.md.
"""

import argparse
import json
import os
import random
import shutil
import statistics
import time

from _recorder import RUNS, Case, Recorder, read_columns, references, write_commands
from _study import (OUT, OneLineParser, commit, load, machine, markdown_page, must, of_the_study, run, say, several, start,
                    whole, write)

REPLAY = "devel/lib/anthrob_sim/anthrob_replay"
DISCOVER = "devel/lib/anthrob_discovery/anthrob_discover"
RIG = "config/two_muscle_rig/model_II.yaml"
DOCUMENT = "studies/conventions.md"
ALONE = 33  # cases of one convention, three of each; all others have three at once
CALIBRATION = """parameters:
  - {path: joints.hinge.friction.viscous, unit: Nms/rad, low: 0.01, high: 0.04, step: 0.003}
  - {path: "muscles.*.rest_tendon_length", unit: m, low: 0.3632, high: 0.3672, step: 0.0003}
  - {path: actuators.motor.gear.efficiency, unit: "1", low: 0.53, high: 0.65, step: 0.01}
"""


def motion_of(run):
    return run.split("_again")[0]


class Asked:
    """A case, recorded by its conventions or by the simulator's."""

    def __init__(self, case, options):
        self.case, self.options = case, options
        self.folder = os.path.join(options.out, "conventions", f"seed_{options.seed}", case.name)
        self.log = os.path.join(self.folder, "log.txt")

    def result(self):
        file = os.path.join(self.folder, "result.json")
        stored = load(file) if os.path.exists(file) else None
        return stored if stored and stored["commit"] == commit() else None

    def simulate(self, run, rows):
        """The motion of the hidden robot under these references, by column."""
        inputs, outputs = (os.path.join(self.folder, "made", f"{run}_{what}") for what in ("in", "out"))
        write_commands(inputs, rows)
        must([REPLAY, "--model", os.path.join(self.folder, "hidden.yaml"), "--in", inputs, "--out", outputs], self.log)
        return read_columns(outputs)

    def record(self):
        """Data sets by the case's conventions, and by our own."""
        write(os.path.join(self.folder, "hidden.yaml"), self.case.model(os.path.abspath(RIG)))
        write(os.path.join(self.folder, "model.yaml"), f"extends: {os.path.abspath(RIG)}\n")
        write(os.path.join(self.folder, "calibration.yaml"), CALIBRATION)
        recorder, plain = Recorder(self.case.conventions, self.case.name), Recorder([], self.case.name)
        clean = {}
        for run in sum(RUNS.values(), []):
            draw = random.Random(f"{self.options.seed}/{self.case.number}/{motion_of(run)}")
            rows = references(draw)
            if motion_of(run) not in clean:
                clean[motion_of(run)] = self.simulate(run, recorder.commanded(rows))
            columns = clean[motion_of(run)]
            recorder.write(run, columns, rows, os.path.join(self.folder, "foreign", run))
            plain.write(run, columns, recorder.commanded(rows), os.path.join(self.folder, "own", run))

    def ask(self, which):
        words = [DISCOVER, "--model", os.path.join(self.folder, "model.yaml"),
                 "--out", os.path.join(self.folder, f"{which}_answer"), "--jobs", str(self.options.jobs)]
        for use, runs in RUNS.items():
            words += [f"--{use}", *(os.path.join(self.folder, which, run) for run in runs)]
        words += ["--effects", *self.options.effects] if self.options.effects else []
        log = os.path.join(self.folder, f"{which}.txt")
        begin = time.time()
        if os.path.exists(log):
            os.remove(log)
        status = run(words, log)
        spent = time.time() - begin
        if status != 0:
            with open(log) as text:
                lines = text.read().strip().splitlines() or [""]
            return {"failed": lines[-1], "time_s": spent}
        report = load(os.path.join(self.folder, f"{which}_answer", "report.json"))
        return {"verdict": report["verdict"], "time_s": spent, "gap": report["gap"],
                "effects": [{"id": e["id"], "place": e["place"], "parameters": e["parameters"]} for e in report["effects"]],
                "measurement": report["measurement"], "remarks": report["remarks"]}

    def carry_out(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        self.record()
        result = {"commit": commit(), "case": self.case.name, "conventions": [str(c) for c in self.case.conventions],
                  "foreign": self.ask("foreign")}
        if self.case.effect:  # of nothing hidden it is known what to say
            result["own"] = self.ask("own")
        for folder in "made", "own", "foreign":
            shutil.rmtree(os.path.join(self.folder, folder))
        write(os.path.join(self.folder, "result.json"), json.dumps(result, indent=1))
        return result


def names(answer):
    return sorted(f"{e['id']}@{e['place']}" for e in answer.get("effects", []))


def is_reported(convention, answer):
    """Whether an answer tells a convention: found, or refused."""
    if "failed" in answer:
        return convention.what in ("sign", "unit")
    rows = [row for row in answer["measurement"] if row["source"] == "found"]
    kinds = {"joint": ["joint position"], "velocity": ["velocity"]}.get(convention.kind, [convention.kind])
    delays = ["delay", "average", "filter"]
    wanted = delays if convention.what in delays else ["clock"] if convention.what == "drift" else \
        ["sign", "unit"] if convention.what in ("sign", "unit") else [convention.what]
    return any(row["what"] in wanted and any(kind in row["channel_kind"] for kind in kinds) for row in rows)


def named(answer, late):
    """What an answer names, with a delay of joints where none of them is late."""
    told = any(row["what"] == "delay" and row["channel_kind"] == "joint position" for row in answer.get("measurement", []))
    return names(answer) + (["late joints"] if told and not late else [])


def judged(asked, result):
    """How the answer by foreign conventions compares with the one by our own."""
    case, answer = asked.case, result["foreign"]
    late = any(c.kind == "joint" and c.what in ("delay", "average", "filter", "clock", "drift") for c in case.conventions)
    ours = named(result["own"], False) if case.effect else []
    found = named(answer, late)
    refused = "failed" in answer and any(c.what in ("sign", "unit") for c in case.conventions)
    right = refused or (found == ours and answer.get("verdict") != "unexplained" and "failed" not in answer)
    return {"case": case.name, "conventions": result["conventions"], "effect": case.effect, "right": right,
            "answer": answer.get("failed") or ", ".join(found) or answer["verdict"], "ours": ", ".join(ours),
            "reported": [is_reported(c, answer) for c in case.conventions], "what": [c.what for c in case.conventions],
            "time_s": answer["time_s"]}


def share(values):
    values = list(values)
    return f"{sum(values)} of {len(values)}" if values else "-"


def page(rows, programs):
    kinds = list(dict.fromkeys(what for row in rows for what in row["what"]))
    by_kind = [[what, share(told for row in rows for w, told in zip(row["what"], row["reported"]) if w == what),
                share(row["right"] for row in rows if row["what"] == [what] and not row["effect"]),
                share(row["right"] for row in rows if row["what"] == [what] and row["effect"])] for what in kinds]
    three = [row for row in rows if len(row["what"]) > 1]
    by_kind.append(["three at once", share(told for row in three for told in row["reported"]),
                    share(row["right"] for row in three if not row["effect"]),
                    share(row["right"] for row in three if row["effect"])])
    wrong = [[row["case"], "; ".join(row["conventions"]), row["answer"], row["ours"]] for row in rows if not row["right"]]
    parts = [
        "`./catkin_ws.sh study conventions` records a rig of two muscles by conventions that are not the simulator's: its "
        "motion is that of `anthrob_replay`, everything between robot and file is made in Python. Two recordings of 20 s to "
        "fit, one to judge, a repetition. *Told*: report.json has the convention among `measurement` (averages and filters "
        "also as a delay), or the recording is refused. *Right*: with nothing hidden, nothing is named; with an effect, the "
        "answer is that to the same motions by our own conventions. A convention that moves no channel by a floor need not "
        "be told, and counts here as not told.",
        (["convention", "told", "nothing hidden: right", "an effect hidden: right"], by_kind),
        {"cases": len(rows), "program": several(programs), "machine": machine(),
         "median time [s]": f"{statistics.median(row['time_s'] for row in rows):.0f}"}]
    if wrong:
        parts += ["## Not right", (["case", "conventions", "answer", "by our own conventions"], wrong)]
    return markdown_page("Foreign conventions", parts)


def arguments():
    parser = OneLineParser("study conventions", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=whole(1), default=64, help="how many; every second one hides an effect (default: 64)")
    parser.add_argument("--effects", nargs="+", default=[], help="only these of the catalogue")
    parser.add_argument("--seed", type=whole(0), default=1, help="of the cases (default: 1)")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count(), help="threads (default: all cores)")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    return parser.parse_args()


def main():
    options = arguments()
    rows, programs = [], set()
    for number in range(options.cases):
        asked = Asked(Case(options.seed, number, number < ALONE, number % 2 == 1), options)
        result = asked.result() or asked.carry_out()
        programs.add(result["commit"])
        rows.append(judged(asked, result))
        say(f"{number + 1} of {options.cases}: {asked.case.name}: {'right' if rows[-1]['right'] else 'wrong'}: "
            f"{rows[-1]['answer']} ({rows[-1]['time_s']:.0f} s)")
        write(f"{options.out}/conventions.json", json.dumps(rows, indent=1))
        text = page(rows, programs)
        write(f"{options.out}/conventions.md", text)
    if of_the_study(options) and not options.effects:
        os.makedirs("studies", exist_ok=True)
        write(DOCUMENT, text)


if __name__ == "__main__":
    start(main)
