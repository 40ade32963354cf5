#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The picture of all frames in docs/robot.md: frames.py docs/images/frames.svg"""
import argparse
import html

import numpy

SIZE, ORIGIN = (1010, 590), (110, 510)
AXES = (("x", "#d62728"), ("y", "#2ca02c"), ("z", "#1f5fd0"))
AXIS = 46  # pixels that an axis is long
GRAY, INK, GIVEN, FOUND = "#9aa3ad", "#20262e", "#b35900", "#6a1fb0"
DOWN = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]  # x right, z down: of what looks down


def project(point):
    x, y, z = point
    return ORIGIN[0] + x + 0.45 * y, ORIGIN[1] - z - 0.32 * y


class Drawing:
    def __init__(self):
        self.items = []

    def line(self, points, color=GRAY, width=2.0, more=""):
        path = " ".join(f"{u:.1f},{v:.1f}" for u, v in map(project, points))
        self.items.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}" stroke-linejoin="round" {more}/>')

    def text(self, place, words, color=INK, size=15, anchor="middle", weight="normal"):
        self.items.append(f'<text x="{place[0]:.1f}" y="{place[1]:.1f}" fill="{color}" font-size="{size}" text-anchor="{anchor}" '
                          f'font-weight="{weight}" stroke="white" stroke-width="5" paint-order="stroke">{html.escape(words)}</text>')

    def box(self, low, size, T=numpy.eye(4), color=GRAY):
        corners = [T[:3, :3] @ (numpy.array(low) + numpy.array(size) * [(k >> axis) & 1 for axis in range(3)]) + T[:3, 3] for k in range(8)]
        for a in range(8):
            for axis in range(3):
                if not (a >> axis) & 1:
                    self.line([corners[a], corners[a | 1 << axis]], color, 1.5)

    def frame(self, T, name, what, shift, anchor="start"):
        """Axes, the frame's name and what it is, at a distance in pixels."""
        for axis, (letter, color) in enumerate(AXES):
            tip = T[:3, 3] + AXIS * T[:3, axis]
            self.line([T[:3, 3], tip], color, 3.0)
            u, v = project(T[:3, 3] + 1.25 * AXIS * T[:3, axis])
            self.text((u, v + 5), letter, color, 13)
        u, v = project(T[:3, 3])
        self.text((u + shift[0], v + shift[1]), name, INK, 16, anchor, "bold")
        self.text((u + shift[0], v + shift[1] + 17), what, INK, 12, anchor)

    def arrow(self, start, end, name, file, color, bend, at):
        """From the frame whose points a transform takes to the one that it takes them to."""
        (u, v), (s, t) = project(start[:3, 3]), project(end[:3, 3])
        control = (u + s) / 2 + bend[0], (v + t) / 2 + bend[1]
        self.items.append(f'<path d="M {u:.1f} {v:.1f} Q {control[0]:.1f} {control[1]:.1f} {s:.1f} {t:.1f}" fill="none" stroke="{color}" '
                          f'stroke-width="2" stroke-dasharray="7 4" marker-end="url(#{color[1:]})"/>')
        middle = (u + s) / 4 + control[0] / 2 + at[0], (v + t) / 4 + control[1] / 2 + at[1]
        self.text(middle, name, color, 15, weight="bold")
        self.text((middle[0], middle[1] + 16), file, color, 12)

    def svg(self):
        marks = "".join(f'<marker id="{color[1:]}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8" orient="auto">'
                        f'<path d="M 0 0 L 10 5 L 0 10 z" fill="{color}"/></marker>' for color in (GIVEN, FOUND))
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE[0]} {SIZE[1]}" font-family="sans-serif">\n'
                f'<defs>{marks}</defs>\n<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(self.items) + "\n</svg>\n")


def frame_at(position, turn=numpy.eye(3)):
    T = numpy.eye(4)
    T[:3, :3], T[:3, 3] = turn, position
    return T


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", metavar="SVG")
    options = parser.parse_args()
    a = numpy.radians(25)
    tilt = numpy.array([[numpy.cos(a), 0, numpy.sin(a)], [0, 1, 0], [-numpy.sin(a), 0, numpy.cos(a)]])
    base, gripper = frame_at((0, 0, 0)), frame_at((215, 0, 330), DOWN)
    sensor, part, bin = frame_at((640, 40, 400), DOWN), frame_at((440, 20, 30), tilt), frame_at((600, 30, 0))
    grasp = frame_at(part[:3, 3] + part[:3, :3] @ (0, 0, 105), tilt @ DOWN)

    drawing = Drawing()
    drawing.box((-40, -40, -18), (80, 80, 18))
    drawing.line([(0, 0, 0), (0, 0, 180), (60, 0, 390), (215, 0, 420), (215, 0, 330)], "#c4cad1", 13, 'stroke-linecap="round"')
    for x in (-26, 26):
        drawing.line([(215, 0, 330), (215 + x, 0, 330), (215 + x, 0, 275)], GRAY, 5)
    drawing.box((360, -70, 0), (480, 200, 85))
    drawing.box((-60, -45, -20), (120, 90, 100), part, "#59636e")
    drawing.box((610, 15, 405), (60, 50, 45), color="#59636e")
    drawing.arrow(part, sensor, "T_scene_model", "the pose: found.poses", FOUND, (60, 0), (36, 74))
    drawing.arrow(bin, sensor, "T_scene_bin", "found by its rim, or given", FOUND, (110, 0), (86, 0))
    drawing.arrow(grasp, part, "T_model_grasp", "part.grasps.json", GIVEN, (-70, 30), (-88, -12))
    drawing.arrow(sensor, base, "T_robot_camera, camera beside", "robot.json of ppfmeam hand-eye", GIVEN, (40, 90), (-50, -66))
    drawing.arrow(sensor, gripper, "T_robot_camera, camera on the gripper", "robot.json of ppfmeam hand-eye", GIVEN, (0, -90), (0, -30))
    drawing.arrow(gripper, base, "T_base_gripper", "the robot", GIVEN, (-40, 30), (20, -20))
    drawing.frame(base, "robot base", "as the robot has it", (-60, 44))
    drawing.frame(gripper, "gripper", "the robot's tool", (70, 30))
    drawing.frame(sensor, "sensor = scan", "x right, y down, z ahead", (66, -16))
    drawing.frame(part, "part", "as in its CAD file", (-32, 40), "end")
    drawing.frame(bin, "bin", "middle of its floor", (62, 12))
    drawing.text((560, 575), "An arrow T_a_b goes from frame b to frame a: it takes points of b to a.", size=13)
    drawing.frame(grasp, "grasp", "z in, jaws close along x", (-26, -40), "end")
    with open(options.out, "w", encoding="utf-8") as file:
        file.write(drawing.svg())


if __name__ == "__main__":
    main()
