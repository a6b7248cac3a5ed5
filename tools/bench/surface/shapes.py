"""Surfaces made by formula, as in tests/support/surface_shapes.hpp but larger: the same ones each time."""

import numpy as np

SEED = 1


def _squares(corner):
    """Two triangles for each square of a lattice (n + 1, m + 1) of vertex numbers."""
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    return np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=2).reshape(-1, 3)


def cube(n=80):
    """[-1, 1]^3, n x n squares on a face, welded at its creases: 12 n n triangles."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    places, triangles = [], []
    for axis in range(3):
        for side in (0, n):
            place = np.empty((n + 1, n + 1, 3), dtype=np.int64)
            place[..., axis] = side
            # The other two axes in cyclic order look out of the upper side, swapped out of the lower one.
            place[..., (axis + (1 if side else 2)) % 3] = i
            place[..., (axis + (2 if side else 1)) % 3] = j
            first = len(places) * (n + 1) ** 2
            triangles.append(_squares(first + np.arange((n + 1) ** 2).reshape(n + 1, n + 1)))
            places.append(place.reshape(-1, 3))
    lattice, number = np.unique(np.concatenate(places), axis=0, return_inverse=True)
    return 2 * lattice / n - 1, number.reshape(-1)[np.concatenate(triangles)]


def sphere(n=80):
    """The unit sphere: a cube, blown up."""
    vertices, triangles = cube(n)
    vertices = np.tan(vertices * np.pi / 4)  # squares of nearly the same size
    return vertices / np.linalg.norm(vertices, axis=1, keepdims=True), triangles


def torus(n=300, m=150):
    """n sections around the axis (radius 1), m around the tube (radius 0.4): 2 n m triangles, genus 1."""
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    r = 1 + 0.4 * np.cos(v)
    vertices = np.stack([r * np.cos(u), r * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3)
    return vertices, _squares(np.pad(np.arange(n * m).reshape(n, m), (0, 1), mode="wrap"))


def scan(n=90):
    """A closed blob of different widths with bumps of all sizes, and noise of a tenth of an edge along the ray from
    the middle, so that it never cuts itself: 12 n n triangles, genus 0."""
    random = np.random.default_rng(SEED)
    vertices, triangles = sphere(n)
    at = random.normal(size=(40, 3))
    at /= np.linalg.norm(at, axis=1, keepdims=True)
    width = 0.08 + 0.4 * random.random(40)
    height = width * (0.6 * random.random(40) - 0.2)
    radius = 1 + 0.1 * np.pi / 2 / n * (2 * random.random(len(vertices)) - 1)
    for k in range(40):
        radius += height[k] * np.exp(-np.sum((vertices - at[k]) ** 2, axis=1) / width[k] ** 2)
    return radius[:, None] * vertices * [1, 0.7, 1.3], triangles


def sheet(n=220):
    """Waves over the unit square with noise of a tenth of an edge in height, n x n squares: 2 n n triangles, one
    border."""
    random = np.random.default_rng(SEED)
    x, y = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n, indexing="ij")
    z = 0.1 / n * (2 * random.random(x.shape) - 1)
    for _ in range(6):
        kx, ky, phase, height = random.random(4)
        z += 0.05 * height * np.sin(40 * (kx - 0.5) * x + 40 * (ky - 0.5) * y + 2 * np.pi * phase)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), _squares(np.arange((n + 1) ** 2).reshape(n + 1, n + 1))
