#!/usr/bin/env python3
"""Random scenes of `wcsph`, far from what anybody would tune: does any blow up?

    tools/stress.py [--scenes N] [--seed S] [--time T] [--particles N] [--backend auto|cpu|gpu] [--weir FILE] [--jobs N]
    tools/stress.py --compare STEPS ...

Pools, columns and drops in tanks near and far from the origin, periodic or open; bodies from foam to lead, some two particles
thin; paddles, hills, jets and drains; all kernels, supports and equations of state. A scene that `weir run` refuses (exit status 2) is
drawn anew. Scenes and what they ended with lie in build/stress; equal seeds draw equal scenes. Exit status 1 if a scene failed.
--compare runs each for so many steps on the CPU and on the GPU instead; a scene fails where a particle's velocities differ by more
than 0.01 of the speed of sound. (Places may differ by more: shifting begins at a threshold.)
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Draw:
    """What one scene is drawn from: random numbers, and its domain."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.dimension = self.random.choice([2, 2, 3])
        self.size = [self.number(0.5, 6), self.number(0.5, 3), self.number(0.3, 1.5)][: self.dimension]
        self.low = [self.random.choice([0, 0, -1.7, 50, -900]) for _ in self.size]

    def number(self, low, high):
        return round(self.random.uniform(low, high), 4)

    def chance(self, share):
        return self.random.random() < share

    def one(self, *values):
        return self.random.choice(values)

    def at(self, *shares):
        """A point by its shares of the domain's sides."""
        return [round(low + share * side, 4) for low, side, share in zip(self.low, self.size, shares)]

    def box(self, low, high):
        return {"box": {"min": low, "max": high}}

    def around(self, center, halves):
        return self.box(
            [round(c - h, 4) for c, h in zip(center, halves)], [round(c + h, 4) for c, h in zip(center, halves)]
        )


def parameters(draw, depth, particles):
    volume = depth * math.prod(draw.size)
    spacing = round((volume / particles) ** (1 / draw.dimension), 5)
    chosen = {"particle_spacing": spacing, "support_radius": round(spacing * draw.one(2.1, 2.5, 3, 3.5, 4), 6)}
    for share, name, values in (
        (0.3, "kernel", ["cubic", "quintic"]),
        (0.3, "equation_of_state", ["tait"]),
        (0.3, "artificial_viscosity", [0, 0.01, 0.1, 0.3]),
        (0.3, "viscosity", [0.001, 0.1, 1, 20]),
        (0.2, "shifting", [0, 0.5, 1]),
        (0.2, "density_diffusion", [0, 0.05]),
        (0.1, "tension_control", ["on"]),
        (0.1, "rest_density", [1.2, 13600]),
        (0.1, "gravity", [[draw.number(-9, 9) for _ in draw.size]]),
    ):
        if draw.chance(share):
            chosen[name] = draw.random.choice(values)
    return chosen


def fluid(draw, depth):
    if draw.chance(0.4):
        pieces = [draw.box(draw.at(0, 0, 0), draw.at(1, depth, 1))]
    else:
        width = draw.number(0.2, 0.45)
        pieces = [draw.box(draw.at(0, 0, 0), draw.at(width, draw.number(0.5, 0.95), 1))]
        if draw.chance(0.5):
            pieces.append(draw.box(draw.at(width, 0, 0), draw.at(1, 0.5 * depth, 1)))
    if draw.chance(0.3):
        drop = {"ball": {"center": draw.at(0.7, 0.8, 0.5), "radius": round(0.1 * min(draw.size), 4)}}
        drop["velocity"] = [draw.number(-3, 3), draw.number(-8, 0), 0][: draw.dimension]
        pieces.append(drop)
    return pieces


def polygon(draw, center, radius):
    corners = draw.one(3, 5, 8)
    angles = [0.3 + 2 * math.pi * k / corners for k in range(corners)]
    return [[round(center[0] + radius * math.cos(a), 4), round(center[1] + radius * math.sin(a), 4)] for a in angles]


def tetrahedron(center, half):
    signs = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    corners = [[round(c + half * s, 4) for c, s in zip(center, sign)] for sign in signs]
    return {"vertices": corners, "triangles": [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]}


def body(draw, number, spacing):
    length = draw.number(0.05, 0.15) * min(draw.size)
    center = draw.at(0.52 + 0.12 * (number % 4), 0.65 + 0.17 * (number // 4), 0.5)
    shape = draw.one("ball", "box", "plate", "polygon")
    if shape == "ball":
        drawn = {"ball": {"center": center, "radius": round(length / 2, 4)}}
    elif shape == "box":
        drawn = draw.around(center, [length / 2] * draw.dimension)
    elif shape == "plate":
        drawn = draw.around(center, [0.8 * length, spacing, length])
    elif draw.dimension == 2:
        drawn = {"polygon": polygon(draw, center, 0.6 * length)}
    else:
        drawn = {"mesh": tetrahedron(center, length / 2)}
    drawn |= {"name": f"body {number}", "density": draw.one(1, 20, 50, 300, 700, 1500, 7800, 20000)}
    if draw.chance(0.3):
        drawn["velocity"] = [draw.number(-2, 2), draw.number(-6, 0), 0][: draw.dimension]
    if draw.chance(0.3):
        spin = [draw.number(-20, 20) for _ in range(3)]
        drawn["angular_velocity"] = spin[0] if draw.dimension == 2 else spin
    if draw.chance(0.15):
        drawn["fixed"] = draw.one("x", "y", "xy")
    return drawn


def wall(draw):
    """A hill, or something that moves."""
    if draw.chance(0.4):
        if draw.dimension == 2:
            hill = {"polygon": [draw.at(0.6, 0), draw.at(0.9, 0), draw.at(0.8, draw.number(0.1, 0.35))]}
        else:
            ends = {"from": draw.at(0.75, 0.15, 0.05), "to": draw.at(0.75, 0.15, 0.95)}
            hill = {"cylinder": ends | {"radius": round(0.1 * min(draw.size), 4)}}
        return hill | {"name": "hill", "no_slip": draw.chance(0.5)}
    turn = draw.number(-4, 4)
    angle = draw.number(0.3, 1.2)
    motion = draw.one(
        {"amplitude": [round(0.08 * side, 3) for side in draw.size[:2]] + [0] * (draw.dimension - 2), "period": draw.number(0.3, 3)},
        {"angle": angle if draw.dimension == 2 else [0, 0, angle], "period": draw.number(0.5, 3)},
        {"angular_velocity": turn if draw.dimension == 2 else [0, 0, turn]},
    )
    return draw.box(draw.at(0.62, 0.12, 0.3), draw.at(0.7, 0.55, 0.7)) | {"name": "paddle", "motion": motion}


def make_scene(seed, particles):
    draw = Draw(seed)
    depth = draw.number(0.2, 0.55)
    chosen = parameters(draw, depth, particles)
    scene = {
        "version": 1,
        "title": f"Random scene {seed}",
        "dimension": draw.dimension,
        "method": "wcsph",
        "parameters": chosen,
        "domain": {"min": draw.low, "max": draw.at(1, 1, 1), "free_slip": draw.chance(0.3)},
        "fluid": fluid(draw, depth),
        "bodies": [body(draw, n, chosen["particle_spacing"]) for n in range(draw.one(0, 1, 3, 8))],
        "walls": [wall(draw)] if draw.chance(0.6) else [],
    }
    if draw.chance(0.35):
        direction = [draw.number(-1, 1), draw.number(-1, -0.2), draw.number(-0.5, 0.5)][: draw.dimension]
        nozzle = {"center": draw.at(0.45, 0.9, 0.5), "size": round(0.08 * min(draw.size), 4), "speed": draw.number(0.5, 15)}
        scene["emitters"] = [nozzle | {"direction": direction}]
        scene["drains"] = [{"min": draw.at(0.9, 0, 0), "max": draw.at(1, 0.1, 1)}]
    if draw.chance(0.3):
        scene["domain"]["periodic"] = "x" if draw.dimension == 2 else draw.one("x", "z", "xz")
    elif draw.chance(0.3):
        scene["domain"]["open"] = draw.one("+y", "+x +y", "-y", "-x +x")
    return scene


def run_weir(file, given, *options):
    """The exit status, and what it said."""
    command = [given.weir, "run", str(file), "--threads", "1", "--json", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    file.with_suffix(".out").write_text(done.stdout + done.stderr)
    message = done.stderr.replace("\r", "\n").strip().split("\n")[-1]
    return done.returncode, message if done.returncode else json.loads(done.stdout)


def largest_difference(one, other):
    """Of the velocities in two dumps, m/s; infinite where a particle is fluid in one of them alone."""
    most = 0.0
    with open(one, encoding="ascii") as first, open(other, encoding="ascii") as second:
        for a, b in zip(csv.DictReader(first), csv.DictReader(second), strict=True):
            if a["id"] != b["id"] or a["group"] != b["group"]:
                return math.inf
            most = max([most] + [abs(float(a[v]) - float(b[v])) for v in ("vx", "vy", "vz") if v in a])
    return most


def compare_backends(file, given):
    dumps = [file.with_suffix(f".{backend}.csv") for backend in ("cpu", "gpu")]
    for backend, dump in zip(("cpu", "gpu"), dumps):
        status, result = run_weir(file, given, "--backend", backend, "--steps", str(given.compare), "--dump", str(dump))
        if status:
            return status, result
    result["difference"] = largest_difference(*dumps) / result["sound_speed"]
    return (1, f"velocities differ by {result['difference']:.3g} c0") if result["difference"] > 0.01 else (0, result)


def run_scene(file, seed, given):
    """Draws until the program takes it."""
    for attempt in range(100):
        file.write_text(json.dumps(make_scene(f"{seed}.{attempt}", given.particles), indent=1) + "\n")
        if given.compare:
            status, result = compare_backends(file, given)
        else:
            status, result = run_weir(file, given, "--backend", given.backend, "--time", str(given.time))
        if status != 2:
            break
    return status, result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=100, help="how many; 100")
    parser.add_argument("--seed", default="1", help="which; 1")
    parser.add_argument("--time", type=float, default=1, help="simulated seconds of each; 1")
    parser.add_argument("--particles", type=int, default=4000, help="of fluid, about; 4000")
    parser.add_argument("--backend", default="auto", help="auto, cpu or gpu; auto")
    parser.add_argument("--compare", type=int, metavar="STEPS", help="compare the backends after so many steps")
    parser.add_argument("--weir", default=str(ROOT / "build" / "weir"), help="the program; build/weir")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="scenes at the same time; one per core")
    given = parser.parse_args()
    folder = ROOT / "build" / "stress"
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / f"{given.seed}-{n:03}.json" for n in range(given.scenes)]
    failed, steps, worst, difference = 0, 0, 0.0, 0.0
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        results = pool.map(lambda file: run_scene(file, file.stem, given), files)
        for file, (status, result) in zip(files, results):
            if status:
                failed += 1
                print(f"{file.relative_to(ROOT)}: exit status {status}: {result}", flush=True)
            else:
                steps += result["steps"]
                worst = max(worst, result["max_density_error"] or 0)
                difference = max(difference, result.get("difference", 0))
    compared = f"velocities differ by {difference:.2g} c0" if given.compare else f"density error {100 * worst:.1f} %"
    print(f"{given.scenes} random scenes, {steps:,} steps, {compared} at most: {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
