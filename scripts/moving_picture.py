#!/usr/bin/python3
"""A moving picture of the simulated robot in RViz, as GIF:
  scripts/moving_picture.py OUT.gif POSTURE...      postures by name, from the robot's demo_postures.yaml

The robot moves from one posture to the next and at last back to the first. It is stepped frame by frame, so that the
motion does not depend on how fast the computer is. ROBOT and MODEL in the environment choose another robot. Needs an X
display of its own (xvfb-run gives one), imagemagick, and the workspace's environment.
"""

import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import rospkg
import rospy
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from anthrob_msgs.srv import Step
from std_srvs.srv import SetBool

PORT = 11398  # beside a simulation that may be running already
FRAME_STEPS = 100  # of 1 ms
MOVE_FRAMES, HOLD_FRAMES = 16, 6  # a posture: 1.6 s to it, 0.6 s there
DRAWN = 0.3  # [s] of wall time until RViz has drawn what was published
CROP, WIDTH, COLOURS = "600x640+310+175", 360, 32


def refuse(message):
    sys.exit(f"moving_picture.py: {message}")


def view(source):
    """The view only: without panels and names of frames, in a window that the virtual screen holds, and nearer."""
    lines, shown = ["Panels: []\n"], False
    with open(source) as file:
        for line in file:
            shown = shown or line.startswith("Visualization Manager:")
            if not shown:
                continue
            key = line.strip().split(":")[0]
            if key in ("Show Names", "Show Axes"):
                line = line.replace("true", "false")
            elif line.startswith("  QMainWindow State:"):
                continue  # where the panels are
            elif line.startswith(("  Height:", "  Width:")):
                line = "  %s: %d\n" % (key, {"Height": 900, "Width": 1280}[key])
            elif key == "Distance":
                line = line[:line.index(":")] + ": 0.95\n"
            lines.append(line)
    return "".join(lines)


class Robot:
    def __init__(self, name, model, folder):
        self.files = [f"_model:={folder}/config/{name}/model_{model}.yaml",
                      f"_postures:={folder}/config/{name}/demo_postures.yaml"]
        self.name = name
        self.commands = rospy.Publisher(f"/{name}/muscle_command", MuscleCommand, queue_size=1)
        self.step_service = rospy.ServiceProxy(f"/{name}/sim/step", Step)
        self.step_service.wait_for_service(timeout=60)

    def hold(self, posture):
        done = subprocess.run(["rosrun", "anthrob_control", "anthrob_hold_posture", f"__ns:={self.name}", *self.files,
                               f"_posture:={posture}"], stdout=subprocess.DEVNULL)
        if done.returncode:
            refuse(f"the robot does not hold {posture}")

    def references(self):
        states = rospy.wait_for_message(f"/{self.name}/muscle_states", MuscleStates, timeout=10)
        return dict(zip(states.name, states.reference))

    def pause(self):
        rospy.ServiceProxy(f"/{self.name}/sim/pause", SetBool)(True)
        self.now = self.step_service(1, rospy.Time()).stamp

    def step(self, references):
        command = MuscleCommand(name=list(references), mode=[MuscleCommand.POSITION] * len(references),
                                reference=list(references.values()))
        command.header.stamp = self.now
        self.commands.publish(command)
        reply = self.step_service(FRAME_STEPS, self.now)
        if not reply.success:
            refuse(reply.message)
        self.now = reply.stamp


def motion(postures):
    """References, frame by frame: smoothly to the next posture, then a rest."""
    for start, end in zip(postures, postures[1:] + postures[:1]):
        for frame in range(1, MOVE_FRAMES + HOLD_FRAMES + 1):
            share = 0.5 - 0.5 * math.cos(math.pi * min(1.0, frame / MOVE_FRAMES))
            yield {name: (1.0 - share) * start[name] + share * end[name] for name in start}


def film(robot, postures, folder):
    robot.hold(postures[0])
    time.sleep(10)  # RViz loads meshes and draws its first frames
    held = []
    for posture in postures[1:] + postures[:1]:
        robot.hold(posture)
        held.append(robot.references())
    robot.pause()
    for number, references in enumerate(motion(held[-1:] + held[:-1])):
        robot.step(references)
        time.sleep(DRAWN)
        subprocess.run(["import", "-window", "root", "-crop", CROP, "+repage", "-resize", str(WIDTH),
                        f"{folder}/{number:04}.png"], check=True)


def main():
    if len(sys.argv) < 4 or not sys.argv[1].endswith(".gif"):
        refuse("expected OUT.gif and two or more postures")
    out, postures = os.path.abspath(sys.argv[1]), sys.argv[2:]
    name, model = os.environ.get("ROBOT", "anthrob"), os.environ.get("MODEL", "II")
    bringup = rospkg.RosPack().get_path("anthrob_bringup")
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{PORT}", LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
    folder = tempfile.mkdtemp()
    with open(f"{folder}/view.rviz", "w") as file:
        file.write(view(f"{bringup}/launch/anthrob.rviz"))
    with open(f"{folder}/launch.log", "w") as log:
        launch = subprocess.Popen(["roslaunch", "-p", str(PORT), "anthrob_bringup", "sim.launch", f"robot:={name}",
                                   f"model:={model}", "rviz:=true", f"rviz_config:={folder}/view.rviz",
                                   "command_timeout:=0"], stdout=log, stderr=subprocess.STDOUT)
    try:
        while subprocess.run(["rosnode", "list"], capture_output=True).returncode:
            if launch.poll() is not None:
                refuse("the simulator did not start: " + open(f"{folder}/launch.log").read()[-500:])
            time.sleep(0.5)
        rospy.init_node("moving_picture", disable_signals=True)
        film(Robot(name, model, bringup), postures, folder)
        # Every frame holds what changed only: a third of the size.
        subprocess.run(["convert", "-delay", str(FRAME_STEPS // 10), "-loop", "0", f"{folder}/*.png", "+dither",
                        "-colors", str(COLOURS), "-layers", "OptimizeTransparency", f"{folder}/all.gif"], check=True)
        shutil.move(f"{folder}/all.gif", out)
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait()
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
