"""Runs the program and looks at what it says. Every run also fails the test on a crash or a sanitizer's report."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["WEIR_PROGRAM"]
SOURCE = Path(os.environ["WEIR_SOURCE"])
WITH_GPU = os.environ.get("WEIR_WITH_GPU", "0") == "1"
SANITIZED = os.environ.get("WEIR_SANITIZED", "0") == "1"

# A sanitizer's report must not look like one of the program's own exit statuses.
SANITIZER_STATUS = 99
ENVIRONMENT = dict(
    os.environ,
    XDG_CACHE_HOME="/nonexistent/cache",  # nothing of a test stays on the machine
    ASAN_OPTIONS=f"exitcode={SANITIZER_STATUS}:allocator_may_return_null=1",
    UBSAN_OPTIONS=f"exitcode={SANITIZER_STATUS}:print_stacktrace=1",
    LSAN_OPTIONS=f"exitcode={SANITIZER_STATUS}:suppressions={SOURCE / 'tests/lsan.supp'}:print_suppressions=0",
)

# 25 x 25 particles that fall in a tank.
SCENE = {
    "version": 1,
    "title": "A small block",
    "dimension": 2,
    "method": "mueller",
    "parameters": {"particle_spacing": 0.02, "support_radius": 0.05, "time_step": 0.0005},
    "domain": {"min": [-0.5, -0.5], "max": [0.5, 0.5]},
    "fluid": [{"box": {"min": [-0.5, -0.5], "max": [0, 0]}}],
}
SCENE_PARTICLES = 625


def scene_with(**changes):
    """The small scene with some top-level keys replaced; None removes a key."""
    scene = json.loads(json.dumps(SCENE))
    for key, value in changes.items():
        if value is None:
            del scene[key]
        else:
            scene[key] = value
    return scene


def parameters(**changes):
    """Parameters of the small scene with some replaced."""
    return dict(SCENE["parameters"], **changes)


class WeirTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="weir-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def weir(self, *arguments, status=0, environment=None, **popen):
        """Runs `weir ARGUMENTS`, checks the exit status and gives (standard output, standard error)."""
        done = subprocess.run(
            [PROGRAM, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=240,
            env=dict(ENVIRONMENT, **(environment or {})),
            **popen,
        )
        self.check_end(done.returncode, done.stdout, done.stderr, status, arguments)
        return done.stdout, done.stderr

    def check_end(self, found, output, errors, status, arguments):
        said = f"weir {' '.join(map(str, arguments))}\n{output[-3000:]}\n{errors[-6000:]}"
        self.assertNotIn("runtime error", errors, said)
        self.assertNotIn("Sanitizer", errors, said)
        self.assertEqual(found, status, said)

    def scene_file(self, scene=None, name="scene.json"):
        """Writes a scene, given as an object or as text, and returns the file's path."""
        path = self.folder / name
        content = scene if isinstance(scene, (str, bytes)) else json.dumps(SCENE if scene is None else scene)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def refused(self, *arguments, says=(), status=2, **options):
        """The program ends with `status`, prints nothing on standard output and one message with all of `says`."""
        output, errors = self.weir(*arguments, status=status, **options)
        self.assertEqual(output, "")
        for word in says:
            self.assertIn(word, errors)
        self.assertTrue(errors.startswith("weir"), errors)
        return errors

    def scene_refused(self, scene, *says):
        """A scene is refused with a message that names the file."""
        path = self.scene_file(scene)
        return self.refused("run", path, "--steps", 1, "--backend", "cpu", says=(str(path), *says))
