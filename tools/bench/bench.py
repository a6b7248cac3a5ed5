#!/usr/bin/env python3
"""Runs tinsmith and its peers on the same rasters, has every result judged, and writes the tables.

Started by run.sh, which builds what is needed; see its --help. Every run leaves one JSON file below BUILD/runs; what
is there already is not run again, so an interrupted benchmark goes on where it stopped. The files of one build of
tinsmith are kept apart from those of another.
"""

import argparse
import concurrent.futures
import hashlib
import json
import math
import pathlib
import shlex
import signal
import statistics
import subprocess
import sys
import tempfile

import inputs
import measure
import report
import tools

TOP = pathlib.Path(__file__).resolve().parents[2]
SMALL = 2_000_000  # samples: a raster of which a run takes seconds
TWO_FIT = 10_000_000  # samples: 11 GB for VTK's quadric decimation, the most that a peer takes
JUDGED = ["samples", "uncovered", "vertices", "triangles", "max_error", "rmse", "p99_error", "folded",
          "non_manifold_edges", "t_junctions", "bytes"]


class Patience:
    """Which runs are not worth starting after one that ran into the limit. What a tool that decimates the full mesh
    takes grows with the triangles that it removes; what one that inserts takes, with fineness. Between rasters the
    time for a removed triangle differs, so that of another one twice as many must have been too many."""

    def __init__(self, limit):
        self.limit = limit
        self.over = {}  # by tool: the cases that ran into the limit

    @staticmethod
    def hopeless(tool, case, over):
        same = case["input"] == over["input"]
        if tool.decimates:
            return case["n_removed"] >= (1 if same else 2) * over["n_removed"]
        return same and case["tolerance"] <= over["tolerance"]

    def why_not(self, tool, case):
        for over in self.over.get(tool.name, []):
            if self.hopeless(tool, case, over):
                return f"not run: over {self.limit:g} s for {over['input']}, {over['tolerance']:g} m"
        return None

    def learn(self, tool, case, run):
        if run.get("limit_hit"):
            self.over.setdefault(tool.name, []).append(case)


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

    def grid(self, name, rasters):
        """The samples as the peers read them."""
        path = self.build / "inputs" / f"{name}.grid"
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            unfinished = path.with_suffix(".new")
            subprocess.run([self.build / "peers/dump", *rasters, unfinished], check=True)
            unfinished.rename(path)
        return path

    def command(self, tool, case, mesh):
        words = {"build": self.build, "bench": TOP / "tools/bench", "grid": case["grid"], "out": mesh,
                 "m": f"{case['tolerance']:g}", "n": case.get("n_triangles")}
        filled = []
        for word in tool.command.split():
            filled += [str(r) for r in case["rasters"]] if word == "{input}" else [word.format(**words)]
        return filled

    def judge(self, case, mesh):
        """What `tinsmith verify` says of the mesh; that it is not valid (exit code 1) is a result like others."""
        command = [self.binary, "verify", *case["rasters"], mesh, "--json", "-"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            return {"judge_failed": done.stderr.strip()}
        certificate = json.loads(done.stdout)
        return {key: certificate[key] for key in JUDGED}

    def once(self, tool, case, repetition=0):
        """What an earlier run left, or one now, or why there is none."""
        name = f"{case['input']}.{case['tolerance']:g}m.{tool.name.replace(', ', '-').replace(' ', '-')}.{repetition}"
        path = self.runs / f"{name}.json"
        reason = self.patience.why_not(tool, case) or (report.NOT_RUN if self.runs_nothing else None)
        if path.exists():
            run = json.loads(path.read_text())
        elif reason:
            run = {"failed": reason}
        else:
            run = self._measured(tool, case, repetition, name)
            unfinished = path.with_suffix(".new")
            unfinished.write_text(json.dumps(run, indent=1))
            unfinished.rename(path)
            say(name, run)
        self.patience.learn(tool, case, run)
        return run

    def _measured(self, tool, case, repetition, name):
        # In an empty folder: tinsmith would go on with the work that an interrupted run has left.
        with tempfile.TemporaryDirectory(dir=self.runs) as empty:
            return self._measured_into(pathlib.Path(empty) / f"{name}.ply", tool, case, repetition)

    def _measured_into(self, mesh, tool, case, repetition):
        """Its costs and, the first time, the judge's verdict."""
        limit = self.limit if tool.may_be_ended else math.inf
        result = measure.run(self.command(tool, case, mesh), limit)
        said = result.pop("stdout")
        wrong = result.pop("stderr").strip().splitlines()
        if result["exit_code"] == 0:
            own = json.loads(said.splitlines()[-1])
            result["own"] = {key: value for key, value in own.items() if key not in ("input", "output")}
            if mesh.exists():
                # In pieces: the peak of a process is never below its starter's.
                with open(mesh, "rb") as file:
                    result["sha256"] = hashlib.file_digest(file, "sha256").hexdigest()
                if repetition == 0:
                    result["judged"] = self.judge(case, mesh)
        elif result["limit_hit"]:
            result["failed"] = f"over {self.limit:g} s"
        elif result["exit_code"] == -signal.SIGKILL:
            result["failed"] = "out of memory"  # no one else sends it
        else:
            result["failed"] = (wrong or ["no message"])[-1]
        return result


def say(name, result):
    judged = result.get("judged", {})
    error = f", max error {judged['max_error']:.4g} m" if "max_error" in judged else ""
    triangles = f", {judged['triangles']} triangles" if "triangles" in judged else ""
    print(f"{name}: {result['wall']:.2f} s{triangles}{error}{result.get('failed', '') and ': ' + result['failed']}",
          flush=True)


def n_samples(case):
    width, height = case["size"]
    return width * height


def suits(tool, case):
    """Only what is given the same raster is compared: a tool that knows no voids can't take one that has some. And
    martini takes squares of 2^k + 1 samples only."""
    width, height = case["size"]
    if case["has_voids"] and not tool.knows_voids:
        return False
    return tool.name != "martini" or (width == height and (width - 1) & (width - 2) == 0)


def measure_by_turns(bench, case, options, n_runs):
    """tinsmith and the tolerance-driven peers at one tolerance, with nothing beside them."""
    ours = tools.tinsmith_tools(options.efforts)
    peers = [t for t in tools.TOLERANCE_DRIVEN if t.name in options.peers and suits(t, case)]
    results = {tool.name: [] for tool in ours + peers}
    for repetition in range(n_runs):
        for tool in ours + peers:
            earlier = results[tool.name]
            if not (earlier and "failed" in earlier[0]):
                earlier.append(bench.once(tool, case, repetition))
    if "delatin" in results and n_samples(case) < SMALL:
        results[tools.CROSS_CHECK.name] = [bench.once(tools.CROSS_CHECK, case)]
    return results


def measure_count_driven(bench, cases, options):
    """The results of each tool at the counts of triangles that tinsmith needed, once. Each takes one core, so two of
    them run at a time, where the memory is enough for that. Those that decimate begin with the least to remove, those
    that insert with the least to insert: what follows on a run over the limit need not be tried."""
    chosen = [t for t in tools.COUNT_DRIVEN if t.name in options.peers and cases and suits(t, cases[0])]

    def measure_tool(tool):
        ordered = sorted(cases, key=lambda case: case["tolerance"], reverse=not tool.decimates)
        return {case["tolerance"]: [bench.once(tool, case)] for case in ordered}

    with concurrent.futures.ThreadPoolExecutor(2 if cases and n_samples(cases[0]) < TWO_FIT else 1) as pool:
        try:
            return dict(zip([t.name for t in chosen], pool.map(measure_tool, chosen)))
        except BaseException:  # interrupted: nothing is left running
            pool.shutdown(wait=False, cancel_futures=True)
            measure.end_all()
            raise


def header_of(grid):
    with open(grid, "rb") as file:
        return json.loads(file.readline())


def measure_input(bench, name, options):
    rasters = inputs.files(name, TOP, bench.build, options.data)
    grid = bench.grid(name, rasters)
    header = header_of(grid)
    about = {"input": name, "size": (header["width"], header["height"]), "has_voids": header["has_voids"]}
    # More runs for the small ones, where a run is short and its time less sure.
    n_runs = options.runs[0] if n_samples(about) < SMALL else options.runs[-1]
    tolerances = options.tolerances or (inputs.QUICK_TOLERANCES if options.quick else inputs.tolerances(name))
    results, with_counts = {}, []
    for tolerance in sorted(tolerances, reverse=True):
        case = {**about, "tolerance": tolerance, "rasters": rasters, "grid": grid}
        results[tolerance] = measure_by_turns(bench, case, options, n_runs)
        leader = next(iter(results[tolerance].values()))[0]
        judged = leader.get("judged", {})
        if "triangles" in judged:
            n_triangles = judged["triangles"]
            with_counts.append({**case, "n_triangles": n_triangles, "n_removed": 2 * judged["samples"] - n_triangles})
    for tool, by_tolerance in measure_count_driven(bench, with_counts, options).items():
        for tolerance, runs in by_tolerance.items():
            results[tolerance][tool] = runs
    return [{**about, "tolerance": tolerance, "results": results[tolerance]} for tolerance in tolerances]


def one_case_a_line(document):
    rest = {key: value for key, value in document.items() if key != "cases"}
    return json.dumps(rest)[:-1] + ', "cases": [\n' + ",\n".join(map(json.dumps, document["cases"])) + "\n]}\n"


def write_tables(bench, options, cases):
    # Of the runs that had nothing beside them.
    beside_others = {tool.name for tool in tools.COUNT_DRIVEN}
    loads = [run["load_before"] for case in cases for tool, runs in case["results"].items() for run in runs
             if "load_before" in run and tool not in beside_others]
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


def counts(text):
    return [int(word) for word in text.split(",")]


def command_line(arguments):
    """As it is shown: without run.sh's own option, and no path of this machine."""
    names = {"--build": "DIR", "--data": "DIR", "--out": "FILE.md"}
    return [names.get(before, word) for before, word in zip(["", *arguments], arguments)][2:]


def parse(arguments):
    parser = argparse.ArgumentParser(prog="tools/bench/run.sh", description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--quick", action="store_true", help="matterhorn only, at 2,5,10,20,50 m")
    parser.add_argument("--inputs", type=words, metavar="A,B", help="default: all there are")
    parser.add_argument("--data", type=pathlib.Path, metavar="DIR", help="real terrain; without it, none is measured")
    parser.add_argument("--tolerances", type=numbers, metavar="M,M", help="metres; default: tolerances.json")
    parser.add_argument("--peers", type=words, metavar="A,B", default=tools.PEERS, help=", ".join(tools.PEERS))
    parser.add_argument("--efforts", type=words, metavar="A,B", default=["default"], help="of tinsmith's --effort")
    parser.add_argument("--runs", type=counts, metavar="N[,N]", default=[5, 3],
                        help="of each, up to 2 million samples and above (default: 5,3)")
    parser.add_argument("--limit", type=float, metavar="S", default=900,
                        help="seconds after which a peer's run is ended (default: 900)")
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
    for name in chosen:
        if options.calibrate:
            inputs.calibrate(bench.build, name, inputs.files(name, TOP, bench.build, options.data))
        else:
            cases += measure_input(bench, name, options)
            write_tables(bench, options, cases)
    if cases:
        print(options.out)


if __name__ == "__main__":
    main(sys.argv[1:])
