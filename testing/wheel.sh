#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the Python wheel for the VTK of this machine (pip wheel . --no-build-isolation), installs it in a fresh virtual
# environment that sees Debian's VTK and NumPy, and uses module and command from there. Needs scikit-build-core (Debian 13:
# python3-scikit-build-core) and python3-venv.
#
#   testing/wheel.sh [FOLDER]      FOLDER: where the wheel stays
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=/usr/bin/python3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed() { tail -n 30 "$work"/*.log >&2; echo "FAILED: $*" >&2; exit 1; }
$python -c 'import scikit_build_core, venv, ensurepip' 2>/dev/null ||
  { echo "skipped: scikit-build-core or python3-venv is missing"; exit 77; }

echo "== the wheel"
wheels=$(mkdir -p "${1:-$work/wheels}" && cd "${1:-$work/wheels}" && pwd)
rm -f "$wheels"/ppfmeam-*.whl
$python -m pip wheel "$root" --no-build-isolation --no-deps -w "$wheels" >"$work/wheel.log" 2>&1 || failed "pip wheel"
wheel=$(ls "$wheels"/ppfmeam-*.whl)
ls -sh "$wheel"

echo "== in a fresh environment"
cd "$work" # nothing of the checkout is on a path
unset PYTHONPATH
$python -m venv --system-site-packages fresh
fresh/bin/pip install --no-index --no-deps "$wheel" >"$work/install.log" 2>&1 || failed "pip install"
version=$(sed -n 's/^project(PPFMEAM VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
[ "$(fresh/bin/ppfmeam --version)" = "ppfmeam $version" ] || failed "ppfmeam --version says $(fresh/bin/ppfmeam --version)"
fresh/bin/python - "$PWD/fresh" <<'END' || failed "the module"
import sys
import ppfmeam
from ppfmeam import filters
assert ppfmeam.__file__.startswith(sys.argv[1]), ppfmeam.__file__
assert filters.__file__.startswith(sys.argv[1]), filters.__file__
part = filters.vtkMEAMSamplePartSource()
part.Update()
assert part.GetOutput().GetNumberOfPolys() > 0
END
plate=$root/examples/parts/hole_plate.stl
fresh/bin/ppfmeam simulate --cad "$plate" --copies 4 --seed 5 --out bins >/dev/null
fresh/bin/ppfmeam train --cad "$plate" --out plate.meam >/dev/null
fresh/bin/ppfmeam detect --model plate.meam --depth bins/test/000000/depth/000000.png --camera bins/camera.json \
  --image bins/test/000000/gray/000000.png --poses 2 --matrices found.txt >/dev/null
[ "$(wc -w <found.txt)" = 32 ] || failed "detect finds less than two poses"
echo "the wheel works"
