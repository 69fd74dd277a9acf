#!/usr/bin/env bash
# A picture of the robot in RViz, one posture beside the other:
#   scripts/picture_postures.sh OUT.png [POSTURE...]    postures by name, from the robot's demo_postures.yaml; none: as it starts
# ROBOT, MODEL and HAND in the environment choose another robot. Needs an X display of its own (xvfb-run gives one)
# and the workspace's environment.
set -u
if [ $# -lt 1 ] || [[ "$1" != *.png ]]; then
  echo "picture_postures.sh: expected OUT.png [POSTURE...]" >&2
  exit 2
fi
out="$1"
shift
robot="${ROBOT:-anthrob}"
model="${MODEL:-II}"
hand="${HAND:-false}"
variant="$([ "$hand" = false ] || echo _hand)"
config="$(rospack find anthrob_bringup)"
# Beside a simulation that may be running already.
export ROS_MASTER_URI="http://localhost:11399" LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
export ROSCONSOLE_STDOUT_LINE_BUFFERED=1 # what the simulator says is waited for
work="$(mktemp -d)"

"$(dirname "$0")/picture_view.py" "$robot$variant" >"$work/view.rviz" || exit 1
# So slow that a robot that nobody holds has not fallen when its picture is taken.
[ $# -gt 0 ] && rate=1 || rate=0.02
roslaunch -p 11399 anthrob_bringup sim.launch "robot:=$robot" "model:=$model" "hand:=$hand" rviz:=true "rate:=$rate" \
  "rviz_config:=$work/view.rviz" command_timeout:=0 >"$work/launch.log" 2>&1 &
launch=$!
trap 'kill -INT $launch 2>/dev/null; wait $launch 2>/dev/null; rm -rf "$work"' EXIT

hold() {
  rosrun anthrob_control anthrob_hold_posture "__ns:=$robot" "_model:=$config/config/$robot/model_$model$variant.yaml" \
    "_postures:=$config/config/$robot/demo_postures.yaml" "_posture:=$1" || {
    cat "$work/launch.log"
    exit 1
  }
}

take() {
  import -window root "$work/$1.png" || exit 1
  # The arm, or all that is not background in RViz's view.
  if [ "$robot$variant" = anthrob ]; then
    convert "$work/$1.png" -crop 780x760+250+90 +repage "$work/$1.png" || exit 1
  else
    convert "$work/$1.png" -crop 1238x800+21+64 +repage -trim -bordercolor '#f6f7f9' -border 20 +repage "$work/$1.png" || exit 1
  fi
  pictures+=("$work/$1.png")
}

pictures=()
[ $# -eq 0 ] || hold "$1"
# Until the simulator publishes, and where RViz begins with a picture of its own there is its light background.
until grep -q '\bready\b' "$work/launch.log" &&
  import -window root -crop 1x1+1250+200 -depth 8 txt:- 2>/dev/null | grep -qi '#F6F7F9'; do
  if ! kill -0 $launch 2>/dev/null || grep -q 'process has died' "$work/launch.log"; then
    cat "$work/launch.log" >&2
    exit 1
  fi
  sleep 0.5
done
sleep 5 # RViz loads meshes
[ $# -gt 0 ] || take start
for posture in "$@"; do
  hold "$posture"
  sleep 2
  take "$posture"
done
convert "${pictures[@]}" +append "$work/all.png" && mv "$work/all.png" "$out"
