# Tab completion in ./catkin_ws.sh shell: ROS's own commands by rosbash, and of this workspace the options of tools and nodes,
# names of robots, models and muscles, arguments of launch files, and the commands of catkin_ws.sh.

# Debian's completions are loaded on demand where bash-completion is installed; here it need not be.
[ ! -f /usr/share/bash-completion/completions/rosbash ] || . /usr/share/bash-completion/completions/rosbash

anthrob_top="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

_anthrob_robots() {
  local file
  for file in "${ANTHROB_CONFIG:-$anthrob_top/config}"/*/model_*.yaml; do
    basename "$(dirname "$file")"
  done | sort -u
}

# usage: _anthrob_files ROBOT model_ .yaml: what stands between the two in the names of the robot's files
_anthrob_files() {
  local file
  for file in "${ANTHROB_CONFIG:-$anthrob_top/config}/$1/$2"*"$3"; do
    [ ! -f "$file" ] || { file="${file##*/"$2"}"; echo "${file%"$3"}"; }
  done
}

_anthrob_models() {
  local robot name
  for robot in $(_anthrob_robots); do
    for name in $(_anthrob_files "$robot" model_ .yaml); do
      echo "$robot/$name"
    done
  done
}

_anthrob_program() {
  local folder
  for folder in ${CMAKE_PREFIX_PATH//:/ }; do
    [ -x "$folder/lib/$1/$2" ] && echo "$folder/lib/$1/$2" && return
  done
}

# Options and parameters as the program's help names them.
_anthrob_options() {
  local program
  program="$(_anthrob_program "$1" "$2")"
  [ -z "$program" ] || "$program" --help 2>/dev/null | sed -nE 's/^ +((-[a-zA-Z],)?(--[a-z-]+)|(_[a-z_]+)  ).*/\3\4/p' |
    sed -E 's/^(_[a-z_]+) *$/\1:=/'
}

_anthrob_muscles() {
  local program
  program="$(_anthrob_program anthrob_sim anthrob_muscles)"
  [ -z "$program" ] || "$program" --robot "$1" --model "$2" --csv 2>/dev/null | sed -E '1d; s/,.*//'
}

# What a word NAME:=VALUE before the cursor says. usage: _anthrob_given NAME DEFAULT
_anthrob_given() {
  local word value="$2"
  for word in "${words[@]}"; do
    [[ "$word" != "$1:="* ]] || value="${word#"$1:="}"
  done
  echo "$value"
}

# The value of an option before the cursor. usage: _anthrob_option --NAME DEFAULT
_anthrob_option() {
  local i value="$2"
  for ((i = 0; i + 1 < ${#words[@]}; ++i)); do
    [ "${words[i]}" != "$1" ] || value="${words[i + 1]}"
  done
  echo "$value"
}

# Sets `words` to the words before the cursor, `current` to the one that is completed. Bash's own list breaks them at ':' and '='.
_anthrob_split() {
  local line="${COMP_LINE:0:COMP_POINT}"
  current="${line##*[[:space:]]}"
  read -ra words <<<"${line%"$current"}"
}

_anthrob_reply() {
  local IFS=$'\n'
  COMPREPLY=($(compgen -W "$1" -- "$2"))
  [[ "${COMPREPLY[*]}" != *:= ]] || compopt -o nospace 2>/dev/null
}

# Values of the arguments of launch files, and of parameters of nodes.
_anthrob_value() {
  local robot
  robot="$(_anthrob_given robot anthrob)"
  case "$1" in
    robot) _anthrob_robots ;;
    model | robot_model | controller_model) _anthrob_files "$robot" model_ .yaml ;;
    _model) _anthrob_models ;;
    protocol) _anthrob_files "$robot" record_ .yaml ;;
    backend) printf '%s\n' hardware emulated sim ;;
    mocap) printf '%s\n' none virtual ;;
    rviz | hand | paused | auto_enable | loop | sim | lock_step | homed | realtime) printf '%s\n' true false ;;
  esac
}

# Of a value, bash replaces only what follows the '='.
_anthrob_assignment() {
  [[ "$current" == *:=* ]] || return
  _anthrob_reply "$(_anthrob_value "${current%%:=*}")" "${current#*:=}"
}

_anthrob_rosrun() {
  local words current
  _anthrob_split
  if ((${#words[@]} < 3)) || [[ "${words[1]}" != anthrob_* ]]; then
    _roscomplete_exe "$@"
    return
  fi
  COMPREPLY=()
  _anthrob_assignment && return
  case "${words[-1]}" in
    --model | --close-the-loop) _anthrob_reply "$(_anthrob_models)"$'\n'"$(compgen -f -- "$current")" "$current" ;;
    --robot) _anthrob_reply "$(_anthrob_robots)" "$current" ;;
    --muscle) _anthrob_reply "$(_anthrob_muscles "$(_anthrob_option --robot anthrob)" "$(_anthrob_option --model II)")" "$current" ;;
    *) [[ "$current" != [-_]* ]] || _anthrob_reply "$(_anthrob_options "${words[1]}" "${words[2]}")" "$current" ;;
  esac
}

# NAME:= of each argument that can be given.
_anthrob_arguments() {
  sed -nE 's/.*<arg name="([a-z_]+)".* doc=.*/\1:=/p' "$anthrob_top/launch/$1" 2>/dev/null
}

_anthrob_roslaunch() {
  local words current
  _anthrob_split
  COMPREPLY=()
  _anthrob_assignment && return
  if ((${#words[@]} > 2)) && [ "${words[1]}" = anthrob_bringup ]; then
    _anthrob_reply "$(_anthrob_arguments "${words[2]}")" "$current"
  else
    _roscomplete_launch "$@"
  fi
}

_anthrob_workspace() {
  local words current
  _anthrob_split
  COMPREPLY=()
  _anthrob_assignment && return
  if ((${#words[@]} == 1)); then
    _anthrob_reply "$("$anthrob_top/catkin_ws.sh" help | sed -nE 's/^  ([a-z]+) .*/\1/p')" "$current"
    return
  fi
  case "${words[1]}" in
    sim) _anthrob_reply "$(_anthrob_arguments sim.launch)" "$current" ;;
    test) _anthrob_reply "$(cd "$anthrob_top/src" && printf '%s\n' anthrob_*)" "$current" ;;
    study) _anthrob_reply "$(cd "$anthrob_top/scripts/study" && printf '%s\n' [!_]*.py | sed 's/\.py$//')" "$current" ;;
  esac
}

complete -o default -F _anthrob_rosrun rosrun
complete -o default -F _anthrob_roslaunch roslaunch
complete -o default -F _anthrob_workspace catkin_ws.sh ./catkin_ws.sh
