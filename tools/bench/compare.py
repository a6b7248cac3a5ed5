"""compare.py A B RASTER PAIRS METRES...: two builds of tinsmith by turns on one raster. compare.sh calls it."""

import json
import pathlib
import statistics
import sys
import tempfile

import measure

LIMIT = 900  # seconds for one run


def timed(program, raster, metres, folder):
    """Wall seconds of the whole process, and the triangles it made."""
    result = measure.run([program, "compress", raster, pathlib.Path(folder) / "mesh.ply", "--max-error", metres,
                          "--threads", "2", "--no-verify", "--json", "-"], LIMIT)
    if result["exit_code"] != 0:
        sys.exit(f"compare: {program} at {metres} m: {result['stderr'].strip() or 'ended after the time limit'}")
    return result["wall"], json.loads(result["stdout"])["triangles"]


def main():
    if len(sys.argv) < 6:
        sys.exit(f"usage: {__doc__}")
    a, b, raster, pairs, *tolerances = sys.argv[1:]
    print(f"{'metres':>8} {'A s':>8} {'B s':>8} {'B : A':>8} {'least':>8} {'most':>8} {'A triangles':>12} "
          f"{'B triangles':>12}")
    with tempfile.TemporaryDirectory() as folder:
        for metres in tolerances:
            runs = [(timed(a, raster, metres, folder), timed(b, raster, metres, folder)) for _ in range(int(pairs))]
            ratios = [after[0] / before[0] for before, after in runs]
            seconds = [statistics.median(run[side][0] for run in runs) for side in (0, 1)]
            print(f"{metres:>8} {seconds[0]:8.3f} {seconds[1]:8.3f} {statistics.median(ratios):8.3f} "
                  f"{min(ratios):8.3f} {max(ratios):8.3f} {runs[0][0][1]:12} {runs[0][1][1]:12}", flush=True)


main()
