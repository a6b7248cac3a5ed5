"""What colours gain and shapes lose: tinsmith's three forms of quadrics beside the geometry alone, on meshes coloured
by the place (a checker of 12 or 4 cells along the longest side, or a smooth gradient)."""

import functools
import json
import subprocess

import numpy as np
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader

import judge

MESHES = ["bunny", "sphere", "torus", "cube", "scan", "sheet", "elephant", "head"]

N_SAMPLES = 200_000
EXACT = 1e-12  # of the diagonal: what is off by no more is off by rounding, and multiples of it say nothing
COEFFICIENTS = {"geometry alone": 10, "separate": 20, "combined": 28, "gradient": 23}  # 8 bytes each
HEADER = ("| colours | triangles asked | form | bytes per vertex | colour RMSE | of geometry alone's | RMS distance | of "
          "geometry alone's | largest distance | of geometry alone's | s |\n|---|---|---|---|---|---|---|---|---|---|---|")


def _checker(n_cells, place):
    odd = np.floor(n_cells * place).astype(int).sum(axis=1) % 2
    return np.where(odd[:, None] == 1, [230, 40, 40], [30, 60, 220])


def _gradient(place):
    return 255 * (0.5 + 0.5 * np.sin(4 * place + [0, 1, 2]))


# At 1 % a bunny has 377 vertices: fewer than the finer checker has cells, of which none can have an edge of its own.
PATTERNS = {"checker": functools.partial(_checker, 12), "coarse-checker": functools.partial(_checker, 4),
            "gradient": _gradient}


def _write(path, vertices, triangles, colours):
    point = np.empty(len(vertices), dtype=[("p", "<f8", 3), ("c", "u1", 3)])
    point["p"], point["c"] = vertices, np.clip(np.round(colours), 0, 255)
    face = np.empty(len(triangles), dtype=[("n", "u1"), ("v", "<i4", 3)])
    face["n"], face["v"] = 3, triangles
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double "
              "y\nproperty double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face "
              f"{len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + point.tobytes() + face.tobytes())


def read(path):
    """Vertices, triangles, colours in [0, 1]."""
    reader = vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    mesh = reader.GetOutput()
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    colours = vtk_to_numpy(mesh.GetPointData().GetScalars())[:, :3] / 255
    return vtk_to_numpy(mesh.GetPoints().GetData()).astype(float), triangles, colours


def _samples(vertices, triangles):
    """Places spread evenly over the area: the triangles they are in, and the shares of their corners."""
    random = np.random.default_rng(judge.SEED)
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(triangles), N_SAMPLES, p=area / area.sum())
    root, share = np.sqrt(random.random(N_SAMPLES)), random.random(N_SAMPLES)
    return triangles[chosen], np.stack([1 - root, root * (1 - share), root * share], axis=1)


def _between(values, corners, shares):
    return np.einsum("ij,ijk->ik", shares, values[corners])


def _shares_of_nearest(vertices, corners, places):
    """Of the corners, in about the place of each triangle that is nearest: outside of it shares are cut at 0."""
    a, b, c = (vertices[corners[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    squared = np.maximum(np.einsum("ij,ij->i", normal, normal), np.finfo(float).tiny)
    shares = np.stack([np.einsum("ij,ij->i", np.cross(v - u, places - u), normal) / squared
                       for u, v in ((b, c), (c, a), (a, b))], axis=1).clip(0, 1)
    return shares / np.maximum(shares.sum(axis=1, keepdims=True), np.finfo(float).tiny)


class Coloured:
    """The input, to be asked for the colour at a place nearby."""

    def __init__(self, vertices, triangles, colours):
        self.vertices, self.colours = vertices, colours
        self.corners, shares = _samples(vertices, triangles)
        self.tree = cKDTree(_between(vertices, self.corners, shares))

    def error(self, result):
        """RMS over samples of the result: to the colour in the triangle of the input's nearest sample."""
        vertices, triangles, colours = result
        corners, shares = _samples(vertices, triangles)
        places = _between(vertices, corners, shares)
        there = self.corners[self.tree.query(places)[1]]
        wanted = _between(self.colours, there, _shares_of_nearest(self.vertices, there, places))
        return np.sqrt(np.mean((_between(colours, corners, shares) - wanted) ** 2))


def _options(form):
    return ["--attribute-weight", "0", "--quadric", "separate"] if form == "geometry alone" else ["--quadric", form]


def _rows(build, mesh, name, share):
    path, out = build / "surface" / f"{mesh['name']}-{name}.ply", build / "surface" / "result.ply"
    vertices, triangles, colours = read(path)
    coloured = Coloured(vertices, triangles, colours)
    first = None
    for form, n_coefficients in COEFFICIENTS.items():
        run = subprocess.run([build / "tinsmith", "simplify", path, out, "--triangles",
                              str(round(len(triangles) * share / 100)), "--json", "-", *_options(form)],
                             check=True, capture_output=True, text=True)
        result = read(out)
        largest, rms = judge.distance((vertices, triangles), result[:2])
        row = {"mesh": mesh["name"], "colours": name, "share": share, "form": form, "bytes": 8 * n_coefficients,
               "colour": coloured.error(result), "rms": rms / mesh["diagonal"], "largest": largest / mesh["diagonal"],
               "seconds": json.loads(run.stdout)["simplify_seconds"]}
        first = first or row
        row["of_colour"] = row["colour"] / first["colour"]
        is_exact = first["rms"] <= EXACT
        for key in ("rms", "largest"):
            row["of_" + key] = None if is_exact else row[key] / first[key]
        yield row


def _text(row):
    of_rms, of_largest = ("-" if row[key] is None else f"{row[key]:.2f}" for key in ("of_rms", "of_largest"))
    return (f"| {row['colours']} | {row['share']:g} % | {row['form']} | {row['bytes']} | {row['colour']:.4f} | "
            f"{row['of_colour']:.2f} | {1e3 * row['rms']:.4f} | {of_rms} | "
            f"{1e3 * row['largest']:.4f} | {of_largest} | {row['seconds']:.2f} |")


def _summary(rows):
    """Of each form the largest multiples, and where they are."""
    text = ("\n### All colours\n\nThe largest multiples of geometry alone's, of all meshes but those that geometry alone "
            "leaves exact, and the geometric mean of those of the largest distance.\n\n| form | colour RMSE | where | RMS "
            "distance | where | largest distance | where | mean |\n|---|---|---|---|---|---|---|---|")
    for form in list(COEFFICIENTS)[1:]:
        of_form = [row for row in rows if row["form"] == form and row["of_rms"] is not None]
        text += f"\n| {form} |"
        for key in ("of_colour", "of_rms", "of_largest"):
            worst = max(of_form, key=lambda row: row[key])
            text += f" {worst[key]:.2f} | {worst['mesh']}, {worst['colours']}, {worst['share']:g} % |"
        text += f" {np.exp(np.mean([np.log(row['of_largest']) for row in of_form])):.2f} |"
    return text


def tables(build, coloured, shares):
    """Line by line, as the runs end."""
    yield (f"\n## Colours\n\nRMSE of a component in [0, 1] between {N_SAMPLES} samples and the input, in its triangle "
           "that has the nearest of as many samples. RMS distance as above. Bytes: of the quadrics of a vertex.")
    rows = []
    for mesh in coloured:
        vertices, triangles = mesh["surface"]
        place = (vertices - vertices.min(axis=0)) / np.ptp(vertices, axis=0).max()
        yield f"\n### {mesh['name']} with colours\n\n{HEADER}"
        for name, pattern in PATTERNS.items():
            _write(build / "surface" / f"{mesh['name']}-{name}.ply", vertices, triangles, pattern(place))
            for share in shares:
                for row in _rows(build, mesh, name, share):
                    rows.append(row)
                    yield _text(row)
    yield _summary(rows)
