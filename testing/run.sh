#!/usr/bin/env bash
# Builds everything and runs all tests: the release build, core under the sanitizers (dev), and the filters
# under plain VTK 9.1 (vtk), two tests at a time. Arguments go to ctest: testing/run.sh -L core, testing/run.sh -R Hashing.
# The dataset tests look for data in $PPFMEAM_DATA and are skipped without it.
set -uo pipefail
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
  found=$((found + $(ctest --test-dir "$root/build/$preset" -N "$@" | sed -n 's/^Total Tests: //p')))
  ctest --test-dir "$root/build/$preset" --output-on-failure -j2 "$@" || failed+=("$preset")
}
run release "core, filters, plugin" "" "$@"
run dev "core under the sanitizers" "" "$@"
run vtk "filters under plain VTK 9.1" runtime -L filters "$@"

if [ ${#failed[@]} -gt 0 ]; then
  echo "FAILED: ${failed[*]}"
  exit 1
fi
if [ "$found" = 0 ]; then
  echo "no test fits: $*"
  exit 1
fi
echo "all tests passed: release, dev, vtk"
