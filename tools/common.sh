# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# What tools/start, tools/test and .ci/run share: saying what happens, and building a preset.
# Sourced from the repository's root.

say() { printf '\n== %s\n' "$*"; }

# Compiler processes at once: every core, but never more than memory holds at 2 GB each.
build_jobs() {
  local cores gigabytes
  cores=$(nproc)
  gigabytes=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo)
  local by_memory=$((gigabytes / 2))
  ((by_memory < 1)) && by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}

# build_preset PRESET [TARGET...]: configures where needed, builds the targets (all when none).
build_preset() {
  local preset=$1 jobs
  shift
  jobs=$(build_jobs)
  if [[ ! -f build/$preset/build.ninja || CMakePresets.json -nt build/$preset/build.ninja ]]; then
    say "configure build/$preset"
    cmake --preset "$preset"
  fi
  say "build build/$preset: ${*:-everything} (ninja -j$jobs)"
  ninja -C "build/$preset" -j "$jobs" "$@"
}
