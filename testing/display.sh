#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# display.sh COMMAND...: runs COMMAND on a virtual display of its own and ends with its status. The server itself takes a
# free number, keeps it when its last client leaves and has ended before this script does; xvfb-run -a does neither.
set -euo pipefail

exec {ready}< <(exec Xvfb -displayfd 1 -screen 0 1280x1024x24 -nolisten tcp -noreset 2>/dev/null)
server=$!
trap 'kill "$server" 2>/dev/null; wait "$server" || :' EXIT
read -r -u "$ready" number || { echo "display.sh: Xvfb does not start (Debian's package xvfb)" >&2; exit 77; }
status=0
DISPLAY=":$number" "$@" || status=$?
exit "$status"
