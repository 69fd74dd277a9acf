"""Shared by the studies: steps that can be interrupted, files, facts about the run, pages."""

import argparse
import html
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap

OUT = "build/study"
BAD_INPUT, INTERRUPTED = 2, 130
PATIENCE = 30  # time for an interrupted step to save its state [s]
WIDTH = 120     # of a line of markdown


def of_the_study(options):
    """Whether the results go to studies/: only those in the default folder do."""
    return os.path.normpath(options.out) == OUT


def say(line):
    print(f"study: {line}", file=sys.stderr, flush=True)


def run(command, log):
    """Runs a step and returns its exit status. If the step was interrupted, the study ends as well."""
    with open(log, "a") as out:
        step = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)
        try:
            status = step.wait()
        except KeyboardInterrupt:
            step.terminate()  # if the signal reached only the study
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
    """Runs a step that has to succeed; otherwise the study ends."""
    if run(command, log) != 0:
        sys.exit(f"study: {' '.join(command)} failed: see {log}")


class OneLineParser(argparse.ArgumentParser):
    """Parser that reports a wrong command line in one line, as all tools do."""

    def error(self, message):
        self.exit(BAD_INPUT, f"{self.prog}: {message} (see --help)\n")


def refuse(line):
    say(line)
    sys.exit(BAD_INPUT)


def start(main, continues=True):
    """Runs a study. Ctrl-C and SIGTERM both end it with status 130."""

    def interrupt(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, interrupt)
    try:
        main()
    except KeyboardInterrupt:
        say(f"interrupted; the same command {'continues where this one stopped' if continues else 'begins anew'}")
        sys.exit(INTERRUPTED)
    except BrokenPipeError:
        # `--list | head`: nobody reads the rest. The interpreter would complain at its end if it could not write it.
        for stream in (sys.stdout, sys.stderr):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        sys.exit(1)


def whole(least):
    """Type of an option: a whole number of at least so much."""

    def read(word):
        if not word.isdecimal() or int(word) < least:
            raise argparse.ArgumentTypeError(f"{word}: expected a whole number of at least {least}")
        return int(word)

    return read


def load(file):
    with open(file) as text:
        return json.load(text)


def load_published(file):
    """Results that an earlier run, perhaps on another machine, has written to studies/."""
    if not os.path.exists(file):
        refuse(f"{file}: no such file; --adopt expects the results of an earlier run there")
    return load(file)


def write(file, content):
    part = f"{file}.{os.getpid()}.part"  # several slices may run at the same time
    with open(part, "w") as out:
        out.write(content)
    os.replace(part, file)


def machine():
    with open("/proc/cpuinfo") as info:
        names = [line.split(":")[1].strip() for line in info if line.startswith("model name")]
    return f"{len(names)} x {names[0]}" if names else "unknown"


def commit():
    """Commit of the workspace, with -dirty if files outside of studies/ differ from it. Else unknown."""
    if not shutil.which("git"):
        return "unknown"

    def git(*words):
        return subprocess.run(["git", *words], capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!studies")
    return (git("rev-parse", "--short", "HEAD") or "unknown") + ("-dirty" if changed else "")


def several(values):
    return ", ".join(sorted({str(value) for value in values}))


def markdown_page(title, parts):
    """Parts: text is a paragraph, or a heading if it begins with #; a dict is a list; (head, rows) is a table."""
    lines = [f"# {title}"]
    for part in parts:
        lines.append("")
        if isinstance(part, dict):
            for key, value in part.items():
                lines += wrapped(f"- {key}: {value}", "  ")
        elif isinstance(part, tuple):
            lines += markdown_table(*part)
        else:
            lines += wrapped(part)
    return "\n".join(lines) + "\n"


def wrapped(text, indent=""):
    return textwrap.wrap(text, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def markdown_table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def html_page(title, parts):
    """The same parts without links: this page lies elsewhere than the documents."""
    body = "".join(map(html_part, parts))
    return (f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>{title}</title>"
            "<style>body{font-family:sans-serif}td,th{border:1px solid #ccc;padding:2px 8px;"
            "text-align:left}table{border-collapse:collapse}</style></head><body>"
            f"<h1>{title}</h1>{body}</body></html>\n")


def html_part(part):
    if isinstance(part, dict):
        return "<ul>" + "".join(f"<li>{plain(f'{key}: {value}')}</li>" for key, value in part.items()) + "</ul>"
    if isinstance(part, tuple):
        return html_table(*part)
    heading = re.match("#+ ", part)
    tag = f"h{heading.end() - 1}" if heading else "p"
    return f"<{tag}>{plain(part[heading.end():] if heading else part)}</{tag}>"


def html_table(head, rows):
    def cells(row, tag):
        return "<tr>" + "".join(f"<{tag}>{plain(c)}</{tag}>" for c in row) + "</tr>"

    return "<table>" + cells(head, "th") + "".join(cells(row, "td") for row in rows) + "</table>"


def plain(text):
    """Markdown as HTML, without links, emphasis and marks of code."""
    return html.escape(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text).replace("`", "").replace("*", ""))
