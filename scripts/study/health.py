#!/usr/bin/python3
"""Study of health. A robot is tested once a day for 60 days (docs/health.md). In three of its tendons something grows from
some day on; the others stay as they are. When is what told, of which tendon, and what is told that is not there?

The robot is simulated, model II of Anthrob with errors of calibration, and its sensors have noise and counts. The same
command continues an interrupted study; what another version of the program has judged is judged again. Writes
build/study/health.json and studies/health.md.
"""

import csv
import datetime
import json
import math
import os
import random
import shutil
import statistics

import yaml

from _study import OUT, OneLineParser, commit, load, machine, markdown_page, must, of_the_study, say, several, start, whole, write

REPLAY = "devel/lib/anthrob_sim/anthrob_replay"
HEALTH = "devel/lib/anthrob_calib/anthrob_health"
MODEL = "config/anthrob/model_II.yaml"
DOCUMENT = "studies/health.md"
DAYS = 60
FIRST_DAY = datetime.date(2026, 1, 1)
MUSCLES = ["lateral_deltoid", "anterior_deltoid", "posterior_deltoid", "supraspinatus", "infraspinatus", "teres_minor",
           "teres_major", "pectoralis_major", "biceps_brachii", "triceps_brachii", "brachialis"]
NOISE = {"position": 0.0018, "velocity": 0.05, "current": 0.02, "force": 0.3}  # rad, rad/s, A, N
COUNT = {"force": 0.122}
TURN = 0.001  # noise of joints [rad]
# Effect, its parameter, what it has after 60 days, and the figures by which it may be told.
LAWS = {
    "creeping tendon": ("tendon_creep", "rate", lambda draw: draw.uniform(4e-5, 1e-4), {"creep", "zero"}),
    "wearing motor": ("motor_friction", "torque", lambda draw: draw.uniform(8e-4, 2e-3), {"friction"}),
    "softening tendon": ("tendon_elasticity", "compliance", lambda draw: draw.uniform(1.5e-4, 4e-4), {"stiffness", "zero"}),
    "drifting zero of a force sensor": ("force_sensor_offset", "offset", lambda draw: draw.uniform(3.0, 8.0), {"force_offset"}),
    "drifting gain of a force sensor": ("force_sensor_gain", "gain", lambda draw: draw.uniform(0.25, 0.5),
                                        {"stiffness", "current_gain", "zero"}),
    "corroding contact of a motor": ("series_resistance", "resistance", lambda draw: draw.uniform(0.2, 0.5), {"resistance"}),
}


def date_of(day):
    return f"{FIRST_DAY + datetime.timedelta(days=day)}T08:00:00Z"


def lengths():
    """Tendon lengths of the model [m]."""
    with open(MODEL) as text:
        return {name: muscle["rest_tendon_length"] for name, muscle in yaml.safe_load(text)["muscles"].items()}


class Robot:
    """A robot, whose errors and changes are drawn before anything is simulated."""

    def __init__(self, options, number):
        self.name = f"robot_{number:02d}"
        self.options = options
        self.folder = os.path.join(options.out, "health", f"seed_{options.seed}", self.name)
        self.log = os.path.join(self.folder, "log.txt")
        draw = random.Random(f"{options.seed}/{number}")
        self.length = {m: length + draw.uniform(-5e-4, 5e-4) for m, length in lengths().items()}
        self.changes = []
        for muscle, law in zip(draw.sample(MUSCLES, 3), draw.sample(sorted(LAWS), 3)):
            self.changes.append({"muscle": muscle, "law": law, "from": draw.randint(10, 30), "size": LAWS[law][2](draw)})

    def effects(self, day):
        effects = []
        for change in self.changes:
            effect, parameter, _, _ = LAWS[change["law"]]
            share = max(0.0, (day - change["from"]) / (DAYS - change["from"]))
            size = share * change["size"] + (1.0 if effect == "force_sensor_gain" else 0.0)
            if share > 0.0:
                effects.append({"id": effect, "place": change["muscle"], parameter: size})
        return effects

    def model(self, day):
        muscles = {m: {"rest_tendon_length": self.length[m]} for m in MUSCLES}
        return json.dumps({"extends": os.path.abspath(MODEL), "muscles": muscles, "effects": self.effects(day)})

    def measured(self, day):
        """What the robot's sensors say of the test of a day."""
        model, out = os.path.join(self.folder, "robot.yaml"), os.path.join(self.folder, "test")
        write(model, self.model(day))
        shutil.rmtree(out, ignore_errors=True)
        must([REPLAY, "--model", model, "--in", os.path.join(self.folder, "commands"), "--out", out], self.log)
        draw = random.Random(f"{self.options.seed}/{self.name}/{day}")
        for table in "muscles", "joints":
            add_noise(os.path.join(out, f"{table}.csv"), draw)
        return out

    def result(self):
        file = os.path.join(self.folder, "result.json")
        stored = load(file) if os.path.exists(file) else None
        return stored if stored and stored["commit"] == commit() else None

    def carry_out(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        must([HEALTH, "commands", "--model", MODEL, "--out", os.path.join(self.folder, "commands")], self.log)
        history, told, moved = os.path.join(self.folder, "history"), [], 0.0
        for day in range(DAYS):
            out = self.measured(day)
            moved = max(moved, largest_turn(out))
            must([HEALTH, "judge", "--model", MODEL, "--in", out, "--history", history, "--time", date_of(day)], self.log)
            told.append(load(os.path.join(history, "health.json")))
        result = {"commit": commit(), "robot": self.name, "moved_deg": moved, "changes": self.changes,
                  "judged": [judged(change, told) for change in self.changes],
                  "others": others(self.changes, told), "tendon_days": (len(MUSCLES) - len(self.changes)) * DAYS}
        shutil.rmtree(os.path.join(self.folder, "test"))
        write(os.path.join(self.folder, "result.json"), json.dumps(result, indent=1))
        return result


def read_csv(file):
    with open(file) as text:
        rows = list(csv.reader(text))
    return rows[0], rows[1:]


def add_noise(file, draw):
    head, rows = read_csv(file)
    for at, name in enumerate(head):
        owner, _, quantity = name.partition("/")
        noise = NOISE.get(quantity) if owner in MUSCLES else TURN if quantity == "position" else None
        if not noise:
            continue
        for row in rows:
            if row[at]:
                value = float(row[at]) + draw.gauss(0.0, noise)
                if quantity in COUNT:
                    value = COUNT[quantity] * round(value / COUNT[quantity])
                row[at] = repr(value)
    with open(file, "w") as out:
        csv.writer(out, lineterminator="\n").writerows([head, *rows])


def largest_turn(folder):
    """Of any joint from where it was at the beginning [degrees]."""
    largest = 0.0
    for table in "joints", "spherical_joints":
        head, rows = read_csv(os.path.join(folder, f"{table}.csv"))
        for at, name in enumerate(head):
            if name.endswith("/w"):
                turns = [2.0 * math.acos(min(1.0, abs(sum(float(rows[0][at + k]) * float(r[at + k]) for k in range(4)))))
                         for r in rows]
                largest = max(largest, *turns)
            if name == "elbow/position":
                # The potentiometer's noise is no motion.
                means = [statistics.mean(float(r[at]) for r in rows[i:i + 50]) for i in range(0, len(rows) - 50, 50)]
                largest = max(largest, *(abs(mean - means[0]) for mean in means))
    return math.degrees(largest)


def judged(change, told):
    """When a change was told, and as what."""
    expected = LAWS[change["law"]][3]
    for day, report in enumerate(told):
        own = [f for f in report["findings"] if f["muscle"] == change["muscle"]]
        if not own:
            continue
        figures = {f["quantity"]: f for t in report["tendons"] if t["muscle"] == change["muscle"] for f in t["figures"]}
        sizes = [abs(figures[q]["change"]) / figures[q]["visible"] for f in own for q in f["quantities"]]
        return {"day": day, "grown": True, "right": any(set(f["quantities"]) & expected for f in own), "early": day <= change["from"],
                "cause": own[0]["text"], "visible_sizes": max(sizes), "limits": limits_of(own, figures),
                "last": [f["text"] for f in told[-1]["findings"] if f["muscle"] == change["muscle"]]}
    # Of what has not grown beyond what would be certain, nothing can be said.
    last = {f["quantity"]: f for t in told[-1]["tendons"] if t["muscle"] == change["muscle"] for f in t["figures"]}
    grown = any(abs(last[q]["change"]) > last[q]["visible"] for q in expected if q in last)
    return {"day": None, "grown": grown, "right": False, "early": False, "cause": "", "visible_sizes": None, "limits": None, "last": []}


def limits_of(findings, figures):
    return max(abs(figures[q]["change"]) / figures[q]["limit"] for f in findings for q in f["quantities"])


def others(changes, told):
    """What was told of tendons in which nothing changes."""
    changed = {change["muscle"] for change in changes}
    return [f"day {day}: {finding['text']}" for day, report in enumerate(told)
            for finding in report["findings"] if finding["muscle"] not in changed]


def page(results):
    rows = []
    for law in LAWS:
        own = [(r, c, j) for r in results for c, j in zip(r["changes"], r["judged"]) if c["law"] == law]
        found = [(c, j) for _, c, j in own if j["day"] is not None]
        grown = sum(j["grown"] for _, _, j in own)
        rows.append([law, str(len(own)), f"{sum(j['right'] and not j['early'] for _, j in found)} of {grown}",
                     *(f"{statistics.median(values):.2g}" if values else "-" for values in (
                         [j["day"] - c["from"] for c, j in found], [j["visible_sizes"] for _, j in found],
                         [j["limits"] for _, j in found]))])
    false = [f"{r['robot']}: {line}" for r in results for line in r["others"]]
    parts = [
        "`./catkin_ws.sh study health` tests simulated robots once a day for 60 days. In three tendons of each, something "
        "grows from some day on, differently fast. *Told*: the first finding about this tendon comes after the change begins "
        "and has the right figure; of those that grew to a size that can be certain. *Visible*: the change when it was told, over the smallest one that would be certain.",
        (["what grows", "tendons", "told", "days until then (median)", "of visible", "of the limit"], rows),
        {"robots": len(results), "told of tendons in which nothing changes": f"{len(false)} in "
         f"{sum(r['tendon_days'] for r in results)} days of a tendon",
         "largest motion of a joint in any test": f"{max(r['moved_deg'] for r in results):.2f} degrees",
         "program": several(r["commit"] for r in results), "machine": machine()}]
    if false:
        parts += ["## Told, and not there", {line.split(": ", 1)[0] + f" ({i})": line.split(": ", 1)[1]
                                               for i, line in enumerate(false)}]
    return markdown_page("Health", parts)


def arguments():
    parser = OneLineParser("study health", description=__doc__)
    parser.add_argument("--robots", type=whole(1), default=6, help="how many (default: 6)")
    parser.add_argument("--seed", type=whole(0), default=1, help="of the robots (default: 1)")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    return parser.parse_args()


def main():
    options = arguments()
    results = []
    for number in range(options.robots):
        robot = Robot(options, number)
        results.append(robot.result() or robot.carry_out())
        for change, one in zip(results[-1]["changes"], results[-1]["judged"]):
            say(f"{robot.name}: {change['law']} of {change['muscle']} from day {change['from']}: "
                f"day {one['day']}: {one['cause'] or 'never told'}")
        for line in results[-1]["others"]:
            say(f"{robot.name}: {line}")
        write(os.path.join(options.out, "health.json"), json.dumps(results, indent=1))
    text = page(results)
    write(os.path.join(options.out, "health.md"), text)
    if of_the_study(options):
        os.makedirs("studies", exist_ok=True)
        write(DOCUMENT, text)


if __name__ == "__main__":
    start(main)
