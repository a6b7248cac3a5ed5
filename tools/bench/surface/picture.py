#!/usr/bin/python3
"""Draws a coloured mesh before and after its simplification, shaded, and with its edges, from the front:

usage: picture.py BEFORE.ply AFTER.ply OUT.png [--side PIXELS]
"""

import argparse
import pathlib

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import colours

SHARPER = 3  # drawn so many times as large, then averaged
LIGHT = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([-0.4, 0.6, 0.7])  # right, up, towards who looks
PAPER, INK, EDGE = (255, 255, 255), (33, 36, 43), (25, 30, 50)
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


def pieces(corners, n):
    """Each triangle (m, 3, k) in n * n equal ones: (m, n * n, 3, k)."""
    steps = [(i, j) for i in range(n) for j in range(n - i)]
    shares = [[(i, j), (i + 1, j), (i, j + 1)] for i, j in steps]
    shares += [[(i + 1, j), (i + 1, j + 1), (i, j + 1)] for i, j in steps if i + j < n - 1]
    weights = np.array([[(n - i - j, i, j) for i, j in piece] for piece in shares]) / n
    return np.einsum("pck,mkd->mpcd", weights, corners)


def shaded(mesh, box, side, with_edges):
    """Triangles that face the viewer, the farthest first; z points to the viewer."""
    vertices, triangles, colour = mesh
    low, high = box
    scale = 0.94 * side * SHARPER / (high - low)[:2].max()
    middle = (low + high)[:2] / 2
    place = (vertices[:, :2] - middle) * [scale, -scale] + side * SHARPER / 2
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    light = 0.35 + 0.65 * np.clip(normals @ LIGHT, 0, 1)
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    order = order[normals[order, 2] > 0]
    n = max(1, round(np.sqrt(40_000 / len(triangles))))
    image = Image.new("RGB", (side * SHARPER,) * 2, PAPER)
    draw = ImageDraw.Draw(image)
    spots = pieces(place[triangles[order]], n)
    tints = pieces(colour[triangles[order]], n).mean(axis=2) * light[order, None, None]
    for t, (spot, tint) in enumerate(zip(spots.reshape(len(order), -1, 6), np.round(255 * tints).astype(int))):
        for xy, rgb in zip(spot.tolist(), tint.tolist()):
            draw.polygon(xy, fill=tuple(rgb), outline=tuple(rgb))
        if with_edges:
            ring = place[triangles[order[t]]][[0, 1, 2, 0]]
            draw.line(ring.ravel().tolist(), fill=EDGE, width=2)
    return image.resize((side, side), Image.Resampling.BOX)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--side", type=int, default=290, help="pixels of each of the three panels")
    arguments = parser.parse_args()
    before, after = colours.read(arguments.before), colours.read(arguments.after)
    box = before[0].min(axis=0), before[0].max(axis=0)
    font = ImageFont.truetype(FONT, 12)
    panels = [(before, False), (after, False), (after, True)]
    page = Image.new("RGB", (len(panels) * arguments.side, arguments.side + 22), PAPER)
    for i, (mesh, with_edges) in enumerate(panels):
        page.paste(shaded(mesh, box, arguments.side, with_edges), (i * arguments.side, 0))
        text = f"{len(mesh[1]):,} triangles".replace(",", " ")
        middle = ((i + 0.5) * arguments.side, arguments.side + 10)
        ImageDraw.Draw(page).text(middle, text, fill=INK, font=font, anchor="mm")
    page.save(arguments.out, optimize=True)


if __name__ == "__main__":
    main()
