"""weir run with wcsph: adaptive steps, the summary's clock, probes, dumps with groups and in 3D."""

import csv
import json
import unittest

from weir_process import WeirTest

# 10 x 10 particles that fall apart in a tank.
TANK = {
    "version": 1,
    "method": "wcsph",
    "parameters": {"particle_spacing": 0.02, "gravity": [0, -9.81]},
    "domain": {"min": [0, 0], "max": [0.6, 0.4], "open": "+y"},
    "fluid": [{"box": {"min": [0, 0], "max": [0.2, 0.2]}}],
    "probes": [
        {"name": "front", "kind": "front", "direction": [1, 0], "rate": 100},
        {"name": "a/b", "kind": "velocity", "position": [0.1, 0.1], "rate": 50},
        {"kind": "mass", "min": [0, 0], "max": [0.6, 0.4], "rate": 20},
        {"name": "push", "kind": "force", "target": "domain", "rate": 20},
    ],
}
TANK_3D = {
    "version": 1,
    "method": "wcsph",
    "dimension": 3,
    "parameters": {"particle_spacing": 0.05, "gravity": [0, -9.81, 0]},
    "domain": {"min": [0, 0, 0], "max": [0.4, 0.4, 0.4]},
    "fluid": [{"box": {"min": [0, 0, 0], "max": [0.2, 0.2, 0.2]}}],
}


class Wcsph(WeirTest):
    def setUp(self):
        super().setUp()
        self.scene = self.scene_file(TANK)

    def on_cpu(self, *arguments, **options):
        return self.weir("run", self.scene, "--backend", "cpu", *arguments, **options)

    def rows(self, name):
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_time_is_met_exactly_and_steps_are_counted(self):
        found = json.loads(self.on_cpu("--time", 0.05, "--json", "--quiet")[0])
        self.assertAlmostEqual(found["time"], 0.05, places=9)
        self.assertEqual(found["outcome"], "done")
        self.assertEqual(found["lost_particles"], 0)
        counted = json.loads(self.on_cpu("--steps", 37, "--json", "--quiet")[0])
        self.assertEqual(counted["steps"], 37)

    def test_clock_in_the_summary(self):
        found = json.loads(self.on_cpu("--time", 0.05, "--json", "--quiet")[0])
        self.assertAlmostEqual(found["mach_number"], found["max_speed"] / found["sound_speed"], places=4)
        self.assertTrue(0 < found["max_density_error"] < 0.03, found)
        self.assertTrue(0 < found["time_step"] < 0.01)
        self.assertEqual((found["fluid_particles"], found["drained_particles"], found["left_particles"]), (100, 0, 0))
        text = self.on_cpu("--steps", 5)[0]
        for line in (r"time step +[0-9.e-]+ s is the next", r"Mach number +0\.\d+", r"density change +[0-9.e-]+ %",
                     r"real-time factor"):
            self.assertRegex(text, line)

    def test_probes_into_a_folder(self):
        folder = self.folder / "probes"
        self.on_cpu("--time", 0.1, "--quiet", "--probe-out", folder)
        self.assertEqual(sorted(p.name for p in folder.iterdir()), ["a_b.csv", "front.csv", "probe 3.csv", "push.csv"])
        front = self.rows("probes/front.csv")
        self.assertEqual(list(front[0]), ["time / s", "front / m"])
        self.assertEqual(len(front), 11)
        for k, row in enumerate(front):
            self.assertAlmostEqual(float(row["time / s"]), k / 100, places=8)
        self.assertAlmostEqual(float(front[0]["front / m"]), 0.2, places=5)
        self.assertGreater(float(front[-1]["front / m"]), 0.21)
        velocity = self.rows("probes/a_b.csv")
        self.assertEqual(list(velocity[0]), ["time / s", "velocity x / m/s", "velocity y / m/s"])
        self.assertEqual(len(velocity), 6)
        self.assertLess(float(velocity[-1]["velocity y / m/s"]), 0)
        mass = self.rows("probes/probe 3.csv")
        for row in mass:
            self.assertAlmostEqual(float(row["mass / kg/m"]), 40, places=4)
        # The floor carries about the column's weight, 392 N per metre.
        force = [float(row["force y / N/m"]) for row in self.rows("probes/push.csv")]
        self.assertTrue(-600 < force[1] < -100, force)

    def test_probes_into_a_file_with_counted_steps(self):
        file = self.folder / "all.csv"
        self.on_cpu("--steps", 100, "--quiet", "--probe-out", file)
        rows = self.rows("all.csv")
        self.assertEqual({row["probe"] for row in rows}, {"front", "a_b", "probe 3", "push"})
        front = [float(row["time / s"]) for row in rows if row["probe"] == "front"]
        # Steps are not cut for samples: each comes at the first step's end that is not before its time.
        for k, time in enumerate(front):
            self.assertTrue(k / 100 <= time < k / 100 + 0.002, (k, time))
        self.assertGreater(len(front), 1)

    def test_probes_that_cannot_be_written(self):
        self.refused("run", self.scene, "--backend", "cpu", "--probe-out", self.folder / "no" / "deep", status=1,
                     says=("--probe-out", "No such file"))
        self.refused("run", self.scene, "--backend", "cpu", "--probe-out", self.folder / "no" / "deep.csv", status=1,
                     says=("--probe-out", "No such file"))
        bare = self.scene_file({key: value for key, value in TANK.items() if key != "probes"}, name="bare.json")
        self.refused("run", bare, "--backend", "cpu", "--probe-out", self.folder / "out", says=("has no probes",))

    def test_dump_has_groups(self):
        self.on_cpu("--steps", 10, "--quiet", "--dump", self.folder / "dump.csv")
        rows = self.rows("dump.csv")
        self.assertEqual(list(rows[0]), ["id", "x", "y", "vx", "vy", "density", "pressure", "group"])
        self.assertEqual([row["group"] for row in rows[:100]], ["0"] * 100)
        self.assertEqual({row["group"] for row in rows[100:]}, {"1"})

    def test_dump_in_3d(self):
        self.scene = self.scene_file(TANK_3D)
        self.on_cpu("--steps", 10, "--quiet", "--dump", self.folder / "dump.csv")
        rows = self.rows("dump.csv")
        self.assertEqual(list(rows[0]), ["id", "x", "y", "z", "vx", "vy", "vz", "density", "pressure", "group"])
        fluid = [row for row in rows if row["group"] == "0"]
        self.assertEqual(len(fluid), 64)
        for row in fluid:
            self.assertTrue(all(0 <= float(row[axis]) <= 0.25 for axis in "xyz"), row)
        self.assertLess(sum(float(row["vy"]) for row in fluid), 0)


if __name__ == "__main__":
    unittest.main()
