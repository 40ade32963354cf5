# SPDX-License-Identifier: BSD-3-Clause
"""`ppfmeam batch` for pvbatch, which wants a file: mpirun -n N pvbatch --symmetric .../ppfmeam/batch/__main__.py ..."""
import sys

from ppfmeam import scripting
from ppfmeam.commands import batch

sys.argv[0] = "ppfmeam batch"
scripting.run(batch.main)
