#!/usr/bin/python3
"""How long ./catkin_ws.sh sim takes from the command to RViz's first picture of the robot, in a workspace that is built:
  scripts/first_picture.py [RUNS]      medians of RUNS, 10 unless said, on a virtual screen (Xvfb, software OpenGL)
"""

import os
import pty
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import numpy

TOP = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
DISPLAY, PORT = ":97", "11397"  # beside what may be running already
WIDTH, HEIGHT = 1600, 1000
LIMIT = 120  # [s]
# Of the middle of the window, where the robot is: pixels that make a picture, of bones and of relaxed tendons.
BONES, TENDONS = 3000, 200
# What is waited for, in this order, and what the script's output says then.
SAID = (("roslaunch", rb"started roslaunch server"), ("master", rb"process\[master\]: started"),
        ("simulator and RViz started", rb"process\[\S*rviz"), ("ready", rb"\bready\b"))


def screen(folder):
    """The screen as Xvfb keeps it, an X window dump whose first number is the length of its header."""
    with open(f"{folder}/Xvfb_screen0", "rb") as file:
        data = file.read()
    header = numpy.frombuffer(data[:100], ">u4")
    offset = int(header[0]) + 12 * int(header[19])
    return numpy.frombuffer(data, numpy.uint8, WIDTH * HEIGHT * 4, offset).reshape(HEIGHT, WIDTH, 4)[:, :, :3]


def phase_of(folder):
    pixels = screen(folder)
    if not pixels[:, :300].any():  # where the window is, but not the picture that RViz begins with
        return None
    blue, green, red = numpy.moveaxis(pixels[200:850, 500:1000].astype(int), 2, 0)
    bones = (red > 150) & (red > blue + 15)
    tendons = (blue > 180) & (red < 90)
    return "picture" if bones.sum() > BONES and tendons.sum() > TENDONS else "window"


def run(folder):
    """Seconds until each phase."""
    env = dict(os.environ, DISPLAY=DISPLAY, LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1", ROS_HOME=f"{folder}/ros",
               ROS_MASTER_URI=f"http://localhost:{PORT}")
    terminal, end = pty.openpty()
    os.set_blocking(terminal, False)
    begin, times, said = time.monotonic(), {}, b""
    process = subprocess.Popen(["./catkin_ws.sh", "sim"], cwd=TOP, env=env, stdout=end, stderr=end, start_new_session=True)
    os.close(end)
    try:
        while "picture" not in times or "ready" not in times:
            now = time.monotonic() - begin
            if now > LIMIT or process.poll() is not None:
                sys.exit("first_picture.py: no picture:\n" + said.decode())
            try:
                said += os.read(terminal, 65536)
            except OSError:
                pass
            for phase, text in SAID:
                if phase not in times and re.search(text, said):
                    times[phase] = now
            shown = phase_of(folder)
            if shown:
                times.setdefault(shown, now)
            time.sleep(0.03)
    finally:
        os.killpg(process.pid, signal.SIGINT)
        process.wait()
        os.close(terminal)
    return times


def main():
    if len(sys.argv) > 2 or not all(word.isdigit() and int(word) > 0 for word in sys.argv[1:]):
        print("first_picture.py: expected a number of RUNS, or nothing", file=sys.stderr)
        sys.exit(2)
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    with tempfile.TemporaryDirectory() as folder:
        server = subprocess.Popen(["Xvfb", DISPLAY, "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", folder],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            while not os.path.exists(f"{folder}/Xvfb_screen0"):
                time.sleep(0.1)
            all_times = []
            for number in range(runs):
                times = run(folder)
                all_times.append(times)
                print(f"run {number + 1}: " + ", ".join(f"{phase} {t:.2f}" for phase, t in sorted(times.items(), key=lambda i: i[1])),
                      flush=True)
                time.sleep(2)
        finally:
            server.terminate()
            server.wait()
    print(f"median of {runs} [s], at a load of {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors:")
    for phase in all_times[0]:
        if all(phase in times for times in all_times):
            print(f"  {phase}: {statistics.median(times[phase] for times in all_times):.2f}")


if __name__ == "__main__":
    main()
