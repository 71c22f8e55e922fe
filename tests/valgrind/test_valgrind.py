"""The program under valgrind: a small campaign begun, gone on with, reported; scenes; refusals. No error and no leak of ours.

usage: test_valgrind.py SOURCE_FOLDER WORK_FOLDER CMAKE GENERATOR C_COMPILER

valgrind knows no AVX-512, which -march=native may emit: a tree of its own, built here, without it. No mpirun: the program
starts MPI alone.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE, WORK, CMAKE, GENERATOR, COMPILER = (pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), *sys.argv[3:6])
FOUND = 99  # valgrind's exit code when it found something; none of the program's own
VALGRIND = ["valgrind", "--quiet", f"--error-exitcode={FOUND}", "--leak-check=full", "--keep-debuginfo=yes",
            "--num-callers=40", f"--suppressions={SOURCE}/tests/house/valgrind.supp"]
SMALL = SOURCE / "tests/cli/commands/small.yaml"


def build():
    """The tree is kept: the next run builds what has changed."""
    for words in (["-S", SOURCE, "-B", WORK, "-G", GENERATOR, f"-DCMAKE_C_COMPILER={COMPILER}",
                   "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DFLOEWEAR_NATIVE=OFF", "-DFLOEWEAR_TESTS=OFF"],
                  ["--build", WORK, "--target", "floewear"]):
        done = subprocess.run([CMAKE, *words], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)

    def call(self, *words, code=0):
        log = pathlib.Path("valgrind.log")
        done = subprocess.run([*VALGRIND, f"--log-file={log}", WORK / "floewear", *words], capture_output=True,
                              stdin=subprocess.DEVNULL, text=True, timeout=300, check=False)
        self.assertEqual((done.returncode, log.read_text(encoding="utf-8")), (code, ""), f"{words}\n{done.stderr}")
        return done.stdout

    def test_campaign(self):
        few = ["--set", "precision.max_realisations=6"]
        self.call("run", SMALL, "-o", "a", "--quiet", *few)
        first = self.call("run", SMALL, "-o", "a", "--quiet", "--json", "--set", "precision.max_realisations=12")
        self.call("run", SMALL, "-o", "a", "--quiet", "--fresh", *few)
        self.call("run", SMALL, "--only-id", "3")
        self.call("run", SMALL, "-o", "a", "--quiet", "--set", "seed=4", code=4)
        self.assertIn("percentiles", first)
        self.call("report", "a.h5")
        self.call("report", "a.h5", "--csv", "--points", "1,3", "--percentiles", "50,90")
        self.call("report", "a.h5", "--json")
        self.call("status", "a.journal")
        self.call("status", "a.journal", "--json")
        self.call("plan", SMALL, "--pilot", "2")

    def test_dense_campaign(self):
        dense = ["--set", "ice.concentration={values: [40 %, 75 %], probabilities: [0.5, 0.5]}", "--set", "exposure={window: 5 s, warm_up: 5 s}"]
        self.call("run", SMALL, "-o", "b", "--quiet", "--set", "precision.max_realisations=3", *dense)

    def test_scenes(self):
        for name in ("scene-raft", "scene-M05", "scene-M11"):
            self.call("scene", SOURCE / f"tests/cli/commands/{name}.yaml", "--trajectory", "t.h5")
        self.call("scene", SOURCE / "tests/cli/good/scene.yaml", "--json", "--set", "contact.friction=0.2")

    def test_refusals(self):
        bad = SOURCE / "tests/cli/bad"
        for name in ("campaign-key-unknown", "campaign-joint-sum", "campaign-deep", "campaign-values-sum"):
            self.call("run", bad / f"{name}.yaml", code=2)
        self.call("scene", bad / "scene-floes-overlap.yaml", code=2)
        self.call("report", SMALL, code=4)
        self.call("status", SMALL, code=4)
        self.call("run", "absent.yaml", code=4)

    def test_lists(self):
        for word in ("keys", "effects", "laws"):
            self.call(word)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
