#!/usr/bin/env bash
# Two VTKs in one process are a crash: nothing built for ParaView may pull in the system's plain VTK.
# Usage: ldd.sh LIBRARY...
status=0
for library in "$@"; do
  [ -f "$library" ] || { echo "missing: $library"; status=1; continue; }
  if ldd "$library" | grep -E 'libvtk[^ ]*-9\.[0-9]'; then echo "^ $library links plain VTK"; status=1; fi
  if ldd "$library" | grep 'not found'; then echo "^ $library does not load"; status=1; fi
done
exit $status
