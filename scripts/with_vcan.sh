#!/usr/bin/env bash
# usage: scripts/with_vcan.sh COMMAND [ARGUMENT...]
# Runs a command where the virtual CAN interface vcan0 exists, and exits with its status.
#
# On the host if its kernel has vcan and we may set it up (or vcan0 is up already). Otherwise in user-mode Linux
# (Debian package user-mode-linux): a kernel that runs as a process, sees and writes this machine's files and has no
# network but its own loopback. ANTHROB_VCAN=uml: there in any case. ANTHROB_VCAN_OUT: folder for HOME and logs there
# (default: a new one under /tmp).
set -u
[ $# -gt 0 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }

host_has_vcan() {
  ip link show vcan0 2>/dev/null | grep -q 'UP' && return 0
  [ "$(id -u)" -eq 0 ] || return 1
  modprobe vcan 2>/dev/null
  ip link add dev vcan0 type vcan 2>/dev/null  # unless it is there already, but down
  ip link set vcan0 up 2>/dev/null
}

if [ "${ANTHROB_VCAN:-auto}" != uml ] && host_has_vcan; then
  export ANTHROB_VCAN_ON="native vcan, Linux $(uname -r)"
  exec "$@"
fi
command -v linux.uml >/dev/null ||
  { echo "with_vcan.sh: this kernel has no vcan and linux.uml is missing: apt-get install user-mode-linux" >&2; exit 1; }

own_out=
[ -n "${ANTHROB_VCAN_OUT:-}" ] || own_out="$(mktemp -d /tmp/vcan.XXXXXX)"
out="${ANTHROB_VCAN_OUT:-$own_out}"
mkdir -p "$out" || exit 1
script="$(mktemp /tmp/vcan_init.XXXXXX)"
status="$out/.status"
rm -f "$status"

# What the little kernel runs as its init: set up, then the command in our environment and folder.
{
  cat <<'INIT'
#!/bin/bash
export PATH=/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t tmpfs -o size=64m tmpfs /run
mount -t tmpfs -o size=64m tmpfs /dev/shm 2>/dev/null
modules=/usr/lib/uml/modules/$(uname -r)/kernel
for module in net/can/can net/can/can-raw drivers/net/can/dev/can-dev drivers/net/can/vcan; do
  [ -f "$modules/$module.ko" ] && insmod "$modules/$module.ko"
done
echo localhost >/proc/sys/kernel/hostname  # anonymous nodes are named by it, and "(none)" is no name
ip link set lo up
ip link add dev vcan0 type vcan && ip link set vcan0 txqueuelen 1000 up || echo "with_vcan.sh: no vcan0 in user-mode Linux" >&2
INIT
  export -p
  echo "export HOME=$(printf %q "$out") ROS_LOG_DIR=$(printf %q "$out/ros_log") ROS_MASTER_URI=http://localhost:11311"
  echo 'unset ROS_IP; export ROS_HOSTNAME=localhost ANTHROB_PACE="${ANTHROB_PACE:-0.25}"'
  echo 'export ANTHROB_VCAN_ON="vcan in user-mode Linux $(uname -r), one processor"'
  printf 'cd %q\n' "$PWD"
  printf '%q ' "$@"
  printf '\necho $? > %q\nsync\nhalt -f\n' "$status"
} >"$script"
chmod +x "$script"

# On processors with AMX it needs help.
xstate=
if grep -qw amx_tile /proc/cpuinfo; then
  xstate="$(mktemp /tmp/vcan_xstate.XXXXXX)"
  cc -shared -fPIC -O1 -o "$xstate" "$(dirname "$0")/uml_xstate.c" -ldl || { rm -f "$xstate"; xstate=; }
fi

# Ahead of all else on this machine, where that is allowed: an emulated robot that has to wait looks dead.
ahead=()
! chrt --fifo 1 true 2>/dev/null || ahead=(chrt --fifo 1)

# In a process group of its own and in the background, so that a signal gets through and ends all of it.
exec 3> >(sed -u 's/\r//g; /^Halting\.$/d; /reboot: System halted$/d')
TMPDIR=/tmp LD_PRELOAD="$xstate" \
  setsid "${ahead[@]}" linux.uml mem="${ANTHROB_VCAN_MEMORY:-768M}" rootfstype=hostfs rootflags=/ rw "init=$script" \
  con=null con0=null,fd:1 quiet loglevel=0 </dev/null 2>"$out/.kernel" >&3 &
uml=$!
trap 'kill -KILL -- -$uml 2>/dev/null; rm -f "$script" ${xstate:+"$xstate"}' EXIT
trap 'exit 143' TERM INT
wait "$uml"
exec 3>&-
if [ -f "$status" ]; then
  ended="$(cat "$status")"
  # Logs of what went well are nobody's; those of a folder that was asked for are.
  [ "$ended" != 0 ] || [ -z "$own_out" ] || rm -rf "$own_out"
  exit "$ended"
fi
echo "with_vcan.sh: the command did not end; messages of the kernel: $out/.kernel" >&2
exit 1
