# SPDX-License-Identifier: BSD-3-Clause
"""The tables of meamBenchmarks: medians and rates, and how the time grows."""
import collections
import json
import math
import os
import statistics
import subprocess

from ppfmeam import scripting

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MS = {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}


def run(*arguments):
    """The runs that the program tells of."""
    build = [os.path.join(ROOT, "cmake", "build.sh"), "release", "meamBenchmarks"]  # which all else leaves as it was
    if subprocess.run(build, stdout=subprocess.DEVNULL, check=False).returncode:
        raise scripting.Failure(f"meamBenchmarks is not built: {' '.join(build)}")
    program = os.path.join(ROOT, "build", "release", "bin", "meamBenchmarks")
    done = subprocess.run([program, *arguments, "--benchmark_format=json"], stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)["benchmarks"]


def medians(names, repetitions=5):
    """Of runs in random order a row for each benchmark."""
    runs = run(f"--benchmark_filter=^({names})(/|$)", f"--benchmark_repetitions={repetitions}",
               "--benchmark_enable_random_interleaving=true",
               "--benchmark_report_aggregates_only=true")
    rows = [{"benchmark": one["run_name"].replace("/real_time", ""), "ms": one["real_time"] * MS[one["time_unit"]],
             **next(({"rate": value, "of": name.removesuffix("/s")} for name, value in one.items() if name.endswith("/s")),
                    {"rate": None, "of": ""})}
            for one in runs if one.get("aggregate_name") == "median"]
    if not rows:
        raise scripting.Failure("no benchmark was measured: do the names still fit?")
    return sorted(rows, key=lambda row: row["benchmark"])


def slopes(runs=None):
    """Fits time = c * points^slope to the benchmarks named By..."""
    growing = collections.defaultdict(list)
    for one in runs or run("--benchmark_filter=By.*Points/"):
        if "points" in one and one["run_type"] == "iteration":
            growing[one["run_name"].split("/")[0]].append((one["points"], one["real_time"] * MS[one["time_unit"]]))
    rows = []
    for name, known in growing.items():
        points, times = ([math.log(value) for value in of] for of in zip(*sorted(known)))
        slope, start = statistics.linear_regression(points, times)
        farthest = max(abs(time - start - slope * point) for point, time in zip(points, times))
        rows.append({"benchmark": name, "points from": math.exp(points[0]), "to": math.exp(points[-1]),
                     "ms from": math.exp(times[0]),
                     "ms to": math.exp(times[-1]), "slope": slope, "farthest from the line, %": 100 * (math.exp(farthest) - 1)})
    return rows
