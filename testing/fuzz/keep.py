#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Chooses from what libFuzzer has found (build/fuzz/corpus, after testing/fuzz/run.sh) the few files of each reader that reach
most of what the files of corpus/ do not, and puts them into testing/fuzz/reached in place of those that are there.

testing/fuzz/keep.py [READER...]"""
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.path.join(HERE, "..", "..", "build", "fuzz")
MOST, LONGEST, LEAST = 12, 2000, 4  # files of a reader, bytes of a file, edges that it adds
COUNTERS = 8  # features of an edge: how often it was taken


def edges_of(reader, *folders):
    """By file the edges of the program that reading it takes."""
    with tempfile.TemporaryDirectory() as folder:
        control = os.path.join(folder, "control")
        os.makedirs(os.path.join(folder, "merged"))
        subprocess.run([os.path.join(BUILD, "bin", "meamFuzz"), "-set_cover_merge=1", "-use_value_profile=0",
                        f"-merge_control_file={control}", os.path.join(folder, "merged"), *filter(os.path.isdir, folders)],
                       env=dict(os.environ, MEAM_READER=reader), stderr=subprocess.DEVNULL, check=True)
        with open(control, encoding="utf-8") as file:
            count, _, *lines = file.read().splitlines()
    paths, words = lines[:int(count)], [line.split() for line in lines[int(count):]]
    return {paths[int(place)]: {int(feature) // COUNTERS for feature in features}
            for kind, place, *features in filter(None, words) if kind == "FT"}


def keep(reader):
    kept, reached, grown = (os.path.join(*place, reader) for place in ((HERE, "corpus"), (HERE, "reached"),
                                                                      (BUILD, "corpus")))
    edges = edges_of(reader, kept, reached, grown)
    known = set().union(*(edges[path] for path in edges if path.startswith(kept + os.sep)))
    before, every = len(known), len(set().union(*edges.values()))
    left = {path for path in edges if not path.startswith(kept + os.sep) and os.path.getsize(path) <= LONGEST}
    contents = []
    while left and len(contents) < MOST:
        path = max(sorted(left), key=lambda path: (len(edges[path] - known), -os.path.getsize(path)))
        if len(edges[path] - known) < LEAST:
            break
        with open(path, "rb") as file:
            contents.append(file.read())
        known |= edges[path]
        left.remove(path)
    shutil.rmtree(reached, ignore_errors=True)
    os.makedirs(reached)
    for number, content in enumerate(contents):
        with open(os.path.join(reached, f"{number:02d}"), "wb") as file:
            file.write(content)
    print(f"{reader}: {before} edges by corpus/, {len(known)} with {len(contents)} files more, {every} by all", flush=True)


for reader in sys.argv[1:] or sorted(os.listdir(os.path.join(HERE, "corpus"))):
    keep(reader)
