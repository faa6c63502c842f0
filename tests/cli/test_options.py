"""Commands, options, help and exit statuses."""

import unittest

from weir_process import WeirTest


class Help(WeirTest):
    def test_help_of_the_program(self):
        output, errors = self.weir("--help")
        for command in ("run", "validate", "bench", "info", "params"):
            self.assertIn(f"weir {command} ", output)
        self.assertIn("Exit status", output)
        self.assertEqual(errors, "")

    def test_help_of_each_command(self):
        options = {
            "run": ["--backend", "--threads", "--steps", "--time", "--set", "--search", "--dump", "--probe-out", "--json", "--quiet"],
            "validate": ["--backend", "--resolution", "--threads", "--out", "--json", "--list", "--quiet"],
            "bench": ["--counts", "--backends", "--search", "--json", "--csv", "--scene", "--case"],
            "info": ["--json"],
            "params": ["--markdown", "--schema", "--json"],
        }
        for command, names in options.items():
            output, _ = self.weir(command, "--help")
            for name in names:
                self.assertIn(f"  {name} ", output)

    def test_version(self):
        header = (self.source / "include/weir/weir.h").read_text()
        version = header.split('#define WEIR_VERSION "')[1].split('"')[0]
        self.assertEqual(self.weir("--version")[0], f"weir {version}\n")

    def test_no_command(self):
        _, errors = self.weir(status=2)
        self.assertIn("weir run", errors)

    @property
    def source(self):
        from weir_process import SOURCE

        return SOURCE


class UnknownOptions(WeirTest):
    def test_suggestions(self):
        cases = [
            (["rnu"], "unknown command 'rnu'", "'run'"),
            (["--versoin"], "unknown option '--versoin'", "'--version'"),
            (["run", "--serach", "grid"], "unknown option '--serach'", "'--search'"),
            (["run", "--thread", "2"], "unknown option '--thread'", "'--threads'"),
            (["run", "--step=2"], "unknown option '--step'", "'--steps'"),
            (["bench", "--count", "3"], "unknown option '--count'", "'--counts'"),
            (["params", "--markdwn"], "unknown option '--markdwn'", "'--markdown'"),
        ]
        for arguments, says, near in cases:
            with self.subTest(arguments=arguments):
                self.refused(*arguments, says=(says, f"did you mean {near}?"))

    def test_nothing_near_gives_no_suggestion(self):
        for arguments in (["run", "--xyzzy"], ["xyzzy"], ["info", "--q"]):
            self.assertNotIn("did you mean", self.refused(*arguments, says=("unknown",)))


class BadValues(WeirTest):
    def test_values_of_options(self):
        path = self.scene_file()
        cases = [
            (["--threads", "two"], ("--threads", "'two'", "0 to 1024")),
            (["--threads", "-1"], ("--threads", "'-1'", "0 to 1024")),
            (["--threads", "2000"], ("--threads", "'2000'", "0 to 1024")),
            (["--steps", "1.5"], ("--steps", "'1.5'", "whole number")),
            (["--steps", ""], ("--steps", "''", "whole number")),
            (["--steps", "99999999999999999999999"], ("--steps", "whole number")),
            (["--time", "nan"], ("--time", "'nan'", "number from")),
            (["--time", "inf"], ("--time", "'inf'", "number from")),
            (["--time", "0"], ("--time", "'0'", "number from")),
            (["--time", "1s"], ("--time", "'1s'", "number from")),
            (["--backend", "cuda"], ("--backend", "'cuda'", "auto|cpu|gpu")),
            (["--search", "tree"], ("--search", "'tree'", "grid|all_pairs")),
            (["--steps"], ("--steps", "needs a value")),
            (["--json=1"], ("--json", "takes no value")),
            (["--steps", "1", "--time", "1"], ("--steps", "--time", "one of them")),
            (["second.json"], ("unexpected argument", "second.json")),
            (["--set", "viscosity=1"] * 65, ("--set", "64 times")),
        ]
        for arguments, says in cases:
            with self.subTest(arguments=arguments[:4]):
                self.refused("run", path, *arguments, says=says)

    def test_missing_scene(self):
        self.refused("run", says=("SCENE is missing",))
        self.refused("run", "--", says=("SCENE is missing",))

    def test_exclusive_outputs(self):
        self.refused("params", "--json", "--schema", says=("--json", "one of them"))
        self.refused("bench", "--json", "--csv", says=("--json", "one of them"))

    def test_lists_of_bench(self):
        self.refused("bench", "--counts", "10,x", says=("--counts", "10,x", "1 to"))
        self.refused("bench", "--counts", "0", says=("--counts", "1 to"))
        self.refused("bench", "--counts", "10,,20", says=("--counts",))
        self.refused("bench", "--backends", "cpu,tpu", says=("--backends", "tpu", "gpu"))
        self.refused("bench", "--search", "tree", says=("--search", "tree", "grid"))
        self.refused("bench", "--scene", "x.json", "--counts", "10", says=("--scene", "--counts"))

    def test_options_may_use_an_equals_sign_and_two_dashes_end_them(self):
        self.scene_file(name="--odd.json")
        output, _ = self.weir("run", "--steps=1", "--backend=cpu", "--", "--odd.json", cwd=self.folder)
        self.assertIn("--odd.json", output)


if __name__ == "__main__":
    unittest.main()
