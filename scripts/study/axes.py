#!/usr/bin/python3
"""Study of driven axes. Benches that share nothing with the simulator (scripts/study/_bench.py), over eight decades of
inertia, ruled by friction or by inertia, with encoders of 12 to 20 bits and rows of 25 to 1000 Hz. Each hides one law of
ten, nothing among them; discovery gets CSV files and a model. With --drives, the benches have a servo drive
(scripts/study/_servo.py), and the results go to build/study/drives.json and studies/drives.md.

The same command continues an interrupted study; what another version of the program has answered is asked again. Writes
build/study/axes.json and studies/axes.md.
"""

import json
import os
import shutil
import statistics

import _bench
import _servo
from _study import (OUT, OneLineParser, commit, machine, markdown_page, of_the_study, say, several, start, whole,
                    write)
from real import Case, gap_text, is_answer, is_rival

HEAD = ["law", "cases", "named", "in a class", "median error of its size", "interval holds it", "more than it", "payload"]
SIZES = {"joint_coulomb": "torque", "joint_coulomb_asymmetric": "forward", "joint_presliding": "torque",
         "joint_lugre": "torque", "joint_quadratic_drag": "drag", "joint_effort_friction": "share", "effort_gain": "gain",
         "payload": "mass", **_servo.SIZES}


def kind(options):
    return "drives" if options.drives else "axes"


class Axis(Case):
    """A bench, whose files are made when they are needed and deleted when it has been answered."""

    def __init__(self, bench, options):
        self.bench = bench
        folder = os.path.join(options.out, kind(options), f"seed_{options.seed}")
        self.made = os.path.join(folder, "made", bench.name)
        self.options, self.name = options, bench.name
        self.out = os.path.join(folder, bench.name)
        self.log = os.path.join(self.out, "log.txt")

    def key(self):
        return f"{commit()} {self.options.effects}"

    def ask(self):
        self.bench.write(self.made)
        super().__init__(self.made, self.options)
        self.out = os.path.join(os.path.dirname(os.path.dirname(self.made)), self.name)
        self.log = os.path.join(self.out, "log.txt")
        self.case.content["options"] = {"effects": self.options.effects} if self.options.effects else {}
        result = self.examine()
        for folder in self.made, os.path.join(self.out, "data"):
            shutil.rmtree(folder, ignore_errors=True)
        return result


def judged(bench, result):
    """How the answer compares with what is hidden."""
    row = {"case": bench.name, "law": bench.law, "answer": result.get("failed", result.get("verdict", "")), "named": False,
           "in_class": False, "more": 0, "payload": False, "time_s": result["time_s"]}
    if "failed" in result:
        return row
    effects = result["effects"]
    row["answer"] = ", ".join(effect["id"] for effect in effects) or result["verdict"]
    row["gap"] = gap_text(result["gap"])
    row["payload"] = any(effect["id"] == "payload" for effect in effects)
    if bench.law == "none":
        row["named"] = result["verdict"] == "no_missing_effect"
        return row
    wanted = {"id": bench.law}
    named = [effect for effect in effects if is_answer(wanted, [effect])]
    row["named"], row["in_class"] = bool(named), not named and is_rival(wanted, result)
    # A law may be declared to be as good as two others together.
    together = [len(other["instead_of"]) for other in result["alternatives"] if is_answer(wanted, [other])]
    row["more"] = len(effects) - (1 if named else max(together, default=int(row["in_class"])))
    if named and bench.law in SIZES:
        found, true = named[0]["parameters"][SIZES[bench.law]], bench.truth[SIZES[bench.law]]
        origin = 1.0 if bench.law == "effort_gain" else 0.0
        row["error"] = abs(found["value"] - true) / abs(true - origin)
        row["holds"] = found["ci95"][0] <= true <= found["ci95"][1]
    return row


def share(rows, name):
    asked = [row[name] for row in rows if name in row]
    return f"{sum(asked)} of {len(asked)}" if asked else "-"


def median(rows):
    errors = [row["error"] for row in rows if "error" in row]
    return f"{100 * statistics.median(errors):.1f} %" if errors else "-"


def table(rows):
    kinds = [(law, [row for row in rows if row["law"] == law]) for law in dict.fromkeys(row["law"] for row in rows)]
    kinds.append(("all but none", [row for row in rows if row["law"] != "none"]))
    return HEAD, [[name, str(len(those)), share(those, "named"), share(those, "in_class"), median(those),
                   share(those, "holds"), str(sum(row["more"] > 0 for row in those)),
                   str(sum(row["payload"] for row in those))] for name, those in kinds if those]


def page(rows, options, programs):
    wrong = [[row["case"], row["answer"], row.get("gap", "")] for row in rows if not (row["named"] or row["in_class"])]
    drives = ("`./catkin_ws.sh study axes --drives` makes benches of one hinge with a servo drive by their closed equation: "
              "motor, gear with losses, rotor of 0.1 to 3 times the arm's inertia, a P controller, encoders of 12 to 16 bits at "
              "motor and joint, rows of 100 to 500 Hz. Three recordings of 20 s: to fit, to judge, a repetition. For `none`, "
              "*named* means that nothing was.")
    parts = [drives if options.drives else
             "`./catkin_ws.sh study axes` makes benches of one driven hinge by their closed equation: inertia of 1e-6 to 100 "
             "kg m^2, ruled by friction or by inertia, encoders of 12 to 20 bits, rows of 25 to 1000 Hz, noise of the effort "
             "of 0.5 to 5 %. What is hidden takes 0.15 to 1 times the effort of all that is known. Three recordings of 30 s: "
             "to fit, to judge, a repetition. For `none`, *named* means that nothing was.",
             table(rows), {"seed": options.seed, "cases": len(rows), "program": several(programs), "machine": machine(),
                           "median time [s]": f"{statistics.median(row['time_s'] for row in rows):.0f}"}]
    if wrong:
        parts += ["## Neither named nor in a class", (["case", "answer", "gap"], wrong)]
    return markdown_page("Servo drives" if options.drives else "Driven axes", parts)


def arguments():
    parser = OneLineParser("study axes", description=__doc__)
    parser.add_argument("--cases", type=whole(1), default=40, help="benches of each law (default: 40)")
    parser.add_argument("--drives", action="store_true", help="benches with a servo drive")
    parser.add_argument("--law", action="append", choices=sorted({*_bench.LAWS, *_servo.LAWS}), default=[],
                        help="only this one; may be given several times")
    parser.add_argument("--effects", nargs="+", default=[], help="only these of the catalogue")
    parser.add_argument("--seed", type=whole(0), default=1, help="of the benches (default: 1)")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count(), help="threads (default: all cores)")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    return parser.parse_args()


def main():
    options = arguments()
    bench, known = (_servo.Servo, _servo.LAWS) if options.drives else (_bench.Bench, _bench.LAWS)
    laws = [law for law in known if law in (options.law or known)]
    axes = [Axis(bench(options.seed, number, law), options) for number in range(options.cases) for law in laws]
    rows, programs = [], set()
    for axis in axes:
        os.makedirs(axis.out, exist_ok=True)
        result = axis.result() or axis.ask()
        programs.add(result["commit"])
        rows.append(judged(axis.bench, result))
        say(f"{len(rows)} of {len(axes)}: {axis.name}: {rows[-1]['answer']} ({result['time_s']:.0f} s)")
        write(f"{options.out}/{kind(options)}.json", json.dumps(rows, indent=1))
        text = page(rows, options, programs)
        write(f"{options.out}/{kind(options)}.md", text)
    if of_the_study(options) and not (options.law or options.effects):
        os.makedirs("studies", exist_ok=True)
        write(f"studies/{kind(options)}.md", text)


if __name__ == "__main__":
    start(main)
