#!/usr/bin/python3
"""The benchmark of real data. Each subfolder of --data with a case.yaml is a case: files of a real machine, how they are
converted, a model that lacks something, and what is known to be missing (docs/tools.md has the keys). Converts the files,
runs discovery, and prints expected | answer | size | gap | time.

A case that is done is not run again, unless its files or the program have changed. Results go to build/study/real/,
build/study/real.json and build/study/real.md; nothing goes to studies/, since the data are not part of this workspace.
"""

import hashlib
import json
import os
import shutil
import time

import yaml
from _study import OUT, OneLineParser, commit, load, machine, markdown_page, refuse, run, say, several, start, whole, write

CONVERT = "devel/lib/anthrob_recording/anthrob_convert"
DISCOVER = "devel/lib/anthrob_discovery/anthrob_discover"
VERDICTS = ["effects_found", "no_missing_effect", "unexplained", "cannot_tell"]
HEAD = ["case", "expected", "answer", "size", "gap", "time", ""]
KEYS = {"model", "convert", "train", "test", "repeat", "calibration", "options", "expected", "notes"}
OPTIONS = {"effects", "max_effects", "seed", "dt"}  # of anthrob_discover


class CaseFile:
    """case.yaml, checked: file, key, value, what was expected."""

    def __init__(self, folder):
        self.folder = folder
        self.file = os.path.join(folder, "case.yaml")
        try:
            with open(self.file) as text:
                self.content = yaml.safe_load(text)
        except (OSError, yaml.YAMLError) as error:
            refuse(f"{self.file}: {' '.join(str(error).split())}")
        self.require_keys("", self.content, KEYS)
        self.made = [self.conversion(i, item) for i, item in enumerate(self.list("convert"))]
        for key in "train", "test":
            if not self.list(key):
                self.fail(key, self.content.get(key), "a list of recordings")
        if not isinstance(self.content.get("model"), str):
            self.fail("model", self.content.get("model"), "a model file beside case.yaml, or a name such as anthrob/II")
        self.require_keys("options", self.content.get("options") or {}, OPTIONS)
        self.check_expected(self.content.get("expected"))

    def fail(self, key, value, expected):
        refuse(f"{self.file}: {key}: {value}: expected {expected}")

    def require_keys(self, key, content, known):
        if not isinstance(content, dict):
            self.fail(key or "case.yaml", content, "a map")
        for name in content:
            if name not in known:
                self.fail(f"{key}.{name}" if key else name, content[name], f"one of the keys {', '.join(sorted(known))}")

    def list(self, key):
        value = self.content.get(key) or []
        if not isinstance(value, list):
            self.fail(key, value, "a list")
        return value

    def conversion(self, place, item):
        key = f"convert.{place}"
        self.require_keys(key, item, {"from", "columns", "to"})
        for name in "from", "columns", "to":
            if not isinstance(item.get(name), str) and (name in item or name != "columns"):
                self.fail(f"{key}.{name}", item.get(name), "a name")
        if os.path.basename(item["to"]) != item["to"] or item["to"] in ("", ".", ".."):
            self.fail(f"{key}.to", item["to"], "the name of a data set, without a folder")
        return item

    def check_expected(self, expected):
        if expected is None or expected in VERDICTS[1:]:
            return
        if not isinstance(expected, list) or not expected:
            self.fail("expected", expected, f"{' or '.join(VERDICTS[1:])}, or a list of effects")
        for i, effect in enumerate(expected):
            self.require_keys(f"expected.{i}", effect, {"id", "place", "sizes"})
            if not isinstance(effect.get("id"), (str, list)):
                self.fail(f"expected.{i}.id", effect.get("id"), "the id of an effect, or a list of ids")
            sizes = effect.get("sizes") or {}
            for name, ends in sizes.items() if isinstance(sizes, dict) else [("", sizes)]:
                if not (isinstance(ends, list) and len(ends) == 2 and all(isinstance(end, (int, float)) for end in ends)):
                    self.fail(f"expected.{i}.sizes.{name}", ends, "[low, high]")


def wanted_ids(effect):
    return [effect["id"]] if isinstance(effect["id"], str) else effect["id"]


class Case:

    def __init__(self, folder, options):
        self.name = os.path.basename(folder)
        self.case = CaseFile(folder)
        self.options = options
        self.out = os.path.join(options.out, "real", self.name)
        self.log = os.path.join(self.out, "log.txt")

    def path(self, name):
        """Of a file or recording that case.yaml names: what a conversion makes, or what lies beside case.yaml."""
        if name.split("/")[0] in [item["to"] for item in self.case.made]:
            return os.path.join(self.out, "data", name)
        beside = os.path.join(self.case.folder, name)
        return beside if os.path.exists(beside) else name

    def key(self):
        """Of everything on which the answer depends."""
        digest = hashlib.sha256(commit().encode())
        for root, folders, files in os.walk(self.case.folder):
            folders.sort()
            for file in sorted(files):
                path = os.path.join(root, file)
                digest.update(f"{os.path.relpath(path, self.case.folder)}\n".encode())
                with open(path, "rb") as content:
                    digest.update(content.read())
        return digest.hexdigest()

    def result(self):
        """The stored result, if it is that of these files and this program."""
        file = os.path.join(self.out, "result.json")
        stored = load(file) if os.path.exists(file) else None
        return stored if stored and stored["key"] == self.key() else None

    def conversions(self):
        for item in self.case.made:
            columns = ["--columns", self.path(item["columns"])] if "columns" in item else []
            yield [CONVERT, *columns, self.path(item["from"]), self.path(item["to"])]

    def question(self):
        content = self.case.content
        words = [DISCOVER, "--model", self.path(content["model"])]
        for key in "train", "test", "repeat":
            recordings = [self.path(str(name)) for name in content.get(key) or []]
            words += [f"--{key}", *recordings] if recordings else []
        if content.get("calibration"):
            words += ["--calibration", self.path(content["calibration"])]
        for key, value in sorted((content.get("options") or {}).items()):
            words += [f"--{key.replace('_', '-')}", *map(str, value if isinstance(value, list) else [value])]
        return words + ["--out", os.path.join(self.out, "found"), "--jobs", str(self.options.jobs)]

    def begin(self, key):
        """Keeps what an interrupted run of the same question left; discovery continues there."""
        begun = os.path.join(self.out, "begun")
        if not os.path.exists(begun) or load(begun) != key:
            shutil.rmtree(self.out, ignore_errors=True)
            os.makedirs(self.out)
            write(begun, json.dumps(key))

    def examine(self):
        key, began = self.key(), time.time()
        self.begin(key)
        result = {"case": self.name, "key": key, "commit": commit(), "machine": machine()}
        for command in [*self.conversions(), self.question()]:
            if run(command, self.log) != 0:
                result["failed"] = self.last_line()
                break
        else:
            report = load(os.path.join(self.out, "found", "report.json"))
            result.update({name: report[name] for name in (
                "verdict", "effects", "alternatives", "improbable", "remarks", "gap")})
        result["time_s"] = time.time() - began
        result["judgement"] = judgement(self.case.content.get("expected"), result)
        result["expected"] = self.case.content.get("expected")
        write(os.path.join(self.out, "result.json"), json.dumps(result, indent=1))
        return result

    def last_line(self):
        with open(self.log, errors="replace") as text:
            return ([line.strip() for line in text if line.strip()] or ["failed without a word"])[-1]


def is_answer(wanted, laws):
    """Whether one of these laws is the wanted one, at its place."""
    return any(law["id"] in wanted_ids(wanted) and wanted.get("place", law["place"]) == law["place"] for law in laws)


def is_rival(wanted, result):
    """Whether the report declares the wanted law to be as good as something that it names."""
    return any(is_answer(wanted, effect["rivals"]) for effect in result["effects"]) or \
        is_answer(wanted, result["alternatives"])


def judgement(expected, result):
    """right; in class: a rival of what was named; wrong; failed; empty: nobody knows."""
    if "failed" in result:
        return "failed"
    if expected is None:
        return ""
    if isinstance(expected, str):
        return "right" if result["verdict"] == expected else "wrong"
    worst = "right"
    for wanted in expected:
        named = [effect for effect in result["effects"] if is_answer(wanted, [effect])]
        if not named and not is_rival(wanted, result):
            return "wrong"
        if not named:
            worst = "in class"
            continue
        for name, (low, high) in (wanted.get("sizes") or {}).items():
            value = named[0]["parameters"].get(name, {}).get("value")
            if value is None or not low <= value <= high:
                return "wrong size"
    return worst if len(result["effects"]) <= len(expected) else "right and more" if worst == "right" else worst


def expected_text(expected):
    if expected is None:
        return "unknown"
    if isinstance(expected, str):
        return expected
    return ", ".join(" or ".join(wanted_ids(effect)) + (f" {effect['place']}" if "place" in effect else "")
                     for effect in expected)


def size_text(effect):
    sizes = []
    for name, size in effect["parameters"].items():
        if not size.get("known") and size["value"] is not None:
            low, high = size["ci95"]
            sizes.append(f"{name} {size['value']:.3g} [{low:.3g}, {high:.3g}] {size['unit']}".strip())
    return ", ".join(sizes)


def gap_text(gap):
    shown = [gap["test"].get(name) for name in ("before", "recalibrated", "after")]
    return " / ".join("-" if value is None else f"{value:.3g}" for value in shown)


def row(result):
    seconds = f"{result['time_s']:.0f} s"
    if "failed" in result:
        return [result["case"], expected_text(result["expected"]), result["failed"], "", "", seconds, result["judgement"]]
    named = [f"{effect['id']} {effect['place']} ({effect['probability']:.2g})" for effect in result["effects"]]
    return [result["case"], expected_text(result["expected"]), ", ".join(named) or result["verdict"],
            "; ".join(map(size_text, result["effects"])), gap_text(result["gap"]), seconds, result["judgement"]]


def page(results):
    counts = {}
    for result in results:
        counts[result["judgement"] or "unknown"] = counts.get(result["judgement"] or "unknown", 0) + 1
    facts = {"cases": len(results), "judged": several(f"{count} {word}" for word, count in counts.items()),
             "program": several(result["commit"] for result in results),
             "machine": several(result["machine"] for result in results)}
    return markdown_page("Real data", [
        facts, "The gap is that of the held-out recordings in floors: as given / recalibrated / with what was named.",
        (HEAD, list(map(row, results)))])


def find_cases(options):
    if not os.path.isdir(options.data):
        refuse(f"--data {options.data}: no such folder")
    found = sorted(folder.path for folder in os.scandir(options.data)
                   if folder.is_dir() and os.path.exists(os.path.join(folder.path, "case.yaml")))
    if not found:
        refuse(f"--data {options.data}: no subfolder with a case.yaml")
    names = [os.path.basename(folder) for folder in found]
    for name in options.case:
        if name not in names:
            refuse(f"--case {name}: expected one of: {', '.join(names)}")
    return [Case(folder, options) for folder in found if not options.case or os.path.basename(folder) in options.case]


def arguments():
    parser = OneLineParser("study real", description=__doc__)
    parser.add_argument("--data", metavar="FOLDER", required=True, help="folder of the cases")
    parser.add_argument("--case", action="append", default=[], help="only this one; may be given several times")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count(), help="threads (default: all cores)")
    parser.add_argument("--out", default=OUT, help=f"folder of the results (default: {OUT})")
    return parser.parse_args()


def main():
    options = arguments()
    cases = find_cases(options)  # all of them are checked before the first one is run
    os.makedirs(os.path.join(options.out, "real"), exist_ok=True)
    results = []
    for case in cases:
        result = case.result()
        if result is None:
            say(f"{case.name} ...")
            result = case.examine()
        results.append(result)
        print(" | ".join(row(result)), flush=True)
        write(f"{options.out}/real.json", json.dumps(results, indent=1))
        write(f"{options.out}/real.md", page(results))
    say(f"wrote {options.out}/real.json and {options.out}/real.md")


if __name__ == "__main__":
    start(main)
