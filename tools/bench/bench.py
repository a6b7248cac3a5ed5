#!/usr/bin/env python3
"""Runs tinsmith and its peers on the same rasters, has every result judged, and writes the tables.

Started by run.sh, which builds what is needed; see its --help. Every run leaves one JSON file below BUILD/runs; what
is there already is not run again, so an interrupted benchmark goes on where it stopped. The files of one build of
tinsmith are kept apart from those of another.
"""

import argparse
import hashlib
import json
import os
import pathlib
import shlex
import signal
import statistics
import subprocess
import sys

import inputs
import measure
import report
import tools

TOP = pathlib.Path(__file__).resolve().parents[2]
JUDGED = ["samples", "uncovered", "vertices", "triangles", "max_error", "rmse", "p99_error", "folded",
          "non_manifold_edges", "t_junctions", "bytes"]


class Patience:
    """Which of the tools that decimate the full mesh are not worth starting: what they take grows with the triangles
    that they remove, so one that ran into the limit is not run where it has as many to remove, or more."""

    def __init__(self, limit):
        self.limit = limit
        self.hopeless = {}  # by tool: the triangles to remove, and where that was

    def why_not(self, tool, n_removed):
        n_hopeless, where = self.hopeless.get(tool.name, (None, None))
        return f"not run: over {self.limit:g} s {where}" if n_hopeless and n_removed >= n_hopeless else None

    def learn(self, tool, case, n_removed, run):
        if tool.decimates and run.get("limit_hit") and not self.why_not(tool, n_removed):
            self.hopeless[tool.name] = n_removed, f"for {case['input']}, {case['tolerance']:g} m"


class Bench:
    """What all runs of one benchmark share."""

    def __init__(self, build, limit, runs_nothing):
        self.build = build
        self.limit = limit
        self.patience = Patience(limit)
        self.runs_nothing = runs_nothing
        self.binary = build / "tinsmith"
        identity = hashlib.sha256(self.binary.read_bytes()).hexdigest()[:12]
        self.runs = build / "runs" / identity
        self.runs.mkdir(parents=True, exist_ok=True)
        self.mesh = self.runs / f"mesh-{os.getpid()}.ply"

    def grid(self, name, rasters):
        """The samples as the peers read them."""
        path = self.build / "inputs" / f"{name}.grid"
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            unfinished = path.with_suffix(".new")
            subprocess.run([self.build / "peers/dump", *rasters, unfinished], check=True)
            unfinished.rename(path)
        return path

    def command(self, tool, case, n_triangles):
        words = {"build": self.build, "bench": TOP / "tools/bench", "grid": case["grid"], "out": self.mesh,
                 "m": f"{case['tolerance']:g}", "n": n_triangles}
        filled = []
        for word in tool.command.split():
            filled += [str(r) for r in case["rasters"]] if word == "{input}" else [word.format(**words)]
        return filled

    def judge(self, case):
        """What `tinsmith verify` says of the mesh; that it is not valid (exit code 1) is a result like others."""
        command = [self.binary, "verify", *case["rasters"], self.mesh, "--json", "-"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            return {"judge_failed": done.stderr.strip()}
        certificate = json.loads(done.stdout)
        return {key: certificate[key] for key in JUDGED}

    def once(self, tool, case, repetition, n_triangles=0):
        """One run, or what an earlier one left: its costs and, the first time, the judge's verdict."""
        name = f"{case['input']}.{case['tolerance']:g}m.{tool.name.replace(', ', '-').replace(' ', '-')}.{repetition}"
        path = self.runs / f"{name}.json"
        if path.exists():
            return json.loads(path.read_text())
        if self.runs_nothing:
            return {"failed": report.NOT_RUN}
        self.mesh.unlink(missing_ok=True)
        result = measure.run(self.command(tool, case, n_triangles), self.limit)
        said = result.pop("stdout")
        wrong = result.pop("stderr").strip().splitlines()
        if result["exit_code"] == 0:
            own = json.loads(said.splitlines()[-1])
            result["own"] = {key: value for key, value in own.items() if key not in ("input", "output")}
            if self.mesh.exists():
                # In pieces: the peak of a process is never below its starter's.
                with open(self.mesh, "rb") as file:
                    result["sha256"] = hashlib.file_digest(file, "sha256").hexdigest()
                if repetition == 0:
                    result["judged"] = self.judge(case)
        elif result["limit_hit"]:
            result["failed"] = f"over {self.limit:g} s"
        elif result["exit_code"] == -signal.SIGKILL:
            result["failed"] = "out of memory"  # no one else sends it
        else:
            result["failed"] = (wrong or ["no message"])[-1]
        self.mesh.unlink(missing_ok=True)
        unfinished = path.with_suffix(".new")
        unfinished.write_text(json.dumps(result, indent=1))
        unfinished.rename(path)
        say(name, result)
        return result


def say(name, result):
    judged = result.get("judged", {})
    error = f", max error {judged['max_error']:.4g} m" if "max_error" in judged else ""
    triangles = f", {judged['triangles']} triangles" if "triangles" in judged else ""
    print(f"{name}: {result['wall']:.2f} s{triangles}{error}{result.get('failed', '') and ': ' + result['failed']}",
          flush=True)


def suits(tool, case):
    """Only what is given the same raster is compared: a tool that knows no voids can't take one that has some. And
    martini takes squares of 2^k + 1 samples only."""
    width, height = case["size"]
    if case["has_voids"] and not tool.knows_voids:
        return False
    return tool.name != "martini" or (width == height and (width - 1) & (width - 2) == 0)


def measure_count_driven(bench, case, options, judged):
    """Each at the count of triangles that `judged` has, once."""
    results = {}
    n_removed = 2 * judged["samples"] - judged["triangles"]
    for tool in (t for t in tools.COUNT_DRIVEN if t.name in options.peers and suits(t, case)):
        reason = bench.patience.why_not(tool, n_removed)
        run = {"failed": reason} if reason else bench.once(tool, case, 0, judged["triangles"])
        bench.patience.learn(tool, case, n_removed, run)
        results[tool.name] = [run]
    return results


def measure_case(bench, case, options, n_runs):
    """All tools at one tolerance: tinsmith and the tolerance-driven peers by turns, then the count-driven ones."""
    ours = tools.tinsmith_tools(options.efforts)
    peers = [t for t in tools.TOLERANCE_DRIVEN if t.name in options.peers and suits(t, case)]
    results = {tool.name: [] for tool in ours + peers}
    for repetition in range(n_runs):
        for tool in ours + peers:
            earlier = results[tool.name]
            if not (earlier and "failed" in earlier[0]):
                earlier.append(bench.once(tool, case, repetition))
    if "delatin" in results and case["size"][0] * case["size"][1] < 5e6:
        results[tools.CROSS_CHECK.name] = [bench.once(tools.CROSS_CHECK, case, 0)]
    leader = results[ours[0].name][0]
    if "judged" in leader and "triangles" in leader["judged"]:
        results |= measure_count_driven(bench, case, options, leader["judged"])
    return results


def header_of(grid):
    with open(grid, "rb") as file:
        return json.loads(file.readline())


def measure_input(bench, name, options):
    rasters = inputs.files(name, TOP, bench.build, options.data)
    grid = bench.grid(name, rasters)
    header = header_of(grid)
    size = (header["width"], header["height"])
    # Five runs for the small ones, where a run is short and its time less sure.
    n_runs = options.runs or (3 if options.quick else 5 if size[0] * size[1] < 2e6 else 3)
    cases = []
    for tolerance in options.tolerances or (inputs.QUICK_TOLERANCES if options.quick else inputs.tolerances(name)):
        shown = {"input": name, "size": size, "has_voids": header["has_voids"], "tolerance": tolerance}
        case = {**shown, "rasters": rasters, "grid": grid}
        cases.append({**shown, "results": measure_case(bench, case, options, n_runs)})
    return cases


def one_case_a_line(document):
    rest = {key: value for key, value in document.items() if key != "cases"}
    return json.dumps(rest)[:-1] + ', "cases": [\n' + ",\n".join(map(json.dumps, document["cases"])) + "\n]}\n"


def write_tables(bench, options, cases):
    loads = [run["load_before"] for case in cases for runs in case["results"].values() for run in runs
             if "load_before" in run]
    if not loads:
        raise SystemExit("bench: --tables: none of these was run with this build; leave --tables out to run them")
    document = {"command": "tools/bench/run.sh " + shlex.join(options.words), "machine": tools.machine(),
                "versions": tools.versions(bench.build, TOP), "limit_seconds": bench.limit,
                "load": {"median": statistics.median(loads), "highest": max(loads)}, "cases": cases}
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.with_suffix(".json").write_text(one_case_a_line(document))
    options.out.write_text(report.markdown(document, options.efforts))


def words(text):
    return text.split(",")


def numbers(text):
    return [float(word) for word in text.split(",")]


def command_line(arguments):
    """As it is shown: without run.sh's own option, and no path of this machine."""
    names = {"--build": "DIR", "--data": "DIR", "--out": "FILE.md"}
    return [names.get(before, word) for before, word in zip(["", *arguments], arguments)][2:]


def parse(arguments):
    parser = argparse.ArgumentParser(prog="tools/bench/run.sh", description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--quick", action="store_true", help="matterhorn only, at 2,5,10,20,50 m, three runs of each")
    parser.add_argument("--inputs", type=words, metavar="A,B", help="default: all there are")
    parser.add_argument("--data", type=pathlib.Path, metavar="DIR", help="real terrain; without it, none is measured")
    parser.add_argument("--tolerances", type=numbers, metavar="M,M", help="metres; default: tolerances.json")
    parser.add_argument("--peers", type=words, metavar="A,B", default=tools.PEERS, help=", ".join(tools.PEERS))
    parser.add_argument("--efforts", type=words, metavar="A,B", default=["default"], help="of tinsmith's --effort")
    parser.add_argument("--runs", type=int, metavar="N", help="default: 5 up to 2 million samples, 3 above")
    parser.add_argument("--limit", type=float, metavar="S", default=900, help="seconds after which a run is ended")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE.md", default=TOP / "tools/bench/RESULTS.md",
                        help="the tables, and beside it all there is as FILE.json (default: tools/bench/RESULTS.md)")
    parser.add_argument("--tables", action="store_true", help="run nothing, only write the tables of what was run")
    parser.add_argument("--calibrate", action="store_true", help="only find the tolerances of the inputs anew")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.peers) - set(tools.PEERS))
    if unknown:
        parser.error(f"--peers {','.join(unknown)}: unknown; there are {', '.join(tools.PEERS)}")
    options.words = command_line(arguments)
    return options


def main(arguments):
    options = parse(arguments)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    chosen = options.inputs or (["matterhorn"] if options.quick else inputs.names(options.data))
    bench = Bench(options.build, options.limit, options.tables)
    cases = []
    try:
        for name in chosen:
            if options.calibrate:
                inputs.calibrate(bench.build, name, inputs.files(name, TOP, bench.build, options.data))
            else:
                cases += measure_input(bench, name, options)
                write_tables(bench, options, cases)
    finally:
        bench.mesh.unlink(missing_ok=True)
    if cases:
        print(options.out)


if __name__ == "__main__":
    main(sys.argv[1:])
