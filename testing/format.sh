#!/usr/bin/env bash
# Whether the C++ sources are formatted as .clang-format has it, by Debian 12's clang-format 14.
#
#   testing/format.sh            lists what differs and fails; ends with 77 (skipped) without clang-format 14
#   testing/format.sh --fix      formats it
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 2
program=$(command -v clang-format-14 || command -v clang-format)
# Other versions break lines elsewhere.
if [ -z "$program" ] || ! "$program" --version | grep -q 'version 14\.'; then
  echo "skipped: there is no clang-format 14; install Debian 12's package clang-format"
  exit 77
fi
files() { find core filters testing examples -name '*.h' -print0 -o -name '*.cpp' -print0 -o -name '*.cxx' -print0; }

if [ "${1:-}" = --fix ]; then
  files | xargs -0 -P "$(nproc)" -n 20 "$program" -i
  exit
fi
different=$(files | xargs -0 -P "$(nproc)" -n 20 "$program" --dry-run 2>&1 | sed -n 's/^\(.*\):\([0-9]*\):[0-9]*: warning: .*/\1:\2/p' | sort -u)
[ -z "$different" ] && exit 0
echo "$different"
echo "these lines are not formatted; testing/format.sh --fix mends them"
exit 1
