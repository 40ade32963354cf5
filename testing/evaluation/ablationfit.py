#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Switches the decisions of the method off, one at a time, and measures what is left of it in several worlds.

  . build/release/env.sh; testing/evaluation/ablation.py --out OUT [--world NAME...] [--switch NAME...]

Needs the target meamAblation. OUT/rows.csv gets a row for each scene and switch as they come; a rerun adds what is missing.
OUT/ablation.csv and OUT/ablation.md are the figures of all rows: of each world and switch
  found        copies that are at least half visible, of the known ones in real scans, by all poses that come out
  R@99         of these, those found by the likeliest poses of the world, as long as 99 % of them are right
  log loss     of the probabilities, nats, sum over all poses (in the table for each copy); a second pose of a copy is wrong
  right, wrong poses above 50 %
  ms           processor time of a scene, mean: one thread
Worlds: bins (20 copies of each of seven parts, seeds 501 on), sensors (parts x sensors, seed 801, and the same bins
searched for another part), siblings (the part is absent and one lies there that looks alike; place probabilities), absent (the
same of the pairs in $PPFMEAM_DATA/failing), sheets (a part of 1 % of its diameter), pipes and real (real scans in
$PPFMEAM_DATA), tohoku (with normal noise of 1 % of D). Of real
scans nothing is known of poses that are no known copy: they have no R@99 and no log loss. Pipes are judged by the depth
that a pose predicts: how many copies there are is not known."""
import argparse
import csv
import datetime
import json
import math
import os
import subprocess
import sys

import numpy

ROOT = "/work/ci"
DATA = os.environ.get("PPFMEAM_DATA", "")
sys.path.insert(0, os.environ.get("PPFMEAM_ABLATION_MODULE", os.path.join(ROOT, "build", "release", "testing", "evaluation")))
import meamAblation as meam  # noqa: E402

BIN_PARTS = {  # the CAD file, and its factor to mm
    "ridged_disc": ("examples/parts/ridged_disc.stl", 1), "arc_lever": ("examples/parts/arc_lever.stl", 1),
    "flap": ("examples/parts/flap.stl", 1), "hole_plate": ("examples/parts/hole_plate.stl", 1),
    "gear": ("DATA/cad/gear.ply", 1), "regulator": ("DATA/cad/assembly_regulator_collision.stl", 1000),
    "lug": ("DATA/cad/small.ply", 1000)}
SENSORS = ("structured-light", "active-stereo", "time-of-flight")
SENSOR_PARTS = ("ribbed_flange", "ridged_disc", "arc_lever", "flap", "hole_plate", "pipe_elbow", "cap", "knob", "handle")
REAL = (("pulleys", "wrs4_pulley", "pulley"), ("pulleys", "wrs4_motor", "motor"), ("cups", "frame0", "coffee_cup"),
        ("wedges", "frame0", "wedge"), ("wedges", "frame1", "wedge"), ("desk", "frame00", "cube"),
        ("desk", "frame00", "dragon"), ("desk", "frame28", "cube"), ("desk", "frame28", "dragon"))
ABSENT = (("absent_part_likely", "pin30", "bin_of_pin36"), ("absent_part_likely", "headed_pin32", "bin_of_rods75"),
          ("handed_part", "left", "bin_of_right"))  # folder, what is looked for, what lies there
TOHOKU_OFFSETS = {3: (-20.9645, -17.4974, -9.3144)}  # mm: its STL is in another frame than its true poses
NOISE = 0.01  # of D
SIBLINGS_SEED = 961  # nothing was fitted on it
SHEETS_SEEDS = range(1001, 1004)  # nothing was fitted on them
PIPES_FOCAL = 422.25  # pixels
LEAST = 1e-4  # probability that a log loss takes for less, and for more than one less it
COLUMNS = ("world", "part", "scene", "switch", "copies", "found", "seconds", "poses")  # poses: probability:outcome ...
FIGURES = ("found", "found at 99 %", "log loss", "right above 50 %", "wrong above 50 %", "ms")
BY_PLACE = ("siblings", "absent")  # worlds without the part
WRONG, FOUND, RIGHT, UNKNOWN = "wfr?"  # RIGHT: a copy that need not be found
NO_IMAGE, NO_EDGES, NO_TURNS = numpy.zeros(0, numpy.uint8), numpy.zeros((0, 3), numpy.float32), numpy.zeros((0, 4, 4))
PARTS = {}  # by what they are made of


def part_of(path, scale=1.0, offset=(0, 0, 0)):
    """The part of a CAD file, or the sample part."""
    key = path, scale
    if key not in PARTS:
        vertices, triangles = meam.sample_part() if path == "ribbed_flange" else meam.read_mesh(path)
        PARTS[key] = meam.Part((vertices * scale + numpy.array(offset)).astype(numpy.float32), triangles)
    return PARTS[key]


class Case:
    """A scene in which a part is looked for: `load` returns its arrays as Scan takes them, the true poses and how much of
    each is visible; `judge` returns the outcome of each pose and how many copies have to be found."""

    def __init__(self, world, part, scene, make_part, load, judge=None):
        self.key, self.part, self.load = (world, part, scene), make_part, load
        self.judge = judge or self.by_truth

    def by_truth(self, part, transforms, scene, degrees=5.0, turns=NO_TURNS, others=WRONG):
        told = meam.judge(part, transforms, scene["truth"], scene["visible"], degrees, turns)

        def outcome(instance, duplicate):
            if instance < 0:
                return others
            if duplicate:
                return WRONG if others == WRONG else UNKNOWN
            return FOUND if told["counts"][instance] else RIGHT
        return [outcome(*each) for each in zip(told["instance"], told["duplicate"])], sum(told["counts"])


def stored(path, make):
    """The arrays of a scene, made once."""
    if not os.path.exists(path):
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path + ".part", "wb") as file:
            numpy.savez(file, **make())
        os.rename(path + ".part", path)
    return numpy.load(path)


def simulated(folder, part, sensor, seed):
    def make():
        return dict(zip(("points", "image", "truth", "visible"), meam.simulate(part(), SENSORS.index(sensor), 20, seed)))
    return stored(f"{folder}_{sensor}_{seed}.npz", make)


def bins(folder, step):
    for seed in range(1501, 1521, step):
        for name, (path, scale) in BIN_PARTS.items():
            path = path.replace("DATA", DATA) if "DATA" in path else os.path.join(ROOT, path)
            def part(path=path, scale=scale):
                return part_of(path, scale)
            yield Case("bins", name, str(seed), part, lambda name=name, part=part, seed=seed: simulated(
                os.path.join(folder, "bins", name), part, SENSORS[0], seed))


def sensors(folder, step):
    def part(name):
        return part_of(name if name == "ribbed_flange" else os.path.join(ROOT, "examples", "parts", name + ".stl"))

    def load(name, sensor, lies):
        scene = simulated(os.path.join(folder, "sensors", lies), lambda: part(lies), sensor, 811)
        if lies == name:
            return scene
        return {**scene, "truth": NO_TURNS, "visible": numpy.zeros(0)}

    for k, name in list(enumerate(SENSOR_PARTS))[::step]:
        for sensor in SENSORS:
            for lies in (name, SENSOR_PARTS[(k + 1) % len(SENSOR_PARTS)]):
                yield Case("sensors", name, f"{sensor} {lies}", lambda name=name: part(name),
                           lambda name=name, sensor=sensor, lies=lies: load(name, sensor, lies))


def siblings(folder, step):
    """Of a part that is not there, but one like it, a pose that comes out is wrong: by its place."""
    import siblings as made  # which imports this file

    for k, name in list(enumerate(SENSOR_PARTS))[::step]:
        path = name if name == "ribbed_flange" else os.path.join(ROOT, "examples", "parts", name + ".stl")
        for axis, factor in made.kinds(k):
            what = "mirrored" if factor < 0 else f"{'xyz'[axis]} {factor:g}"

            def load(name=name, path=path, axis=axis, factor=factor, what=what):
                scene = made.bin_of(os.path.join(folder, "siblings"), name, what, SENSORS[0], SIBLINGS_SEED,
                                    lambda: made.sibling(path, axis, factor))
                return {**scene, "truth": NO_TURNS, "visible": numpy.zeros(0)}

            if factor > 0 or part_of(path).has_mirror_image:
                yield Case("siblings", name, what, lambda path=path: part_of(path), load)


def absent(_, step):
    for folder, part, scan in ABSENT[::step]:
        folder = os.path.join(DATA, "failing", folder)
        yield Case("absent", part, scan, lambda path=f"{folder}/{part}.stl": part_of(path),
                   lambda path=f"{folder}/{scan}.pcd": real_scan(path, ()))


def sheets(folder, step):
    def part():
        return part_of(os.path.join(DATA, "failing", "sheet_1mm", "sheet_1mm.stl"))

    for seed in SHEETS_SEEDS[::step]:
        for sensor in SENSORS[:2]:
            yield Case("sheets", "sheet_1mm", f"{sensor} {seed}", part, lambda sensor=sensor, seed=seed: simulated(
                os.path.join(folder, "sheets", "sheet_1mm"), part, sensor, seed))


def real_scan(path, known):
    points, image = meam.read_scan(path)
    truth = numpy.array([line.split() for line in known if line.strip() and line[0] != "#"], float).reshape(-1, 4, 4)
    return {"points": points, "image": image, "truth": truth, "visible": numpy.ones(len(truth))}


def turns_onto_itself(path):
    """The rotations that map a part onto itself, without the identity: of a models_info.json's entry, an axis in steps of
    2 degrees."""
    with open(path, encoding="utf-8") as file:
        info = json.load(file)
    turns = [numpy.eye(4)] + [numpy.reshape(turn, (4, 4)) for turn in info.get("symmetries_discrete", [])]
    for symmetry in info.get("symmetries_continuous", []):
        axis, point = (numpy.array(symmetry[name], float) for name in ("axis", "offset"))
        cross = numpy.cross(numpy.eye(3), axis / numpy.linalg.norm(axis)).T
        about = []
        for angle in numpy.radians(range(0, 360, 2)):
            turn = numpy.eye(4)
            turn[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
            turn[:3, 3] = point - turn[:3, :3] @ point
            about += [one @ turn for one in turns]
        turns = about
    return numpy.array(turns[1:]).reshape(-1, 4, 4)


def real(_, step):
    for folder, scan, name in REAL[::step]:
        folder = os.path.join(DATA, "real", folder)
        known = next(path for path in (f"{folder}/{scan}_known.txt", f"{folder}/{scan}_{name}_known.txt") if os.path.exists(path))
        turns = turns_onto_itself(f"{folder}/{name}.json")

        def load(folder=folder, scan=scan, known=known):
            with open(known, encoding="utf-8") as file:
                return real_scan(f"{folder}/{scan}.pcd", file)
        case = Case("real", name, scan, lambda path=f"{folder}/{name}.stl": part_of(path), load)
        case.judge = lambda part, transforms, scene, case=case, turns=turns: case.by_truth(part, transforms, scene, 10.0, turns,
                                                                                          UNKNOWN)
        yield case


def inside(mask):
    """Without the pixels at its outline."""
    result = numpy.zeros_like(mask)
    result[1:-1, 1:-1] = mask[1:-1, 1:-1] & mask[:-2, 1:-1] & mask[2:, 1:-1] & mask[1:-1, :-2] & mask[1:-1, 2:]
    return result


def mesh_points(part, spacing=0.35):
    """Points of the surface (mm), dense enough that every pixel that sees it gets one."""
    vertices, triangles = part.mesh
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    count = numpy.ceil(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2 / spacing ** 2).astype(int)
    of, random = numpy.repeat(numpy.arange(len(triangles)), count), numpy.random.default_rng(0)
    u, v = random.random((2, len(of)))
    u, v = numpy.where(u + v > 1, 1 - u, u), numpy.where(u + v > 1, 1 - v, v)
    return a[of] + u[:, None] * (b - a)[of] + v[:, None] * (c - a)[of]


def by_depth(part, transforms, scene, margin=150, tolerance=6.0):
    """Right is a pose whose predicted depth is where the sensor saw the part's color, and which no better pose explains."""
    points, cloud, image = mesh_points(part), scene["points"].astype(float), scene["image"].astype(int)
    height, width = cloud.shape[:2]
    rows, columns = numpy.nonzero(numpy.isfinite(cloud[..., 0]))
    offset = [int(numpy.median(numpy.rint(PIPES_FOCAL * cloud[rows, columns, axis] / cloud[rows, columns, 2]) - at))
              for axis, at in ((0, columns), (1, rows))]
    measured = numpy.pad(cloud[..., 2], margin, constant_values=numpy.nan)
    colored = numpy.pad(image[..., 2] - image[..., 0] > 45, margin)
    outcomes, taken = [], []
    for T in transforms:
        x, y, z = T[:3, :3] @ points.T + T[:3, 3:]
        u, v = (numpy.rint(PIPES_FOCAL * at / z).astype(int) - shift + margin for at, shift in ((x, offset[0]), (y, offset[1])))
        seen = (u >= 0) & (v >= 0) & (u < width + 2 * margin) & (v < height + 2 * margin)
        depth = numpy.full(measured.shape, numpy.inf)
        numpy.minimum.at(depth, (v[seen], u[seen]), z[seen])
        inner = inside(numpy.isfinite(depth))
        with numpy.errstate(invalid="ignore"):
            agree, behind = inner & (numpy.abs(measured - depth) <= tolerance), inner & (measured > depth + tolerance)
        count, there = agree.sum(), (inner & numpy.isfinite(measured)).sum()
        right = (count >= 250 and count >= 0.92 * (count + behind.sum()) and count >= 0.75 * there and
                 there >= 0.5 * inner.sum() and (agree & colored).sum() >= 0.7 * count and
                 not any((agree & other).sum() > 0.5 * count for other in taken))
        outcomes.append(FOUND if right else WRONG)
        if right:
            taken.append(agree)
    return outcomes, 0


def pipes(_, step):
    folder = os.path.join(DATA, "pipes")
    for name in sorted(name for name in os.listdir(folder) if name.endswith(".pcd"))[::step]:
        yield Case("pipes", "elbow", name[:-4], lambda: part_of(os.path.join(folder, "elbow.stl")),
                   lambda name=name: real_scan(os.path.join(folder, name), ()), by_depth)


def tohoku(folder, step):
    def part(number):
        return part_of(os.path.join(DATA, "tohoku", f"Part_{number}", f"Part_{number}.STL"), 1.0,
                       TOHOKU_OFFSETS.get(number, (0, 0, 0)))

    def make(number, scene):
        where = os.path.join(DATA, "tohoku", f"Part_{number}")
        clouds = [meam.read_scan(os.path.join(where, "Scenes", name))[0].reshape(1, -1, 3)
                  for name in (f"Scene{scene}.pcd", f"Scene_boundary{scene}.pcd")]
        truth = meam.read_transforms(os.path.join(where, "Results", f"trans{scene}.txt"))
        visible = meam.visible_shares(part(number), meam.Scan(clouds[0], NO_IMAGE, clouds[1]), truth)
        random, deviation = numpy.random.default_rng(scene), NOISE * part(number).diameter
        noisy = [(cloud + random.normal(0.0, deviation, cloud.shape)).astype(numpy.float32) for cloud in clouds]
        return {"points": noisy[0], "image": NO_IMAGE, "edges": noisy[1], "truth": truth, "visible": visible}

    for scene in range(0, 20, step):
        for number in (1, 2, 3):
            yield Case("tohoku", str(number), str(scene), lambda number=number: part(number),
                       lambda number=number, scene=scene: stored(os.path.join(folder, "tohoku", f"{number}_{scene}.npz"),
                                                                 lambda: make(number, scene)))


WORLDS = {"pipes": pipes, "real": real, "tohoku": tohoku, "bins": bins, "sensors": sensors, "siblings": siblings,
          "absent": absent, "sheets": sheets}


def read_rows(path):
    """The whole lines of an earlier run."""
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8", newline="") as file:
        return [row for row in csv.DictReader(line for line in file if line.endswith("\n"))]


def measure(case, names, write):
    """Rows of a case, of these switches."""
    part, scene = case.part(), case.load()
    scan = meam.Scan(scene["points"], scene["image"], scene["edges"] if "edges" in scene else NO_EDGES)
    search = meam.Search(part, scan)
    for name in names:
        found = search.find(name)
        outcomes, copies = case.judge(part, found["T"], scene)
        claims = found["place" if case.key[0] in BY_PLACE else "probability"]
        write(dict(zip(COLUMNS, (*case.key, name, copies, outcomes.count(FOUND), f"{found['seconds']:.4f}", " ".join(
            f"{probability:.6f}:{outcome}" for probability, outcome in zip(claims, outcomes))))))


class Figures:
    """Of rows of one world and switch."""

    def __init__(self, rows):
        poses = [(float(pose[:-2]), pose[-1]) for row in rows for pose in row["poses"].split()]
        self.scenes, self.copies, self.found = len(rows), *(sum(int(row[name]) for row in rows) for name in ("copies", "found"))
        self.ms = 1000 * sum(float(row["seconds"]) for row in rows) / len(rows)
        self.right, self.wrong = (sum(p > 0.5 and outcome in kinds for p, outcome in poses) for kinds in (FOUND + RIGHT, WRONG))
        self.sure, self.loss = None, None
        if not any(outcome == UNKNOWN for _, outcome in poses):
            ranked = sorted((pose for pose in poses if pose[1] != RIGHT), key=lambda pose: -pose[0])
            right = numpy.cumsum([outcome == FOUND for _, outcome in ranked]) if ranked else numpy.zeros(0)
            self.sure = int(max([0, *right[100 * right >= 99 * numpy.arange(1, len(ranked) + 1)]]))
            losses = [-math.log(min(max(p if outcome != WRONG else 1 - p, LEAST), 1 - LEAST)) for p, outcome in poses]
            self.loss = sum(losses)

    def columns(self):
        """As FIGURES names them."""
        return (self.found, "" if self.sure is None else self.sure, "" if self.loss is None else f"{self.loss:.3f}", self.right,
                self.wrong, f"{self.ms:.0f}")


def summary(rows):
    """Of each world and switch its figures and those of `none` in the same scenes."""
    by = {}
    for row in rows:
        by.setdefault((row["world"], row["switch"]), {})[row["part"], row["scene"]] = row
    result = {}
    for (world, switch), scenes in by.items():
        plain = by.get((world, "none"), {})
        common = [scene for scene in scenes if scene in plain]
        if common:
            result[world, switch] = Figures([scenes[k] for k in common]), Figures([plain[k] for k in common])
    return result


def write_tables(rows, folder):
    figures, told = summary(rows), meam.switches()
    worlds = [world for world in WORLDS if any(key[0] == world for key in figures)]
    git = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], stdout=subprocess.PIPE, text=True, check=False)
    lines = ["| changed | " + " | ".join(worlds) + " |", "|---" * (len(worlds) + 1) + "|"]
    with open(os.path.join(folder, "ablation.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("date", "commit", "world", "switch", "changed", "scenes", "copies", *FIGURES,
                         *(f"{name}, nothing changed" for name in FIGURES)))
        for switch, words in told.items():
            cells = []
            for world in worlds:
                if (world, switch) not in figures:
                    cells.append("")
                    continue
                here, plain = figures[world, switch]
                writer.writerow((datetime.date.today(), git.stdout.strip(), world, switch, words, here.scenes, here.copies or "",
                                 *here.columns(), *plain.columns()))
                cells.append(cell(here, plain if switch != "none" else None))
            if any(cells):
                lines.append(f"| `{switch}`: {words} | " + " | ".join(cells) + " |")
    text = "\n".join(lines) + "\n"
    with open(os.path.join(folder, "ablation.md"), "w", encoding="utf-8") as file:
        file.write(text)
    return text


def cell(here, plain):
    """found / R@99 / log loss / right, wrong / ms; of a switch what changes by it."""
    if plain is None:
        words = [f"{here.found} of {here.copies}" if here.copies else f"{here.found}"]
        words += [f"R@99 {here.sure}", f"loss {here.loss / max(here.copies or here.found, 1):.3f}"] if here.sure is not None else []
        return ", ".join([*words, f"above 50 % {here.right} right {here.wrong} wrong", f"{here.ms:.0f} ms", f"{here.scenes} scenes"])
    words = [f"{here.found - plain.found:+d}"]
    if here.sure is not None and plain.sure is not None:
        words += [f"{here.sure - plain.sure:+d}", f"{100 * (here.loss / plain.loss - 1):+.1f} %" if plain.loss else "-"]
    return ", ".join([*words, f"{here.right - plain.right:+d}/{here.wrong - plain.wrong:+d}", f"{100 * (here.ms / plain.ms - 1):+.0f} % ms"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True, metavar="DIR", help="where rows and tables go, and rows of earlier runs are")
    parser.add_argument("--world", nargs="+", choices=WORLDS, default=list(WORLDS), help="default: all")
    parser.add_argument("--switch", nargs="+", choices=meam.switches(), default=list(meam.switches()), metavar="NAME",
                        help=f"default: all: {', '.join(meam.switches())}")
    parser.add_argument("--scenes", default=os.path.join(ROOT, "build", "evaluation"), metavar="DIR",
                        help="where simulated scenes are kept (default: %(default)s)")
    parser.add_argument("--step", type=int, default=1, metavar="N", help="of the scenes every Nth")
    parser.add_argument("--most", type=int, metavar="N", help="scenes of a world, at most")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    path = os.path.join(options.out, "rows.csv")
    rows = read_rows(path)
    done = {tuple(row[name] for name in COLUMNS[:4]) for row in rows}
    with open(path + ".part", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(path + ".part", path)
    with open(path, "a", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")

        def write(row):
            rows.append(row)
            writer.writerow(row)
            file.flush()

        for world in options.world:
            for case in [c for c in WORLDS[world](options.scenes, options.step) if not os.environ.get("PARTS") or c.key[1] in os.environ["PARTS"].split()][:options.most]:
                names = [name for name in dict.fromkeys(["none", *options.switch]) if (*case.key, name) not in done]
                if names:
                    measure(case, names, write)
            print(f"{world}: done", file=sys.stderr, flush=True)
    print(write_tables(rows, options.out))


if __name__ == "__main__":
    main()
