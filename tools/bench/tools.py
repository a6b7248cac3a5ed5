"""The programs that are compared: their commands, and where their versions stand."""

import dataclasses
import json
import platform
import subprocess


@dataclasses.dataclass(frozen=True)
class Tool:
    """{input}: the rasters. {grid}: their samples as dump writes them. {m}: metres. {n}: triangles. {out}: a PLY."""
    name: str
    command: str
    knows_voids: bool = True
    decimates: bool = False  # from the full mesh: the fewer triangles are to be left, the longer it takes
    may_be_ended: bool = True  # after the limit


def tinsmith_tools(efforts):
    """Each effort with one thread and with two; "default" is the program without the option."""
    tools = []
    for effort in efforts:
        option = "" if effort == "default" else f" --effort {effort}"
        label = "tinsmith" if effort == "default" else f"tinsmith {effort}"
        for threads in (1, 2):
            tools.append(Tool(f"{label}, {threads} thread{'s' * (threads > 1)}", "{build}/tinsmith compress {input} "
                              f"{{out}} --max-error {{m}} --threads {threads}{option} --no-verify --json -",
                              may_be_ended=False))
    return tools


# They stop at a largest error, as tinsmith does. The memory is for V8, whose limit is far below the machine's.
TOLERANCE_DRIVEN = [
    Tool("delatin", "node --max-old-space-size=12000 {build}/node/delatin.mjs {grid} {m} {out}",
         knows_voids=False),
    Tool("martini", "node --max-old-space-size=12000 {build}/node/martini.mjs {grid} {m} {out}",
         knows_voids=False),
]

# Not timed: delatin's mesh measured by other code than the judge's.
CROSS_CHECK = Tool("delatin, own measurement",
                   "node --max-old-space-size=12000 {build}/node/delatin.mjs {grid} {m} --check", knows_voids=False)

# They stop at a count of triangles: the one that tinsmith needed.
COUNT_DRIVEN = [
    Tool("cgal-gh", "{build}/peers/cgal_peer gh {grid} {n} {out}", decimates=True),
    Tool("cgal-lt", "{build}/peers/cgal_peer lt {grid} {n} {out}", decimates=True),
    Tool("meshopt", "{build}/peers/meshopt_peer {grid} {n} {out}"),
    Tool("vtk-greedy", "/usr/bin/python3 {bench}/peers/vtk_peer.py greedy {grid} {n} {out}", knows_voids=False),
    Tool("vtk-quadric", "/usr/bin/python3 {bench}/peers/vtk_peer.py quadric {grid} {n} {out}", decimates=True),
]

PEERS = [tool.name for tool in TOLERANCE_DRIVEN + COUNT_DRIVEN]


def _output(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "?"


def _debian(package):
    return _output("dpkg-query", "-W", "-f", "${Version}", package)


def _field(path, name):
    for line in open(path):
        key, _, value = line.partition(":")
        if key.strip() == name:
            return value.strip()
    return "?"


def versions(build, top):
    """Of all that takes part, tinsmith first."""
    def npm(package):
        return json.loads((build / "node/node_modules" / package / "package.json").read_text())["version"]
    changed = " with uncommitted changes" if _output("git", "-C", top, "status", "--porcelain", "-uno") else ""
    commit = _output("git", "-C", top, "rev-parse", "--short", "HEAD")
    return {"tinsmith": f"{_output(build / 'tinsmith', '--version').split()[-1]} at {commit}{changed}",
            "delatin": npm("delatin"), "@mapbox/martini": npm("@mapbox/martini"), "node": _output("node", "--version"),
            "CGAL": _debian("libcgal-dev"), "meshoptimizer": _debian("libmeshoptimizer-dev"),
            "VTK": _debian("python3-vtk9"), "g++": _output("g++", "-dumpfullversion")}


def machine():
    memory = int(_field("/proc/meminfo", "MemTotal").split()[0]) / 2**20
    return {"processor": _field("/proc/cpuinfo", "model name"), "cores": _output("nproc"),
            "memory": f"{memory:.0f} GiB", "kernel": platform.release()}
