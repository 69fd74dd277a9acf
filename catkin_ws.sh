#!/usr/bin/env bash
# All commands of this workspace. Each first installs and builds what it needs.
set -u -o pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cd "$here" || exit 1

# Of Debian 12 (bookworm), of which ROS 1 is part.
needed_packages=(
  catkin ros-core-dev rosbash
  python3-roslaunch python3-rostopic python3-rosservice python3-rosnode python3-rosbag python3-rosparam
  python3-rospy python3-rostest python3-rosunit librostest-dev
  python3-diagnostic-msgs python3-geometry-msgs python3-sensor-msgs python3-std-msgs python3-std-srvs
  python3-tf2-msgs python3-visualization-msgs python3-rosgraph-msgs
  librosbag-dev librosbag-storage-dev libroscpp-dev libroslib-dev libtf2-ros-dev
  libdiagnostic-msgs-dev libgeometry-msgs-dev libros-rosgraph-msgs-dev libsensor-msgs-dev libstd-msgs-dev
  libstd-srvs-dev libvisualization-msgs-dev
  ros-robot-state-publisher rviz topic-tools
  librviz-dev libinteractive-markers-dev libqcustomplot-dev pluginlib-dev qtbase5-dev
  libimage-transport-dev libactionlib-dev python3-actionlib python3-actionlib-msgs
  build-essential cmake
  libbullet-dev libeigen3-dev liburdfdom-dev libtinyxml2-dev libconsole-bridge-dev libyaml-cpp-dev libcli11-dev
  nlohmann-json3-dev libsqlite3-dev zlib1g-dev libnlopt-dev libnlopt-cxx-dev libcgal-dev libassimp-dev libceres-dev
  libpagmo-dev libopenmpi-dev openmpi-bin
  libopencv-calib3d-dev libopencv-imgcodecs-dev libopencv-imgproc-dev libtbb-dev libaravis-dev libusb-1.0-0-dev
  libdc1394-dev pkg-config python3-numpy python3-jinja2
  libgtest-dev libgmock-dev
)
# For tests, benchmarks and the demo's pictures only. What cannot be installed is left out of them.
extra_packages=(
  libbenchmark-dev libmujoco-dev  # the second is a peer in benchmarks
  opencv-doc                      # stereo pictures of a real checkerboard
  xvfb xauth imagemagick ffmpeg libgl1-mesa-dri
  user-mode-linux kmod iproute2   # CAN where the kernel has none
  clang-tidy git                  # checks of the files that changed
)

say() { printf '\033[1m%s\033[0m\n' "$*"; }

# One line: what failed, and what to do.
die() {
  printf 'catkin_ws.sh: %s\n' "$*" >&2
  exit 1
}

# The same for wrong arguments.
refuse() {
  printf 'catkin_ws.sh: %s\n' "$*" >&2
  exit 2
}

help() {
  cat <<'TEXT'
usage: ./catkin_ws.sh COMMAND [ARGUMENTS]

  deps              install missing packages (as root or through sudo)
  build             compile the workspace; build tests: also its tests; build install: install into install/, or
                    elsewhere with -DCMAKE_INSTALL_PREFIX=DIR
  sim [ARG:=VALUE]  simulate Anthrob, with RViz if there is a display; takes the arguments of sim.launch, such as
                    robot:=anthrob model:=II rviz:=false rate:=1 (0: as fast as possible)
  demo              simulate the arm as it rises, bends and returns; bag, figures and pictures (one of them moves) go to
                    build/demo/
  picture OUT.png [POSTURE...]
                    a picture of the robot in postures of its demo_postures.yaml; none: as it starts; also hand:=true
  movie OUT.mp4|OUT.gif [POSTURE...]
                    a moving picture of the robot between postures, or of a recording by bag:=FILE; both take robot:= and
                    model:=
  test [PACKAGE...] run all tests, or those of the named packages; the last line counts them
  bench             run the benchmarks, also of MuJoCo and OpenCV for comparison; writes build/bench.json
  study NAME        axes: discovery on made-up benches of one driven joint; --drives: with a servo drive
                    calibration: repeat chapter 8 of the thesis with virtual robots
                    conventions: discovery on recordings of a rig that were taken by other conventions than ours
                    discovery: the blind test; with --slice K/N a part of it; also --list, --summary, --help
                    fuzz: give damaged files to every reader of files, with sanitizers
                    health: tests of tendons on 60 days, in some of which something grows
                    real: run discovery on the data of real machines; --data FOLDER
                    rules: discovery with other numbers that judge, or without one of its rules
                    threads: run on several threads, with a sanitizer; --tbb FOLDER
                    soak: watch memory, descriptors and threads of the nodes; --hours N; it begins anew
                    hours of computing; an interrupted study continues; results go to build/study/ and overwrite
                    studies/, or go to FOLDER with --out FOLDER
  shell             open a shell in which rosrun, roslaunch and rostopic know the workspace; Tab completes names and options
  clean             remove build/ (but not build/study), devel/ and install/, with any results you keep there
  help              print this text
TEXT
}

# ROS needs the system's Python, so the system's paths come before those of pyenv or conda. Another ROS that was sourced
# is removed from the environment. Overlays of this workspace, whose ROS is Debian's, stay.
clean_environment() {
  export PATH="/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin:/usr/local/bin"
  unset PYTHONHOME PYTHONPATH CONDA_PREFIX CONDA_DEFAULT_ENV VIRTUAL_ENV
  [ "${ROS_DISTRO:-Debian}" = Debian ] ||
    unset ROS_DISTRO ROS_VERSION ROS_ROOT ROS_ETC_DIR ROS_PACKAGE_PATH ROSLISP_PACKAGE_DIRECTORIES \
      CMAKE_PREFIX_PATH LD_LIBRARY_PATH PKG_CONFIG_PATH AMENT_PREFIX_PATH COLCON_PREFIX_PATH
  export ROS_PYTHON_VERSION=3
  export LANG="${LANG:-C.UTF-8}"
}

source_file() {
  # Setup files of ROS use unset variables.
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

ros_environment() {
  [ ! -f devel/setup.bash ] || source_file devel/setup.bash
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "installing packages needs root: run ./catkin_ws.sh deps as root, or install sudo"
  fi
}

# Prints those of the named packages that are not installed.
lacking() {
  local installed package
  installed="$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null)"
  for package in "$@"; do
    [[ $'\n'"$installed"$'\n' == *$'\n'"$package installed"$'\n'* ]] || printf '%s ' "$package"
  done
}

update_lists() {
  as_root apt-get update -q || die "apt-get update failed: check the network and /etc/apt/sources.list"
}

install_packages() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"
}

# Other systems lack these packages, or the packages would install a second ROS beside the one in /opt/ros.
require_debian_12() {
  local release
  release="$(cat /etc/os-release 2>/dev/null)"
  grep -Eq '^VERSION_CODENAME="?bookworm"?$' <<<"$release" ||
    die "needed packages are missing; only Debian 12 (bookworm) has them, and this is $(
      sed -nE 's/^PRETTY_NAME="?([^"]*)"?$/\1/p' <<<"$release" | grep . || echo 'another system'
    ): use a container of debian:12 (README, On another system)"
}

deps() {
  local missing
  missing="$(lacking "${needed_packages[@]}")"
  [ -z "$missing" ] && return 0
  require_debian_12
  say "installing $(wc -w <<<"$missing") packages"
  update_lists
  # shellcheck disable=SC2086
  install_packages $missing ||
    die "apt-get install failed: see above"
}

extras() {
  deps
  local missing package
  missing="$(lacking "${extra_packages[@]}")"
  [ -z "$missing" ] && return 0
  say "installing $(wc -w <<<"$missing") optional packages"
  # In subshells: a failure here must not end this script.
  # shellcheck disable=SC2086
  (update_lists && install_packages $missing) && return 0
  # One that is not available must not prevent the others.
  for package in $missing; do
    (install_packages "$package" >/dev/null) || say "cannot install $package; whatever needs it is left out"
  done
}

# A line that changes with the name, size or time of any file that a build reads: sources, this script, installed packages.
# Robots and launch files are read where they are.
sources_stamp() {
  {
    echo "${ANTHROB_WERROR:-OFF}"
    find -L src catkin_ws.sh /var/lib/dpkg/status \( -path src/anthrob_bringup/config -o -path src/anthrob_bringup/launch \
      -o -path src/CMakeLists.txt -o -name __pycache__ \) -prune -o ! -type d -printf '%p %s %T@ %C@\n' 2>&1 | sort
  } | sha256sum
}

# The same of what it makes.
products_stamp() {
  find devel -name __pycache__ -prune -o ! -type d -printf '%p %s %T@\n' 2>&1 | sort | sha256sum
}

# Builds unless all is as the last build without further arguments has left it.
build_if_changed() {
  if [ -f devel/setup.bash ] && [ -f build/stamp ] && [ "$(sources_stamp; products_stamp)" = "$(cat build/stamp)" ]; then
    ros_environment
  else
    build
  fi
}

build() {
  deps
  ros_environment
  mkdir -p build
  rm -f build/stamp
  local sources
  sources="$(sources_stamp)"  # before: what changes meanwhile may have been read already
  say "building (log: build/build.log)"
  catkin_make -DCMAKE_BUILD_TYPE=Release -DPYTHON_EXECUTABLE=/usr/bin/python3 \
    -DPython3_EXECUTABLE=/usr/bin/python3 -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -j"$(nproc)" \
    -DCMAKE_COMPILE_WARNING_AS_ERROR="${ANTHROB_WERROR:-OFF}" "$@" >build/build.log 2>&1 ||
    { grep -m5 -E 'error|Error' build/build.log >&2; die "the build failed: see build/build.log"; }
  [ $# -gt 0 ] || { echo "$sources"; products_stamp; } >build/stamp
  source_file devel/setup.bash
}

have_display() { [ -n "${DISPLAY:-}" ]; }

# Where there is no session, Qt takes this folder, but warns of it first.
runtime_folder() {
  [ -z "${XDG_RUNTIME_DIR:-}" ] || return 0
  export XDG_RUNTIME_DIR="${TMPDIR:-/tmp}/runtime-$(id -un)"
  mkdir -p -m 700 "$XDG_RUNTIME_DIR"
}

# What to try once the robot of sim's arguments runs.
first_command() {
  local argument robot=anthrob
  for argument in "$@"; do
    [[ "$argument" != robot:=* ]] || robot="${argument#robot:=}"
  done
  if [ "$robot" = anthrob ]; then
    printf '%s' 'in ./catkin_ws.sh shell, raise the arm: rostopic pub -r 10 /anthrob/muscle_command' \
      ' anthrob_msgs/MuscleCommand "{name: [lateral_deltoid], mode: [1], reference: [6.0]}"'
  else
    printf '%s' "in ./catkin_ws.sh shell, look at it: rostopic echo -n1 /$robot/muscle_states"
  fi
}

sim() {
  build_if_changed
  local rviz=false
  have_display && rviz=true && runtime_folder
  export ROSCONSOLE_STDOUT_LINE_BUFFERED=1  # also where it goes to a file
  exec roslaunch --skip-log-check --no-summary anthrob_bringup sim.launch rviz:=$rviz "hint:=$(first_command "$@")" "$@"
}

demo() {
  extras
  build_if_changed
  local out="$here/build/demo" rviz=false
  have_display && rviz=true
  rm -rf "$out" && mkdir -p "$out" || die "cannot write $out"
  say "simulating and recording about 30 s"
  roslaunch anthrob_bringup demo.launch "bag:=$out/demo.bag" rviz:=$rviz >"$out/demo.log" 2>&1 ||
    die "the demo did not finish: see build/demo/demo.log"
  # roslaunch ends with 0 even if a node failed.
  ! grep -q 'exit code -\?[1-9]' "$out/demo.log" || die "the demo did not finish: see build/demo/demo.log"
  [ -f "$out/demo.bag" ] || die "nothing was recorded: see build/demo/demo.log"
  rosrun anthrob_recording anthrob_convert "$out/demo.bag" "$out/recording" >>"$out/demo.log" ||
    die "converting the bag failed: see above"
  rosrun anthrob_recording anthrob_plot "$out/recording" --out "$out" >>"$out/demo.log" || die "drawing failed: see above"
  if ! command -v xvfb-run >/dev/null || ! command -v import >/dev/null; then
    say "no pictures: xvfb or imagemagick is missing; the rest is in build/demo/"
    return 0
  fi
  say "taking pictures of the arm in three postures"
  on_virtual_screen scripts/picture_postures.sh "$out/postures.png" rest abducted flexed >>"$out/demo.log" 2>&1 ||
    die "the picture failed: see build/demo/demo.log"
  say "taking a moving picture"
  on_virtual_screen scripts/moving_picture.py "$out/arm.gif" rest abducted flexed diagonal >>"$out/demo.log" 2>&1 ||
    die "the moving picture failed: see build/demo/demo.log"
  say "done: build/demo/ holds"
  (cd "$out" && ls -1 -- *.bag *.svg *.png *.gif && echo "recording/")
}

# Runs a script that looks at RViz on a virtual screen, which shows nothing else. Its arguments may have robot:=, model:=,
# hand:= and bag:=.
on_virtual_screen() {
  local argument arguments=()
  for argument in "$@"; do
    case "$argument" in
      robot:=*) export ROBOT="${argument#*:=}" ;;
      model:=*) export MODEL="${argument#*:=}" ;;
      hand:=*) export HAND="${argument#*:=}" ;;
      bag:=*) export BAG="${argument#*:=}" ;;
      *) arguments+=("$argument") ;;
    esac
  done
  xvfb-run -a -s "-screen 0 1280x960x24" "${arguments[@]}"
}

picture() {
  [[ "${1:-}" == *.png ]] || refuse "picture: expected OUT.png [POSTURE...] [robot:=NAME] [model:=NAME] [hand:=true]"
  extras
  build_if_changed
  on_virtual_screen scripts/picture_postures.sh "$@" || die "no picture was taken: see above"
  say "wrote $1"
}

movie() {
  [[ "${1:-}" == *.mp4 || "${1:-}" == *.gif ]] ||
    refuse "movie: expected OUT.mp4 or OUT.gif, then [POSTURE...] [robot:=NAME] [model:=NAME]"
  extras
  build_if_changed
  local out="$1" argument shown=()
  shift
  for argument in "$@"; do
    [[ "$argument" == *:=* && "$argument" != bag:=* ]] || shown+=("$argument")
  done
  [ ${#shown[@]} -gt 0 ] || set -- rest abducted flexed diagonal "$@"  # those of the demo
  on_virtual_screen scripts/moving_picture.py "$out" "$@" || die "no movie was made: see above"
  say "wrote $out"
}

idle=()  # how to start what only gets what others leave of the machine
# usage: ctest_of KINDS PACKAGES ARGUMENT...
# KINDS of tests as an alternative of a regular expression; PACKAGES likewise, empty: all
ctest_of() {
  local names="_ctest_(${2:-.*})_($1)_"
  shift 2
  (cd build && "${idle[@]}" ctest -R "$names" "$@")
}

# usage: run_tests FOLDER KINDS PACKAGES ARGUMENT...
# FOLDER: below build/, for test.log and ctest's own files. Status 8, of tests that fail, counts as 0: their results tell.
run_tests() {
  local folder="$here/build/$1" status=0
  shift
  mkdir -p "$folder"
  [ -f "$folder/CTestTestfile.cmake" ] || printf 'subdirs("%s")\n' "$here/build" >"$folder/CTestTestfile.cmake"
  ctest_of "$@" --test-dir "$folder" --timeout 3600 --output-on-failure >>"$folder/test.log" 2>&1 || status=$?
  [ $status -eq 8 ] || return $status
}

tests() {
  local package packages built=(tests)
  for package in "$@"; do
    [ -f "src/$package/package.xml" ] ||
      refuse "test: $package: unknown package; expected one of: $(cd src && ls -d -- */ | tr -d / | tr '\n' ' ')"
  done
  packages="$(IFS='|' && echo "$*")"
  extras
  # The driver's own tests need a CAN bus, of this kernel or of user-mode Linux.
  local bus
  bus="$(timeout 60 scripts/with_vcan.sh printenv ANTHROB_VCAN_ON 2>/dev/null)"
  if [ -n "$bus" ]; then
    export ANTHROB_VCAN_TESTS="${ANTHROB_VCAN_TESTS:-1}"
    # A tenth of real time, so that an ECU does not look dead when the machine is busy for a moment.
    export ANTHROB_PACE="${ANTHROB_PACE:-0.1}"
  else
    local left_out="left out: tests of the driver on a CAN bus: neither this kernel nor user-mode Linux provides one"
    unset ANTHROB_VCAN_TESTS
    say "$left_out"
  fi
  # Which tests exist depends on installed packages and on the bus, so CMake must look again.
  build --force-cmake
  rm -rf build/test_results
  ctest_of 'gtest|rostest|vcan' "$packages" --show-only=json-v1 >build/tests.json ||
    die "ctest cannot list the tests: see build/tests.json"
  for package in "$@"; do
    grep -q "\"_ctest_${package}_" build/tests.json || refuse "test: $package: this package has no tests of its own"
  done
  # shellcheck disable=SC2207
  [ $# -eq 0 ] || built=($(sed -nE 's/.*"name" : "_ctest_(anthrob_[a-z]+(_[a-z]+)?)_gtest_.*/\1_test/p' build/tests.json | sort -u))
  say "building the tests (log: build/build.log)"
  [ ${#built[@]} -eq 0 ] || catkin_make -j"$(nproc)" "${built[@]}" >>build/build.log 2>&1 ||
    { grep -m5 -E 'error|Error' build/build.log >&2; die "the tests do not build: see build/build.log"; }
  say "running the tests (log: build/test.log)"
  rm -f build/test.log build/aside/test.log
  # Nodes run in real time, one after the other; all other tests have what they leave of the machine. In user-mode Linux,
  # each test has a bus and a processor of its own; where the host has the bus, it is one for all.
  local status=0 aside buses=1
  [[ "$bus" == native* ]] || buses="$(nproc)"
  (
    ! chrt --idle 0 true 2>/dev/null || idle=(chrt --idle 0)
    run_tests aside 'gtest|rostest' "$packages" -LE real_time -j"$(nproc)"
  ) &
  aside=$!
  # shellcheck disable=SC2064
  trap "kill $aside 2>/dev/null" EXIT
  run_tests . vcan "$packages" -j"$buses" || status=$?
  run_tests . rostest "$packages" -L real_time || status=$?
  wait "$aside" || status=$?
  trap - EXIT
  cat build/aside/test.log >>build/test.log
  [ -z "${left_out:-}" ] || say "$left_out"  # again, at the end, where it is seen
  /usr/bin/python3 scripts/count_tests.py build/test_results --registered build/tests.json --status "$status"
}

# Google Benchmark's JSON into build/, medians of several repetitions in random order.
measure() {
  local name="$1"
  shift
  devel/lib/*/"${name}_benchmark" --benchmark_out="build/$name.json" --benchmark_out_format=json \
    --benchmark_repetitions=5 --benchmark_report_aggregates_only=true --benchmark_display_aggregates_only=true \
    --benchmark_enable_random_interleaving=true "$@" >"build/$name.log" 2>&1 ||
    die "the benchmark failed: see build/$name.log"
}

bench() {
  extras
  build --force-cmake  # an earlier one may have found no benchmark library
  say "building the benchmarks"
  catkin_make -j"$(nproc)" step_benchmark scaling_benchmark mesh_benchmark mocap_benchmark >>build/build.log 2>&1 ||
    die "the benchmarks do not build: see build/build.log"
  export ANTHROB_BENCH_ROBOTS="$here/build/bench_robots"
  local n
  for n in 0 10 20 50 100 200; do
    scripts/make_torso.py --muscles "$n" --out "$ANTHROB_BENCH_ROBOTS/muscles_$n" || die "cannot write the robots"
  done
  for n in 1 5 10 20 40; do
    scripts/make_torso.py --joints "$n" --muscles 40 --out "$ANTHROB_BENCH_ROBOTS/joints_$n" || die "cannot write the robots"
  done
  say "measuring"
  measure step "$@"
  measure scaling "$@"
  measure mesh "$@"
  measure mocap "$@"
  /usr/bin/python3 scripts/bench_table.py build/bench.json build/{step,scaling,mesh,mocap}.json
}

study() {
  local name="${1:-}"
  # Files that begin with an underscore are shared by the studies.
  [[ "$name" != _* && -f "scripts/study/$name.py" ]] ||
    refuse "study: ${name:-no name given}: expected one of: $(
      cd scripts/study && ls -- [!_]*.py | sed 's/\.py$//' | tr '\n' ' '
    )"
  shift
  build_if_changed
  mkdir -p build/study
  scripts/study/"$name".py "$@"
}

shell() {
  build_if_changed
  say "this shell knows the workspace; leave it with exit"
  bash --rcfile <(echo "[ -f ~/.bashrc ] && . ~/.bashrc; export PATH='$PATH'; . '$here/devel/setup.bash'
    . '$here/scripts/completion.bash'") -i
}

clean() {
  rm -rf devel install .catkin_workspace src/CMakeLists.txt
  [ -d build ] && find build -mindepth 1 -maxdepth 1 ! -name study -exec rm -rf {} +
  return 0
}

command="${1:-help}"
[ $# -gt 0 ] && shift
clean_environment
case "$command" in
  deps | build | sim | demo | picture | movie | bench | study | shell | clean | help) "$command" "$@" ;;
  test) tests "$@" ;;
  -h | --help) help ;;
  *) refuse "unknown command '$command': run ./catkin_ws.sh help for a list" ;;
esac
