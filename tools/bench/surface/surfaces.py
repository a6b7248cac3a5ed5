#!/usr/bin/python3
"""Simplifies surfaces with tinsmith and its peers, judges all results with VTK and numpy, and writes a table.

Started by run.sh, which builds what is needed and fetches the meshes.
"""

import argparse
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

import numpy as np

import colours
import judge
import meshes
import plain_ply

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import tools  # noqa: E402

TOOLS = {
    "tinsmith": "{build}/tinsmith simplify {mesh} {out} --triangles {n} --json -",
    "cgal-gh": "{build}/peers/cgal_surface gh {mesh} {n} {out}",
    "cgal-lt": "{build}/peers/cgal_surface lt {mesh} {n} {out}",
    "vtk-quadric": "/usr/bin/python3 -B {here}/vtk_surface.py quadric {mesh} {n} {out}",
    "vtk-pro": "/usr/bin/python3 -B {here}/vtk_surface.py pro {mesh} {n} {out}",
    "meshopt": "{build}/peers/meshopt_surface {mesh} {n} {out}",
}
PACKAGES = {"cgal-gh": "libcgal-dev", "cgal-lt": "libcgal-dev", "vtk-quadric": "python3-vtk9",
            "vtk-pro": "python3-vtk9", "meshopt": "libmeshoptimizer-dev"}
LIMIT = 600  # seconds for one run
FLOOR = 1e-7  # of the diagonal
# Runs are started by a Python of their own: the kernel's peak memory of a process is never below its starter's.
STARTER = "import json, sys, measure; print(json.dumps(measure.run(sys.argv[2:], float(sys.argv[1]))))"

HEADER = ("| triangles asked | tool | triangles | Hausdorff | RMS | s | us per removed | MB | turned edges | genus "
          "| borders | parts |\n|---|---|---|---|---|---|---|---|---|---|---|---|")


def arguments():
    parser = argparse.ArgumentParser(prog="run.sh", description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--mesh", action="append", help=f"of {', '.join(meshes.MESHES)}, or a plain .ply (default: all "
                        "named); may be given again")
    parser.add_argument("--share", action="append", type=float, help="percent of the triangles (default 50, 20, 5, 1)")
    parser.add_argument("--tool", action="append", choices=list(TOOLS), help="(default: all)")
    parser.add_argument("--option", default="", help="more options for tinsmith simplify, in one word")
    parser.add_argument("--colours", action="store_true", help="instead the forms of quadrics, on coloured meshes")
    parser.add_argument("--repeat", type=int, default=1, help="runs of each tool, by turns, of which the fastest counts")
    parser.add_argument("--again", action="store_true", help="measure anew what BUILD/surface/runs.json has already")
    parser.add_argument("--out", type=pathlib.Path, help="the table as Markdown (default: BUILD/surface/RESULTS.md)")
    options = parser.parse_args()
    # The machine's paths say nothing to the reader of the table.
    words = sys.argv[1:]
    skipped = {i + k for i, word in enumerate(words) if word in ("--build", "--out") for k in (0, 1)}
    options.command = [word for i, word in enumerate(words) if i not in skipped]
    return options


def command_of(tool, options, mesh, n_triangles, out):
    words = TOOLS[tool].format(build=options.build, here=HERE, mesh=mesh, n=n_triangles, out=out).split()
    return words + shlex.split(options.option) if tool == "tinsmith" else words


def run_once(command):
    """What it cost: seconds of the simplification alone as the program measured them, without reading and writing."""
    starter = subprocess.run(["/usr/bin/python3", "-B", "-c", STARTER, str(LIMIT), *map(str, command)], check=True,
                             env={**os.environ, "PYTHONPATH": str(HERE.parent)}, capture_output=True, text=True)
    cost = json.loads(starter.stdout)
    if cost["exit_code"] != 0:
        reason = "took too long" if cost["limit_hit"] else (cost["stderr"].strip().splitlines() or ["?"])[-1]
        return {"failure": reason}
    said = json.loads(cost["stdout"])
    seconds = said.get("own_seconds", said.get("simplify_seconds"))
    return {"seconds": seconds, "collapse_seconds": said.get("collapse_seconds", seconds),
            "peak_memory": cost["peak_memory"]}


def judged(runs, mesh, out):
    """The fastest of them, and what its mesh is like."""
    failed = [one for one in runs if "failure" in one]
    if failed:
        return failed[0]
    best = min(runs, key=lambda one: one["seconds"])
    vertices, triangles = plain_ply.read(out)
    if len(triangles) == 0:
        return {"failure": "no triangle is left"}
    hausdorff, rms = judge.distance(mesh["surface"], (vertices, triangles))
    return {**best, **judge.facts(vertices, triangles), "triangles": len(triangles),
            "hausdorff": hausdorff / mesh["diagonal"], "rms": rms / mesh["diagonal"]}


def run_by_turns(chosen, options, mesh, n_triangles):
    """By tool. Each round runs all of them, so that a slow minute of the machine is slow for all."""
    out = {tool: options.build / "surface" / f"result.{tool}.ply" for tool in chosen}
    runs = {tool: [] for tool in chosen}
    for _ in range(options.repeat):
        for tool in chosen:
            out[tool].unlink(missing_ok=True)
            runs[tool].append(run_once(command_of(tool, options, mesh["path"], n_triangles, out[tool])))
    results = {tool: judged(runs[tool], mesh, out[tool]) for tool in chosen}
    for path in out.values():
        path.unlink(missing_ok=True)
    return results


def identity(tool, options):
    """Of the program that is measured."""
    if tool != "tinsmith":
        return version_of(PACKAGES[tool])
    return hashlib.sha256((options.build / "tinsmith").read_bytes()).hexdigest() + options.option


class Runs:
    """Results, kept in a file: a table takes an hour, and goes on after an end where it was."""

    def __init__(self, options):
        self.options = options
        self.path = options.build / "surface" / "runs.json"
        self.known = json.loads(self.path.read_text()) if self.path.exists() and not options.again else {}

    def of(self, mesh, share):
        """By tool, all that are asked for."""
        n_triangles = round(len(mesh["surface"][1]) * share / 100)
        keys = {tool: " ".join([tool, identity(tool, self.options), mesh["name"], str(n_triangles)])
                for tool in self.options.tool or TOOLS}
        missing = [tool for tool, key in keys.items() if key not in self.known]
        if missing:
            for tool, result in run_by_turns(missing, self.options, mesh, n_triangles).items():
                self.known[keys[tool]] = result
            unfinished = self.path.with_suffix(".new")
            unfinished.write_text(json.dumps(self.known, indent=1))
            unfinished.rename(self.path)
        return {tool: self.known[key] for tool, key in keys.items()}


def load(name, folder):
    path = meshes.prepare(name, folder) if name in meshes.MESHES else pathlib.Path(name)
    surface = plain_ply.read(path)
    diagonal = np.linalg.norm(np.ptp(surface[0], axis=0))
    return {"name": path.stem, "path": path, "surface": surface, "diagonal": diagonal, "facts": judge.facts(*surface)}


def row(share, tool, result, n_input):
    start = f"| {share:g} % | {tool} |"
    if "failure" in result:
        return f"{start} failed: {result['failure']} | | | | | | | | | |"
    per_triangle = 1e6 * result["seconds"] / max(1, n_input - result["triangles"])
    return (f"{start} {result['triangles']} | {1e3 * result['hausdorff']:.4f} | {1e3 * result['rms']:.5f} | "
            f"{result['seconds']:.3f} | {per_triangle:.2f} | {result['peak_memory'] / 1e6:.0f} | "
            f"{result['turned_edges']} | {result['genus']:g} | {result['borders']} | {result['components']} |")


def table(options, runs, mesh):
    """Line by line, as the runs end."""
    n_input, facts = len(mesh["surface"][1]), mesh["facts"]
    yield (f"\n### {mesh['name']}: {n_input} triangles, genus {facts['genus']:g}, {facts['borders']} borders, "
           f"{facts['components']} parts, {facts['turned_edges']} turned edges\n\n{HEADER}")
    for share in options.share or [50, 20, 5, 1]:
        for tool, result in runs.of(mesh, share).items():
            yield row(share, tool, result, n_input)


def multiples(options, runs, mesh):
    """Of the distances, and of the time per removed triangle, from the runs that the tables show."""
    n_input = len(mesh["surface"][1])
    for share in options.share or [50, 20, 5, 1]:
        results = runs.of(mesh, share)
        ours, *peers = (results[tool] for tool in ("tinsmith", "cgal-gh", "vtk-quadric"))
        if any("failure" in one for one in (ours, *peers)):
            continue
        cells = [max(ours[what], FLOOR) / max(peer[what], FLOOR) for peer in peers for what in ("hausdorff", "rms")]
        n_removed, n_of_cgal = (max(1, n_input - one["triangles"]) for one in (ours, peers[0]))
        paces = [peers[0][what] / n_of_cgal / (ours["seconds"] / n_removed) for what in ("seconds", "collapse_seconds")]
        yield f"| {mesh['name']} | {share:g} % | " + " | ".join(f"{x:.2f}" for x in (*cells, *paces)) + " |"


def summary(options, runs):
    yield ("\n## tinsmith's distances as multiples of its peers'\n\nAsked are 1.05 of CGAL's and 1.00 of VTK's, and "
           "CGAL's time. Distances below a ten-millionth of the diagonal, about what single precision rounds away, count "
           "as that much: those of the cube.\n\n| mesh | triangles asked | Hausdorff : CGAL GH | RMS : CGAL GH | "
           "Hausdorff : VTK quadric | RMS : VTK quadric | time per removed triangle, CGAL GH : ours | the same, of CGAL its collapses alone |\n"
           "|---|---|---|---|---|---|---|---|")
    for name in options.mesh or meshes.MESHES:
        yield from multiples(options, runs, load(name, options.build / "surface"))


def version_of(package):
    return subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True).stdout


def preface(options):
    m = tools.machine()
    option = f" with `{options.option}`" if options.option else ""
    peers = ", ".join(f"{name} {version_of(PACKAGES[tool])}" for name, tool in
                      (("CGAL", "cgal-gh"), ("VTK", "vtk-quadric"), ("meshoptimizer", "meshopt")))
    command = " ".join(["tools/bench/surface/run.sh", *map(shlex.quote, options.command)])
    other = "without colours are in [RESULTS.md](RESULTS.md)" if options.colours else "with colours are in [COLOURS.md](COLOURS.md)"
    return (f"Made by `{command}`.\n\nSurfaces {other}.\n\ntinsmith{option} and {peers}, on {m['processor']}, one thread each. Distances are symmetric, between "
            f"{judge.N_SAMPLES} samples (for the largest one also the vertices) and the other surface, as thousandths "
            "of the diagonal of the mesh's box, by VTK. Seconds: from triangles in memory to triangles in memory. Turned "
            "edges: the normals of the two triangles are more than 90 degrees apart.")


def tables(options):
    if options.colours:
        coloured = (load(name, options.build / "surface") for name in options.mesh or colours.MESHES)
        yield from colours.tables(options.build, coloured, [20, 5, 1])
        return
    runs = Runs(options)
    for name in options.mesh or meshes.MESHES:
        yield from table(options, runs, load(name, options.build / "surface"))
    if not options.tool or {"tinsmith", "cgal-gh", "vtk-quadric"} <= set(options.tool):
        yield from summary(options, runs)


def main():
    options = arguments()
    folder = options.build / "surface"
    out = options.out or folder / "RESULTS.md"
    with open(out, "w") as file:
        print(preface(options), file=file)
        for text in tables(options):
            print(text, flush=True)
            print(text, file=file, flush=True)
    print(f"written: {out}", file=sys.stderr)


main()
