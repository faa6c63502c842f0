"""weir bench: the table is complete and its columns belong together."""

import csv
import io
import json
import unittest

from weir_process import WeirTest

COLUMNS = """scene particles backend device search threads mean_neighbors ms_per_step particle_steps_per_second
             real_time_factor frames_per_second""".split()


class Bench(WeirTest):
    def bench(self, *arguments, **options):
        return self.weir("bench", "--backends", "cpu", "--seconds", "0.01", *arguments, **options)[0]

    def test_rows(self):
        rows = json.loads(self.bench("--counts", "100,250", "--threads", "1,2", "--json"))
        found = [(row["particles"], row["threads"], row["search"]) for row in rows]
        expected = [(n, threads, search) for n in (100, 250) for threads in (1, 2) for search in ("all_pairs", "grid")]
        self.assertEqual(found, expected)
        for row in rows:
            self.assertEqual(sorted(row), sorted(COLUMNS))
            step = row["ms_per_step"] / 1e3
            self.assertGreater(step, 0)
            self.assertAlmostEqual(row["particle_steps_per_second"] * step, row["particles"], delta=1e-3 * row["particles"])
            self.assertAlmostEqual(row["real_time_factor"] * step, 0.0008, delta=1e-6)
            self.assertAlmostEqual(row["frames_per_second"] * step, 1, delta=1e-3)

    def test_csv(self):
        rows = list(csv.DictReader(io.StringIO(self.bench("--counts", "128", "--threads", "1", "--csv"))))
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual([row["search"] for row in rows], ["all_pairs", "grid"])
        self.assertTrue(all(float(row["ms_per_step"]) > 0 for row in rows))

    def test_table(self):
        lines = self.bench("--counts", "128", "--threads", "1", "--search", "grid").splitlines()
        self.assertEqual(len(lines), 2)
        self.assertEqual(lines[1].split()[:4], ["128", "cpu", "grid", "1"])

    def test_wcsph_counts_its_fluid(self):
        for case, neighbors in (("block_2d", 19.6), ("dam_2d", 19.6), ("dam_3d", 30)):
            rows = json.loads(self.bench("--case", case, "--counts", "1000", "--threads", "1", "--json"))
            self.assertEqual(len(rows), 1)
            self.assertEqual(rows[0]["scene"], case)
            self.assertTrue(960 <= rows[0]["particles"] <= 1040, rows[0])
            self.assertTrue(0.6 * neighbors < rows[0]["mean_neighbors"] < 1.1 * neighbors, rows[0])

    def test_case_n20_has_about_twenty_neighbours(self):
        rows = json.loads(self.bench("--case", "n20", "--counts", "10000", "--threads", "1", "--json"))
        self.assertEqual([row["search"] for row in rows], ["grid"])
        self.assertTrue(18 < rows[0]["mean_neighbors"] < 22, rows[0])

    def test_scene(self):
        rows = json.loads(self.bench("--scene", self.scene_file(), "--threads", "1", "--json"))
        self.assertEqual([(row["particles"], row["scene"]) for row in rows], [(625, "A small block")])

    def test_counts_that_do_not_make_a_rectangle(self):
        rows = json.loads(self.bench("--counts", "1,7,101", "--threads", "1", "--search", "grid", "--json"))
        self.assertEqual([row["particles"] for row in rows], [1, 7, 101])

    def test_gpu_that_is_missing(self):
        self.refused("bench", "--backends", "gpu", "--counts", "100", status=1, says=("--backends gpu",),
                     environment={"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"})


if __name__ == "__main__":
    unittest.main()
