#!/usr/bin/env bash
# The order of the house; prints what breaks it and fails:
# - dependencies point one way: examples -> plugin, xml -> filters -> core
# - a folder of core/ holds a dozen units, and testing/core/ has the same folders
# - a type has a name of its own
# - a number has a reason, a field of settings is set somewhere
cd "$1" || exit 2
status=0
forbid() { # reason, pattern, files...; `except`: lines that may
  local reason=$1 pattern=$2; shift 2
  if grep -nHE "$pattern" "$@" | grep -vE "${except:-^$}"; then echo "^ $reason"; status=1; fi
}
shopt -s nullglob globstar
core=(core/**/*.h core/**/*.cpp)
headers=(filters/*/*.h)
sources=(filters/*/*.h filters/*/*.cxx)
steps=(core/{features,mesh,model,pose,scene}/**/*.cpp)
stepHeaders=(core/{features,mesh,model,pose,scene}/**/*.h)
[ ${#core[@]} -gt 0 ] && [ ${#headers[@]} -gt 0 ] && [ ${#steps[@]} -gt 0 ] || { echo "no sources under $1"; exit 2; }
forbid "core/ does not include VTK" '#include *["<]vtk' "${core[@]}"
forbid "core/ does not print" 'std::(cout|cerr|clog)|(^|[^a-zA-Z_])printf *\(' "${core[@]}"
forbid "filters/ knows nothing of ParaView" '[Pp]ara[Vv]iew|PARAVIEW|vtkPV|vtkSM[A-Z]' "${sources[@]}"
forbid "no third-party type in a filter's header" '(pcl|cv|Eigen|CGAL|OpenMesh)::|#include *[<"](pcl|opencv2|Eigen|CGAL|OpenMesh)/|#include *[<"](bullet|btBullet)|#include *<[A-Z][A-Za-z]+(_[A-Za-z0-9]+)?\.hxx>' "${headers[@]}"

# A unit is a stem: its header, its source, or both.
most_units=12
while read -r units folder; do
  [ "$units" -le $most_units ] || { echo "$folder holds $units units, more than $most_units: split it"; status=1; }
done < <(printf '%s\n' "${core[@]%.*}" | sort -u | xargs -n1 dirname | uniq -c)

# Two types of one name share their inline functions at link time, whichever header a file includes.
twice=$(grep -hE '^(struct|class) [A-Za-z0-9_]+( final)?( :.*)?$' core/**/*.h testing/core/**/*.h | awk '{ print $2 }' | sort | uniq -d)
[ -z "$twice" ] || { echo "two headers of core define $twice"; status=1; }

# testing/core/ROOM/TestStem.cpp tests core/ROOM/Stem.h. Those of testing/core itself are about several rooms.
for test in testing/core/*/**/Test*.cpp; do
  folder=$(dirname "${test#testing/}") stem=$(basename "$test" .cpp)
  [ -f "$folder/${stem#Test}.h" ] || { echo "$test: there is no $folder/${stem#Test}.h"; status=1; }
done

# A number is a constexpr with its reason as a comment, behind it or before it (`constexpr int chunk = 128; // bins that
# wait`), or a field of settings, and a preset, a filter, a benchmark or an example sets that.
awk '
  function constant(line) {
    return FILENAME ~ /cpp$/ && line ~ /^(static |inline )*(constexpr|const) [^(]*[={].*[0-9]/ ||
      line ~ /^ +(static |inline )*(constexpr|const) [^(=]*( =|[{]) *-?\.?[0-9][-+*\/ .0-9e]*[fFuUlL]*[};]/
  }
  FNR == 1 { told = begun = 0 }
  /^ *\/\// { told = 1; next }
  constant($0) { begun = 1 }
  !begun { told = 0; next }
  /;/ { if (!told && !/; *\/\//) { print FILENAME ":" FNR ":" $0; wrong = 1 } begun = 0 }
  END { if (wrong) { print "^ a number has its reason as a comment" } exit wrong }' "${steps[@]}" "${stepHeaders[@]}" || status=1
/usr/bin/python3 testing/settings.py . || status=1
except=' = 1\.0[,)]|: +const (double|float) [A-Za-z]+ = ' forbid "a tuned number is no argument's default" '(double|float) [A-Za-z]+ = [^,;)]*[1-9][^,;)]*[,)]' "${stepHeaders[@]}"
exit $status
