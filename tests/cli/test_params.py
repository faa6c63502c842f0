"""weir params: the list, the generated documents, and the schema against every scene."""

import json
import unittest

import jsonschema
from weir_process import SOURCE, WeirTest, parameters, scene_with


class Lists(WeirTest):
    def names(self):
        """The names in the list itself, read from its source."""
        import re

        source = (SOURCE / "src/core/params.inl").read_text()
        return re.findall(r"^WEIR_(?:VECTOR|NUMBER|CHOICE)\((\w+)", source, re.MULTILINE)

    def test_every_parameter_is_everywhere(self):
        names = self.names()
        self.assertGreater(len(names), 8)
        table, _ = self.weir("params")
        markdown, _ = self.weir("params", "--markdown")
        listed = json.loads(self.weir("params", "--json")[0])
        schema = json.loads(self.weir("params", "--schema")[0])
        self.assertEqual([entry["name"] for entry in listed], names)
        self.assertEqual(list(schema["$defs"]["parameters"]["properties"]), names)
        for name in names:
            self.assertIn(f"\n{name} ", table)
            self.assertIn(f"| `{name}` |", markdown)

    def test_table_tells_what_is_live(self):
        table, _ = self.weir("params")
        self.assertRegex(table, r"\ngas_constant +m\^2/s\^2 +2000 +0 to 1e\+07 +yes +Stiffness")
        self.assertRegex(table, r"\nparticle_spacing +m +0.01 +1e-05 to 10 +no +Distance")

    def test_numbers_of_one_parameter(self):
        listed = {entry["name"]: entry for entry in json.loads(self.weir("params", "--json")[0])}
        self.assertEqual(listed["gas_constant"]["unit"], "m^2/s^2")
        self.assertEqual(listed["gas_constant"]["default"], 2000)
        self.assertEqual((listed["gas_constant"]["minimum"], listed["gas_constant"]["maximum"]), (0, 1e7))
        self.assertTrue(listed["gas_constant"]["live"])
        self.assertFalse(listed["particle_spacing"]["live"])
        self.assertEqual(listed["gravity"]["default"], [0, -9.81])
        self.assertEqual(listed["search"]["enum"], ["grid", "all_pairs"])
        self.assertEqual(listed["search"]["default"], "grid")

    def test_defaults_are_what_a_run_uses(self):
        """Setting every parameter to its listed default changes no bit."""
        listed = json.loads(self.weir("params", "--json")[0])
        given = scene_with()["parameters"]
        changes = []
        for entry in listed:
            if entry["name"] not in given:
                value = entry["default"]
                text = ",".join(map(str, value)) if isinstance(value, list) else str(value)
                changes += ["--set", f"{entry['name']}={text}"]
        path = self.scene_file()
        run = ["run", path, "--backend", "cpu", "--steps", 20, "--json", "--quiet"]
        plain, spelled = (json.loads(self.weir(*run, *extra)[0]) for extra in ([], changes))
        self.assertEqual(plain["state_hash"], spelled["state_hash"])


class Documents(WeirTest):
    def test_generated_documents_are_current(self):
        documents = (("--markdown", "parameters.md"), ("--keys", "scene_keys.md"), ("--schema", "scene.schema.json"))
        for option, name in documents:
            printed, _ = self.weir("params", option)
            self.assertEqual((SOURCE / "docs" / name).read_text(), printed, f"docs/{name} is old: run make docs")


class Schema(WeirTest):
    def setUp(self):
        super().setUp()
        self.schema = json.loads((SOURCE / "docs/scene.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(self.schema)
        self.validator = jsonschema.Draft202012Validator(self.schema)

    def test_every_scene_is_valid(self):
        scenes = sorted((SOURCE / "scenes").glob("*.json"))
        self.assertGreater(len(scenes), 0)
        for path in scenes:
            errors = [error.message for error in self.validator.iter_errors(json.loads(path.read_text()))]
            self.assertEqual(errors, [], path.name)

    def test_schema_and_program_agree(self):
        """Each of these documents is accepted by both or refused by both."""
        box = {"min": [-0.5, -0.5], "max": [0, 0]}
        ball = {"center": [0, 0], "radius": 0.2}
        cube = {"min": [-0.5, -0.5, -0.5], "max": [0.5, 0.5, 0.5]}
        cube_2d = {"min": [-0.5, -0.5], "max": [0.5, 0.5]}
        box_3d = {"min": [-0.5, -0.5, -0.5], "max": [0, 0, 0]}
        water = {"particle_spacing": 0.05}
        wall = {"min": [0.2, 0.2], "max": [0.4, 0.4]}
        rows = [[0, 0, 0, 0], [1, 0.1, 0, 0.2]]
        tap = {"center": [0.2, 0.2], "direction": [0, -1], "size": 0.1, "speed": 1}
        good = [
            scene_with(),
            scene_with(title=None, version=None, dimension=None, method=None),
            scene_with(fluid=[{"ball": ball, "velocity": [1, 0]}]),
            scene_with(parameters=parameters(gravity=[0, 0, 0], search="all_pairs", kernels="tutorial")),
            scene_with(parameters=parameters(restitution=1)),
            scene_with(method="wcsph", parameters=water),
            scene_with(method="wcsph", parameters=water, walls=[{"name": "a", "ball": ball, "no_slip": False}]),
            scene_with(method="wcsph", parameters=water, walls=[{"box": wall, "motion": {"rows": rows}}]),
            scene_with(method="wcsph", parameters=water, bodies=[{"box": wall, "density": 500, "fixed": "x"}]),
            scene_with(method="wcsph", parameters=water, emitters=[tap], drains=[wall]),
            scene_with(method="wcsph", parameters=water, probes=[{"kind": "height", "position": [0, 0]}]),
            scene_with(method="wcsph", parameters=water, domain=dict(cube_2d, periodic="x", open="+y", free_slip=True)),
            scene_with(method="wcsph", dimension=3, parameters=water, domain=cube, fluid=[{"box": box_3d}]),
        ]
        bad = [
            {},
            scene_with(version=2),
            scene_with(version="1"),
            scene_with(dimension=3),
            scene_with(method="pbf"),
            scene_with(title=1),
            scene_with(title="x" * 120),
            scene_with(colour="blue"),
            scene_with(parameters=[]),
            scene_with(parameters={}),
            scene_with(parameters={"viscosty": 1}),
            scene_with(parameters=parameters(viscosity=-1)),
            scene_with(parameters=parameters(viscosity="thick")),
            scene_with(parameters=parameters(gravity=-9.81)),
            scene_with(parameters=parameters(gravity=[1])),
            scene_with(parameters=parameters(gravity=[0, -2000])),
            scene_with(parameters=parameters(search="tree")),
            scene_with(parameters=parameters(restitution=1.01)),
            scene_with(domain={"min": [0]}),
            scene_with(domain={"mid": [0, 0]}),
            scene_with(fluid=[]),
            scene_with(fluid={}),
            scene_with(fluid=[{}]),
            scene_with(fluid=[{"velocity": [0, 0]}]),
            scene_with(fluid=[{"box": box, "ball": ball}]),
            scene_with(fluid=[{"box": {"min": [-0.5, -0.5]}}]),
            scene_with(fluid=[{"ball": {"center": [0, 0], "radius": 0}}]),
            scene_with(fluid=[{"ball": {"center": [0, 0, 0], "radius": 0.2}}]),
            scene_with(fluid=[{"box": dict(box, mid=[0, 0])}]),
            scene_with(fluid=[{"box": box, "velocity": 1}]),
            scene_with(method="wcsph", walls=[{"box": wall, "ball": ball}]),
            scene_with(method="wcsph", walls=[{"box": wall, "motion": {"rows": [[0, 0, 0]]}}]),
            scene_with(method="wcsph", bodies=[{"box": wall, "density": 500, "fixed": "z"}]),
            scene_with(method="wcsph", emitters=[dict(tap, capacity=0.5)]),
            scene_with(method="wcsph", emitters=[dict(tap, center=None)]),
            scene_with(method="wcsph", drains=[{"min": [0, 0]}]),
            scene_with(method="wcsph", probes=[{"kind": "heat"}]),
            scene_with(method="wcsph", domain={"periodic": "z"}),
            scene_with(method="wcsph", domain={"open": "y"}),
            scene_with(method="wcsph", domain={"free_slip": "yes"}),
            scene_with(method="wcsph", dimension=3),
            scene_with(method="wcsph", dimension=4),
            scene_with(method="wcsph", dimension=3, domain=cube, fluid=[{"box": box}]),
            scene_with(method="wcsph", fluid=[{"box": box_3d}]),
        ]
        for document in good:
            with self.subTest(good=document):
                self.assertEqual(list(self.validator.iter_errors(document)), [])
                self.weir("run", self.scene_file(document), "--steps", 0, "--backend", "cpu", "--quiet")
        for document in bad:
            with self.subTest(bad=document):
                self.assertFalse(self.validator.is_valid(document))
                self.scene_refused(document)


if __name__ == "__main__":
    unittest.main()
