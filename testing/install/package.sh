#!/usr/bin/env bash
# A new user's programs: the installed tree is found by find_package wherever it lies, examples/cpp and examples/cell are built
# against it, and find parts in a scan. Usage: package.sh SOURCE_DIR BUILD_DIR PYTHON_DIR PYTHON CXX
set -euo pipefail
source=$1 build=$2 python_dir=$3 python=$4
export CXX=$5 CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/first" >"$folder/log"
mv "$folder/first" "$folder/moved" # nothing may depend on the place
prefix=$folder/moved
if grep -rlF -e "$source" -e "$build" -e "$folder/first" "$prefix/lib/cmake/PPFMEAM" "$prefix/include"; then
  echo "^ installed files that name folders of the build"; exit 1
fi
if grep -rhE '#include' "$prefix/include/meam" | grep -vE '#include (<(Eigen/.*|[a-z_]+)>|"(meam\.h|Preset\.h|(\.\./)?(base|calibration|features|io/cad|pick|pose|scene)/.*)")'; then
  echo "^ meam.h or picks.h includes more than Eigen and its own headers"; exit 1
fi
bash "$here/libraries.sh" "$prefix/lib/libmeam"{Detect,Images,Pick,Train}.so "$prefix/lib/libppfmeam"{Detection,IO,Picking}.so

configure() { # FOLDER SOURCE
  # Without optimization: the work is that of the libraries.
  cmake -S "$2" -B "$1" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -DCMAKE_PREFIX_PATH="$prefix" >"$1.log" 2>&1 &&
    cmake --build "$1" >>"$1.log" 2>&1 || { cat "$1.log"; exit 1; }
}
cp -r "$source/examples/cpp" "$folder/cpp"
configure "$folder/cpp-build" "$folder/cpp"
cp -r "$source/examples/cell" "$folder/cell"
configure "$folder/cell-build" "$folder/cell"
cp -r "$here/module" "$folder/module"
configure "$folder/module-build" "$folder/module"

export PYTHONPATH=$prefix/$python_dir${PYTHONPATH:+:$PYTHONPATH}
"$python" "$here/scan.py" make "$folder"
"$folder/cpp-build/find_parts" "$folder/part.stl" "$folder/scan.pcd" "$folder/part.meam" >"$folder/found.txt"
"$folder/cpp-build/propose_grasps" "$folder/part.meam" "$folder/part.stl" "$folder/part.grasps.json"
"$folder/cpp-build/pick" "$folder/part.meam" "$folder/part.stl" "$folder/part.grasps.json" "$folder/scan.pcd" "$folder/robot.json" \
  >"$folder/picks.txt"
"$python" "$here/scan.py" check "$folder"
"$python" "$here/robot.py" "$folder" "$folder/cell/cell.py" "$folder/cell-build/cell"
"$folder/module-build/find_parts" "$folder/part.stl" "$folder/scan.pcd"
"$folder/module-build/find_trained_parts" "$folder/part.meam" "$folder/scan.pcd"
if "$folder/module-build/find_trained_parts" "$folder/part.stl" "$folder/scan.pcd" 2>"$folder/errors.txt"; then echo "trained without Training"; exit 1; fi
grep -qF 'PPFMEAM::Training' "$folder/errors.txt" || { cat "$folder/errors.txt"; exit 1; }
for program in cpp-build/pick cell-build/cell; do
  ldd "$folder/$program" | grep -E 'meamTrain|gmp|mpfr|OpenMesh|libTK|vtk|poppler' && { echo "^ $program links what only training needs"; exit 1; }
done
for wrong in missing.pcd part.stl; do
  if "$folder/cpp-build/pick" "$folder/part.meam" "$folder/part.stl" "$folder/part.grasps.json" "$folder/$wrong" 2>"$folder/errors.txt"; then
    echo "no error: $wrong"; exit 1
  fi
  grep -qF "$wrong" "$folder/errors.txt" || { cat "$folder/errors.txt"; exit 1; }
done
