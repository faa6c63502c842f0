"""tools/validation_report.py: from what weir validate leaves to HTML, Markdown and small pictures."""

import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from weir_process import SOURCE, WeirTest

TOOL = SOURCE / "tools/validation_report.py"


class Report(WeirTest):
    def report(self, *arguments, status=0):
        done = subprocess.run(["/usr/bin/python3", "-B", TOOL, *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, timeout=200)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout, done.stderr

    def test_html_and_documents(self):
        results = self.folder / "coarse"
        self.weir("validate", "poiseuille", "kernels", "--resolution", "coarse", "--backend", "cpu", "--quiet", "--out",
                  results)
        page, docs = self.folder / "out/report.html", self.folder / "docs"
        output, _ = self.report(results, "--html", page, "--docs", docs)
        self.assertIn("2 of 2 cases and 17 of 17 gates pass", output)
        text = page.read_text()
        for part in ("Poiseuille flow from rest", "L2 error of the profile at 60 s", "at most 0.02", "pass", "<svg"):
            self.assertIn(part, text)
        self.assertNotIn("FAIL", text)
        readme = (docs / "README.md").read_text()
        self.assertIn("| [poiseuille](#poiseuille) | pass |", readme)
        pictures = sorted(docs.glob("*.svg"))
        self.assertEqual([p.name for p in pictures], ["kernels-1.svg", "poiseuille-1.svg"])
        for picture in pictures:
            self.assertIn(f"({picture.name})", readme)
            self.assertTrue(ElementTree.fromstring(picture.read_text()).tag.endswith("svg"))
            self.assertLess(picture.stat().st_size, 60000)

    def test_a_failed_gate_stays_visible(self):
        results = self.folder / "coarse"
        self.weir("validate", "kernels", "--backend", "cpu", "--quiet", "--out", results)
        path = results / "results.json"
        path.write_text(path.read_text().replace('"passed": true', '"passed": false'))
        docs = self.folder / "docs"
        output, _ = self.report(results, "--docs", docs)
        self.assertIn("0 of 1 cases and 0 of 12 gates pass", output)
        self.assertIn("| [kernels](#kernels) | **FAIL** |", (docs / "README.md").read_text())

    def test_no_results(self):
        _, errors = self.report(self.folder / "nothing", "--html", self.folder / "x.html", status=2)
        self.assertIn("no results", errors)


if __name__ == "__main__":
    unittest.main()
