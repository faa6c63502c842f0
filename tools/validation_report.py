#!/usr/bin/env python3
"""One report from the folders that `weir validate --out` wrote: tables of gates, plots, convergence.

    tools/validation_report.py FOLDER... --html build/validation/report.html
    tools/validation_report.py FOLDER... --docs docs/validation

Several folders (resolutions, devices) stand side by side; plots show the first one given. Needs Debian's
python3-matplotlib. Exit status: 0, or 2 if a folder holds no results.
"""

import argparse
import csv
import html
import io
import json
import math
import re
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

MOST_POINTS = 240
COLORS = ["#1f6fb4", "#d1495b", "#2a9d8f", "#edae49", "#6a4c93", "#7a7a7a"]
plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "weir", "font.family": "DejaVu Sans", "font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25,
    "legend.frameon": False, "legend.fontsize": 7, "axes.linewidth": 0.6, "path.simplify_threshold": 0.5,
})


class Results:
    """One folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.data = json.loads((self.folder / "results.json").read_text())
        self.cases = {case["name"]: case for case in self.data["cases"]}

    @property
    def label(self):
        return f"{self.data['resolution']}, {self.data['device'] or self.data['backend']}"

    def curves(self, name):
        """plot -> list of (curve, is reference, x label, y label, xs, ys), in the file's order."""
        path = self.folder / f"{name}.csv"
        plots = {}
        if not path.exists():
            return plots
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                curves = plots.setdefault(row["plot"], {})
                key = (row["curve"], row["reference"] == "1")
                x_label, y_label = axis_label(row["x name"], row["x unit"]), axis_label(row["y name"], row["y unit"])
                curve = curves.setdefault(key, (x_label, y_label, [], []))
                curve[2].append(float(row["x"]))
                curve[3].append(float(row["y"]))
        return plots


def axis_label(name, unit):
    return name if unit in ("", "1") else f"{name} [{unit}]"


def number(value, digits=4):
    return "-" if value is None else f"{value:.{digits}g}"


def limit_text(gate):
    if gate["kind"] == "reported":
        return "reported"
    if gate["kind"] == "relative":
        return f"within {100 * gate['limit']:.3g} %"
    return ("at most " if gate["kind"] == "at_most" else "at least ") + number(gate["limit"])


def verdict(gate):
    return "" if gate["kind"] == "reported" else "pass" if gate["passed"] else "**FAIL**"


def commit():
    try:
        text = subprocess.run(["git", "describe", "--always", "--dirty", "--abbrev=10"], capture_output=True, text=True,
                              check=True, cwd=Path(__file__).parent).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return text


# ---- Plots ----


def thin(xs, ys):
    stride = max(1, math.ceil(len(xs) / MOST_POINTS))
    last = len(xs) - 1
    keep = [k for k in range(len(xs)) if k % stride == 0 or k == last]
    return [xs[k] for k in keep], [ys[k] for k in keep]


def svg_of(figure):
    """The figure as small SVG text: no metadata, one decimal of a point."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    text = buffer.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S).replace("'DejaVu Sans'", "sans-serif")
    return re.sub(r' d="[^"]*"', lambda found: re.sub(r"(\.\d)\d+", r"\1", found.group()), text)


def is_scatter(xs):
    return len(xs) > 2 and any(b < a for a, b in zip(xs, xs[1:]))


def draw(plot, curves):
    figure, axes = plt.subplots(figsize=(4.4, 2.8), layout="constrained")
    names = []
    for (name, is_reference), (x_label, y_label, xs, ys) in curves.items():
        if name not in names:
            names.append(name)
        axes.set_xlabel(x_label)
        axes.set_ylabel(y_label)
        color = COLORS[names.index(name) % len(COLORS)]
        if is_scatter(xs):
            axes.plot(xs, ys, ".", markersize=1.2, color=color, rasterized=False)
            axes.set_aspect("equal")
            continue
        xs, ys = thin(xs, ys)
        if is_reference:
            points = 2 < len(xs) < 30
            style = {"marker": "o", "linestyle": "none", "markersize": 3.2} if points else {"linestyle": "--"}
            # A reference of the same name as a measured curve shares its entry in the legend.
            shared = (name, False) in curves
            axes.plot(xs, ys, color="#222222", linewidth=0.9, label=None if shared else name, zorder=3, **style)
        else:
            axes.plot(xs, ys, color=color, linewidth=1.2, label=name)
    if plot.startswith("Convergence"):
        axes.set_xscale("log")
        axes.set_yscale("log")
    values = [abs(y) for _, _, _, ys in curves.values() for y in ys if y > 0]
    if "nergy" in plot and values and max(values) > 1e3 * min(values):
        axes.set_yscale("log")
    axes.set_title(plot, fontsize=9, loc="left")
    if 0 < len(curves) <= 12 and axes.get_legend_handles_labels()[0]:
        axes.legend()
    return svg_of(figure)


def draw_convergence(name, all_results):
    """Deviation of each gate over spacing; None if there are not two resolutions."""
    points = {}
    for results in all_results:
        case = results.cases.get(name)
        if not case or not case["runs"]:
            continue
        spacing = min(run["spacing"] for run in case["runs"])
        for gate in case["gates"]:
            value = gate["value"]
            if value is None or gate["kind"] == "at_least":
                continue
            if gate["kind"] == "relative":
                value = abs(value / gate["reference"] - 1)
            if value > 0:
                points.setdefault(gate["name"], {})[spacing] = value
    points = {gate: values for gate, values in points.items() if len(values) > 1}
    if not points:
        return None
    figure, axes = plt.subplots(figsize=(4.4, 2.8), layout="constrained")
    for k, (gate, values) in enumerate(points.items()):
        xs = sorted(values)
        axes.plot(xs, [values[x] for x in xs], "o-", color=COLORS[k % len(COLORS)], linewidth=1, markersize=3,
                  label=gate)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("smallest spacing [m]")
    axes.set_ylabel("deviation")
    axes.set_title("Convergence over resolutions", fontsize=9, loc="left")
    if len(points) <= 8:
        axes.legend(fontsize=6)
    return svg_of(figure)


def plots_of(name, all_results):
    """(title, SVG text) of a case."""
    made = [(plot, draw(plot, curves)) for plot, curves in all_results[0].curves(name).items()]
    convergence = draw_convergence(name, all_results)
    return made + ([("Convergence over resolutions", convergence)] if convergence else [])


# ---- Tables ----


def names_in_order(all_results):
    names = []
    for results in all_results:
        names += [name for name in results.cases if name not in names]
    return names


def gate_rows(name, all_results):
    """Per gate: name, unit, reference, then (value, limit, verdict) per results."""
    gates = []
    for results in all_results:
        for gate in results.cases.get(name, {"gates": []})["gates"]:
            if gate["name"] not in gates:
                gates.append(gate["name"])
    for gate_name in gates:
        found = [next((g for g in r.cases.get(name, {"gates": []})["gates"] if g["name"] == gate_name), None)
                 for r in all_results]
        first = next(g for g in found if g)
        yield gate_name, first["unit"], first["reference"], found


def counted(results):
    gates = [g for case in results.cases.values() for g in case["gates"] if g["kind"] != "reported"]
    cases = results.cases.values()
    return (f"{sum(c['passed'] for c in cases)} of {len(cases)} cases and {sum(g['passed'] for g in gates)} of "
            f"{len(gates)} gates pass")


def provenance(all_results):
    lines = []
    for results in all_results:
        wall = sum(case["wall_time"] for case in results.cases.values())
        lines.append(f"{results.data['resolution']}: {counted(results)}; {results.data['device']} "
                     f"({results.data['backend']}), {results.data['date']}, {wall:.0f} s")
    return lines


def markdown_table(name, all_results):
    head = "| gate | reference |" + "".join(f" {r.data['resolution']} | gate | |" for r in all_results)
    lines = [head, "|---|---|" + "---|---|---|" * len(all_results)]
    for gate, unit, reference, found in gate_rows(name, all_results):
        unit = "" if unit == "1" else f" {unit}"
        cells = [gate, number(reference) + (unit if reference is not None else "")]
        for item in found:
            cells += [number(item["value"]) + unit, limit_text(item), verdict(item)] if item else ["", "", ""]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def write_docs(folder, all_results):
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.svg"):
        old.unlink()
    lines = ["# Validation report", "", "Written by `tools/validation_report.py` from what `weir validate` measured; "
             "cases and gates are explained in [docs/validation.md](../validation.md).", ""]
    lines += [f"- {line}" for line in provenance(all_results)] + [f"- commit {commit()}", ""]
    lines += ["| case | " + " | ".join(r.data["resolution"] for r in all_results) + " | worst gate |",
              "|---|" + "---|" * len(all_results) + "---|"]
    names = names_in_order(all_results)
    for name in names:
        cases = [r.cases.get(name) for r in all_results]
        marks = [("pass" if case["passed"] else "**FAIL**") if case else "" for case in cases]
        failed = [g["name"] for case in cases if case for g in case["gates"] if not g["passed"]]
        lines.append(f"| [{name}](#{name}) | " + " | ".join(marks) + f" | {'; '.join(dict.fromkeys(failed))} |")
    for name in names:
        case = next(r.cases[name] for r in all_results if name in r.cases)
        lines += ["", f"## {name}", "", f"**{case['title']}.** {case['summary']} Reference: {case['source']}.", ""]
        errors = [r.cases[name]["error"] for r in all_results if r.cases.get(name, {}).get("error")]
        lines += [f"A simulation broke off: {error}\n" for error in errors]
        lines += markdown_table(name, all_results) + [""]
        for k, (title, svg) in enumerate(plots_of(name, all_results)):
            file = f"{name}-{k + 1}.svg"
            (folder / file).write_text(svg)
            lines.append(f"![{title}]({file})")
    (folder / "README.md").write_text("\n".join(lines) + "\n")


STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem;color:#1c2530}
table{border-collapse:collapse;font-size:13px;margin:.6rem 0}td,th{padding:.2rem .7rem;border-bottom:1px solid #dde3ea;text-align:left}
td.n{text-align:right;font-variant-numeric:tabular-nums}.pass{color:#1a7f4b}.fail{color:#c0222f;font-weight:600}
figure{display:inline-block;margin:.3rem;vertical-align:top}svg{max-width:100%;height:auto}h2{margin-top:2.2rem}
@media(prefers-color-scheme:dark){body{background:#fff}}"""


def mark(passed):
    return f'<span class="{"pass" if passed else "fail"}">{"pass" if passed else "FAIL"}</span>'


def html_table(name, all_results):
    out = ["<table><tr><th>gate<th>reference"]
    out += [f"<th>{html.escape(r.data['resolution'])}<th>gate<th>" for r in all_results]
    for gate, unit, reference, found in gate_rows(name, all_results):
        unit = "" if unit == "1" else f" {unit}"
        out.append(f"<tr><td>{html.escape(gate)}<td class=n>{number(reference)}{unit if reference is not None else ''}")
        for item in found:
            if not item:
                out.append("<td><td><td>")
                continue
            word = "" if item["kind"] == "reported" else mark(item["passed"])
            out.append(f"<td class=n>{number(item['value'])}{unit}<td>{limit_text(item)}<td>{word}")
    return "".join(out) + "</table>"


def write_html(path, all_results):
    names = names_in_order(all_results)
    out = ["<!doctype html><html lang=en><meta charset=utf-8><title>Weir: validation</title>", f"<style>{STYLE}</style>",
           "<h1>Weir: validation</h1><ul>"]
    out += [f"<li>{html.escape(line)}" for line in provenance(all_results)] + [f"<li>commit {commit()}</ul>"]
    out.append("<table><tr><th>case" + "".join(f"<th>{html.escape(r.label)}" for r in all_results))
    for name in names:
        out.append(f"<tr><td><a href='#{name}'>{name}</a>")
        out += [f"<td>{mark(r.cases[name]['passed']) if name in r.cases else ''}" for r in all_results]
    out.append("</table>")
    for name in names:
        case = next(r.cases[name] for r in all_results if name in r.cases)
        out.append(f"<h2 id={name}>{html.escape(case['title'])}</h2><p>{html.escape(case['summary'])} "
                   f"<i>Reference: {html.escape(case['source'])}.</i>")
        for results in all_results:
            error = results.cases.get(name, {}).get("error")
            if error:
                out.append(f"<p class=fail>{html.escape(results.label)}: {html.escape(error)}")
        out.append(html_table(name, all_results))
        out += [f"<figure>{svg}</figure>" for _, svg in plots_of(name, all_results)]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(out) + "</html>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", help="what `weir validate --out` wrote")
    parser.add_argument("--html", type=Path, help="write one HTML file")
    parser.add_argument("--docs", type=Path, help="write README.md and SVG files into this folder")
    options = parser.parse_args()
    try:
        all_results = [Results(folder) for folder in options.folders]
    except (OSError, ValueError, KeyError) as error:
        print(f"validation_report.py: no results: {error}", file=sys.stderr)
        return 2
    for results in all_results:
        print(f"{results.folder}: {counted(results)}")
    if options.html:
        write_html(options.html, all_results)
        print(f"report: {options.html}")
    if options.docs:
        write_docs(options.docs, all_results)
        print(f"report: {options.docs}/README.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
