"""Bad scene files: one clear message with field, value and allowed range, exit status 2, no crash."""

import math
import os
import unittest

from weir_process import SANITIZED, WeirTest, parameters, scene_with


class MalformedJson(WeirTest):
    def test_syntax_error_has_line_and_column(self):
        path = self.scene_file('{\n  "version": 1,\n  "title": oops\n}\n')
        self.refused("run", path, says=(f"{path}:3:", "malformed JSON"))

    def test_column_is_that_of_the_fault(self):
        path = self.scene_file('{"version": 1, }')
        self.refused("run", path, says=(f"{path}:1:16:",))

    def test_cut_file(self):
        self.scene_refused('{"version": 1, "fluid": [', "malformed JSON")

    def test_empty_file(self):
        self.scene_refused("", ":1:0", "malformed JSON")

    def test_trailing_text(self):
        self.scene_refused('{"version": 1}\nmore', ":2:4", "end of file expected")

    def test_duplicate_key(self):
        self.scene_refused('{"version": 1,\n"version": 1}', ":2:9", "duplicate")

    def test_nan_and_infinity_are_no_json(self):
        for word in ("NaN", "Infinity", "-Infinity"):
            self.scene_refused('{"parameters": {"viscosity": %s}}' % word, "malformed JSON", ":1:")

    def test_number_too_large_for_a_double(self):
        self.scene_refused('{"parameters": {"viscosity": 1e999}}', "malformed JSON", "overflow")

    def test_not_utf8(self):
        self.scene_refused(b'{"title": "\xff\xfe"}', "malformed JSON", ":1:", "unable to decode byte 0xff")

    def test_very_deep_nesting(self):
        self.scene_refused('{"fluid": ' + "[" * 100000, "malformed JSON")
        self.scene_refused('{"fluid": ' + '{"a":' * 1000 + "1" + "}" * 1001, "fluid")

    def test_top_level_is_no_object(self):
        self.scene_refused("[1, 2]", "object")
        self.scene_refused("3", "malformed JSON")

    def test_very_long_key(self):
        self.scene_refused('{"%s": 1}' % ("k" * 5000), "unknown key")

    def test_large_file(self):
        self.scene_refused(" " * 2_000_000 + "{}", "larger than")


class UnreadableFiles(WeirTest):
    def test_missing_file(self):
        self.refused("run", self.folder / "none.json", says=("none.json", "cannot be read", "No such file"))

    def test_folder(self):
        self.refused("run", self.folder, says=("cannot be read", "Is a directory"))

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_no_permission(self):
        path = self.scene_file()
        path.chmod(0)
        self.refused("run", path, says=("cannot be read", "Permission denied"))


class WrongTypes(WeirTest):
    def test_wrong_types_of_known_keys(self):
        cases = [
            ("parameters.viscosity", dict(parameters={"viscosity": "thick"}), "thick", "a number"),
            ("parameters.viscosity", dict(parameters={"viscosity": True}), "true", "a number"),
            ("parameters.viscosity", dict(parameters={"viscosity": None}), "null", "a number"),
            ("parameters.viscosity", dict(parameters={"viscosity": [1, 2]}), "list of 2", "a number"),
            ("parameters.gravity", dict(parameters={"gravity": -9.81}), "-9.81", "a list of 2"),
            ("parameters.gravity", dict(parameters={"gravity": [1, 2, 3, 4]}), "4", "list of 2 or 3"),
            ("parameters.gravity", dict(parameters={"gravity": [1, "x"]}), "mixed", "list"),
            ("parameters.search", dict(parameters={"search": 1}), "1", "all_pairs"),
            ("parameters.search", dict(parameters={"search": "tree"}), "tree", "grid|all_pairs"),
            ("parameters", dict(parameters=3), "3", "object"),
            ("parameters", dict(parameters=[]), "list", "object"),
            ("domain", dict(domain="large"), "large", "object"),
            ("domain.min", dict(domain={"min": 3}), "3", "[x, y]"),
            ("domain.min", dict(domain={"min": [1]}), "list of 1", "[x, y]"),
            ("title", dict(title=7), "7", "text"),
            ("version", dict(version="1"), '"1"', "number"),
            ("method", dict(method=1), "1", "text"),
            ("fluid", dict(fluid=4), "4", "list"),
            ("fluid", dict(fluid=[]), "list of 0", "pieces"),
            ("fluid", dict(fluid=[1, 2]), "list of 2", "pieces"),
            ("fluid[0]", dict(fluid=["water"]), "water", "box or ball"),
            ("fluid[0]", dict(fluid=[{}]), "empty object", "box or ball"),
            ("fluid[0].box", dict(fluid=[{"box": [0, 0]}]), "list", "object"),
            ("fluid[0].ball.radius", dict(fluid=[{"ball": {"radius": "1"}}]), '"1"', "a number"),
        ]
        for path, change, value, wanted in cases:
            with self.subTest(path=path, change=change):
                self.scene_refused(dict(scene_with(), **change), f"{path}:", value, wanted)


class UnknownKeys(WeirTest):
    def test_unknown_keys_are_named(self):
        box = {"min": [-0.5, -0.5], "max": [0, 0]}
        cases = [
            ("gravity", dict(gravity=[0, 0])),
            ("parameters.viscosty", dict(parameters={"viscosty": 1})),
            ("domain.mid", dict(domain={"mid": [0, 0]})),
            ("fluid[0].box.mid", dict(fluid=[{"box": dict(box, mid=[0, 0])}])),
            ("fluid[1].colour", dict(fluid=[{"box": box}, {"colour": "red"}])),
            ("camera", dict(camera={})),
            ("camera.zoom", dict(camera={"zoom": {"deep": 1}})),
            ('"parameters.viscosity"', {"parameters.viscosity": 1}),
            ('"fluid[0]"', {"fluid[0]": {"box": box}}),
            ('""', {"": 1}),
        ]
        for path, change in cases:
            with self.subTest(path=path):
                said = self.scene_refused(dict(scene_with(), **change), path)
                self.assertRegex(said, "unknown key|no such parameter")

    def test_other_versions_are_refused_by_name(self):
        self.scene_refused(scene_with(version=2), "version", "2", "1")
        self.scene_refused(scene_with(dimension=3), "dimension", "3", "2")
        self.scene_refused(scene_with(method="pbf"), "method", "pbf", "mueller")


class OutOfRange(WeirTest):
    def test_parameters(self):
        cases = [
            ("viscosity", -1, "0 to 10000"),
            ("time_step", 0, "1e-07 to 0.1"),
            ("time_step", 10**30, "1e-07 to 0.1"),
            ("restitution", 1.5, "0 to 1"),
            ("rest_density", 0, "0.001 to 100000"),
            ("gravity", [0, -1e6], "-1000 to 1000"),
            ("particle_spacing", -0.01, "1e-05 to 10"),
        ]
        for name, value, allowed in cases:
            with self.subTest(name=name, value=value):
                shown = "%g" % (value[1] if isinstance(value, list) else value)
                self.scene_refused(
                    scene_with(parameters=parameters(**{name: value})), f"parameters.{name}:", shown, allowed
                )

    def test_support_radius_against_spacing(self):
        self.scene_refused(scene_with(parameters=parameters(support_radius=0.01)), "support_radius", "0.01", "1.1")
        self.scene_refused(scene_with(parameters=parameters(support_radius=10)), "support_radius", "10", "40")

    def test_set_refuses_what_a_file_may_not_say(self):
        path = self.scene_file()
        cases = [
            ("viscosity=nan", "viscosity", "nan", "0 to 10000"),
            ("viscosity=inf", "viscosity", "inf", "0 to 10000"),
            ("gravity=0,-inf", "gravity", "-inf", "-1000 to 1000"),
            ("viscosity=1e999", "viscosity", "inf", "0 to 10000"),
            ("viscosity=-1", "viscosity", "-1", "0 to 10000"),
            ("viscosity=thick", "viscosity", "thick", "number"),
            ("viscosity=", "viscosity", "number"),
            ("viscosity=1,2", "viscosity", "2", "one number"),
            ("gravity=1", "gravity", "1", "list of 2 or 3"),
            ("search=tree", "search", "tree", "grid|all_pairs"),
            ("viscosty=1", "viscosty", "did you mean 'viscosity'"),
            ("viscosity", "NAME=VALUE"),
            ("=1", "NAME=VALUE"),
        ]
        for text, *says in cases:
            with self.subTest(text=text):
                self.refused("run", path, "--set", text, says=("--set", *says))


class BadFluid(WeirTest):
    def box(self, low, high):
        return {"box": {"min": low, "max": high}}

    def test_outside_the_domain(self):
        self.scene_refused(scene_with(fluid=[self.box([-0.5, -0.5], [0, 0.75])]), "fluid[0]", "0.75", "-0.5 to 0.5")
        ball = {"ball": {"center": [0.4, 0], "radius": 0.2}}
        self.scene_refused(scene_with(fluid=[ball]), "fluid[0]", "0.6", "-0.5 to 0.5")

    def test_overlap(self):
        boxes = [self.box([-0.5, -0.5], [0, 0]), self.box([-0.1, -0.1], [0.3, 0.3])]
        self.scene_refused(scene_with(fluid=boxes), "fluid[0]", "fluid[1]", "overlaps")
        ball = {"ball": {"center": [0, 0], "radius": 0.2}}
        self.scene_refused(scene_with(fluid=[boxes[0], ball]), "overlaps")

    def test_turned_box(self):
        self.scene_refused(scene_with(fluid=[self.box([0, 0], [-0.5, -0.5])]), "fluid[0].box", "min", "max")

    def test_turned_domain(self):
        self.scene_refused(scene_with(domain={"min": [1, 1], "max": [-1, -1]}), "domain", "min", "max")

    def test_missing_corner(self):
        self.scene_refused(scene_with(fluid=[{"box": {"min": [0, 0]}}]), "fluid[0]", "box.max is missing")

    def test_box_and_ball_in_one_piece(self):
        piece = dict(self.box([-0.5, -0.5], [0, 0]), ball={"center": [0.2, 0.2], "radius": 0.1})
        self.scene_refused(scene_with(fluid=[piece]), "fluid[0]", "one of them")

    def test_no_fluid(self):
        self.scene_refused(scene_with(fluid=None), "fluid", "has none")
        self.scene_refused("{}", "fluid", "has none")

    def test_zero_particles(self):
        self.scene_refused(scene_with(fluid=[self.box([0, 0], [0.001, 0.001])]), "fluid[0]", "no particle", "0.02")

    def test_far_too_many_particles(self):
        tiny = parameters(particle_spacing=1e-5, support_radius=2e-5)
        self.scene_refused(scene_with(parameters=tiny), "particles", "particle_spacing", "allowed")

    @unittest.skipIf(SANITIZED, "the sanitizers reserve more address space than the limit")
    def test_more_particles_than_memory(self):
        import resource

        small = scene_with(parameters=parameters(particle_spacing=2e-4, support_radius=5e-4, time_step=1e-6))
        limit = 128 << 20

        def limit_memory():
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        self.refused(
            "run", self.scene_file(small), "--steps", 1, "--backend", "cpu", "--threads", 1,
            says=("particle_spacing",), preexec_fn=limit_memory,
        )


class Advice(WeirTest):
    def test_large_time_step_is_a_warning(self):
        path = self.scene_file(scene_with(parameters=parameters(time_step=0.05)))
        _, errors = self.weir("run", path, "--steps", 0, "--backend", "cpu", "--quiet")
        for word in ("warning", "parameters.time_step", "0.05", "largest stable step"):
            self.assertIn(word, errors)

    def test_blow_up_ends_the_run_with_step_and_hint(self):
        path = self.scene_file(scene_with(parameters=parameters(time_step=0.05)))
        dump = self.folder / "dump.csv"
        output, errors = self.weir(
            "run", path, "--steps", 1000, "--backend", "cpu", "--dump", dump, status=1
        )
        self.assertRegex(errors, r"step \d+: the fluid blew up")
        self.assertRegex(errors, r"(try|use) .*\d")
        self.assertIn("failed", output)
        self.assertRegex(errors, r"dump.csv holds the last state that was kept, of step \d+")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["dump.csv", "scene.json"])
        for row in dump.read_text().splitlines()[1:]:
            self.assertTrue(all(math.isfinite(float(cell)) for cell in row.split(",")), row)

    def test_no_advice_without_need(self):
        _, errors = self.weir("run", self.scene_file(), "--steps", 1, "--backend", "cpu", "--quiet")
        self.assertEqual(errors, "")


if __name__ == "__main__":
    unittest.main()
