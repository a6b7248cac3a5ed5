"""Meshes as numpy arrays: vertices (n, 3) float64, triangles (m, 3) int32. In and out of the PLY that plain_ply.hpp
describes, and in from the files that the benchmark starts from."""

import numpy as np

_FACE = np.dtype([("n", "u1"), ("corners", "<i4", 3)])


def write(path, vertices, triangles):
    faces = np.empty(len(triangles), dtype=_FACE)
    faces["n"] = 3
    faces["corners"] = triangles
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\n"
                   f"property double y\nproperty double z\nelement face {len(triangles)}\n"
                   "property list uchar int vertex_indices\nend_header\n".encode())
        file.write(np.ascontiguousarray(vertices, "<f8").tobytes())
        file.write(faces.tobytes())


def read(path):
    """Also what tinsmith writes without attributes; its integers may be unsigned."""
    counts = {}
    with open(path, "rb") as file:
        for line in file:
            words = line.split()
            if words[0] == b"element":
                counts[words[1]] = int(words[2])
            if words[0] == b"end_header":
                break
        vertices = np.fromfile(file, "<f8", counts[b"vertex"] * 3).reshape(-1, 3)
        faces = np.fromfile(file, _FACE, counts[b"face"])
    return vertices, faces["corners"]


def read_off(text):
    """Triangles only."""
    words = " ".join(line.split("#")[0] for line in text.splitlines()).split()
    n_vertices, n_faces = int(words[1]), int(words[2])
    end = 4 + 3 * n_vertices
    vertices = np.array(words[4:end], dtype=np.float64).reshape(-1, 3)
    faces = np.array(words[end:end + 4 * n_faces], dtype=np.int32).reshape(-1, 4)
    if words[0] != "OFF" or (faces[:, 0] != 3).any():
        raise ValueError("this is no OFF file of triangles")
    return vertices, faces[:, 1:]
