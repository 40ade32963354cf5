# SPDX-License-Identifier: BSD-3-Clause
"""PrintSelf of every class shows every property that it has."""
from meamtest import check, concrete_classes

shown = 0
for kind in concrete_classes():
    text = str(kind())
    ours = [base for base in kind.__mro__ if base.__name__.startswith("vtkMEAM")]
    names = {name[3:] for base in ours for name in vars(base) if name.startswith("Set") and hasattr(kind, "Get" + name[3:])}
    lacks = [name for name in sorted(names) if f"{name}: " not in text]
    check(not lacks, f"PrintSelf of {kind.__name__} lacks {lacks}")
    shown += len(names)
check(shown > 250, f"only {shown} properties are known")
