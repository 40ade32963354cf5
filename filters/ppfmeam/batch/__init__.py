# SPDX-License-Identifier: BSD-3-Clause
"""Many scans: by one process or by all that mpirun starts, stopped and taken up again, and as they arrive."""
