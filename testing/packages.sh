#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# On a bare Debian that never saw a build, of the release that they were made on, as root: installs the packages of
# packaging/build.sh by apt and uses all of them.
# It installs about 1 GB of Debian's packages; run it in a chroot or a container.
#
#   testing/packages.sh FOLDER      the folder of the .deb files
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" # nothing of the checkout is on a path
failed() { echo "FAILED: $*" >&2; exit 1; }
get() { apt-get install -q -y --no-install-recommends "$@" >>"$work/apt.log" 2>&1 || { tail -n 30 "$work/apt.log"; failed "apt-get install $*"; }; }
soversion=$(sed -n 's/^project(PPFMEAM VERSION \([0-9]*\.[0-9]*\)\..*/\1/p' "$here/../CMakeLists.txt")
[ -n "$soversion" ] || failed "CMakeLists.txt names no version"
export DEBIAN_FRONTEND=noninteractive
apt-get update -q >"$work/apt.log"

echo "== libppfmeam-detect and libppfmeam-pick alone: what a cell gets"
get "$folder"/libppfmeam-{detect,pick}_*.deb binutils
if dpkg-query -W -f '${db:Status-Status} ${Package}\n' | grep -E '^installed .*(cgal|mpfr|poppler|gdal|paraview|vtk|openmesh|bullet|occt)'; then failed "detection installs what it does not need"; fi
for library in Detect Pick; do
  [ -e /usr/lib/libmeam$library.so."$soversion" ] || failed "there is no libmeam$library.so.$soversion"
  readelf -d /usr/lib/libmeam$library.so."$soversion" | grep -E "(gmp|mpfr|OpenMesh|Bullet|libTK|imgcodecs|vtk)" && failed "libmeam$library.so links what only training needs"
done

echo "== the command and the Python package"
get "$folder"/{python3-ppfmeam,libppfmeam-train}_*.deb
[ -e /usr/lib/libmeamTrain.so."$soversion" ] || failed "python3-ppfmeam comes without the C++ libraries"
python3 -c "import ppfmeam; ppfmeam.detect"
version=$(dpkg-query -W -f '${Version}' python3-ppfmeam)
[ "$(ppfmeam --version)" = "ppfmeam ${version%-*}" ] || failed "ppfmeam --version says $(ppfmeam --version)"
ppfmeam --help | grep -q '^  detect ' || failed "ppfmeam --help"
python3 -m ppfmeam --help >/dev/null
python3 -c 'import ppfmeam; assert ppfmeam.__file__ == "/usr/lib/python3/dist-packages/ppfmeam/__init__.py", ppfmeam.__file__'
ls /usr/lib/python3/dist-packages/ppfmeam/__pycache__/*.pyc >/dev/null || failed "modules are not compiled"
plate=/usr/share/doc/python3-ppfmeam/examples/parts/hole_plate.stl
ppfmeam simulate --cad "$plate" --copies 4 --seed 5 --out bins
ppfmeam train --cad "$plate" --out plate.meam
ppfmeam detect --model plate.meam --depth bins/test/000000/depth/000000.png --camera bins/camera.json \
  --image bins/test/000000/gray/000000.png --poses 2 --matrices found.txt --report found.html
[ "$(wc -w <found.txt)" = 32 ] || failed "detect finds less than two poses"
grep -q THREE.OrbitControls found.html || failed "the page has no 3D"
ppfmeam evaluate bop bins --poses 2 --out results.csv | grep -q strict || failed "evaluate"

echo "== the plugin in ParaView's list"
get "$folder"/ppfmeam-paraview_*.deb
cat >plugin.py <<'END'
from paraview import servermanager
from paraview.simple import *

plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
names = [plugins.GetPluginName(k) for k in range(plugins.GetNumberOfPlugins())]
assert "PPFMEAM" in names, names
print("listed:", names)
LoadDistributedPlugin("PPFMEAM", ns=globals())
part = SamplePartSource()
part.UpdatePipeline()
assert part.GetDataInformation().GetNumberOfPoints() > 0
assert "MEAMPoseEstimation" in globals()
print("loaded, and it works")
END
pvpython plugin.py || failed "the plugin"

echo "== C++ with find_package(PPFMEAM)"
get "$folder"/libppfmeam-{train,dev}_*.deb g++ make cmake
bash "$here/install/libraries.sh" /usr/lib/libmeam{Detect,Images,Pick,Train}.so /usr/lib/libppfmeam{Detection,IO,Picking}.so || failed "libraries"
cmake -S /usr/share/doc/libppfmeam-dev/examples/cpp -B cpp -DCMAKE_BUILD_TYPE=Release >cpp.log 2>&1 && cmake --build cpp >>cpp.log 2>&1 ||
  { cat cpp.log; failed "the examples do not compile"; }
python3 "$here/install/scan.py" make "$work"
cpp/find_parts part.stl scan.pcd part.meam >found.txt
cpp/propose_grasps part.meam part.stl part.grasps.json
cpp/pick part.meam part.stl part.grasps.json scan.pcd robot.json >picks.txt
python3 "$here/install/scan.py" check "$work"
cmake -S /usr/share/doc/libppfmeam-dev/examples/cell -B cell -DCMAKE_BUILD_TYPE=Release >cell.log 2>&1 && cmake --build cell >>cell.log 2>&1 ||
  { cat cell.log; failed "the cell does not compile"; }
python3 "$here/install/robot.py" "$work" /usr/share/doc/libppfmeam-dev/examples/cell/cell.py "$work/cell/cell"

echo "== the VTK modules in C++"
get paraview-dev
cmake -S "$here/install/module" -B module >module.log 2>&1 && cmake --build module >>module.log 2>&1 ||
  { cat module.log; failed "programs with the VTK modules do not compile"; }
module/find_parts part.stl scan.pcd || failed "a program with PPFMEAM::Filters"
module/find_trained_parts part.meam scan.pcd || failed "a program with PPFMEAM::Detection"

echo "== lintian"
get lintian
lintian --fail-on error "$folder"/*.deb >lintian.log 2>&1 || { grep '^E' lintian.log || cat lintian.log; failed "lintian finds errors"; }

echo "== removed again"
apt-get purge -q -y 'ppfmeam-paraview' 'python3-ppfmeam' 'libppfmeam-*' >>"$work/apt.log" 2>&1 || { tail -n 20 "$work/apt.log"; failed "purge"; }
left=$(find /usr /etc /var/lib/dpkg/info -iname '*ppfmeam*' -o -name 'libmeam*' -o -path /usr/bin/paraview.conf)
[ -z "$left" ] || failed "left behind: $left"
echo "all packages work"
