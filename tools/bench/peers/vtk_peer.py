#!/usr/bin/python3
"""vtk_peer.py greedy|quadric GRID TRIANGLES OUT.ply: VTK's simplification down to a count of triangles.

greedy: vtkGreedyTerrainDecimation of the raster; quadric: vtkQuadricDecimation of the full grid's triangles. Both are
C++ inside VTK; Python only hands them the samples. Needs Debian's python3-vtk9 and python3-numpy.
"""

import json
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation
from vtkmodules.vtkFiltersHybrid import vtkGreedyTerrainDecimation


def read_grid(path):
    """The header, and the samples with NaN for voids; grid.hpp says what the file holds."""
    with open(path, "rb") as file:
        grid = json.loads(file.readline())
        n = grid["width"] * grid["height"]
        samples = np.fromfile(file, np.float32, n).reshape(grid["height"], grid["width"])
    return grid, samples


def raster(grid, samples):
    """Spacing 1, whatever the metres: with others VTK's tests of orientation are not exact, and triangles fold."""
    image = vtkImageData()
    image.SetDimensions(grid["width"], grid["height"], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(samples.astype(np.float64).ravel(), deep=True))
    return image


def full_mesh(grid, samples):
    """Two triangles for each cell of four valid samples, in metres."""
    rows, columns = np.indices(samples.shape)
    points = np.column_stack([columns.ravel() * grid["step"][0], rows.ravel() * grid["step"][1],
                              np.nan_to_num(samples).ravel() * grid["unit"]]).astype(np.float64)
    valid = ~np.isnan(samples)
    cells = valid[:-1, :-1] & valid[1:, :-1] & valid[:-1, 1:] & valid[1:, 1:]
    at = (rows * grid["width"] + columns)[:-1, :-1][cells]
    below = at + grid["width"]
    corners = np.concatenate([np.column_stack([at, at + 1, below]), np.column_stack([at + 1, below + 1, below])])
    table = np.column_stack([np.full(len(corners), 3), corners]).astype(np.int64)
    array = vtkCellArray()
    array.SetCells(len(corners), numpy_to_vtkIdTypeArray(table.ravel(), deep=True))
    vertices = vtkPoints()
    vertices.SetDataTypeToDouble()
    vertices.SetData(numpy_to_vtk(points, deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(vertices)
    mesh.SetPolys(array)
    return mesh, len(corners)


def greedy(grid, samples, n_triangles):
    """It knows no voids. With the border vertices kept: without them (VTK's default) the border rows miss by up to 2 000 m."""
    simplify = vtkGreedyTerrainDecimation()
    simplify.SetInputData(raster(grid, samples))
    simplify.SetErrorMeasureToNumberOfTriangles()
    simplify.SetNumberOfTriangles(n_triangles)
    simplify.BoundaryVertexDeletionOff()
    return simplify, [1, 1, 1]


def quadric(grid, samples, n_triangles):
    mesh, n_full = full_mesh(grid, samples)
    simplify = vtkQuadricDecimation()
    simplify.SetInputData(mesh)
    simplify.SetTargetReduction(1 - n_triangles / n_full)
    return simplify, [*grid["step"], grid["unit"]]


def mesh_of(output, scale):
    """Vertices as (column, row, height in the grid's unit), and triangles."""
    vertices = vtk_to_numpy(output.GetPoints().GetData()).astype(np.float64) / scale
    return vertices, vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def write_ply(path, grid, vertices, triangles):
    """PLY in the CRS of the grid; all triangles are turned over when most of the area is clockwise in plan."""
    g = grid["geotransform"]
    column, row = vertices[:, 0] + 0.5, vertices[:, 1] + 0.5
    vertices = np.column_stack([g[0] + column * g[1] + row * g[2], g[3] + column * g[4] + row * g[5], vertices[:, 2]])
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = np.sum((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))
    faces = np.empty(len(triangles), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    faces["n"] = 3
    faces["corners"] = triangles if area > 0 else triangles[:, ::-1]
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\ncomment crs {grid['crs']}\nelement vertex {len(vertices)}\n"
                   "property double x\nproperty double y\nproperty double z\n"
                   f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        file.write(vertices.astype("<f8").tobytes())
        file.write(faces.tobytes())


def main():
    if len(sys.argv) != 5 or sys.argv[1] not in ("greedy", "quadric"):
        sys.exit("usage: vtk_peer.py greedy|quadric GRID TRIANGLES OUT.ply")
    method, path, n_triangles, output = sys.argv[1:]
    grid, samples = read_grid(path)
    simplify, scale = {"greedy": greedy, "quadric": quadric}[method](grid, samples, int(n_triangles))
    start = time.perf_counter()
    simplify.Update()
    seconds = time.perf_counter() - start
    vertices, triangles = mesh_of(simplify.GetOutput(), scale)
    write_ply(output, grid, vertices, triangles)
    print(json.dumps({"own_seconds": seconds, "triangles": len(triangles)}))


main()
