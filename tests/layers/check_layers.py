#!/usr/bin/env python3
"""Checks that the folders of src/ include only what their rank allows.

A folder may include its own files and those of folders of a lower rank. An outside library is named in one
place only. A type has one header: two types of one name would break the one definition rule, which no compiler
sees. Prints one line for each wrong #include or definition and exits 1.

usage: check_layers.py [--self-test] [SOURCE_FOLDER]
"""

import pathlib
import re
import sys
import tempfile

RANK = {
    "base": 0,
    "geometry": 1,
    "geodesy": 2, "samples": 2, "mesh": 2,
    "triangulate": 3, "simplify": 3, "codec": 3,
    "tile": 4, "io": 4,
    "stitch": 5, "judge": 5, "render": 5,
    "pipeline": 6,
}

# Which #include names the library, and the only folders that may.
LIBRARIES = {
    "CGAL": (r"CGAL/", {"triangulate"}),
    "GDAL": (r"(gdal|ogr|cpl|vrt|gnm)\w*\.h$", {"io"}),
    "OSR": (r"(ogr_spatialref|ogr_srs_api|ogr_core|cpl_\w+)\.h$", {"geodesy"}),
    "PROJ": (r"proj\w*\.h$", {"geodesy"}),
    "GeographicLib": (r"GeographicLib/", {"geodesy"}),
    "TBB": (r"(tbb|oneapi)/|tbb\.h$", {"pipeline"}),
    "cairo": (r"cairo", {"render"}),
    "Draco": (r"draco/", {"codec"}),
    "meshoptimizer": (r"meshoptimizer", {"codec"}),
}

# The judge shares no code with what it judges; plain data is no such code.
FORBIDDEN = {"judge": {"mesh", "triangulate", "simplify", "tile", "stitch", "geometry"}}
PLAIN_DATA = {"mesh/terrain_mesh.hpp", "geometry/lattice.hpp"}

TYPE = re.compile(r"^(?:struct|class|enum class|union) (\w+)[^;]*$")  # at the file's own level

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def libraries_named(header):
    return [name for name, (pattern, _) in LIBRARIES.items() if re.match(pattern, header)]


def wrong_library(folder, header):
    """A header that two patterns match (OSR's are GDAL's too) is fine where one of them is at home."""
    names = libraries_named(header)
    if not names or any(folder in LIBRARIES[name][1] for name in names):
        return None
    homes = sorted(set().union(*(LIBRARIES[name][1] for name in names)))
    return f"names {names[0]}: only {', '.join(homes)} may"


def wrong_layer(folder, header):
    target = header.split("/")[0]
    if target == folder or target == "tinsmith":
        return None
    if target not in RANK:
        return "is no folder of src/, include/ or a known library"
    if target in FORBIDDEN.get(folder, ()) and header not in PLAIN_DATA:
        return f"{folder} shares no code with {target}"
    if RANK[target] >= RANK[folder]:
        return f"{folder} (rank {RANK[folder]}) may not know {target} (rank {RANK[target]})"
    return None


def wrong_includes(path, folder):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        bracket, header = match.groups()
        reason = wrong_library(folder, header)
        if not reason and bracket == '"' and not libraries_named(header):
            reason = wrong_layer(folder, header)
        if reason:
            yield f"{path}:{number}: #include of {header}: {reason}"


def repeated_types(headers):
    first = {}
    for path in headers:
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = TYPE.match(line)
            if not match:
                continue
            here = f"{path}:{number}"
            there = first.setdefault(match.group(1), here)
            if there != here:
                yield f"{here}: {match.group(1)} is another type at {there}: rename one"


def check(source):
    """Every complaint about the folders below `source`, and how many files were read."""
    complaints, n_files = [], 0
    for folder in sorted(p for p in source.iterdir() if p.is_dir()):
        if folder.name not in RANK:
            complaints.append(f"{folder}: a folder without a rank: give it one in check_layers.py")
            continue
        for path in sorted(folder.rglob("*.[ch]pp")):
            n_files += 1
            complaints += wrong_includes(path, folder.name)
    complaints += repeated_types(sorted(source.rglob("*.hpp")))
    return complaints, n_files


# (folder, line, whether it is wrong): each rule once in its right and once in its wrong form.
SAMPLES = [
    ("simplify", '#include "mesh/window_mesh.hpp"', False),
    ("mesh", '#include "simplify/simplify.hpp"', True),
    ("simplify", '#include "triangulate/triangulate.hpp"', True),
    ("simplify", '#include "tile/window.hpp"', True),
    ("simplify", '#include "tinsmith/options.hpp"', False),
    ("simplify", '  #  include "io/mesh_file.hpp"', True),
    ("simplify", '// #include "io/mesh_file.hpp"', False),
    ("io", '#include "mesh/terrain_mesh.hpp"', False),
    ("io", "#include <gdal_priv.h>", False),
    ("geodesy", "#include <ogr_spatialref.h>", False),
    ("geodesy", "#include <gdal_priv.h>", True),
    ("render", "#include <gdal.h>", True),
    ("render", "#include <cairo.h>", False),
    ("judge", "#include <cairo/cairo.h>", True),
    ("triangulate", "#include <CGAL/Constrained_Delaunay_triangulation_2.h>", False),
    ("stitch", "#include <CGAL/Simple_cartesian.h>", True),
    ("pipeline", "#include <tbb/flow_graph.h>", False),
    ("tile", "#include <oneapi/tbb/parallel_for.h>", True),
    ("geodesy", "#include <GeographicLib/Geodesic.hpp>", False),
    ("io", "#include <GeographicLib/Geodesic.hpp>", True),
    ("judge", '#include "samples/height_grid.hpp"', False),
    ("judge", '#include "io/mesh_file.hpp"', False),
    ("judge", '#include "mesh/terrain_mesh.hpp"', False),
    ("judge", '#include "mesh/window_mesh.hpp"', True),
    ("judge", '#include "simplify/error_bound.hpp"', True),
    ("judge", '#include "stitch/weld.hpp"', True),
    ("judge", '#include "render/hillshade.hpp"', True),
    ("base", '#include "elsewhere/thing.hpp"', True),
    ("geometry", "#include <vector>", False),
]


def self_test():
    failures = []
    for folder, line, is_wrong in SAMPLES:
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name, folder, "sample.cpp")
            path.parent.mkdir()
            path.write_text(f"// a file\n{line}\n")
            complaints, _ = check(pathlib.Path(name))
        if bool(complaints) != is_wrong:
            failures.append(f"self-test: {folder}: {line}: expected {'a' if is_wrong else 'no'} complaint")
    with tempfile.TemporaryDirectory() as name:
        pathlib.Path(name, "attic").mkdir()
        if not check(pathlib.Path(name))[0]:
            failures.append("self-test: a folder without a rank was not found")
    for second, n_expected in [("struct Facet {", 1), ("class Facet : public Plane {", 1), ("struct Facet;", 0),
                               ("  struct Facet {", 0), ("struct Side {", 0)]:
        with tempfile.TemporaryDirectory() as name:
            for folder, line in [("judge", "struct Facet {"), ("simplify", second)]:
                pathlib.Path(name, folder).mkdir()
                pathlib.Path(name, folder, "one.hpp").write_text(line + "\n")
            if len(check(pathlib.Path(name))[0]) != n_expected:
                failures.append(f"self-test: {second} beside struct Facet: expected {n_expected} complaints")
    return failures, len(SAMPLES) + 6


def main(arguments):
    if arguments == ["--self-test"]:
        complaints, n = self_test()
        what = "rules"
    else:
        source = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).parents[2] / "src"
        complaints, n = check(source)
        what = "files"
        if n == 0:
            complaints.append(f"{source}: no source files: name the folder src/")
    print("\n".join(complaints) if complaints else f"layers: {n} {what}, all right")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
