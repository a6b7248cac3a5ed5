"""The tables of RESULTS.md."""

import math
import statistics

import tools

NOT_RUN = "not run"

KNOWN = """\
Wall, CPU and peak memory are those of the whole process, start, reading and writing included. tinsmith reads the
raster and writes PLY with `--no-verify`; the peers read float32 samples from a plain file and write PLY too. "Own" is
what the peer's own work takes, without reading and writing (for delatin its constructor and `run`; for the
count-driven ones the simplification alone, without building the full mesh). Times are medians; tinsmith and the
tolerance-driven peers run by turns, with nothing beside them, and "ratio" is the median of tinsmith's wall time (2
threads) over delatin's in the same turn, whole process / own. The count-driven ones run once, up to 10 million samples
two of them at a time, each on a core of its own. Errors are in metres, measured by `tinsmith verify` against every
valid sample.
"""

OTHERS = """\
The sample terrain is in RESULTS.md, other terrain in [TERRAINS.md](TERRAINS.md), the time per sample from 1 to 64
million in [SIZES.md](SIZES.md), surfaces in [surface/RESULTS.md](surface/RESULTS.md), with colours in
[surface/COLOURS.md](surface/COLOURS.md).
"""

VOIDS = """\
This input has voids. It is measured as it is beside the peers that know voids, and as {name}_filled, its voids filled by
inverse distance, beside all. Its exact outline takes vertices at every tolerance, so that few may be out of reach.
"""


PER_SAMPLE = """\
Microseconds for a sample of generated terrain, medians: of the whole process, and in brackets as the tool itself
counts them (tinsmith: once its libraries are loaded, reading and writing included; delatin: without them).
tinsmith's process takes longer than it counts by the loading of GDAL and the hundred libraries that GDAL needs.
"""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def count(n):
    return f"{n:,}".replace(",", " ")


def metres(value):
    return "-" if value is None else f"{value:.4g}"


def seconds(value):
    return f"{value:.2f}" if value < 100 else f"{value:.0f}"


def median(runs, key):
    return statistics.median(run[key] for run in runs)


def own_seconds(run):
    return run["own"].get("own_seconds", run["own"].get("seconds"))


def verdict(case, tool):
    """What the judge measured; None when there is nothing to show."""
    runs = case["results"].get(tool, [])
    judged = runs[0].get("judged", {}) if runs else {}
    return judged if "triangles" in judged else None


def whole(case, tool):
    """The runs of a tool that ended well."""
    return [run for run in case["results"].get(tool, []) if "failed" not in run]


def why_missing(case, tool):
    runs = case["results"].get(tool, [])
    if not runs:
        return "-"
    return runs[0].get("failed") or runs[0].get("judged", {}).get("judge_failed", "-")


def quality_cells(case, tool):
    judged = verdict(case, tool)
    if judged is None:
        return [why_missing(case, tool), "", ""]
    return [count(judged["triangles"]), metres(judged["max_error"]), metres(judged["rmse"])]


def fraction(case, ours):
    mine, greedy = verdict(case, ours), verdict(case, "delatin")
    return mine["triangles"] / greedy["triangles"] if mine and greedy else None


def quality_table(cases, ours):
    head = ["tolerance", "vertices / samples", "bytes of PLY"]
    for name in ("tinsmith", "delatin", "martini"):
        head += [f"{name}: triangles", "max error", "RMSE"]
    rows = []
    for case in cases:
        mine = verdict(case, ours)
        share = f"{mine['vertices'] / mine['samples']:.3%}" if mine else "-"
        cells = [f"{case['tolerance']:g} m", share, count(mine["bytes"]) if mine else "-"]
        for tool in (ours, "delatin", "martini"):
            cells += quality_cells(case, tool)
        part = fraction(case, ours)
        rows.append(cells + ["-" if part is None else f"**{part:.3f}**"])
    return table(head + ["tinsmith : delatin"], rows)


def pair_ratio(mine, theirs, time_of):
    pairs = [a["wall"] / time_of(b) for a, b in zip(mine, theirs)]
    return f"{statistics.median(pairs):.2f}" if pairs else "-"


def cost_cells(runs):
    if not runs:
        return ["-", "-"]
    return [f"{seconds(median(runs, 'wall'))} ({seconds(median(runs, 'cpu'))})",
            f"{median(runs, 'peak_memory') / 2**20:.0f}"]


def time_row(case, one, two):
    mine, both, greedy = whole(case, one), whole(case, two), whole(case, "delatin")
    cells = [f"{case['tolerance']:g} m", *cost_cells(mine), *cost_cells(both)]
    if mine and both:
        samples = case["size"][0] * case["size"][1]
        cells += [f"{median(mine, 'wall') / median(both, 'wall'):.2f}", f"{samples / median(both, 'wall') / 1e6:.2f}"]
    else:
        cells += ["-", "-"]
    cells += cost_cells(greedy)
    if not greedy:
        return cells + ["-", "-"]
    own = statistics.median(own_seconds(run) for run in greedy)
    ratios = [pair_ratio(both, greedy, time_of) for time_of in (lambda run: run["wall"], own_seconds)]
    return cells + [seconds(own), f"**{ratios[0]}** / {ratios[1]}"]


def time_table(cases, one, two):
    head = ["tolerance", "1 thread: wall (CPU) s", "MiB", "2 threads: wall (CPU) s", "MiB", "1 : 2",
            "million samples / s", "delatin: wall (CPU) s", "MiB", "own s", "ratio"]
    return table(head, [time_row(case, one, two) for case in cases])


def per_sample_cells(cases, tool):
    """Of one tool at one tolerance, sizes from left to right, then the largest over the smallest."""
    cells, wholes, owns = [], [], []
    for case in cases:
        runs = whole(case, tool)
        if not runs:
            cells.append(why_missing(case, tool))
            continue
        micro = 1e6 / (case["size"][0] * case["size"][1])
        wholes.append(median(runs, "wall") * micro)
        owns.append(statistics.median(map(own_seconds, runs)) * micro)
        cells.append(f"{wholes[-1]:.3f} ({owns[-1]:.3f})")
    spread = f"{max(wholes) / min(wholes):.2f} ({max(owns) / min(owns):.2f})" if len(wholes) > 1 else "-"
    return cells + [f"**{spread}**"]


def per_sample_section(cases, one, two):
    """How the time grows with the size, where generated terrain of several sizes was measured."""
    generated = [case for case in cases if case["input"].startswith("fractal_")]
    sizes = dict.fromkeys(tuple(case["size"]) for case in generated)
    if len(sizes) < 2:
        return ""
    rows = []
    for tolerance in dict.fromkeys(case["tolerance"] for case in generated):
        at_tolerance = [case for case in generated if case["tolerance"] == tolerance]
        if len(at_tolerance) == len(sizes):
            for tool in (one, two, "delatin"):
                rows.append([f"{tolerance:g} m", tool, *per_sample_cells(at_tolerance, tool)])
    head = ["tolerance", "tool", *(f"{width} x {height}" for width, height in sizes), "largest : smallest"]
    return "\n## Time per sample\n\n" + PER_SAMPLE + "\n" + table(head, rows)


def faults(judged):
    found = [f"{count(judged[key])} {text}" for key, text in (
        ("folded", "folded"), ("uncovered", "samples uncovered"), ("non_manifold_edges", "non-manifold edges"),
        ("t_junctions", "T-junctions")) if judged[key]]
    return ", ".join(found) or "none"


def count_row(case, tool, mine):
    judged = verdict(case, tool)
    if judged is None:
        return ["", tool, why_missing(case, tool)] + [""] * 7
    run = case["results"][tool][0]
    own = own_seconds(run)
    return ["", tool, count(judged["triangles"]), metres(judged["max_error"]), metres(judged["rmse"]),
            f"{mine['max_error'] / judged['max_error']:.3f}", f"{mine['rmse'] / judged['rmse']:.3f}", faults(judged),
            f"{seconds(run['wall'])} ({seconds(own)})", f"{run['peak_memory'] / 2**20:.0f}"]


def count_table(cases, ours, two):
    head = ["tolerance", "tool", "triangles", "max error", "RMSE", "max error, tinsmith : peer",
            "RMSE, tinsmith : peer", "faults", "wall (own) s", "MiB"]
    rows = []
    for case in cases:
        mine = verdict(case, ours)
        peers = [tool.name for tool in tools.COUNT_DRIVEN if tool.name in case["results"]]
        if mine and any(why_missing(case, tool) != NOT_RUN for tool in peers):
            runs = whole(case, two)
            rows.append([f"{case['tolerance']:g} m", "tinsmith", count(mine["triangles"]), metres(mine["max_error"]),
                         metres(mine["rmse"]), "", "", faults(mine),
                         seconds(median(runs, "wall")), f"{median(runs, 'peak_memory') / 2**20:.0f}"])
            rows += [count_row(case, tool, mine) for tool in peers]
    return table(head, rows) if rows else ""


def same_bytes(cases, one, two):
    """Whether all runs of a case, with one thread and with two, wrote the same bytes."""
    sums = [{run["sha256"] for tool in (one, two) for run in whole(case, tool)} for case in cases]
    return sum(len(s) == 1 for s in sums), sum(len(s) > 0 for s in sums)


def cross_checks(cases):
    """The largest relative difference between the judge and delatin measured by its own peer script."""
    differences = []
    for case in cases:
        second = whole(case, tools.CROSS_CHECK.name)
        judged = verdict(case, "delatin")
        if second and judged:
            own = second[0]["own"]
            differences += [abs(own[key] - judged[key]) / (judged[key] or 1) for key in ("max_error", "rmse")]
    return differences


def geometric_mean(values):
    return math.exp(statistics.fmean(map(math.log, values)))


def best_peer_ratios(case, ours, key):
    """tinsmith's error over the least error of any count-driven peer that gave a result."""
    errors = [v[key] for v in (verdict(case, tool.name) for tool in tools.COUNT_DRIVEN) if v and v[key]]
    mine = verdict(case, ours)
    return mine[key] / min(errors) if mine and errors else None


def time_against(cases, two, leader):
    """The wall time of an effort over that of the first one, case by case."""
    return [median(whole(case, two), "wall") / median(whole(case, leader), "wall")
            for case in cases if whole(case, two) and whole(case, leader)]


def at_equal_count(cases, ours):
    lines = []
    for key, name in (("max_error", "Max error"), ("rmse", "RMSE")):
        ratios = [r for r in (best_peer_ratios(case, ours, key) for case in cases) if r]
        if ratios:
            lines.append(f"{name} over that of the best count-driven peer at equal triangles: geometric mean "
                         f"{geometric_mean(ratios):.3f}, worst {max(ratios):.3f}.")
    return lines


def summary(cases, one, two, leader):
    """`leader` is the first effort with two threads: the count-driven peers ran at its triangles."""
    lines = []
    parts = [p for p in (fraction(case, one) for case in cases) if p]
    if parts:
        lines.append(f"Triangles as a fraction of delatin's at the same certified tolerance: geometric mean "
                     f"{geometric_mean(parts):.3f}, worst {max(parts):.3f}, of {len(parts)} cases.")
    if two == leader:
        lines += at_equal_count(cases, one)
    elif times := time_against(cases, two, leader):
        lines.append(f"Wall time over that of the first effort (2 threads): geometric mean "
                     f"{geometric_mean(times):.2f}, worst {max(times):.2f}.")
    equal, total = same_bytes(cases, one, two)
    lines.append(f"The same bytes from 1 and 2 threads and from every repetition: {equal} of {total} cases.")
    differences = cross_checks(cases)
    if differences:
        lines.append(f"The judge against a second measurement (delatin's meshes, by other code in another language): "
                     f"max error and RMSE differ by at most {max(differences):.1e} of their value, "
                     f"{len(differences)} comparisons.")
    return "".join(f"- {line}\n" for line in lines)


def made_by(document, all_tools):
    load = document["load"]
    commands = [[tool.name, f"`{tool.command}`"] for tool in all_tools]
    machine = ", ".join(f"{key} {value}" for key, value in document["machine"].items())
    versions = ", ".join(f"{key} {value}" for key, value in document["versions"].items())
    return (f"Made by `{document['command'].strip()}`.\n\n"
            f"Machine: {machine}. Load before the runs: median {load['median']:.1f}, highest {load['highest']:.1f} "
            f"(0 is a quiet machine). Runs of peers were ended after {document['limit_seconds']:g} s.\n\n"
            f"Versions: {versions}.\n\n" + table(["tool", "command"], commands))


def input_section(cases, one, two, leader):
    name = cases[0]["input"]
    width, height = cases[0]["size"]
    text = f"\n## {name}: {width} x {height} samples\n\n"
    if cases[0]["has_voids"]:
        text += VOIDS.format(name=name) + "\n"
    text += quality_table(cases, one) + "\n" + time_table(cases, one, two)
    count_driven = count_table(cases, one, two) if two == leader else ""
    return text + ("\nAt equal triangles:\n\n" + count_driven if count_driven else "")


def markdown(document, efforts):
    """RESULTS.md: for each effort a summary, the time per sample and, for each input, the three tables."""
    all_tools = tools.tinsmith_tools(efforts) + tools.TOLERANCE_DRIVEN + tools.COUNT_DRIVEN
    text = "# Measured beside the peers\n\n" + OTHERS + "\n" + made_by(document, all_tools) + "\n" + KNOWN
    cases = document["cases"]
    leader = tools.tinsmith_tools(efforts)[1].name
    for effort in efforts:
        one, two = (tool.name for tool in tools.tinsmith_tools([effort]))
        text += f"\n# Effort {effort}\n\n" if len(efforts) > 1 else "\n"
        text += summary(cases, one, two, leader) + per_sample_section(cases, one, two)
        for name in dict.fromkeys(case["input"] for case in cases):
            text += input_section([case for case in cases if case["input"] == name], one, two, leader)
    return text
