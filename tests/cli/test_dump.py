"""--dump: all or nothing, and every digit."""

import csv
import math
import os
import resource
import stat
import struct
import unittest

from weir_process import SCENE_PARTICLES, WeirTest, parameters, scene_with


def float32(value):
    return struct.unpack("f", struct.pack("f", value))[0]


class Dump(WeirTest):
    def setUp(self):
        super().setUp()
        self.scene = self.scene_file()
        self.file = self.folder / "particles.csv"

    def dump(self, *arguments, target=None, **options):
        return self.weir("run", self.scene, "--backend", "cpu", "--quiet", "--dump", target or self.file,
                         *arguments, **options)

    def rows(self):
        with open(self.file, newline="") as file:
            return list(csv.DictReader(file))

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_lattice_of_the_start(self):
        self.dump("--steps", 0)
        rows, spacing = self.rows(), float32(0.02)
        self.assertEqual(list(rows[0]), ["id", "x", "y", "vx", "vy", "density", "pressure"])
        self.assertEqual([int(row["id"]) for row in rows], list(range(SCENE_PARTICLES)))
        for row in rows:
            column, line = int(row["id"]) % 25, int(row["id"]) // 25
            self.assertEqual(float32(float(row["x"])), float32(-0.5 + spacing * (0.5 + column)))
            self.assertEqual(float32(float(row["y"])), float32(-0.5 + spacing * (0.5 + line)))
            self.assertEqual((float(row["vx"]), float(row["vy"])), (0, 0))
        inner = rows[12 * 25 + 12]
        self.assertAlmostEqual(float(inner["density"]), 1000, delta=1)

    def test_numbers_read_back_as_the_same_floats(self):
        self.dump("--steps", 40)
        for row in self.rows():
            for key in ("x", "y", "vx", "vy", "density", "pressure"):
                value = float(row[key])
                self.assertTrue(math.isfinite(value))
                self.assertEqual("%.9g" % float32(value), row[key])

    def test_ids_stay_with_their_particles(self):
        """In 10 ms nothing moves farther than a few millimetres from where its id began."""
        self.dump("--steps", 20)
        for row in self.rows():
            column, line = int(row["id"]) % 25, int(row["id"]) // 25
            self.assertAlmostEqual(float(row["x"]), -0.49 + 0.02 * column, delta=0.02)
            self.assertAlmostEqual(float(row["y"]), -0.49 + 0.02 * line, delta=0.02)

    def test_same_run_same_file(self):
        self.dump("--steps", 30, "--threads", 1)
        first = self.file.read_bytes()
        self.dump("--steps", 30, "--threads", 3)
        self.assertEqual(self.file.read_bytes(), first)
        self.assertEqual(self.names(), ["particles.csv", "scene.json"])

    def test_full_device(self):
        _, errors = self.dump("--steps", 1, target="/dev/full", status=1)
        self.assertIn("/dev/full", errors)
        self.assertIn("No space left on device", errors)
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))
        self.assertFalse(os.path.exists("/dev/full.tmp"))

    def test_disk_that_fills_up_keeps_the_old_file(self):
        def fill_up():
            resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))

        for old in (None, "kept\n"):
            if old:
                self.file.write_text(old)
            _, errors = self.dump("--steps", 1, status=1, preexec_fn=fill_up)
            self.assertIn("cannot be written: File too large", errors)
            self.assertEqual(self.names(), ["particles.csv", "scene.json"] if old else ["scene.json"])
        self.assertEqual(self.file.read_text(), "kept\n")

    def test_targets_that_cannot_be_written(self):
        missing = self.folder / "none" / "particles.csv"
        self.assertIn("No such file", self.dump("--steps", 10**9, target=missing, status=1)[1])
        self.assertIn("Is a directory", self.dump("--steps", 10**9, target=self.folder, status=1)[1])
        long = self.folder / ("n" * 5000)
        self.assertIn("name too long", self.dump("--steps", 10**9, target=long, status=1)[1])

    def test_pipes_are_written_directly(self):
        output, _ = self.dump("--steps", 0, target="/dev/stdout")
        self.assertEqual(len(output.splitlines()), 1 + SCENE_PARTICLES)
        self.assertTrue(output.startswith("id,x,y,vx,vy,density,pressure\n0,-0.49"))

    def test_a_link_keeps_pointing_to_the_new_data(self):
        self.file.write_text("old\n")
        link = self.folder / "link.csv"
        link.symlink_to(self.file)
        self.dump("--steps", 0, target=link)
        self.assertTrue(link.is_symlink())
        self.assertEqual(len(self.rows()), SCENE_PARTICLES)

    def test_a_scene_that_is_refused_leaves_nothing(self):
        self.scene = self.scene_file(scene_with(parameters=parameters(viscosity=-1)))
        self.dump("--steps", 1, status=2)
        self.assertEqual(self.names(), ["scene.json"])


if __name__ == "__main__":
    unittest.main()
