#!/usr/bin/python3
"""vtk_surface.py quadric|pro IN.ply TRIANGLES OUT.ply: VTK's simplification of a surface to a count of triangles.

quadric: vtkQuadricDecimation; pro: vtkDecimatePro, keeping the topology as the others do. Both are C++ inside VTK;
Python only hands them the mesh. Needs Debian's python3-vtk9 and python3-numpy.
"""

import json
import sys
import time

from vtkmodules.vtkFiltersCore import vtkDecimatePro, vtkQuadricDecimation

import plain_ply
import vtk_mesh


def main():
    if len(sys.argv) != 5 or sys.argv[1] not in ("quadric", "pro"):
        sys.exit("usage: vtk_surface.py quadric|pro IN.ply TRIANGLES OUT.ply")
    method, path, n_triangles, output = sys.argv[1:]
    vertices, triangles = plain_ply.read(path)
    simplify = vtkQuadricDecimation() if method == "quadric" else vtkDecimatePro()
    if method == "pro":
        simplify.PreserveTopologyOn()
    simplify.SetInputData(vtk_mesh.to_vtk(vertices, triangles))
    simplify.SetTargetReduction(1 - int(n_triangles) / len(triangles))
    start = time.perf_counter()
    simplify.Update()
    seconds = time.perf_counter() - start
    vertices, triangles = vtk_mesh.from_vtk(simplify.GetOutput())
    plain_ply.write(output, vertices, triangles)
    print(json.dumps({"own_seconds": seconds, "triangles": len(triangles)}))


main()
