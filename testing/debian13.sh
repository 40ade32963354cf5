#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# All of it on a Debian 13 that has nothing installed, which is made in a folder: README's two commands, the packages,
# and what they do on another bare Debian 13. Needs root, debootstrap or mmdebstrap, 8 GB and a mirror of Debian.
#
#   testing/debian13.sh [FOLDER]      FOLDER stays, the next run with it does only what is new; without it all goes
#   testing/debian13.sh --here        on this machine, as in a container of debian:13; packages are made, not tried
#   SUITE=bookworm, MIRROR=URL        Debian 12; another mirror
#
# What is tried is the commit that is checked out.
set -euo pipefail
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
suite=${SUITE:-trixie}
mirror=${MIRROR:-http://deb.debian.org/debian}
failed=()
step() { # "what", command...
  local what=$1 begin=$SECONDS; shift
  echo "== $what"
  if "$@"; then echo "== $what: $((SECONDS - begin)) s"; else failed+=("$what"); fi
}
steps() { # how to run a command in the sources
  step "finds the parts of a simulated bin" "$@" examples/run.sh
  step "tests" "$@" testing/run.sh
  step "packages" "$@" packaging/build.sh
}
summary() {
  if [ ${#failed[@]} -gt 0 ]; then printf 'FAILED: %s\n' "${failed[@]}"; exit 1; fi
  echo "all of it works on $1"
}

if [ "${1:-}" = --here ]; then
  cd "$checkout"
  steps env
  summary "this machine"
  exit
fi

[ "$(id -u)" = 0 ] || { echo "testing/debian13.sh: only root can make a Debian in a folder" >&2; exit 2; }
if [ -n "${1:-}" ]; then
  folder=$(mkdir -p "$1" && cd "$1" && pwd)
else
  folder=$(mktemp -d)
  trap 'rm -rf --one-file-system "$folder"' EXIT
fi

make_debian() { # a bare one
  [ ! -f "$1/etc/debian_version" ] || return 0
  echo "making a bare $suite in $1"
  local log=$1.log
  if command -v debootstrap >/dev/null; then
    set -- "$1" debootstrap
  else
    set -- "$1" mmdebstrap
  fi
  "$2" --variant=minbase --include=ca-certificates "$suite" "$1" "$mirror" >"$log" 2>&1 || { tail "$log"; exit 1; }
  cp /etc/resolv.conf "$1/etc/"
}
name=$(git -C "$checkout" config user.name || echo PPFMEAM)
address=$(git -C "$checkout" config user.email || echo ppfmeam@example.org)
within() { # FOLDER COMMAND...: in its /src, with mounts that go when the command ends
  local place=$1; shift
  unshare --mount --pid --fork bash -euc '
    mount -t proc proc "$0/proc"
    mount --rbind /dev "$0/dev"
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 ${http_proxy:+http_proxy="$http_proxy"} \
      DEBFULLNAME="$1" DEBEMAIL="$2" \
      chroot "$0" bash -c "cd /src && exec \"\$@\"" within "${@:3}"
    exit # not exec: Xvfb tells process 1, which this is, nothing of its start, and xvfb-run would wait' \
    "$place" "$name" "$address" "$@"
}
give_sources() { # to FOLDER/src: the commit, and what was built there stays
  [ -d "$1/src" ] || git clone -q --no-checkout "$checkout" "$1/src"
  git -C "$1/src" fetch -q "$checkout" HEAD
  git -C "$1/src" reset -q --hard FETCH_HEAD
}
packages() { # on a Debian that never saw a build
  rm -rf --one-file-system "$folder/user"
  make_debian "$folder/user"
  give_sources "$folder/user"
  cp -r "$folder/build/src/build/packages" "$folder/user/packages"
  within "$folder/user" testing/packages.sh /packages
}

make_debian "$folder/build"
give_sources "$folder/build"
steps within "$folder/build"
step "packages on a bare $suite" packages
summary "$(sed -n 's/^PRETTY_NAME=//p' "$folder/build/etc/os-release")"
