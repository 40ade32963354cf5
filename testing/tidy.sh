#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy) on the C++ sources that differ from a base, with the commands of build/release.
#
#   testing/tidy.sh [BASE]      BASE: a commit; default: where the branch left main, on main itself the commit before
#   testing/tidy.sh --all       all sources of core/
#
# Fails when clang-tidy finds something; ends with 77 (skipped) without clang-tidy, a build or a repository.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 2
build=${PPFMEAM_BUILD:-$root/build/release}
skip() { echo "skipped: $*"; exit 77; }
command -v clang-tidy >/dev/null || skip "there is no clang-tidy; install the Debian package of that name"
[ -f "$build/compile_commands.json" ] || skip "there is no $build/compile_commands.json: configure the release build first"

if [ "${1:-}" = --all ]; then
  mapfile -t files < <(find core -name '*.cpp' | sort)
else
  git rev-parse --verify -q HEAD >/dev/null || skip "this is no git repository: nothing tells what was changed"
  base=${1:-$(git merge-base HEAD main 2>/dev/null)}
  if [ -z "$base" ] || [ "$base" = "$(git rev-parse HEAD)" ]; then base=HEAD~1; fi
  git rev-parse --verify -q "$base^{commit}" >/dev/null || {
    [ -z "${1:-}" ] || { echo "there is no commit $1 to compare with"; exit 2; }
    skip "there is no commit before this one to compare with"
  }
  # Sources that were changed, and those beside a header that was.
  mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- core filters |
    sed -n 's|^\(core/.*\)\.h$|\1.cpp|p; s|^\(filters/.*\)\.h$|\1.cxx|p; /\.\(cpp\|cxx\)$/p' | sort -u | while read -r file; do [ -f "$file" ] && echo "$file"; done)
fi
# Only what the build compiles: another flavor leaves some out.
known=()
for file in "${files[@]}"; do
  if grep -qF "\"$root/$file\"" "$build/compile_commands.json"; then known+=("$file"); fi
done
[ ${#known[@]} -gt 0 ] || { echo "no source was changed"; exit 0; }
commands=$(mktemp -d)
trap 'rm -rf "$commands"' EXIT
sed 's/ -fsched-pressure//g' "$build/compile_commands.json" >"$commands/compile_commands.json" # GCC's alone
printf '%s\0' "${known[@]}" | xargs -0 -P "$(nproc)" -n 1 clang-tidy --quiet -p "$commands" 2> >(grep -vE 'warnings? (generated|treated)|Suppressed|Use -header-filter|^$' >&2)
