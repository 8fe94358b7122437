# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Functions that tools/start, tools/test, tools/dev, tools/package and .ci/run share: headings,
# building with progress and time left. Sourced from the repository's root.

# Worktrees share the compiler cache: paths are relative in it. tools/dev sets this for good.
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$PWD} CCACHE_NOHASHDIR=1

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

# clock SECONDS: prints "1:05", or "1:02:10" from one hour on.
clock() {
  if (($1 < 3600)); then
    printf '%d:%02d' $(($1 / 60)) $(($1 % 60))
  else
    printf '%d:%02d:%02d' $(($1 / 3600)) $(($1 / 60 % 60)) $(($1 % 60))
  fi
}

# build_progress: copies ninja's output and replaces its status lines by the share done and the time
# left: on a terminal one line that is redrawn, elsewhere a line every 15 s, later every tenth of the
# elapsed time. Compiler messages pass unchanged. Status lines: NINJA_STATUS of run_ninja.
build_progress() {
  local line finished=0 total=0 elapsed=0 next=15 text bar drawn=0
  local status='^\[([0-9]+)/([0-9]+) ([0-9]+)[.0-9]*\] '
  while IFS= read -r line || [[ -n $line ]]; do
    if [[ ! $line =~ $status ]]; then
      ((drawn)) && printf '\r\e[K'
      drawn=0
      printf '%s\n' "$line"
      continue
    fi
    finished=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]} elapsed=${BASH_REMATCH[3]}
    ((finished > 0)) || continue
    printf -v text '%3d %%  %d of %d steps  %s, about %s left' $((100 * finished / total)) \
      "$finished" "$total" "$(clock "$elapsed")" \
      "$(clock $((elapsed * (total - finished) / finished)))"
    if [[ -t 1 ]]; then
      printf -v bar '%*s' $((24 * finished / total)) ''
      printf -v bar '%-24s' "${bar// /#}"
      printf '\r\e[K[%s] %s' "${bar// /.}" "$text"
      drawn=1
    elif ((elapsed >= next)); then
      printf '%s\n' "$text"
      next=$((elapsed + (elapsed > 150 ? elapsed / 10 : 15)))
    fi
  done
  ((drawn)) && printf '\r\e[K'
  if ((finished > 0)); then
    echo "built: $finished of $total steps in $(clock "$elapsed")"
  fi
}

# run_ninja FOLDER [TARGET...]: builds with progress; ninja's exit code.
run_ninja() (
  set -o pipefail
  folder=$1
  shift
  NINJA_STATUS='[%f/%t %e] ' ninja -C "$folder" -j "$(build_jobs)" "$@" | build_progress
)

# build_preset PRESET [TARGET...]: configures where needed, builds the targets (all when none).
build_preset() {
  local preset=$1
  shift
  if [[ ! -f build/$preset/build.ninja || CMakePresets.json -nt build/$preset/build.ninja ]]; then
    say "configure build/$preset"
    cmake --preset "$preset"
  fi
  say "build build/$preset: ${*:-everything} (ninja -j$(build_jobs))"
  run_ninja "build/$preset" "$@"
}
