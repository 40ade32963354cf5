#!/usr/bin/env bash
# Sets up the machine and brings one build up to date, quietly; the whole output is in build/PRESET.log and
# its end is shown when something fails. Says nothing when nothing is to be done.
#
#   cmake/build.sh PRESET [TARGET...]        release, dev, sanitized, vtk or fuzz; the targets default to everything
#
# The preset vtk links the core of build/release, and dev and sanitized some of its objects: they are built first.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=$1; shift
build=$root/build/$preset
log=$root/build/$preset.log
mkdir -p "$root/build"
case $preset in
  vtk) "${BASH_SOURCE[0]}" release coreLibraries ;;
  dev) "${BASH_SOURCE[0]}" release meamMeshCore meamPoseCore meamPartCore ;;
  sanitized) "${BASH_SOURCE[0]}" release meamMeshCore ;;
esac
exec 9>"$root/build/.lock"
flock 9 # two runs at once: the second waits

"$root/cmake/debian.sh" "$preset" >&2 9>&-

failed() { tail -n 40 "$log" >&2; echo "$1 failed; the whole output is in build/$preset.log" >&2; exit 1; }

: >"$log"
if [ ! -f "$build/build.ninja" ] || [ "$root/CMakePresets.json" -nt "$build/build.ninja" ]; then
  echo "configuring build/$preset" >&2
  cmake -S "$root" --preset "$preset" >>"$log" 2>&1 || failed "configuring"
fi

targets=(); for target in "$@"; do targets+=(--target "$target"); done
announced=
cmake --build "$build" --parallel "$(nproc)" "${targets[@]}" 2>&1 | while IFS= read -r line; do
  printf '%s\n' "$line" >>"$log"
  [[ $line =~ ^\[([0-9]+/[0-9]+)\] ]] || continue
  [ -n "$announced" ] || { echo "building build/$preset (log: build/$preset.log)" >&2; announced=1; }
  [ ! -t 2 ] || printf '\r%s ' "${BASH_REMATCH[1]}" >&2
done || failed "building"
[ ! -t 2 ] || printf '\r\033[K' >&2
