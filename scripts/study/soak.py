#!/usr/bin/python3
"""Study of long runs, each part on a ROS master of its own: `arm` is the simulator with posture player, motion capture by
virtual cameras and rosbag, `recorder` steps another simulator and records trajectories, `driver` is driver, emulated units,
posture player and rosbag, where a CAN bus vcan0 is (scripts/with_vcan.sh ./catkin_ws.sh study soak --part driver). Notes
memory, descriptors and threads of every process for --hours.

Memory must grow by less than 1 MB/h after the first ten minutes, descriptors and threads not at all. A run cannot be
continued: it begins anew. Writes build/study/soak.json and studies/soak.md.
"""

import argparse
import glob
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time

import yaml
from _study import OUT, OneLineParser, commit, machine, markdown_page, of_the_study, refuse, say, start, write

DOCUMENT = "studies/soak.md"
PARTS = ["arm", "recorder", "driver"]
BUS = "/sys/class/net/vcan0"
PERIOD = 10.0     # [s] between two looks
SETTLED = 600.0   # [s] that count as the start
MOST = 1.0        # [MB/h]
PAGE = os.sysconf("SC_PAGE_SIZE")
SHELL = ["bash", "-c", 'source devel/setup.bash && exec "$@"', "soak"]


def hours(word):
    try:
        value = float(word)
    except ValueError:
        value = 0.0
    if not 0.0 < value < 1000.0:
        raise argparse.ArgumentTypeError(f"{word}: expected a number of hours above 0")
    return value


def pace(word):
    try:
        value = float(word)
    except ValueError:
        value = 0.0
    if not 0.0 < value <= 1.0:
        raise argparse.ArgumentTypeError(f"{word}: expected a number in (0, 1]")
    return value


def arguments():
    parser = OneLineParser("study soak", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hours", type=hours, default=2.0, help="how long (default: 2)")
    parser.add_argument("--part", action="append", choices=PARTS, default=[], help="only this one; may be given several times")
    parser.add_argument("--pace", type=pace, default=1.0, help="speed of simulator and emulated units, in (0, 1] (default: 1)")
    parser.add_argument("--out", default=OUT, help="folder of the results (default: build/study, and studies/)")
    return parser.parse_args()


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def long_postures(folder, length):
    """The demo's postures, again and again for so many seconds."""
    with open("config/anthrob/demo_postures.yaml") as file:
        content = yaml.safe_load(file)
    name = next(key for key, value in content.items() if isinstance(value, list))
    content[name] = content[name] * (1 + int(length / 5.0))
    path = os.path.join(folder, "postures.yaml")
    with open(path, "w") as file:
        yaml.safe_dump(content, file)
    return path


def long_protocol(folder):
    """Trajectories again and again, for days."""
    with open("config/anthrob/record_tier2_trajectories.yaml") as file:
        content = yaml.safe_load(file)
    content["postures"] = os.path.abspath(os.path.join("config/anthrob", content["postures"]))
    content["repeats"] = 1000
    path = os.path.join(folder, "protocol.yaml")
    with open(path, "w") as file:
        yaml.safe_dump(content, file)
    return path


class Part:
    """Programs of one ROS master."""

    def __init__(self, folder, name, commands):
        self.name, self.commands = name, commands
        self.port = str(free_port())
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{self.port}"}
        self.log = open(os.path.join(folder, name + ".log"), "w")
        self.running = [self.launch(command) for command in commands]

    def launch(self, command):
        return subprocess.Popen(SHELL + ["roslaunch", "-p", self.port, *command], env=self.environment, stdout=self.log,
                                stderr=subprocess.STDOUT, start_new_session=True)

    def ended(self):
        """@return what ended and should not have, or None"""
        for command, program in zip(self.commands, self.running):
            if program.poll() is not None:
                return f"{self.name}: {' '.join(command)} ended with {program.returncode}"
        return None

    def processes(self):
        """By process number: the name of the node, or of the program."""
        found = {}
        for environment in glob.glob("/proc/[0-9]*/environ"):
            try:
                with open(environment) as file:
                    masters = [word for word in file.read().split("\0") if word.startswith("ROS_MASTER_URI=")]
                with open(os.path.join(os.path.dirname(environment), "cmdline")) as file:
                    words = file.read().split("\0")
            except (OSError, UnicodeDecodeError):
                continue  # it ended meanwhile, or is somebody else's
            if masters and masters[-1].rstrip("/").endswith(":" + self.port) and words[0] and words[0] != "bash":
                found[int(environment.split("/")[2])] = f"{self.name}: {node_of(words)}"
        return found

    def end(self):
        for program in self.running:
            if program.poll() is None:
                os.killpg(program.pid, signal.SIGTERM)
        for program in self.running:
            try:
                program.wait(60)
            except subprocess.TimeoutExpired:
                os.killpg(program.pid, signal.SIGKILL)
        self.log.close()


def node_of(words):
    named = [word.split(":=")[1] for word in words if word.startswith("__name:=")]
    scripts = [word for word in words[:3] if word and not word.startswith("-")]
    # Anonymous nodes have the host's name, a process and a random number at their end.
    return re.sub(r"_[^_]+_\d+_\d+$", "", named[0]) if named else os.path.basename(scripts[-1] if "python" in scripts[0] else scripts[0])


def measured(pid):
    """Resident memory [MB], descriptors, threads; None if the process has ended."""
    try:
        with open(f"/proc/{pid}/statm") as file:
            resident = int(file.read().split()[1]) * PAGE / 1e6
        return resident, len(os.listdir(f"/proc/{pid}/fd")), len(os.listdir(f"/proc/{pid}/task"))
    except OSError:
        return None


def slope(course):
    """Of memory after the start, by least squares [MB/h]; None if there is too little of it."""
    later = [(t / 3600.0, values[0]) for t, values in course if t - course[0][0] > SETTLED]
    if len(later) < 10 or later[-1][0] - later[0][0] < SETTLED / 3600.0:
        return None
    mean_t = sum(t for t, _ in later) / len(later)
    mean = sum(m for _, m in later) / len(later)
    return sum((t - mean_t) * (m - mean) for t, m in later) / sum((t - mean_t) ** 2 for t, _ in later)


def commands(name, folder, length, pace):
    """Of a part: what roslaunch is called with."""
    folder = os.path.abspath(folder)
    play = ["--wait", "anthrob_bringup", "soak.launch", f"postures:={long_postures(folder, length)}",
            f"bag:={os.path.join(folder, name + '.bag')}"]
    if name == "arm":
        return [["anthrob_bringup", "sim.launch", "mocap:=virtual", "rviz:=false", f"rate:={pace}"], [*play, f"pace:={pace}"]]
    if name == "recorder":
        return [["anthrob_bringup", "record.launch", f"protocol_file:={long_protocol(folder)}",
                 f"out:={os.path.join(folder, 'recordings')}"]]
    return [["anthrob_bringup", "robot.launch", "backend:=emulated", "homed:=true", f"pace:={pace}"],
            [*play, "enable:=true", f"pace:={pace}"]]


def watch(parts, length):
    """Of every process: [(time [s], (memory [MB], descriptors, threads))]. Ends early if a program does."""
    courses, begin, told = {}, time.time(), 0.0
    while time.time() - begin < length:
        now = time.time() - begin
        for part in parts:
            ended = part.ended()
            if ended:
                return courses, ended
            for pid, name in part.processes().items():
                values = measured(pid)
                if values:
                    courses.setdefault((name, pid), []).append((now, values))
        if now - told > 60.0:
            told = now
            say(f"{now / 60:.0f} of {length / 60:.0f} min, {(length - now) / 60:.0f} min left")
        time.sleep(PERIOD)
    return courses, None


def rows_of(courses, length):
    rows = []
    for (name, _), course in sorted(courses.items()):
        if course[-1][0] - course[0][0] < 0.5 * length:
            continue  # it ended as it should
        grows, first, last = slope(course), course[len(course) // 10][1], course[-1][1]
        # A descriptor more or less: somebody connects just now.
        good = (grows is None or grows < MOST) and last[1] <= first[1] + 2 and last[2] <= first[2] + 1
        rows.append({"process": name, "memory_MB": [first[0], last[0]], "slope_MB_per_h": grows, "descriptors": [first[1], last[1]],
                     "threads": [first[2], last[2]], "good": good})
    return rows


def page(rows, facts):
    def both(values, form="%d"):
        return " ".join(form % value for value in values)

    head = ["process", "memory [MB], after a tenth and at the end", "growth [MB/h]", "descriptors", "threads"]
    table = [[row["process"], both(row["memory_MB"], "%.1f"),
              "-" if row["slope_MB_per_h"] is None else "%.2f" % row["slope_MB_per_h"], both(row["descriptors"]),
              both(row["threads"])] for row in rows]
    return markdown_page("Long runs", [
        "`./catkin_ws.sh study soak` runs the arm with everything that measures and records it, and notes what each process "
        "has. Growth is a straight line through the memory after the first ten minutes. The recorder tabulates all its "
        "recordings after each of them, so it grows with their number, not with time.", (head, table), facts])


def main():
    options = arguments()
    names = options.part or [part for part in PARTS if part != "driver" or os.path.exists(BUS)]
    if "driver" in names and not os.path.exists(BUS):
        refuse("--part driver: no vcan0: expected to run under scripts/with_vcan.sh, or on a kernel with vcan")
    if "driver" not in names:
        say("without driver and emulated units")
    folder = os.path.join(options.out, "soak")
    os.makedirs(folder, exist_ok=True)
    length = 3600.0 * options.hours
    parts = [Part(folder, name, commands(name, folder, length, options.pace)) for name in names]
    try:
        courses, ended = watch(parts, length)
    finally:
        for part in parts:
            part.end()
    if ended:
        refuse(f"{ended}: see {folder}/")
    rows = rows_of(courses, length)
    facts = {"hours": options.hours, "commit": commit(), "machine": machine()}
    write(os.path.join(options.out, "soak.json"), json.dumps({**facts, "processes": rows}, indent=2) + "\n")
    if of_the_study(options):
        os.makedirs(os.path.dirname(DOCUMENT), exist_ok=True)
        write(DOCUMENT, page(rows, facts))
    bad = [row["process"] for row in rows if not row["good"]]
    if bad:
        say(f"grows: {', '.join(bad)}")
        sys.exit(1)


if __name__ == "__main__":
    start(main, continues=False)
