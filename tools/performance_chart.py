#!/usr/bin/env python3
"""The chart of docs/performance.md from the CSV files in docs/performance.

    tools/performance_chart.py                         write docs/performance/speed.svg
    tools/performance_chart.py --prototype TEXT        turn the lab prototype's table into CSV, to standard output
    tools/performance_chart.py --table NAME            the tables of docs/performance.md from NAME.csv, to standard output

Each file of WEIR becomes a line per dimension (its cases box_2d and box_3d on the GPU); peers.csv, prototype-h200.csv
and targets.csv stand beside them. Needs Debian's python3-matplotlib.
"""

import argparse
import csv
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from validation_report import COLORS, svg_of  # noqa: E402

FOLDER = Path(__file__).resolve().parent.parent / "docs/performance"
CASES = {"box_2d": "2D, n about 20", "box_3d": "3D, n about 37"}
# The files of `weir bench --csv` that the chart shows.
WEIR = {"h200.csv": "Weir, H200", "h100-before-lists.csv": "Weir before lists, H100"}
# Of the prototype's line: variant (p8: packed 2D positions), workgroup, kernel, dimension, N, n, candidates | ms, rate.
LINE = re.compile(r"(\S+)\s+\d+ \w (\d)\s+(\d+)\s+([\d.]+)\s+([\d.]+) \|\s+([\d.]+)\s+([\d.]+) \|")


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def convert_prototype(path):
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["scene", "variant", "particles", "mean_neighbors", "ms_per_step", "particle_steps_per_second"])
    found = 0
    for line in Path(path).read_text().splitlines():
        match = LINE.match(line)
        if match:
            variant, dimension, count, neighbors, _, ms, rate = match.groups()
            writer.writerow([f"box_{dimension}d", variant.removesuffix("-p8"), count, neighbors, ms, f"{float(rate) * 1e6:.5g}"])
            found += 1
    return 0 if found else 2


def draw_lines(axes, rows, label_of, **style):
    lines = {}
    for row in rows:
        point = (float(row["particles"]), float(row["particle_steps_per_second"]) / 1e6)
        lines.setdefault(label_of(row), []).append(point)
    for label, points in lines.items():
        points.sort()
        axes.plot([x for x, _ in points], [y for _, y in points], label=label, **style)


def draw_panel(axes, case):
    def of_case(name):
        return [row for row in rows_of(FOLDER / name) if row["scene"] == case and row.get("backend", "gpu") == "gpu"]

    for color, (name, label) in zip(COLORS, WEIR.items()):
        draw_lines(axes, of_case(name), lambda _: label, color=color, marker="o", markersize=3, linewidth=1.6)
    draw_lines(axes, of_case("peers.csv"), lambda row: f"{row['name']}, CUDA", color="#777777", marker="s", markersize=3,
               linewidth=1)
    for variant, style in (("X8.lb", "--"), ("X8.lb.r1.f3", ":")):
        rows = [row for row in of_case("prototype-h200.csv") if row["variant"] == variant]
        draw_lines(axes, rows, lambda row: f"prototype {row['variant']}", color=COLORS[2], linestyle=style, linewidth=1)
    targets = of_case("targets.csv")
    for key, marker in (("at_least", "_"), ("goal", "*")):
        axes.plot([float(row["particles"]) for row in targets], [float(row[key]) for row in targets], marker,
                  color="#222222", markersize=8, linestyle="none", label=key.replace("_", " "))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(250, 25000)
    axes.set_xlabel("particles of fluid")
    axes.set_title(CASES[case], fontsize=9, loc="left")
    axes.legend(fontsize=6, loc="lower right")


def draw_chart():
    figure, panels = plt.subplots(1, 2, figsize=(8.8, 3.8), layout="constrained")
    for axes, case in zip(panels, CASES):
        draw_panel(axes, case)
    panels[0].set_ylabel("M particle-steps/s, whole step")
    (FOLDER / "speed.svg").write_text(svg_of(figure))
    return 0


# ---- Tables ----


def near(rows, row, **keys):
    """Those of `rows` with the scene and about the particles of `row`."""
    count = float(row["particles"])
    return [r for r in rows if r["scene"] == row["scene"] and abs(float(r["particles"]) - count) < 0.04 * count
            and all(r[key] == value for key, value in keys.items())]


def millions(rows, key="particle_steps_per_second", unit=1e6):
    return f"{float(rows[0][key]) / unit:,.0f}" if rows else ""


def print_targets(rows):
    targets = rows_of(FOLDER / "targets.csv")
    prototype = [row for path in sorted(FOLDER.glob("prototype*.csv")) for row in rows_of(path)]
    print("| case | particles | n | at least | goal | prototype `X8.lb` / `X8.lb.r1.f3` | Weir | +-% | ms per step | G pairs/s | real-time factor | bytes per particle |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for row in rows:
        target = near(targets, row)
        lists = [millions(near(prototype, row, variant=variant)) for variant in ("X8.lb", "X8.lb.r1.f3")]
        print("|", " | ".join([
            f"`{row['scene']}`", f"{int(row['particles']):,}", f"{float(row['mean_neighbors']):.1f}",
            millions(target, "at_least", 1), millions(target, "goal", 1), " / ".join(lists) if lists[0] else "",
            millions([row]), f"{50 * float(row['spread']):.1f}", f"{float(row['ms_per_step']):.3f}",
            f"{float(row['pairs_per_second']) / 1e9:.0f}", f"{float(row['real_time_factor']):.2g}", f"{float(row['bytes_per_particle']):.0f}"]), "|")


LANE_INSTRUCTIONS = 33e12  # per second, of an H100 or H200


def print_passes(rows):
    print("\n| case | pass | ms | share | lane-instructions per candidate | per pair |")
    print("|---|---|---|---|---|---|")
    for row in rows:
        passes = [part.rsplit(" ", 1) for part in row["passes"].split("; ") if part]
        whole = sum(float(ms) for _, ms in passes)
        for name, ms in passes:
            if float(ms) < 0.02 * whole:
                continue
            spent = LANE_INSTRUCTIONS * float(ms) / 1e3 / float(row["all_particles"])
            pairs = name in ("forces", "continuity", "neighbors", "density")
            each = [f"{spent / float(row[key]):.0f}" if pairs else "" for key in ("candidates", "mean_neighbors")]
            print("|", " | ".join([f"`{row['scene']}`, {int(row['particles']):,}", f"`{name}`", ms,
                                  f"{100 * float(ms) / whole:.0f} %", *each]), "|")


def print_relative(rows):
    print("\n| case | particles | n | candidates | M particle-steps/s | time per particle, of the reference's |")
    print("|---|---|---|---|---|---|")
    for row in rows:
        print("|", " | ".join([f"`{row['scene']}`", f"{int(row['particles']):,}", f"{float(row['mean_neighbors']):.1f}",
                              f"{float(row['candidates']):.0f}", millions([row]), row["relative"] or "1"]), "|")


def print_tables(name):
    rows = rows_of(FOLDER / f"{name}.csv")
    print_targets(rows)
    print_passes([row for row in rows if row["scene"] in CASES and 9e5 < float(row["particles"]) < 2e6])
    print_relative(rows)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prototype", metavar="TEXT")
    parser.add_argument("--table", metavar="NAME")
    arguments = parser.parse_args()
    if arguments.table:
        return print_tables(arguments.table)
    return convert_prototype(arguments.prototype) if arguments.prototype else draw_chart()


if __name__ == "__main__":
    sys.exit(main())
