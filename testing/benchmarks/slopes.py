#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How the time of a benchmark grows: fits time = c * points^slope to the benchmarks named By..., and prints the slopes.

meamBenchmarks --benchmark_filter=By --benchmark_format=json | testing/benchmarks/slopes.py
Of repetitions the medians count; otherwise every run.
"""
import collections
import json
import math
import statistics
import sys


def main():
    runs = [run for run in json.load(sys.stdin)["benchmarks"] if "points" in run]
    medians = [run for run in runs if run.get("aggregate_name") == "median"]
    growing = collections.defaultdict(list)
    for run in medians or [run for run in runs if run["run_type"] == "iteration"]:
        growing[run["run_name"].split("/")[0]].append((run["points"], run["real_time"], run["time_unit"]))
    print(f"{'benchmark':28}  {'points':>15}  {'time':>22}  slope  farthest from the line")
    for name, rows in growing.items():
        rows.sort()
        points = [math.log(row[0]) for row in rows]
        times = [math.log(row[1]) for row in rows]
        slope, start = statistics.linear_regression(points, times)
        farthest = max(abs(time - start - slope * point) for point, time in zip(points, times))
        print(f"{name:28}  {rows[0][0]:6.0f} - {rows[-1][0]:6.0f}  {rows[0][1]:8.3f} - {rows[-1][1]:8.3f} {rows[0][2]}"
              f"  {slope:5.2f}  {100 * (math.exp(farthest) - 1):.0f} %")


main()
