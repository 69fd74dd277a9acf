#!/usr/bin/env bash
# A picture of the robot in RViz, one posture beside the other:
#   scripts/picture_postures.sh OUT.png POSTURE...      postures by name, from the robot's demo_postures.yaml
# ROBOT and MODEL in the environment choose another robot. Needs an X display of its own (xvfb-run gives one)
# and the workspace's environment.
set -u
if [ $# -lt 2 ]; then
  echo "picture_postures.sh: expected OUT.png POSTURE..." >&2
  exit 2
fi
out="$1"
shift
robot="${ROBOT:-anthrob}"
model="${MODEL:-II}"
config="$(rospack find anthrob_bringup)"
# Beside a simulation that may be running already.
export ROS_MASTER_URI="http://localhost:11399" LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
work="$(mktemp -d)"

# The view only, without panels, as large as the virtual screen, and nearer.
sed -e 's/^\( *Distance:\) .*/\1 0.95/' \
  -e 's/^\(  Height:\) .*/\1 900/' -e 's/^\(  Width:\) .*/\1 1280/' -e '/^  QMainWindow State:/d' \
  -e '/^Panels:/,/^Visualization Manager:/{/^Visualization Manager:/!d}; 1i Panels: []' \
  "$config/launch/anthrob.rviz" >"$work/view.rviz"
roslaunch -p 11399 anthrob_bringup sim.launch "robot:=$robot" "model:=$model" rviz:=true \
  "rviz_config:=$work/view.rviz" command_timeout:=0 >"$work/launch.log" 2>&1 &
launch=$!
trap 'kill -INT $launch 2>/dev/null; wait $launch 2>/dev/null; rm -rf "$work"' EXIT

hold() {
  rosrun anthrob_control anthrob_hold_posture "__ns:=$robot" "_model:=$config/config/$robot/model_$model.yaml" \
    "_postures:=$config/config/$robot/demo_postures.yaml" "_posture:=$1" || {
    cat "$work/launch.log"
    exit 1
  }
}

hold "$1"
sleep 8 # RViz loads meshes and draws its first frames
pictures=()
for posture in "$@"; do
  hold "$posture"
  sleep 2
  import -window root "$work/$posture.png" || exit 1
  convert "$work/$posture.png" -crop 780x760+250+90 +repage "$work/$posture.png" || exit 1
  pictures+=("$work/$posture.png")
done
convert "${pictures[@]}" +append "$work/all.png" && mv "$work/all.png" "$out"
