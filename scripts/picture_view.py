#!/usr/bin/python3
"""Prints what RViz shows in pictures: launch/anthrob.rviz without panels and names of frames, on a light background, in a window
that the virtual screen holds. The arm fills it.
  scripts/picture_view.py ROBOT >VIEW.rviz
"""

import os
import sys

SOURCE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "launch", "anthrob.rviz")
BACKGROUND, GRID = "246; 247; 249", "200; 203; 208"
WINDOW = {"Height": "900", "Width": "1280"}
NEAR = "0.95"  # [m] from the arm


def view(robot):
    lines, shown, display = ["Panels: []\n"], False, None
    with open(SOURCE) as file:
        for line in file:
            shown = shown or line.startswith("Visualization Manager:")
            key = line.split(":")[0]
            name = key.strip()
            if not shown or name == "QMainWindow State":
                continue  # the panels, and where they are
            if name == "- Class":
                display = line.split(":")[1].strip()
            if name in ("Show Names", "Show Axes"):
                line = f"{key}: false\n"
            elif name == "Theme":
                line = f"{key}: light\n"
            elif name == "Background Color":
                line = f"{key}: {BACKGROUND}\n"
            elif name == "Color" and display == "rviz/Grid":
                line = f"{key}: {GRID}\n"
            elif name in WINDOW and key.startswith("  ") and not key.startswith("   "):
                line = f"{key}: {WINDOW[name]}\n"
            elif name == "Fit View" and robot == "anthrob":
                line = f"{key}: false\n"  # its pictures do without the stand's foot
            elif name == "Distance" and robot == "anthrob":
                line = f"{key}: {NEAR}\n"
            lines.append(line)
    return "".join(lines)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        print("picture_view.py: expected ROBOT", file=sys.stderr)
        sys.exit(2)
    sys.stdout.write(view(sys.argv[1]))
