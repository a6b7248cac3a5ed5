"""What colours gain and shapes lose: tinsmith's three forms of quadrics beside the geometry alone, on a mesh coloured
by the place (a checker of 12 or 4 cells along the longest side, or a smooth gradient)."""

import functools
import json
import subprocess

import numpy as np
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader

import judge

N_SAMPLES = 200_000
COEFFICIENTS = {"geometry alone": 10, "separate": 20, "combined": 28, "gradient": 23}  # 8 bytes each
HEADER = ("| colours | triangles asked | form | bytes per vertex | colour RMSE | of geometry alone's | RMS distance | of "
          "geometry alone's | s |\n|---|---|---|---|---|---|---|---|---|")


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


def _coloured_samples(vertices, triangles, colours):
    """Places spread evenly over the area, with the colours there."""
    random = np.random.default_rng(judge.SEED)
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = triangles[random.choice(len(triangles), N_SAMPLES, p=area / area.sum())]
    root, share = np.sqrt(random.random((N_SAMPLES, 1))), random.random((N_SAMPLES, 1))
    weights = (1 - root, root * (1 - share), root * share)
    return [sum(w * values[chosen[:, i]] for i, w in enumerate(weights)) for values in (vertices, colours)]


def _colour_error(tree, colours, result):
    """RMS over samples of the result: to the colour of the input's nearest sample."""
    places, found = _coloured_samples(*result)
    wanted = colours[tree.query(places)[1]]
    return np.sqrt(np.mean((found - wanted) ** 2))


def _options(form):
    return ["--attribute-weight", "0", "--quadric", "separate"] if form == "geometry alone" else ["--quadric", form]


def _rows(build, name, mesh, share):
    path, out = build / "surface" / f"{name}.ply", build / "surface" / "result.ply"
    vertices, triangles, colours = read(path)
    places, sampled = _coloured_samples(vertices, triangles, colours)
    tree = cKDTree(places)
    first = None
    for form, n_coefficients in COEFFICIENTS.items():
        run = subprocess.run([build / "tinsmith", "simplify", path, out, "--triangles",
                              str(round(len(triangles) * share / 100)), "--json", "-", *_options(form)],
                             check=True, capture_output=True, text=True)
        result = read(out)
        colour = _colour_error(tree, sampled, result)
        rms = judge.distance((vertices, triangles), result[:2])[1] / mesh["diagonal"]
        first = first or (colour, rms)
        yield (f"| {name} | {share:g} % | {form} | {8 * n_coefficients} | {colour:.4f} | {colour / first[0]:.2f} | "
               f"{1e3 * rms:.4f} | {rms / first[1]:.2f} | {json.loads(run.stdout)['simplify_seconds']:.2f} |")


def table(build, mesh, shares):
    """Line by line, as the runs end."""
    vertices, triangles = mesh["surface"]
    low = vertices.min(axis=0)
    place = (vertices - low) / np.ptp(vertices, axis=0).max()
    yield (f"\n### {mesh['name']} with colours\n\nColours: RMSE of a component in [0, 1] between {N_SAMPLES} samples and "
           "the nearest of as many samples of the input. RMS distance as above. Bytes: of the quadrics.\n\n" + HEADER)
    for name, pattern in PATTERNS.items():
        _write(build / "surface" / f"{name}.ply", vertices, triangles, pattern(place))
        for share in shares:
            yield from _rows(build, name, mesh, share)
