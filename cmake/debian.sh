#!/usr/bin/env bash
# Gets a Debian 12 or 13 ready to build: installs the packages that are missing and unpacks into build/deps what
# cannot be installed beside ParaView. Costs nothing, and needs no network, when everything is there.
#
#   cmake/debian.sh            what the plugin, the Python package, the examples and the tests need
#   cmake/debian.sh vtk        that and, for the vtk preset, a plain VTK in build/deps/vtk9
#   cmake/debian.sh packages   that and what packaging/build.sh makes Debian packages with
#   cmake/debian.sh fuzz       that and what testing/fuzz/run.sh builds with
#
# libpcl-dev and plain VTK's packages conflict with python3-paraview, hence the unpacking: of PCL only the
# headers are needed (its runtime libraries install fine), plain VTK runs from where it is unpacked.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
deps=$root/build/deps

fail() { echo "cmake/debian.sh: $*" >&2; exit 1; }
command -v apt-get >/dev/null || fail "this machine has no apt-get; its list of packages tells what to install by hand"

# What the releases of Debian name differently.
. /etc/os-release
case ${VERSION_ID:-} in
  12)
    pcl=1.13 vtk=9.1
    # The plugin's toolbar and icons (ParaView's icons are libqt5svg5's), and what ParaView makes its help pages with.
    suite=(libqt5svg5 qtbase5-dev qttools5-dev qtxmlpatterns5-dev-tools clang-format)
    ;;
  *)
    [ "${VERSION_ID:-}" = 13 ] || echo "cmake/debian.sh: made for Debian 12 and 13, this is ${PRETTY_NAME:-unknown}" >&2
    pcl=1.15 vtk=9.3
    suite=(libqt6svg6 qt6-base-dev python3-dev) # ParaView has no help pages of plugins with Qt 6
    ;;
esac

packages=(
  g++ cmake ninja-build
  make # what CMake builds examples/cpp with when it is not told otherwise
  paraview paraview-dev python3-paraview python3-numpy xvfb xauth libgl1-mesa-dri
  libpcl-{common,kdtree,octree,search,sample-consensus,filters,features,registration}"$pcl"
  libopencv-imgcodecs-dev libopencv-calib3d-dev libeigen3-dev libcgal-dev libopenmesh-dev
  libflann-dev liblzf-dev zlib1g-dev nlohmann-json3-dev libyaml-cpp-dev libbullet-dev libfcl-dev pybind11-dev
  libocct-{foundation,modeling-data,modeling-algorithms,data-exchange}-dev
  openmpi-bin python3-mpi4py # several processes: ppfmeam batch
  libjs-three # pages in 3D: ppfmeam detect --report
  libutfcpp-dev libdouble-conversion-dev liblzma-dev # what VTK::IOCore's CMake files ask for
  libgtest-dev libbenchmark-dev
  python3-nbclient python3-ipykernel # a notebook in a kernel: TestNotebook
  qemu-user # a processor without AVX: TestSameBits
  "${suite[@]}"
)
[ "${1:-}" != packages ] || packages+=(dpkg-dev file)
[ "${1:-}" != fuzz ] || packages+=(clang libclang-rt-dev libomp-dev)
unpack=(pcl:libpcl-dev)
if [ "${1:-}" = vtk ]; then
  unpack+=(vtk9:{libvtk9-dev,"libvtk$vtk","libvtk$vtk-qt",vtk9,python3-vtk9})
fi

mkdir -p "$deps"
log=$root/build/packages.log

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; return; fi
  command -v sudo >/dev/null || { echo "not root, and there is no sudo"; return 1; }
  sudo "$@"
}

mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}" | sort) \
  <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null | sed -n 's/^installed //p' | sort))
if [ ${#missing[@]} -gt 0 ]; then
  echo "installing ${#missing[@]} Debian packages and what they need (log: build/packages.log)"
  # --no-remove: a machine with libpcl-dev or python3-vtk9 has to be told, not changed.
  { as_root apt-get update -q && as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -q -y --no-remove --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 || {
    tail -n 20 "$log" >&2
    fail "could not install what is missing. By hand, as root: apt-get install --no-install-recommends ${missing[*]}
(libpcl-dev, libvtk9-dev and python3-vtk9 conflict with python3-paraview: if they are installed, remove them first.)"
  }
fi

# Unpacked files of one folder come together or not at all.
for folder in $(printf '%s\n' "${unpack[@]%%:*}" | uniq); do
  [ ! -d "$deps/$folder" ] || continue
  wanted=()
  for entry in "${unpack[@]}"; do [ "${entry%%:*}" != "$folder" ] || wanted+=("${entry#*:}"); done
  echo "unpacking ${wanted[*]} into build/deps/$folder"
  part=$(mktemp -d "$deps/.part.XXXXXX")
  cd "$part"
  { apt-get download -q "${wanted[@]}" || { as_root apt-get update -q && apt-get download -q "${wanted[@]}"; }; } >"$log" 2>&1 || {
    tail -n 20 "$log" >&2
    rm -rf "$part"
    fail "could not download ${wanted[*]}"
  }
  for deb in ./*.deb; do dpkg -x "$deb" tree; done
  mv tree "$deps/$folder"
  rm -rf "$part"
done
