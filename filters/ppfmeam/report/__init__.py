# SPDX-License-Identifier: BSD-3-Clause
"""What was found, as one HTML file to send: page.py makes it, of what content.py takes from the scan and told.py says of it."""
