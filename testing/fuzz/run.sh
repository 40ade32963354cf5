#!/usr/bin/env bash
# Builds the preset `fuzz` and gives every reader, or those named, files that libFuzzer makes, two readers at a time. Prints
# a line for each; what was found is kept in build/fuzz/found and makes it fail.
#
#   testing/fuzz/run.sh [SECONDS] [READER...]      testing/fuzz/run.sh 600 pcd model; 60 seconds each without
#
# New files that reach code no file has reached before stay in build/fuzz/corpus, where a next run goes on from them;
# testing/fuzz/keep.py puts the few that reach the most into testing/fuzz/reached. A file that was found goes, made as small
# as possible, to testing/fuzz/corpus/READER when what it showed is mended.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build/fuzz
seconds=60
if [[ ${1:-} =~ ^[0-9]+$ ]]; then seconds=$1; shift; fi
[ -n "${MEAM_FUZZ_BUILT:-}" ] || "$root/cmake/build.sh" fuzz meamFuzz || exit 1
[ -x "$build/bin/meamFuzz" ] || { echo "skipped: there is no build/fuzz; testing/fuzz/run.sh makes it"; exit 77; }
readers=("$@")
[ ${#readers[@]} -gt 0 ] || mapfile -t readers < <(cd "$here/corpus" && ls | grep -vxE 'step|iges') # another process reads these

fuzz() { # READER
  local reader=$1 log=$build/$1.log
  mkdir -p "$build/corpus/$reader" "$build/found"
  local folders=("$build/corpus/$reader" "$here/corpus/$reader")
  [ ! -d "$here/reached/$reader" ] || folders+=("$here/reached/$reader") # of a new reader there is none
  MEAM_READER=$reader "$build/bin/meamFuzz" -max_total_time="$seconds" -max_len=65536 -len_control=1000 \
    -dict="$here/words.dict" -timeout=10 -rss_limit_mb=4096 -use_value_profile=1 -print_final_stats=1 \
    -artifact_prefix="$build/found/$reader-" "${folders[@]}" >"$log" 2>&1 &
  local status=0 runs coverage found=-
  wait $! || status=$?
  rm -rf "/dev/shm/meam-fuzz-$!-$reader" "${TMPDIR:-/tmp}/meam-fuzz-$!-$reader" # a crash leaves it
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  coverage=$(grep -ao 'cov: [0-9]*' "$log" | tail -1)
  [ $status = 0 ] || found=$(sed -n 's/.*Test unit written to //p' "$log" | tail -1)
  # libFuzzer looks at the clock: a machine that is busy makes any file last too long.
  if [[ $found == *-timeout-* ]] && MEAM_READER=$reader "$build/bin/meamFuzz" -timeout=10 "$found" >>"$log" 2>&1; then
    rm "$found"
    found="- (ended early: the machine is busy)" status=0
  fi
  printf '%-14s %10s %8s  %s\n' "$reader" "${runs:--}" "${coverage#cov: }" "${found:-status $status, see $log}"
  return $status
}

printf '%-14s %10s %8s  %s\n' reader runs coverage found
status=0
for reader in "${readers[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n || status=1; done
  fuzz "$reader" &
done
while [ -n "$(jobs -p)" ]; do wait -n || status=1; done
exit $status
