#!/usr/bin/env bash
# usage: scripts/tidy.sh [XML]
# Runs clang-tidy with the checks of .clang-tidy on the .cpp files that changed, and ends with 1 on a finding. XML: result
# file with a test case for each file. The workspace must be built: flags are those of build/compile_commands.json.
#
# Changed: since ANTHROB_TIDY_BASE; without it, since the branch left origin/main; on main itself, in the last commit.
# At most ANTHROB_TIDY_FILES files (default 12), those that changed last.
set -u -o pipefail
cd "$(dirname "$0")/.." || exit 1
xml="${1:-/dev/null}" most="${ANTHROB_TIDY_FILES:-12}" out=build/tidy found=0 cases=

# Of another user's folder too, as in containers.
git() { command git -c safe.directory='*' "$@"; }

# usage: add_case NAME [ELEMENT]
add_case() { cases+="<testcase classname=\"tidy\" name=\"$1\">${2:-}</testcase>"$'\n'; }

leave_out() {
  echo "tidy.sh: left out: $1"
  add_case "$1" '<skipped/>'
}

finish() {
  mkdir -p "$(dirname "$xml")" && printf '<testsuites><testsuite name="tidy">\n%s</testsuite></testsuites>\n' "$cases" >"$xml"
  exit "$found"
}

skip() { leave_out "$1"; finish; }

# The commit to compare with; fails where there is none, as in a tarball or a clone of depth 1.
find_base() {
  [ -z "$(git rev-parse --show-cdup)" ] || return 1  # a folder of some other repository
  local base="${ANTHROB_TIDY_BASE:-}"
  [ -n "$base" ] || base="$(git merge-base HEAD origin/main 2>/dev/null)" || base=
  if [ -z "$base" ] || [ "$base" = "$(git rev-parse HEAD)" ]; then base=HEAD~1; fi
  git rev-parse -q --verify "$base^{commit}"
}

# Not yet committed, then by commits, newest first.
changed_files() {
  {
    git diff --name-only HEAD -- '*.cpp'
    git ls-files --others --exclude-standard -- '*.cpp'
    git log --format= --name-only "$1..HEAD" -- '*.cpp'
  } | awk '!seen[$0]++'
}

# The commands of the single files, of which the build compiles several as one.
single_files() {
  /usr/bin/python3 - build/compile_commands.json "$out/compile_commands.json" <<'PYTHON'
import json, re, sys
singles = []
for entry in json.load(open(sys.argv[1])):
    together = []
    # What gcc has compiled beforehand, clang cannot read.
    command = re.sub(r'-include \S*cmake_pch\.hxx', '', entry['command'])
    if '/Unity/unity_' in entry['file']:
        together = re.findall(r'#include "(.*)"', open(entry['file']).read())
    singles += [{'directory': entry['directory'], 'file': file, 'command': command.replace(entry['file'], file)}
                for file in together or [entry['file']]]
json.dump(singles, open(sys.argv[2], 'w'), indent=2)
PYTHON
}

# A file as build/compile_commands.json names it, if it is compiled at all. tests/ is a link in a package.
as_compiled() {
  sed -nE "s|^ *\"file\": \"(.*/${1/#tests\//anthrob_tests/tests/})\".*|\1|p" "$out/compile_commands.json" | head -1
}

check() {
  local said
  if said="$(clang-tidy --quiet -p "$out" "$2" 2>/dev/null)"; then
    add_case "$1"
  else
    found=1
    said="${said:-clang-tidy did not end well}"
    printf '%s\n' "$said"
    add_case "$1" "<failure>$(sed "s|$PWD/||g; s/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g" <<<"$said")</failure>"
  fi
}

command -v clang-tidy >/dev/null || skip 'no clang-tidy: apt-get install clang-tidy'
[ -f build/compile_commands.json ] || skip 'no build/compile_commands.json: build the workspace first'
base="$(find_base 2>/dev/null)" || skip 'no history to compare with'

mkdir -p "$out"
single_files || skip 'build/compile_commands.json cannot be read'
files=()
while read -r file; do
  compiled="$(as_compiled "$file")"
  [ ! -f "$file" ] || [ -z "$compiled" ] || files+=("$file:$compiled")
done < <(changed_files "$base")
[ ${#files[@]} -gt 0 ] || skip "no compiled file changed since ${base:0:10}"

for pair in "${files[@]:0:$most}"; do
  echo "tidy.sh: ${pair%%:*}"
  check "${pair%%:*}" "${pair#*:}"
done
[ ${#files[@]} -le "$most" ] || leave_out "$((${#files[@]} - most)) more files that changed earlier"
finish
