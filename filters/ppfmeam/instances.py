# SPDX-License-Identifier: BSD-3-Clause
"""What became of every true instance of the scenes that were judged: which pose found it, or which stage lost it."""
import csv

import numpy

from . import api, scripting

COLUMNS = ("part", "scene", "image", "instance", "has to be found", "found by", "visible", "mm", "degrees", "lost in", "why")


class Instances:
    """A row for each true instance; of those that were not found the stage that lost them and why, which takes another search
    of the scene. `options`: those of the search, as why() has them."""

    def __init__(self, **options):
        self.rows, self.options = [], options

    def add(self, where, run, poses, truth, scan, **inputs):
        """A scene: `where` has its part, scene and image. Returns the Diagnosis of each that was missed, by its place."""
        _, columns = run.judged_image(poses, truth)
        missed = numpy.flatnonzero(columns["FoundBy"] == 0).tolist()
        told = {}
        if missed:
            transforms = scripting.column(truth, "Transform", 4, 4)[missed]
            told = dict(zip(missed, api.why(api.Model(run.model), scan, pose=transforms, poses=0, **inputs, **self.options)))
        for k, (wanted, by, visible, mm, degrees) in enumerate(zip(*(columns[name] for name in (
                "HasToBeFound", "FoundBy", "VisibleFraction", "TranslationError", "RotationError")))):
            why = told.get(k)
            self.rows.append({**dict.fromkeys(COLUMNS, ""), **where, "instance": k + 1, "has to be found": wanted, "found by": by or "",
                              "visible": f"{visible:.3f}", "mm": f"{mm:.3f}", "degrees": f"{degrees:.3f}",
                              "lost in": why.lost_in if why else "",
                              "why": f"{why.verdict} {why.advice}".strip() if why else ""})
        return told

    def write(self, path):
        with scripting.written(path, newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(self.rows)
