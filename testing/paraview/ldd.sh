#!/usr/bin/env bash
# Two VTKs in one process are a crash: nothing built for ParaView may pull in the system's VTK 9.1.
# Usage: ldd.sh LIBRARY...
status=0
for library in "$@"; do
  [ -f "$library" ] || { echo "missing: $library"; status=1; continue; }
  if ldd "$library" | grep -E 'libvtk[^ ]*-9\.1'; then echo "^ $library links VTK 9.1"; status=1; fi
  if ldd "$library" | grep 'not found'; then echo "^ $library does not load"; status=1; fi
done
exit $status
