#!/usr/bin/python3
"""A moving picture of a robot in RViz:
  scripts/moving_picture.py OUT.gif|OUT.mp4 POSTURE...      postures by name, from the robot's demo_postures.yaml
  BAG=FILE scripts/moving_picture.py OUT.gif|OUT.mp4        what a bag holds

The simulated robot moves from one posture to the next and at last back to the first. It is stepped, and a bag is
played, frame by frame, so that the motion does not depend on how fast the computer is. ROBOT and MODEL in the
environment choose another robot. Needs an X display of its own (xvfb-run gives one), imagemagick, ffmpeg unless for a
GIF, and the workspace's environment.
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
from anthrob_msgs.msg import MuscleCommand, MuscleStates, PlayerState
from anthrob_msgs.srv import Seek, Step
from std_srvs.srv import SetBool

from picture_view import view

PORT = 11398  # beside a simulation that may be running already
FRAME_STEPS = 100  # of 1 ms, also of a recording
MOVE_FRAMES, HOLD_FRAMES = 16, 6  # a posture: 1.6 s to it, 0.6 s there
DRAWN = 0.3  # [s] of wall time until RViz has drawn what was published
CROP, WIDTH, COLOURS = "600x640+310+175", 360, 32
WHOLE = "1280x840+0+30"  # of robots whose size is not known here
VIEW = 60  # [s] until RViz must show something
LOADING = 5  # [s] until RViz has loaded meshes


def refuse(message):
    sys.exit(f"moving_picture.py: {message}")


class Simulated:
    """A robot that goes through postures."""
    def __init__(self, name, model, folder, postures):
        self.postures = postures
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

    def frames(self):
        """Yields once the robot stands where the next frame shows it."""
        self.hold(self.postures[0])
        wait_for_view()
        held = []
        for posture in self.postures[1:] + self.postures[:1]:
            self.hold(posture)
            held.append(self.references())
        self.pause()
        for references in motion(held[-1:] + held[:-1]):
            self.step(references)
            yield


class Played:
    """A robot as a bag has it."""
    def __init__(self, name):
        self.duration = rospy.wait_for_message(f"/{name}/player/state", PlayerState, timeout=60).duration
        self.seek = rospy.ServiceProxy(f"/{name}/player/seek", Seek)
        rospy.ServiceProxy(f"/{name}/player/pause", SetBool)(True)

    def frames(self):
        wait_for_view()
        for number in range(1 + round(1000 * self.duration) // FRAME_STEPS):
            self.seek(0.001 * FRAME_STEPS * number)
            yield


def motion(postures):
    """References, frame by frame: smoothly to the next posture, then a rest."""
    for start, end in zip(postures, postures[1:] + postures[:1]):
        for frame in range(1, MOVE_FRAMES + HOLD_FRAMES + 1):
            share = 0.5 - 0.5 * math.cos(math.pi * min(1.0, frame / MOVE_FRAMES))
            yield {name: (1.0 - share) * start[name] + share * end[name] for name in start}


def wait_for_view():
    """RViz begins with a picture of its own, and may die."""
    end = time.time() + VIEW
    while b"#F6F7F9" not in subprocess.run(["import", "-window", "root", "-crop", "1x1+1250+200", "-depth", "8", "txt:-"],
                                           stdout=subprocess.PIPE).stdout.upper():
        if time.time() > end:
            refuse(f"RViz shows no view after {VIEW} s")
        time.sleep(0.5)
    time.sleep(LOADING)


def film(shown, name, folder):
    for number, _ in enumerate(shown.frames()):
        time.sleep(DRAWN)
        subprocess.run(["import", "-window", "root", "-crop", crop(name), "+repage", f"{folder}/{number:05}.png"],
                       check=True)


def crop(robot):
    return CROP if robot == "anthrob" else WHOLE


def write(folder, out, rate):
    """The frames of a folder as one file."""
    if out.endswith(".gif"):
        # Every frame holds what changed only: a third of the size.
        subprocess.run(["convert", "-delay", str(round(100 / rate)), "-loop", "0", f"{folder}/*.png", "-resize", str(WIDTH),
                        "+dither", "-colors", str(COLOURS), "-layers", "OptimizeTransparency", f"{folder}/all.gif"], check=True)
        shutil.move(f"{folder}/all.gif", out)
    else:
        subprocess.run(["ffmpeg", "-loglevel", "error", "-framerate", str(rate), "-pattern_type", "glob", "-i", f"{folder}/*.png",
                        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", f"{folder}/all.mp4"], check=True)
        shutil.move(f"{folder}/all.mp4", out)


def main():
    bag, postures = os.environ.get("BAG"), sys.argv[2:]
    if len(sys.argv) < 2 or not sys.argv[1].endswith((".gif", ".mp4")) or (bool(postures) if bag else len(postures) < 2):
        print("moving_picture.py: expected OUT.gif or OUT.mp4, and two or more postures or a bag", file=sys.stderr)
        sys.exit(2)
    if bag and not os.path.isfile(bag):
        refuse(f"{bag}: no such bag")
    out = os.path.abspath(sys.argv[1])
    name, model = os.environ.get("ROBOT", "anthrob"), os.environ.get("MODEL", "II")
    bringup = rospkg.RosPack().get_path("anthrob_bringup")
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{PORT}", LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
    folder = tempfile.mkdtemp()
    with open(f"{folder}/view.rviz", "w") as file:
        file.write(view(name))
    with open(f"{folder}/launch.log", "w") as log:
        launch = subprocess.Popen(["roslaunch", "-p", str(PORT), "anthrob_bringup", "play.launch" if bag else "sim.launch",
                                   f"robot:={name}", f"model:={model}", "rviz:=true", f"rviz_config:={folder}/view.rviz",
                                   f"bag:={os.path.abspath(bag)}" if bag else "command_timeout:=0"], stdout=log, stderr=subprocess.STDOUT)
    try:
        while subprocess.run(["rosnode", "list"], capture_output=True).returncode:
            if launch.poll() is not None:
                refuse("it did not start: " + open(f"{folder}/launch.log").read()[-500:])
            time.sleep(0.5)
        rospy.init_node("moving_picture", disable_signals=True)
        film(Played(name) if bag else Simulated(name, model, bringup, postures), name, folder)
        write(folder, out, 1000 / FRAME_STEPS)
    except rospy.ROSException as error:
        refuse(f"{error}: " + open(f"{folder}/launch.log").read()[-500:])
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait()
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
