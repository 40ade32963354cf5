#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What others would use instead, on scenes of the Tohoku dataset, judged as our own poses are (testing/evaluation/tohoku.py --found).
#
#   testing/rivals/tohoku.sh BUILD DATASET OUT [SCENES]      such as build/release data/tohoku /tmp/rivals 10
#
# Needs a build with PPFMEAM_BUILD_RIVALS=ON. OUT/NAME/Part_P/transI.txt, and OUT/NAME/seconds.txt: of processor time.
set -euo pipefail
build=$1 data=$2 out=$3 scenes=${4:-10}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [ ! -x "$build/bin/meamRivalOpenCV" ] || [ ! -x "$build/bin/meamRivalPCL" ]; then
  echo "there are no rivals in $build: cmake -DPPFMEAM_BUILD_RIVALS=ON $build && cmake --build $build" >&2
  exit 1
fi
offset() { if [ "$1" = 3 ]; then echo "-20.9645 -17.4974 -9.3144"; else echo "0 0 0"; fi; } # Part 3's STL is in another frame
for name in OpenCV PCL; do
  for refined in "" --refined; do
    to="$out/$name$refined"
    rm -f "$to/seconds.txt"
    for part in 1 2 3; do
      mkdir -p "$to/Part_$part"
      files=()
      for ((scene = 0; scene < scenes; ++scene)); do
        files+=("$data/Part_$part/Scenes/Scene$scene.pcd" "$to/Part_$part/trans$scene.txt")
      done
      # shellcheck disable=SC2046,SC2086
      "$build/bin/meamRival$name" $refined "$data/Part_$part/Part_$part.STL" $(offset "$part") "${files[@]}" |
        grep '\.pcd [0-9.e-]*$' >> "$to/seconds.txt" # PCL tells of its votes, too
    done
    echo "== $name $refined: $(sort -k2 -g "$to/seconds.txt" | awk '{ t[NR] = $2 } END { print t[int((NR + 1) / 2)] }') s of processor time a scene (median)"
    bash "$root/examples/run.sh" "$root/testing/evaluation/tohoku.py" "$data" --scenes "0-$((scenes - 1))" --found "$to"
  done
done
