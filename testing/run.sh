#!/usr/bin/env bash
# Builds everything and runs the tests, two at a time: the release build and what of core reads files and scans under the
# sanitizers (dev); with --long the filters under plain VTK (vtk), too.
#
#   testing/run.sh [--long] [CTEST ARGUMENT...]      testing/run.sh -L core, testing/run.sh --long -R Hashing
#
# Tests with the label `long` (all scenes of a dataset, thousands of damaged files, libFuzzer for a minute a reader, each test
# of core in the build where it does not run every day, each short script of a filter in a process of its own) and the build of
# the benchmarks are left out without --long.
# The dataset tests look for data in $PPFMEAM_DATA and are skipped without it.
set -uo pipefail
without=(-LE '^long$')
if [ "${1:-}" = --long ]; then without=(); shift; fi
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ -z "${PPFMEAM_DATA:-}" ] && [ -d "$root/../shared/data" ]; then
  PPFMEAM_DATA=$(cd "$root/../shared/data" && pwd)
fi
export PPFMEAM_DATA=${PPFMEAM_DATA:-}

failed=()
found=0
run() { # PRESET, "what", build target or "", ctest arguments...
  local preset=$1 what=$2 target=$3; shift 3
  echo "== $preset: $what"
  "$root/cmake/build.sh" "$preset" ${target:+"$target"} || { failed+=("$preset (build)"); return; }
  local chosen
  chosen=$(ctest --test-dir "$root/build/$preset" -N "${without[@]}" "$@")
  found=$((found + $(sed -n 's/^Total Tests: //p' <<<"$chosen")))
  if grep -q ': fuzz$' <<<"$chosen"; then "$root/cmake/build.sh" fuzz meamFuzz || failed+=("fuzz (build)"); fi
  ctest --test-dir "$root/build/$preset" --output-on-failure -j2 "${without[@]}" "$@" || failed+=("$preset")
}
if [ ${#without[@]} = 0 ]; then
  "$root/cmake/build.sh" release meamAblation meamCoreTests || failed+=("release, for --long (build)")
fi
run release "core, filters, plugin" "" "$@"
if [ ${#without[@]} = 0 ]; then
  "$root/cmake/build.sh" release meamBenchmarks || failed+=("benchmarks (build)")
  "$root/cmake/build.sh" sanitized meamPoseTests || failed+=("sanitized, for --long (build)")
  run sanitized "core under the sanitizers" "" "$@"
  run vtk "filters under plain VTK" runtime -L filters "$@"
else
  run dev "readers and scans under the sanitizers" "" "$@"
fi

if [ ${#failed[@]} -gt 0 ]; then
  echo "FAILED: ${failed[*]}"
  exit 1
fi
if [ "$found" = 0 ]; then
  echo "no test fits: $* (those of a single filter run with --long)"
  exit 1
fi
echo "all tests passed"
