# SPDX-License-Identifier: BSD-3-Clause
"""PPF-MEAM: 6D poses of industrial parts in a bin.

    import ppfmeam
    model = ppfmeam.train("part.stl")
    print(ppfmeam.detect(model, "scan.pcd").poses)

The single steps are VTK algorithms: ppfmeam.filters."""


class Error(Exception):
    """Something the user has to know and can act on: the message says what is wrong and what to do."""


def __getattr__(name):
    # Only now, so that ppfmeam.filters alone needs neither NumPy nor VTK's readers.
    if name in ("Detections", "Diagnosis", "Model", "detect", "load", "train", "why"):
        from . import api
        return getattr(api, name)
    if name in ("Grasps", "Picks", "grasps", "pick"):
        from . import picking
        return getattr(picking, name)
    if name == "__version__":
        from .version import VERSION
        return VERSION
    raise AttributeError(f"module 'ppfmeam' has no attribute '{name}'")
