#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds build/release and makes Debian packages of it, for the Debian and the ParaView of this machine:
#
#   packaging/build.sh [FOLDER]      FOLDER: where to put them, default build/packages
#
# Their maintainer is DEBFULLNAME <DEBEMAIL>, as for Debian's own tools, or who commits here with git. Where nobody is named
# it is the user of this machine, and lintian finds errors when that is root or the machine has no domain.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-$root/build/packages}
mkdir -p "$folder"
name=${DEBFULLNAME:-$(git -C "$root" config user.name 2>/dev/null || id -un)}
address=${DEBEMAIL:-$(git -C "$root" config user.email 2>/dev/null || echo "$(id -un)@$(hostname -f)")}

"$root/cmake/debian.sh" packages
"$root/cmake/build.sh" release runtime
log=$root/build/packaging.log
failed() { tail -n 40 "$log" >&2; echo "making packages failed; the whole output is in build/packaging.log" >&2; exit 1; }
cmake -S "$root" --preset release -DPPFMEAM_MAINTAINER="$name <$address>" >"$log" 2>&1 || failed
cmake --build "$root/build/release" --target runtime >>"$log" 2>&1 || failed
rm -f "$folder"/*ppfmeam*.deb
cpack --config "$root/build/release/CPackConfig.cmake" -B "$folder" >>"$log" 2>&1 || failed
rm -rf "$folder/_CPack_Packages"
ls "$folder"/*.deb
