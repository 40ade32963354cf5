# SPDX-License-Identifier: BSD-3-Clause
"""PPF-MEAM: 6D poses of industrial parts in a bin.

    import ppfmeam
    model = ppfmeam.train("part.stl")
    print(ppfmeam.detect(model, "scan.pcd").poses)

The single steps are VTK algorithms: ppfmeam.filters."""


class Error(Exception):
    """Something the user has to know and can act on: the message says what is wrong and what to do."""

    def __str__(self):
        from .choices import worded
        return worded(super().__str__())


_HOMES = {"Detections": "api", "Diagnosis": "api", "Model": "api", "calibrate": "api", "detect": "api", "load": "api", "train": "api", "why": "api",
          "Grasp": "_core", "Pick": "_core", "Pose": "_core", "Grasps": "picking", "Picks": "picking", "grasps": "picking",
          "pick": "picking"}
__all__ = ["Error", "filters", *_HOMES]


def __getattr__(name):
    # Only now, so that ppfmeam.filters alone needs neither NumPy nor VTK's readers.
    from importlib import import_module
    if name in _HOMES:
        return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    if name == "filters":
        return import_module(f"{__name__}.filters")
    if name == "__version__":
        from .version import VERSION
        return VERSION
    raise AttributeError(f"module 'ppfmeam' has no attribute '{name}'")


def __dir__():
    return sorted([*__all__, "__version__"])
