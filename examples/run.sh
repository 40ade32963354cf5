#!/usr/bin/env bash
# Runs an example; sets up the machine (Debian 12 or 13) and builds first when that is needed.
#
#   examples/run.sh                    the main job: finds the parts in a simulated bin
#   examples/run.sh SCRIPT [ARGS...]   a script of this folder, or a path to one of yours
#
# Scripts run under /usr/bin/python3 with ParaView's VTK; one whose first line names pvpython runs under
# pvpython with the plugin loaded. PPFMEAM_PRESET=vtk runs under plain VTK instead. Without a display a
# virtual one is started.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
preset=${PPFMEAM_PRESET:-release}

script=${1:-simulated_bin.py}
shift $(($# > 0))
if [ -f "$here/$script" ]; then
  script=$here/$script
elif [ ! -f "$script" ]; then
  echo "examples/run.sh: there is no script $script here or in examples/" >&2
  exit 2
fi

"$root/cmake/build.sh" "$preset" runtime
. "$root/build/$preset/env.sh"

interpreter=/usr/bin/python3
if head -n 1 "$script" | grep -q pvpython; then interpreter=pvpython; fi
display=()
if [ -z "${DISPLAY:-}" ]; then display=(xvfb-run -a); fi
exec "${display[@]}" "$interpreter" "$script" "$@"
