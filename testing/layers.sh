#!/usr/bin/env bash
# Dependencies point one way: examples -> plugin, xml -> filters -> core. Prints what breaks that and fails.
cd "$1" || exit 2
status=0
forbid() { # reason, pattern, files...
  local reason=$1 pattern=$2; shift 2
  if grep -nHE "$pattern" "$@"; then echo "^ $reason"; status=1; fi
}
shopt -s nullglob globstar
core=(core/**/*.h core/**/*.cpp)
headers=(filters/*.h)
sources=(filters/*.h filters/*.cxx)
[ ${#core[@]} -gt 0 ] && [ ${#headers[@]} -gt 0 ] || { echo "no sources under $1"; exit 2; }
forbid "core/ does not include VTK" '#include *["<]vtk' "${core[@]}"
forbid "core/ does not print" 'std::(cout|cerr|clog)|(^|[^a-zA-Z_])printf *\(' "${core[@]}"
forbid "filters/ knows nothing of ParaView" '[Pp]ara[Vv]iew|PARAVIEW|vtkPV|vtkSM[A-Z]' "${sources[@]}"
forbid "no third-party type in a filter's header" '(pcl|cv|Eigen|CGAL|OpenMesh)::|#include *[<"](pcl|opencv2|Eigen|CGAL|OpenMesh)/|#include *[<"](bullet|btBullet)' "${headers[@]}"
exit $status
