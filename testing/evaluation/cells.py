#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table 9 of the paper: the sample parts in a simulated picking cell (`ppfmeam cell`), with a gripper that suits each part, slim
to reach in at walls. DIR gets picks.csv, from which a run goes on that was stopped, table9.md with every failure and its reason,
with a display a chart of it; films and pictures of the bins."""
import os

from ppfmeam import cell, scripting, simulation

import charts
import results
from scenes import PARTS, part_mesh

COPIES = 12  # in a bin, as in the paper
BINS = 5
KIND = ("part", "sensor", "gripper")
PAPER = {"part": "part A (the paper)", "sensor": "structured light", "gripper": "jaws", "bins": 5, "trials": 63, "success": 60,
         "failure": 3,
         "success rate": 95.2, "left in the bins": 0, "detection ms": 889, "planning ms": None}


def lengths(diameter):
    """The gripper's, mm."""
    shares = dict(opening=92, jaw_clearance=2, finger_width=6, finger_thickness=4, finger_length=60, tip_length=5, body_length=80,
                  body_width=40, cup_diameter=8, cup_length=70)
    return {name: share * diameter / 80 for name, share in shares.items()}


def figures(picks):
    """A line of the table for each kind of cell, after the paper's."""
    rows = [PAPER]
    for kind in dict.fromkeys(tuple(row[name] for name in KIND) for row in picks):
        of_kind = [row for row in picks if tuple(row[name] for name in KIND) == kind]
        bins, _, tried, right, left = cell.summary(of_kind)
        rows.append({**dict(zip(KIND, kind)), "bins": bins, "trials": tried, "success": right, "failure": tried - right,
                     "success rate": 100 * right / tried if tried else None, "left in the bins": left,
                     "detection ms": round(results.median(of_kind, "detect_ms")),
                     "planning ms": round(results.median(of_kind, "plan_ms"))})
    return rows


def failures(picks):
    return [f"- {row['part']}, {row['sensor']}, bin {row['seed']}, trial {row['pick']}: "
            + (f"{row['outcome']} ({row['reason']}; the pose is {row['mm']} mm and {row['degrees']} degrees off)"
               if row["outcome"] else f"{row['left']} left: {row['reason']}") for row in picks if row["outcome"] != "success"]


def table9(out, parts, sensors, gripper, bins, copies, seed, threads):
    """The table in Markdown, which is also written, and its rows."""
    wanted = [(part, sensor, gripper, "0", str(copies), str(number)) for part in parts for sensor in sensors
              for number in range(seed, seed + bins)]
    picks = cell.Cell(out).run(wanted, lambda part, sensor,
                               gripper: cell.Station(part, part_mesh(part), sensor, gripper, lengths, threads))
    rows, reasons = figures(picks), failures(picks)
    text = "\n\n".join([f"Table 9. Pickup success rate: a simulated cell with {copies} parts in a bin.",
                        results.markdown(list(rows[0]), [
        [f"{value:.1f} %" if name == "success rate" and value is not None else results.words_of(value)
         for name, value in row.items()] for row in rows]),
        *(["Failures, and bins that were left:", "\n".join(reasons)] if reasons else [])]) + "\n"
    with scripting.written(os.path.join(out, "table9.md")) as file:
        file.write(text)
    shares = {"trials with success": [row["success rate"] for row in rows],
              "parts picked": [100 * row["success"] / max(row["success"] + row["left in the bins"], 1) for row in rows]}
    charts.bars(os.path.join(out, "table9.png"), "Table 9. Pickup success rate",
                [", ".join(row[name] for name in KIND) for row in rows], shares, "%")
    return text, rows


def measure(dir, parts: results.names_of(PARTS) = ["ridged_disc"],
            sensors: results.names_of(simulation.SENSORS) = ["structured-light"],
            gripper="jaws", bins=BINS, copies=COPIES, seed=1, threads=0):
    return table9(dir, parts, sensors, gripper, bins, copies, seed, threads)[1]


if __name__ == "__main__":
    results.command(measure, dir="folder to write", gripper="jaws or cup", bins="of each part and sensor",
                    seed="of the first bin")
