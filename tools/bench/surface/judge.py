"""How far two surfaces are from each other, and what a surface is: by VTK, numpy and scipy, no code of ours."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

import vtk_mesh

N_SAMPLES = 100_000  # of each surface, besides its vertices
SEED = 20261122


def _normals(vertices, triangles):
    """Twice the area each."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def samples(vertices, triangles):
    """Points spread evenly over the area, the same ones for the same surface; and all used vertices."""
    random = np.random.default_rng(SEED)
    area = np.linalg.norm(_normals(vertices, triangles), axis=1)
    chosen = triangles[random.choice(len(triangles), N_SAMPLES, p=area / area.sum())]
    root, share = np.sqrt(random.random((N_SAMPLES, 1))), random.random((N_SAMPLES, 1))
    a, b, c = (vertices[chosen[:, i]] for i in range(3))
    spread = (1 - root) * a + root * (1 - share) * b + root * share * c
    return spread, vertices[np.unique(triangles)]


def distances(points, surface):
    """Of points (n, 3) to the nearest point of a surface (vertices, triangles)."""
    implicit = vtkImplicitPolyDataDistance()
    implicit.SetInput(vtk_mesh.to_vtk(*surface))
    result = vtkDoubleArray()
    implicit.EvaluateFunction(numpy_to_vtk(np.ascontiguousarray(points), deep=True), result)
    return np.abs(vtk_to_numpy(result))


def distance(one, other):
    """(Hausdorff, RMS), symmetric: the larger of both ways, and the mean of both. Vertices count for the largest
    only, since they are not spread by area."""
    largest, mean_square = [], []
    for a, b in ((one, other), (other, one)):
        spread, corners = samples(*a)
        to_spread = distances(spread, b)
        largest.append(max(to_spread.max(), distances(corners, b).max()))
        mean_square.append(np.mean(to_spread**2))
    return max(largest), np.sqrt(np.mean(mean_square))


def _edges(triangles):
    """Halfedges as (lower vertex, higher vertex, triangle)."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.column_stack([np.sort(ends, axis=1), np.tile(np.arange(len(triangles)), 3)])


def _n_components(nodes, links):
    """Of a graph whose nodes have any numbers."""
    if len(nodes) == 0:
        return 0
    i, j = np.searchsorted(nodes, links[:, 0]), np.searchsorted(nodes, links[:, 1])
    graph = coo_matrix((np.ones(len(i)), (i, j)), shape=(len(nodes), len(nodes)))
    return connected_components(graph, directed=False)[0]


def turned_edges(vertices, triangles):
    """Edges whose triangles have normals more than 90 degrees apart; triangles of no area have none."""
    edges = _edges(triangles)
    edges = edges[np.lexsort((edges[:, 1], edges[:, 0]))]
    same = (edges[1:, :2] == edges[:-1, :2]).all(axis=1)
    normals = _normals(vertices, triangles)
    return int((np.einsum("ij,ij->i", normals[edges[1:][same, 2]], normals[edges[:-1][same, 2]]) < 0).sum())


def topology(triangles):
    """Components, border loops, genus (sum over the components), edges of more than two triangles."""
    edges, counts = np.unique(_edges(triangles)[:, :2], axis=0, return_counts=True)
    nodes = np.unique(triangles)
    n_components = _n_components(nodes, edges)
    border = edges[counts == 1]
    n_borders = _n_components(np.unique(border), border)
    euler = len(nodes) - len(edges) + len(triangles)
    return {"components": n_components, "borders": n_borders, "genus": (2 * n_components - n_borders - euler) / 2,
            "non_manifold_edges": int((counts > 2).sum())}


def facts(vertices, triangles):
    """What must not change."""
    return {**topology(triangles), "turned_edges": turned_edges(vertices, triangles)}
