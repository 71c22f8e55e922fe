"""Every command of the program when its n-th allocation and all after it fail: exit code 5 and a sentence about memory, nothing
half done on disk, and the next call is as if nothing had been.

usage: test_starved.py STARVED_PROGRAM SOURCE_FOLDER
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SMALL = str(SOURCE / "tests/cli/commands/small.yaml")
FEW = ["--set", "precision.max_realisations=4", "--set", "exposure={window: 10 s, warm_up: 1 s}"]
# In a sanitizer build: Open MPI unloads its components before leaks are counted, so that no suppression can name them.
MPI = {"ASAN_OPTIONS": "detect_leaks=0"}


def without_clocks(text):
    return re.sub(r"[-+0-9.e]+ (CPU s|s\b)|.*cpu.*|.*CPU.*", "", text)


class Starved(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)

    def call(self, words, fails_at=None, code=0):
        more = {"FLOEWEAR_FAILS_AT": str(fails_at)} if fails_at else {}
        done = subprocess.run([PROGRAM, *words], capture_output=True, stdin=subprocess.DEVNULL, text=True, timeout=120,
                              check=False, env={**os.environ, **more, **(MPI if words[0] == "run" else {})})
        self.assertIn(done.returncode, (0, code), f"{words}, allocation {fails_at}\n{done.stderr}")
        return done

    def walk(self, *words, first=1, after_failure=lambda: None):
        """n = 1, 2, ... 8, then steps of a quarter, until the program has enough."""
        wanted = without_clocks(self.call(words).stdout)
        after_failure()
        n, n_failed = first, 0
        while True:
            done = self.call(words, n, code=5)
            if done.returncode == 0:
                self.assertEqual(without_clocks(done.stdout), wanted, f"{words}, allocation {n}")
                break
            self.assertIn("memory", done.stderr, f"{words}, allocation {n}")
            self.assertEqual([p.name for p in pathlib.Path(".").glob("*.tmp")], [], f"{words}, allocation {n}")
            after_failure()
            n_failed += 1
            n += max(1, n // 4)
        self.assertGreater(n_failed, 0)
        self.assertEqual(without_clocks(self.call(words).stdout), wanted)
        print(f"{' '.join(pathlib.Path(w).name for w in words):70.70} {n_failed} failures, the last at {n}")

    def test_lists(self):
        for word in ("keys", "effects", "laws"):
            self.call([word], fails_at=1)  # they need no memory

    def test_scene(self):
        self.walk("scene", str(SOURCE / "tests/cli/good/scene.yaml"), "--json", "--set", "contact.friction=0.2")
        gone = lambda: pathlib.Path("t.h5").unlink(missing_ok=True)
        self.walk("scene", str(SOURCE / "tests/cli/commands/scene-M05.yaml"), "--trajectory", "t.h5", after_failure=gone)

    def test_plan(self):
        self.walk("plan", SMALL, "--pilot", "2", "--set", "exposure={window: 10 s, warm_up: 1 s}")

    def test_results(self):
        self.call(["run", SMALL, "-o", "a", "--quiet", *FEW])
        before = pathlib.Path("a.h5").read_bytes()
        self.walk("status", "a.journal")
        self.walk("status", "a.journal", "--json")
        self.walk("report", "a.h5", "--points", "1,3", "--percentiles", "50,90,95")
        self.walk("report", "a.h5", "--csv")
        self.assertEqual(pathlib.Path("a.h5").read_bytes(), before)

    def test_run(self):
        gone = lambda: [p.unlink() for p in pathlib.Path(".").glob("a.*")]
        self.walk("run", SMALL, "-o", "a", "--quiet", *FEW, first=12, after_failure=gone)
        self.walk("run", SMALL, "-o", "a", "--quiet", *FEW, first=40)  # goes on from whatever the failure before left
        self.walk("run", SMALL, "--only-id", "1", *FEW, first=30)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
