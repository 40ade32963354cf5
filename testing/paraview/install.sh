#!/usr/bin/env bash
# The installed tree works from where it lies: Python imports it, ParaView loads the plugin from it.
# Usage: install.sh BUILD_DIR PYTHON_DIR PLUGIN_DIR PYTHON PVPYTHON SCRIPT ARGS...
set -euo pipefail
build=$1 python_dir=$2 plugin_dir=$3 python=$4 pvpython=$5
shift 5
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix/first" >"$prefix/log"
mv "$prefix/first" "$prefix/moved" # nothing may depend on the place
export PYTHONPATH=$prefix/moved/$python_dir PV_PLUGIN_PATH=$prefix/moved/$plugin_dir
unset LD_LIBRARY_PATH
"$python" -c 'import ppfmeam.filters; print(ppfmeam.filters.__file__)'
"$pvpython" "$@"
