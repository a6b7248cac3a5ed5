"""What is measured: the rasters, and the tolerances for each of them."""

import json
import pathlib
import subprocess

QUICK_TOLERANCES = [2, 5, 10, 20, 50]

# Side in samples: 2^k + 1, since martini takes no other.
GENERATED = {"fractal_1m": 1025, "fractal_4m": 2049, "fractal_16m": 4097, "fractal_64m": 8193}

# Below the folder that --data names; skipped when it is not there.
REAL = {
    "alps": "srtm3_alps/*.hgt",
    "murray": "srtm3_murray/*.tif",
    "vancouver": "srtm3_vancouver/*.tif",
    "autzen": "autzen_dsm_rgb/autzen_dsm_3ft.tif",
    "etopo5": "etopo5/etopo5_int16.tif",
}

# Those of them that have voids are measured as they are, beside the peers that know voids, and filled, beside all.
FILLED = {f"{name}_filled": name for name in ("alps", "murray", "vancouver", "autzen")}

# Shares of the samples that the result keeps as vertices, and by how much of themselves they may be missed: a ragged
# outline alone may need more vertices, then there is no such tolerance.
SHARES = [0.5, 0.2, 0.05, 0.01, 0.001]
LARGEST_MISS = 0.25

TABLE = pathlib.Path(__file__).with_name("tolerances.json")


def names(data):
    """Every input that can be had, in the order in which they are measured."""
    real = [name for name, pattern in REAL.items() if data and list(data.glob(pattern))]
    filled = [name for name, source in FILLED.items() if source in real]
    return ["matterhorn", *GENERATED, *real, *filled]


def _made(path, *command):
    """The file that the command makes, unless it is there."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(".new.tif")
        subprocess.run([*command, unfinished], check=True)
        unfinished.rename(path)
    return [path]


def files(name, top, build, data):
    """The rasters of an input; generated and filled ones are made when they are not there yet."""
    made = build / "inputs" / f"{name}.tif"
    if name in FILLED:
        return _made(made, build / "peers/dump", "--fill", *files(FILLED[name], top, build, data))
    if name in REAL:
        found = sorted(data.glob(REAL[name])) if data else []
        if not found:
            raise SystemExit(f"bench: input {name}: no {REAL[name]} below --data; leave it out of --inputs")
        return found
    if name == "matterhorn":
        return [top / "data/matterhorn.tif"]
    if name not in GENERATED:
        known = ["matterhorn", *GENERATED, *REAL, *FILLED]
        raise SystemExit(f"bench: --inputs {name}: unknown; there are {', '.join(known)}")
    side = GENERATED[name]
    return _made(made, build / "make_terrain", "--kind", "fractal", "--size", f"{side}x{side}")


def tolerances(name):
    """From the table; all generated mountains share one row, for the time per sample at equal tolerances."""
    table = json.loads(TABLE.read_text())
    row = "fractal" if name in GENERATED else name
    return [entry["tolerance"] for entry in table[row]]


def calibrate(build, name, paths):
    """Finds the tolerances (two digits) at which tinsmith keeps the shares, and enters them in the table."""
    entries = []
    (build / "inputs").mkdir(parents=True, exist_ok=True)
    for share in SHARES:
        # A triangulation has about two triangles a vertex, and so has the full grid.
        found = _compress(build, paths, ["--ratio", str(share)])
        if found is None:
            continue
        tolerance = float(f"{found['tolerance']:.2g}")
        kept = _compress(build, paths, ["--max-error", str(tolerance)])
        kept_share = kept["vertices"] / kept["samples"]
        print(f"{name}: {tolerance:g} m keeps {kept_share:.3%}", flush=True)
        if abs(kept_share / share - 1) > LARGEST_MISS:
            print(f"{name}: that is not {share:.1%}, and left out")
            continue
        entries.append({"tolerance": tolerance, "share": round(kept_share, 5)})
    table = json.loads(TABLE.read_text()) if TABLE.exists() else {}
    table["fractal" if name in GENERATED else name] = entries
    rows = [f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in table.items()]
    TABLE.write_text("{\n" + ",\n".join(rows) + "\n}\n")


def _compress(build, paths, goal):
    """The report; None, and why, when there is no such result."""
    mesh = build / "inputs/calibration.ply"
    command = [build / "tinsmith", "compress", *paths, mesh, *goal, "--no-verify", "--json", "-"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    mesh.unlink(missing_ok=True)
    if done.returncode == 1:
        print(done.stderr.strip())
        return None
    done.check_returncode()
    return json.loads(done.stdout)
