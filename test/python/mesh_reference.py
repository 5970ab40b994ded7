"""Distances to meshes computed another way: one point and one triangle at a time."""

import numpy as np

from deformable_manipulation import _distance

FIELDS = (
    "minimum offsets distance obstacle object_point obstacle_point normal vertices weights"
    " obstacle_velocity identity"
).split()
CUBE_VERTICES = np.array([(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
CUBE = np.array(
    [
        (0, 1, 3),
        (0, 3, 2),
        (4, 6, 7),
        (4, 7, 5),
        (0, 4, 5),
        (0, 5, 1),
        (2, 3, 7),
        (2, 7, 6),
        (0, 2, 6),
        (0, 6, 4),
        (1, 5, 7),
        (1, 7, 3),
    ]
)


def cube(low=(0.0, 0.0, 0.0), high=(1.0, 1.0, 1.0)):
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    return low + CUBE_VERTICES * (high - low), CUBE


def joined(*meshes):
    """Several meshes as one."""
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    return (
        np.concatenate([vertices for vertices, _ in meshes]),
        np.concatenate([triangles + n for (_, triangles), n in zip(meshes, starts)]),
    )


def star(rng, rings=5, sectors=7):
    """A closed surface seen whole from the origin."""
    polar = np.pi * np.arange(1, rings) / rings
    azimuth = 2.0 * np.pi * np.arange(sectors) / sectors
    directions = [(0.0, 0.0, 1.0)]
    for p in polar:
        directions += [(np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)) for a in azimuth]
    directions.append((0.0, 0.0, -1.0))
    radii = rng.uniform(0.5, 1.2, len(directions)) if rng.random() < 0.7 else 1.0
    last = len(directions) - 1
    triangles = []
    for s in range(sectors):
        t = (s + 1) % sectors
        triangles.append((0, 1 + s, 1 + t))
        for r in range(rings - 2):
            a, b = 1 + r * sectors, 1 + (r + 1) * sectors
            triangles += [(a + s, b + s, b + t), (a + s, b + t, a + t)]
        triangles.append((last, last - sectors + t, last - sectors + s))
    return np.array(directions) * np.reshape(radii, (-1, 1)), np.array(triangles)


def sheet(rng, cells=3, size=1.0, waves=0.2, middle=(0.0, 0.0, 0.0)):
    """A wavy fabric in any position: points (P, 3), triangles (T, 3)."""
    line = np.linspace(-size / 2.0, size / 2.0, cells + 1)
    x, y = np.meshgrid(line, line, indexing="ij")
    z = waves * np.sin(rng.uniform(1, 4) * x + rng.uniform(0, 6)) * np.cos(rng.uniform(1, 4) * y)
    turn = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    points = np.stack((x, y, z), axis=-1).reshape(-1, 3) @ turn + middle
    return points, grid_triangles(cells)


def grid_triangles(cells):
    corner = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    down = corner + cells + 1
    return np.concatenate(
        (
            np.stack((corner, down, corner + 1), axis=1),
            np.stack((corner + 1, down, down + 1), axis=1),
        )
    )


def compute(mesh, points, triangles=None, band=0.3, margin=0.0, pose=()):
    """Fields of Distances of one copy, or several."""
    calculator = _distance.MinimumDistance([_distance.MeshObstacle(*mesh, *pose)], margin, band)
    points = np.asarray(points, dtype=float)
    return fields(calculator, points if points.ndim == 3 else points[None], triangles)


def fields_of(distances):
    """All arrays of Distances by their names."""
    return {name: getattr(distances, name) for name in FIELDS}


def changed(distances, **arrays):
    """Distances with some arrays replaced."""
    return _distance.Distances(**{**fields_of(distances), "names": distances.names, **arrays})


def fields(calculator, points, triangles=None):
    return fields_of(calculator.compute(points, triangles))


def unsigned_distances(mesh, points):
    """From points (K, 3) to the nearest of all triangles: their faces, then their edges."""
    corners = mesh[0][mesh[1]]
    a = corners[:, 0]
    u, v = corners[:, 1] - a, corners[:, 2] - a
    normal = np.cross(u, v)
    arms = points[:, None] - a
    height = np.einsum("kfi,fi->kf", arms, normal) / np.linalg.norm(normal, axis=1)
    inverse = np.linalg.inv(np.stack((u, v, normal), axis=2))
    s, t, _ = np.moveaxis(np.einsum("fij,kfj->kfi", inverse, arms), 2, 0)
    over = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0)
    nearest = np.where(over, np.abs(height), np.inf)
    for k in range(3):
        start, edge = corners[:, k], corners[:, (k + 1) % 3] - corners[:, k]
        arms = points[:, None] - start
        along = np.clip(np.einsum("kfi,fi->kf", arms, edge) / np.sum(edge**2, axis=1), 0.0, 1.0)
        nearest = np.minimum(nearest, np.linalg.norm(arms - along[..., None] * edge, axis=2))
    return nearest.min(axis=1)


def winding_numbers(mesh, points):
    """How often the surface goes around points (K, 3): by the solid angles of its triangles."""
    a, b, c = np.moveaxis(mesh[0][mesh[1]][None] - points[:, None, None], 2, 0)
    na, nb, nc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    dots = [np.sum(x * y, axis=2) for x, y in ((a, b), (b, c), (c, a))]
    below = na * nb * nc + dots[0] * nc + dots[1] * na + dots[2] * nb
    angles = 2.0 * np.arctan2(np.einsum("kfi,kfi->kf", a, np.cross(b, c)), below)
    return angles.sum(axis=1) / (4.0 * np.pi)


def signed_distances(mesh, points):
    unsigned = unsigned_distances(mesh, points)
    return np.where(np.abs(winding_numbers(mesh, points)) > 0.5, -unsigned, unsigned)


def element_bounds(mesh, points, elements, count=10):
    """Between which two values (E, 2) [m] each element's least signed distance is."""
    weights = (
        np.array([(i, j, count - i - j) for i in range(count + 1) for j in range(count + 1 - i)])
        / count
    )
    corners = points[elements]
    samples = np.einsum("kw,ewd->ekd", weights, corners)
    distances = signed_distances(mesh, samples.reshape(-1, 3)).reshape(len(elements), -1)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    least = distances.min(axis=1)
    return np.stack((least - longest / count, least), axis=1)
