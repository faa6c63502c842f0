#!/usr/bin/env python3
"""Writes scene.json: the piston makes Rayleigh's solitary wave (K. Guizien, E. Barthelemy, J. Hydraul. Res. 40, 2002).

The piston moves with the water's mean speed behind it, X' = c eta / (h + eta) at x = X (D. G. Goring, thesis, Caltech
1979), which has the solution X = S/2 (tanh(theta) + 1), theta = kappa (c (t - t0) - X), S = 2 a / (kappa h). Run it in
this folder.
"""

import json
import math

GRAVITY, DEPTH, HEIGHT = 9.81, 0.25, 0.05
CREST_TIME = 1.6  # s, when the crest leaves the piston; theta is about -4 at the start
END, STEP = 3.2, 0.05

KAPPA = math.sqrt(0.75 * HEIGHT / (DEPTH**2 * (DEPTH + HEIGHT)))
SPEED = math.sqrt(GRAVITY * (DEPTH + HEIGHT))
STROKE = 2 * HEIGHT / (KAPPA * DEPTH)


def displacement(time):
    """Newton's method for X."""
    x = 0.0
    for _ in range(60):
        theta = KAPPA * (SPEED * (time - CREST_TIME) - x)
        error = x - STROKE / 2 * (math.tanh(theta) + 1)
        x -= error / (1 + STROKE / 2 * KAPPA / math.cosh(theta) ** 2)
    return x


def main():
    start = displacement(0)
    times = [round(k * STEP, 6) for k in range(round(END / STEP) + 1)]
    rows = [[time, round(displacement(time) - start, 7), 0, 0] for time in times]
    parts = {
        "parameters": {"particle_spacing": DEPTH / 40, "rest_density": 1000, "viscosity": 0.001,
                       "gravity": [0, -GRAVITY]},
        "domain": {"min": [-0.3, 0], "max": [5, 0.5], "open": "+y", "free_slip": True},
        "fluid": [{"box": {"min": [0, 0], "max": [5, DEPTH]}}],
        "probes": [{"name": f"x = {x} m", "kind": "height", "position": [x, 0], "rate": 100} for x in (2, 2.75, 3.5)],
    }
    lines = ["{", '  "version": 1,', '  "title": "Solitary wave made by a piston",', '  "dimension": 2,',
             '  "method": "wcsph",']
    lines += [f'  "{key}": {json.dumps(value)},' for key, value in parts.items()]
    lines += ['  "walls": [', "    {",
              '      "name": "piston", "box": { "min": [-0.2, 0], "max": [0, 0.45] }, "no_slip": false,',
              '      "motion": {', '        "rows": [']
    lines += [f"          {json.dumps(row)}{',' if row is not rows[-1] else ''}" for row in rows]
    lines += ["        ]", "      }", "    }", "  ]", "}"]
    with open("scene.json", "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


main()
