"""weir validate: names, exit statuses, the JSON object, the files it leaves."""

import csv
import json
import unittest

import jsonschema
from weir_process import SOURCE, WeirTest

NUMBER = {"type": ["number", "null"]}
GATE = {
    "type": "object",
    "additionalProperties": False,
    "required": ["name", "kind", "unit", "value", "reference", "limit", "passed"],
    "properties": {
        "name": {"type": "string", "minLength": 1},
        "kind": {"enum": ["at_most", "at_least", "relative", "reported"]},
        "unit": {"type": "string"},
        "value": NUMBER,
        "reference": NUMBER,
        "limit": NUMBER,
        "passed": {"type": "boolean"},
    },
}
RUN = {
    "type": "object",
    "additionalProperties": False,
    "required": ["label", "spacing", "particles", "steps", "time", "wall_time"],
    "properties": {"label": {"type": "string"}, "spacing": NUMBER, "particles": {"type": "integer"},
                   "steps": {"type": "integer"}, "time": NUMBER, "wall_time": NUMBER},
}
RESULTS = {
    "type": "object",
    "additionalProperties": False,
    "required": ["version", "date", "resolution", "backend", "device", "cases"],
    "properties": {
        "version": {"type": "string"},
        "date": {"type": "string", "pattern": "^20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ$"},
        "resolution": {"enum": ["coarse", "normal", "fine"]},
        "backend": {"enum": ["auto", "cpu", "gpu"]},
        "device": {"type": "string"},
        "cases": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "required": ["name", "title", "summary", "source", "passed", "wall_time", "gates", "runs"],
                "properties": {
                    "name": {"type": "string"}, "title": {"type": "string"}, "summary": {"type": "string"},
                    "source": {"type": "string"}, "passed": {"type": "boolean"}, "error": {"type": "string"},
                    "wall_time": NUMBER, "gates": {"type": "array", "items": GATE, "minItems": 1},
                    "runs": {"type": "array", "items": RUN},
                },
            },
        },
    },
}


class Validate(WeirTest):
    def names(self):
        return [line.split()[0] for line in self.weir("validate", "--list")[0].splitlines()]

    def test_list_names_every_folder(self):
        folders = sorted(path.parent.name for path in (SOURCE / "validation").glob("*/README.md"))
        self.assertEqual(sorted(self.names()), folders)

    def test_scenes_of_cases_run_unchanged(self):
        for path in sorted((SOURCE / "validation").glob("*/scene*.json")):
            with self.subTest(path=path.parent.name):
                spacing = json.loads(path.read_text())["parameters"]["particle_spacing"]
                # Coarser, so that the start alone is quick; it must divide the same lengths.
                self.weir("run", path, "--steps", 0, "--backend", "cpu", "--quiet", "--set",
                          f"particle_spacing={2 * spacing}")

    def test_unknown_case(self):
        errors = self.refused("validate", "poiseuile", says=("unknown case 'poiseuile'", "'poiseuille'"))
        self.assertIn("--list", errors)
        self.refused("validate", "poiseuille", "xyzzy", says=("unknown case 'xyzzy'",))

    def test_bad_options(self):
        self.refused("validate", "--resolution", "huge", says=("--resolution", "coarse|normal|fine"))
        self.refused("validate", "--backend", "cuda", says=("--backend", "auto|cpu|gpu"))
        self.refused("validate", "--jsn", says=("--jsn", "'--json'"))
        self.refused("validate", "poiseuille", "--backend", "gpu", status=1, says=("--backend gpu",),
                     environment={"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"})

    def test_results(self):
        folder = self.folder / "results"
        output, _ = self.weir("validate", "poiseuille", "--resolution", "coarse", "--backend", "cpu", "--json", "--out",
                              folder)
        results = json.loads(output)
        jsonschema.validate(results, RESULTS)
        self.assertEqual([case["name"] for case in results["cases"]], ["poiseuille"])
        case = results["cases"][0]
        self.assertTrue(case["passed"])
        self.assertEqual(case["passed"], all(gate["passed"] for gate in case["gates"]))
        self.assertEqual(case["runs"][0]["time"], 60)
        self.assertGreater(case["runs"][0]["steps"], 1000)
        self.assertEqual(json.loads((folder / "results.json").read_text()), results)
        with open(folder / "poiseuille.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        measured = {row["curve"] for row in rows if row["reference"] == "0"}
        self.assertEqual(measured, {f"t = {t} s" for t in (2, 6, 10, 20, 60)})
        self.assertEqual({row["curve"] for row in rows if row["reference"] == "1"}, measured)

    def test_table(self):
        output, _ = self.weir("validate", "poiseuille", "--resolution", "coarse", "--backend", "cpu")
        self.assertRegex(output, r"(?m)^poiseuille: .*\(coarse, ")
        self.assertRegex(output, r"(?m)^  pass L2 error of the profile at 2 s +0\.00\d+ +reference - +<= 0\.02$")

    def test_folder_that_cannot_be_made(self):
        self.refused("validate", "poiseuille", "--backend", "cpu", "--resolution", "coarse", "--out",
                     self.folder / "none" / "deep", status=1, says=("--out", "No such file"))


if __name__ == "__main__":
    unittest.main()
