"""Files that a scene names: tables of motion and meshes, found beside the scene, with messages that name file and line."""

import json
import re
import unittest

import jsonschema

from weir_process import SOURCE, WeirTest

CORNERS = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
CUBE = [
    [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
    [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
]


def stl(triangles):
    text = "solid part\n"
    for triangle in triangles:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex %g %g %g\n" % tuple(CORNERS[corner]) for corner in triangle)
        text += "endloop\nendfacet\n"
    return text + "endsolid part\n"


def obj(triangles):
    text = "".join("v %g %g %g\n" % tuple(corner) for corner in CORNERS)
    return text + "".join("f %d %d %d\n" % tuple(corner + 1 for corner in triangle) for triangle in triangles)


def tank_3d(mesh):
    return {
        "method": "wcsph",
        "dimension": 3,
        "domain": {"min": [-1, -1, -1], "max": [1, 1, 1]},
        "parameters": {"particle_spacing": 0.1},
        "fluid": [{"box": {"min": [-1, -1, -1], "max": [1, 0, 1]}}],
        "walls": [{"mesh": dict({"scale": 0.6, "translate": [-0.3, -0.8, -0.3]}, **mesh)}],
    }


def flap(motion):
    return {
        "method": "wcsph",
        "domain": {"min": [0, 0], "max": [2, 1]},
        "parameters": {"particle_spacing": 0.05},
        "fluid": [{"box": {"min": [0.2, 0], "max": [2, 0.4]}}],
        "walls": [{"name": "piston", "box": {"min": [0, 0], "max": [0.2, 0.8]}, "motion": motion}],
    }


class Manual(WeirTest):
    def test_its_examples_run(self):
        examples = re.findall(r"```json\n(.*?)```", (SOURCE / "docs/scene.md").read_text(), re.DOTALL)
        schema = json.loads((SOURCE / "docs/scene.schema.json").read_text())
        self.assertGreater(len(examples), 4)
        for example in examples:
            with self.subTest(example=example[:80]):
                jsonschema.validate(json.loads(example), schema)
                self.weir("run", self.scene_file(example), "--steps", 1, "--backend", "cpu", "--quiet")


class Meshes(WeirTest):
    def hash_of(self, mesh):
        printed, _ = self.weir("run", self.scene_file(tank_3d(mesh)), "--steps", 1, "--backend", "cpu", "--json", "--quiet")
        return json.loads(printed)["state_hash"]

    def test_files_are_read_beside_the_scene(self):
        (self.folder / "parts").mkdir()
        (self.folder / "parts/cube.obj").write_text(obj(CUBE))
        inline = self.hash_of({"vertices": CORNERS, "triangles": CUBE})
        self.assertEqual(self.hash_of({"file": "parts/cube.obj"}), inline)
        self.assertEqual(self.hash_of({"file": str(self.folder / "parts/cube.obj")}), inline)

    def test_stl_is_welded(self):
        (self.folder / "cube.stl").write_text(stl(CUBE))
        self.hash_of({"file": "cube.stl"})

    def test_bad_meshes(self):
        turned = [triangle[::-1] for triangle in CUBE]
        one_turned = [CUBE[0][::-1]] + CUBE[1:]
        cases = [
            ("hole.stl", stl(CUBE[1:]), "walls[0].mesh", "hole", "edge"),
            ("turned.stl", stl(turned), "walls[0].mesh", "inwards"),
            ("one.stl", stl(one_turned), "walls[0].mesh", "opposite normals"),
            ("flat.obj", obj(CUBE + [[0, 0, 1]]), "walls[0].mesh.triangles", "no area"),
            ("text.stl", "no mesh at all", "walls[0].mesh.file", "text.stl", "cannot be read as a mesh"),
            ("letter.doc", "Dear Sir", "walls[0].mesh.file", "letter.doc", "cannot be read"),
        ]
        for name, text, *says in cases:
            with self.subTest(name=name):
                (self.folder / name).write_text(text)
                self.scene_refused(tank_3d({"file": name}), *says)
        self.scene_refused(tank_3d({"file": "none.stl"}), "walls[0].mesh.file", "none.stl")
        self.scene_refused(tank_3d({"file": 3}), "walls[0].mesh.file", "text")


class Tables(WeirTest):
    def test_a_table_is_the_same_from_file_or_scene(self):
        (self.folder / "piston.csv").write_text("t, dx, dy, angle\n# a stroke\n0,0,0,0\n\n0.5;0.1;0;0\n1 0 0 0\n")
        hashes = []
        for motion in ({"file": "piston.csv"}, {"rows": [[0, 0, 0, 0], [0.5, 0.1, 0, 0], [1, 0, 0, 0]]}):
            path = self.scene_file(flap(motion))
            printed, _ = self.weir("run", path, "--steps", 5, "--backend", "cpu", "--json", "--quiet")
            hashes.append(json.loads(printed)["state_hash"])
        self.assertEqual(*hashes)

    def test_bad_tables(self):
        cases = [
            ("0,0,0,0\n1,0,0\n", "piston.csv:2", "columns", "4", "t, dx, dy, angle"),
            ("0,0,0,0\n1,0,zero,0\n", "piston.csv:2", "no number"),
            ("t,dx,dy,angle\n", "piston.csv", "no rows"),
            ("0,0,0,0\n1,0,0,0\n0.5,0,0,0\n", "walls[0].motion.rows[2]", "0.5", "above 1"),
            ("0,0,0,0\n1,1e9,0,0\n", "walls[0].motion.rows", "1e+09", "out of range"),
            ("0,0.1,0,0\n1,0,0,0\n", "walls[0].motion.rows[0]", "moved already"),
        ]
        for text, *says in cases:
            with self.subTest(text=text):
                (self.folder / "piston.csv").write_text(text)
                self.scene_refused(flap({"file": "piston.csv"}), *says)
        self.scene_refused(flap({"file": "none.csv"}), "walls[0].motion.file", "none.csv", "No such file")


if __name__ == "__main__":
    unittest.main()
