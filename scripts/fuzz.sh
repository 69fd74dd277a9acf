#!/usr/bin/env bash
# usage: scripts/fuzz.sh [FRAMES]
# Builds driver core, firmware and emulated ECUs with the address and undefined-behaviour sanitizers and sends them that
# many random and mutated frames (default 1000000), see src/anthrob_driver/test/integration/fuzz_test.cpp.
set -eu
cd "$(dirname "$0")/.."
out=build/fuzz
mkdir -p "$out"
mapfile -t sources < <(find src/anthrob_core/src src/anthrob_ecu/src src/anthrob_driver/src -name '*.cpp')
sources+=(src/anthrob_driver/test/integration/fuzz_test.cpp)
includes=(-isystem /usr/include/eigen3 -Isrc/anthrob_driver/test)
for package in core ecu driver; do includes+=("-Isrc/anthrob_$package/include" "-Isrc/anthrob_$package/src"); done
# Anew each time: an object that is older than a header would be a bug of its own.
rm -f "$out"/*
for source in "${sources[@]}"; do echo "$source $out/$(echo "$source" | tr / _).o"; done |
  xargs -P "$(nproc)" -L 1 bash -c \
    'g++ -std=c++17 -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all \
       -DANTHROB_CONFIG_DIR="\"'"$PWD"'/config\"" '"${includes[*]}"' -c "$1" -o "$2"' compile
g++ -fsanitize=address,undefined "$out"/*.o -o "$out/fuzz_test" -lgtest_main -lgtest -lyaml-cpp -lpthread
FUZZ_FRAMES="${1:-1000000}" "$out/fuzz_test"
