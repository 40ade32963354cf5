# SPDX-License-Identifier: BSD-3-Clause
"""Where the picture beside the scan shows its points."""
import numpy

RAYS = 20000  # points that a camera is fitted to: enough for a hundredth of a pixel


class Fitted:
    """The camera of an organized scan, fitted to the pixels of its points: of each coordinate 1, x, y, and both times r^2, which
    is the first term of a lens' distortion. Through one point, or for an orthographic sensor along z."""

    def __init__(self, points):
        height, width = points.shape[:2]
        rows, columns = numpy.nonzero(numpy.isfinite(points).all(axis=2))
        step = max(1, len(rows) // RAYS)
        pixels = numpy.stack((columns, rows), axis=1)[::step].astype(float)
        measured = points[rows[::step], columns[::step]].astype(float)
        fits = []
        for is_central in (True, False):
            terms = self.terms(measured, is_central)
            factors = numpy.linalg.lstsq(terms, pixels, rcond=None)[0]
            fits.append((numpy.square(terms @ factors - pixels).sum(), not is_central, factors))
        self.is_central = not min(fits, key=lambda fit: fit[:2])[1]
        self.factors = fits[0 if self.is_central else 1][2]
        self.size = width, height

    @staticmethod
    def terms(points, is_central):
        x, y = (points[:, :2] / points[:, 2:] if is_central else points[:, :2]).T
        radius = x * x + y * y
        return numpy.stack((numpy.ones_like(x), x, y, radius * x, radius * y), axis=1)

    def __call__(self, points):
        with numpy.errstate(divide="ignore", invalid="ignore"):
            return self.terms(points, self.is_central) @ self.factors, points[:, 2]


class Pinhole:
    """A camera beside the sensor, by its calibration."""

    def __init__(self, camera, size):
        self.camera, self.size = camera, size

    def __call__(self, points):
        camera = self.camera
        seen = points @ camera.pose[:3, :3].T + camera.pose[:3, 3]
        depth = seen[:, 2]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            x, y = seen[:, 0] / depth, seen[:, 1] / depth
            k1, k2, p1, p2, k3, k4, k5, k6 = camera.distortion
            r = x * x + y * y
            radial = (1 + r * (k1 + r * (k2 + r * k3))) / (1 + r * (k4 + r * (k5 + r * k6)))
            across = x * radial + 2 * p1 * x * y + p2 * (r + 2 * x * x), y * radial + p1 * (r + 2 * y * y) + 2 * p2 * x * y
        matrix = camera.matrix
        return numpy.stack((matrix[0, 0] * across[0] + matrix[0, 2], matrix[1, 1] * across[1] + matrix[1, 2]), axis=1), depth


class FromAbove:
    """A map of points that are not organized, along z from the side that the sensor is on."""
    WIDTH = 800  # pixels
    MOST = 1600  # pixels along the longer side

    def __init__(self, points, looks):
        low, high = points.min(axis=0), points.max(axis=0)
        extent = numpy.maximum(high - low, 1e-6)
        between = (extent[0] * extent[1] / len(points)) ** 0.5
        cell = max(extent[0] / self.WIDTH, extent[1] / self.MOST, 1.5 * between)  # so that few cells stay empty
        self.turn = numpy.array((1.0, numpy.sign(looks[2]), numpy.sign(looks[2])))  # y is down where z goes away
        self.corner = numpy.minimum(low * self.turn, high * self.turn)
        self.cell = cell
        self.size = int(extent[0] / cell + 0.5) + 1, int(extent[1] / cell + 0.5) + 1

    def __call__(self, points):
        turned = points * self.turn - self.corner
        return turned[:, :2] / self.cell, turned[:, 2]
