"""What the studies share: steps that can be interrupted, files, facts about the run, tables."""

import argparse
import html
import json
import os
import shutil
import signal
import subprocess
import sys

OUT = "build/study"
BAD_INPUT, INTERRUPTED = 2, 130
PATIENCE = 30  # for a step that was interrupted to write down where it was [s]


def of_the_study(options):
    """What is run elsewhere, for a look at it, is not what the documents tell of."""
    return os.path.normpath(options.out) == OUT


def say(line):
    print(f"study: {line}", file=sys.stderr, flush=True)


def run(command, log):
    """Exit status of a step. The study ends where a step was interrupted."""
    with open(log, "a") as out:
        step = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)
        try:
            status = step.wait()
        except KeyboardInterrupt:
            step.terminate()  # if only the study was told
            try:
                step.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                step.kill()
                step.wait()
            raise
    if status in (INTERRUPTED, -signal.SIGINT, -signal.SIGTERM):
        raise KeyboardInterrupt
    return status


def must(command, log):
    """A step without which the study cannot go on."""
    if run(command, log) != 0:
        sys.exit(f"study: {' '.join(command)} failed: see {log}")


class OneLineParser(argparse.ArgumentParser):
    """Of a command line; what is wrong with one is said in a line, as by all tools."""

    def error(self, message):
        self.exit(BAD_INPUT, f"{self.prog}: {message} (--help explains)\n")


def refuse(line):
    say(line)
    sys.exit(BAD_INPUT)


def start(main):
    """Runs a study; Ctrl-C and a request to terminate are the same, and end with 130."""

    def interrupt(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, interrupt)
    try:
        main()
    except KeyboardInterrupt:
        say("interrupted; the same command goes on where it was")
        sys.exit(INTERRUPTED)
    except BrokenPipeError:
        # `--list | head`: nobody reads on. Without another place to go the interpreter complains when it ends.
        for stream in (sys.stdout, sys.stderr):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        sys.exit(1)


def load(file):
    with open(file) as text:
        return json.load(text)


def load_published(file):
    """What an earlier run, perhaps elsewhere, has left in the documents."""
    if not os.path.exists(file):
        refuse(f"{file}: no such file; expected what an earlier run has written")
    return load(file)


def write(file, content):
    part = f"{file}.{os.getpid()}.part"  # several slices may run beside each other
    with open(part, "w") as out:
        out.write(content)
    os.replace(part, file)


def machine():
    with open("/proc/cpuinfo") as info:
        names = [line.split(":")[1].strip() for line in info if line.startswith("model name")]
    return f"{len(names)} x {names[0]}" if names else "unknown"


def commit():
    """With -dirty where files are not as committed; documents, which studies write, do not count. Without git, unknown."""
    if not shutil.which("git"):
        return "unknown"

    def git(*words):
        return subprocess.run(["git", *words], capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs")
    return (git("rev-parse", "--short", "HEAD") or "unknown") + ("-dirty" if changed else "")


def several(values):
    return ", ".join(sorted({str(value) for value in values}))


def markdown_table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def markdown_facts(facts):
    return [f"- {key}: {value}" for key, value in facts.items()]


def html_table(head, rows):
    def cells(row, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(c)}</{tag}>" for c in row) + "</tr>"

    return "<table>" + cells(head, "th") + "".join(cells(row, "td") for row in rows) + "</table>"


def html_page(title, facts, body):
    items = "".join(f"<li>{html.escape(k)}: {html.escape(str(v))}</li>" for k, v in facts.items())
    return (f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>{title}</title>"
            "<style>body{font-family:sans-serif}td,th{border:1px solid #ccc;padding:2px 8px;"
            "text-align:left}table{border-collapse:collapse}</style></head><body>"
            f"<h1>{title}</h1><ul>{items}</ul>{body}</body></html>\n")
