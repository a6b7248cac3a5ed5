"""The meshes that are measured: from files of Debian packages, or the user's own.

libcgal-demo, data/meshes: the Stanford bunny (a laser scan) and CGAL's elephant, both closed.
mricron-data: MRI of a head (ch2, Montreal). Its iso-surfaces, of the brain (closed, 111 864 triangles, genus 60) and of
the head above a slice (open, 201 586 triangles), are what a scanner gives: noise, steps and handles. slivers is the
brain at a value that voxels have: 2 920 of its 109 716 triangles have no area.
The others are made by shapes.py.
"""

import tarfile

import numpy as np
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkPolyDataConnectivityFilter
from vtkmodules.vtkImagingCore import vtkExtractVOI
from vtkmodules.vtkImagingGeneral import vtkImageGaussianSmooth
from vtkmodules.vtkIOImage import vtkNIFTIImageReader

import plain_ply
import shapes
import vtk_mesh

PACKAGES = ["libcgal-demo", "mricron-data"]

_CGAL_DATA = "libcgal-demo/usr/share/doc/libcgal-dev/data.tar.gz"
_MRI = "mricron-data/usr/share/mricron/templates"


def _of_cgal(packages, name):
    with tarfile.open(packages / _CGAL_DATA) as archive, archive.extractfile(f"data/meshes/{name}.off") as file:
        return plain_ply.read_off(file.read().decode())


def _of_mri(packages, name, value, step, first_slice):
    """The largest piece of the iso-surface of the smoothed scan, of every step-th voxel from a slice on."""
    scan = vtkNIFTIImageReader()
    scan.SetFileName(str(packages / _MRI / name))
    scan.Update()
    smooth = vtkImageGaussianSmooth()
    smooth.SetInputConnection(scan.GetOutputPort())
    smooth.SetStandardDeviation(1)  # voxels
    part = vtkExtractVOI()
    part.SetInputConnection(smooth.GetOutputPort())
    extent = list(scan.GetOutput().GetExtent())
    extent[4] = first_slice
    part.SetVOI(extent)
    part.SetSampleRate(step, step, step)
    surface = vtkFlyingEdges3D()
    surface.SetInputConnection(part.GetOutputPort())
    surface.SetValue(0, value)
    surface.ComputeNormalsOff()
    surface.ComputeScalarsOff()
    largest = vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(surface.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    largest.Update()
    return vtk_mesh.from_vtk(largest.GetOutput())


MESHES = {
    "bunny": lambda packages: _of_cgal(packages, "bunny00"),
    "elephant": lambda packages: _of_cgal(packages, "refined_elephant"),
    "brain": lambda packages: _of_mri(packages, "ch2bet.nii.gz", 60.5, 2, 0),
    "head": lambda packages: _of_mri(packages, "ch2.nii.gz", 40.5, 1, 60),
    "slivers": lambda packages: _of_mri(packages, "ch2bet.nii.gz", 60, 2, 0),
    "sphere": lambda _: shapes.sphere(),
    "torus": lambda _: shapes.torus(),
    "cube": lambda _: shapes.cube(),
    "scan": lambda _: shapes.scan(),
    "sheet": lambda _: shapes.sheet(),
}


def _compacted(vertices, triangles):
    """Without the vertices that no triangle uses."""
    used, corners = np.unique(triangles, return_inverse=True)
    return vertices[used], corners.reshape(-1, 3).astype(np.int32)


def prepare(name, folder):
    """The mesh as a plain PLY in the folder, from the packages unpacked there; made once."""
    path = folder / f"{name}.ply"
    if not path.exists():
        unfinished = path.with_suffix(".new")
        plain_ply.write(unfinished, *_compacted(*MESHES[name](folder / "packages")))
        unfinished.rename(path)
    return path
