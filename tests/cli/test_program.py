"""Laws that the whole program obeys, from files to answers: resume, symmetry, failure, what locking rotation costs.

usage: test_program.py PROGRAM
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
CAMPAIGN = """
name: small
structure: {diameter: 7.4 m, measuring_points: 8}
ice:
  temperature: {uniform: [-12 degC, -2 degC]}
  thickness_mixes: [{probability: 1, classes: {0.3 m: 1}}]
  concentration: 10 %
current: {speed: 1 m/s, direction: {rose: {0 deg: 1, 180 deg: 1}}}
exposure: {window: 60 s}
precision: {quantity: P90, max_realisations: 40}
seed: 3
"""
SCENE = """
structure: {diameter: 7.4 m}
ice: {temperature: -10 degC}
current: {speed: 2 m/s}
duration: 5 s
floes: [{x: -4.8 m, y: 2 m, diameter: 2.5 m, thickness: 0.5 m, vx: 2 m/s, vy: 0 m/s}]
"""
THROWN = """
structure: {diameter: 7.4 m}
ice: {temperature: -10 degC}
current: {speed: 2 m/s}
contact: {stiffness: 1 kN/m}
duration: 5 s
floes: [{x: -12 m, y: 0.1 m, diameter: 12 m, thickness: 3 m, vx: 50 m/s, vy: 0 m/s}]
"""
# In a sanitizer build: Open MPI unloads its components before leaks are counted, so that no suppression can name them.
MPI_ENVIRONMENT = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        for name, text in (("small.yaml", CAMPAIGN), ("scene.yaml", SCENE), ("thrown.yaml", THROWN)):
            with open(name, "w", encoding="utf-8") as f:
                f.write(text)

    def call(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], capture_output=True, stdin=subprocess.DEVNULL, text=True, timeout=60,
                              check=False, env=MPI_ENVIRONMENT if words[0] == "run" else None)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_run_again_gives_the_same_answer(self):
        first = json.loads(self.call("run", "small.yaml", "--quiet", "--json").stdout)
        again = json.loads(self.call("run", "small.yaml", "--quiet", "--json").stdout)
        self.assertEqual(first, again)
        self.assertEqual(first, json.loads(self.call("report", "small.h5", "--json").stdout))
        self.assertEqual((first["n"], first["failed"]), (40, 0))
        fresh = json.loads(self.call("run", "small.yaml", "--quiet", "--json", "--fresh").stdout)
        self.assertEqual(first["percentiles"], fresh["percentiles"])

    def test_symmetry_of_the_rose(self):
        """Current to the north and to the south alike: points 1 and 5 (0 and 180 deg) have the same law."""
        out = json.loads(self.call("run", "small.yaml", "--quiet", "--json").stdout)
        mean = {p["point"]: p["mean_mm"] for p in out["points"]}
        self.assertGreater(mean[1], 0)
        self.assertAlmostEqual(mean[1] / mean[5], 1, delta=1e-12)

    def test_one_realisation_again(self):
        self.assertIn("hits", self.call("run", "small.yaml", "--only-id", "5").stdout)
        self.assertFalse(os.path.exists("small.journal"), "--only-id writes nothing")

    def test_law_beyond_all_range(self):
        """GSL cannot sum up such a law and would end the program; it is a refusal with a sentence."""
        law = "current.speed={gamma: {shape: 1e300, scale: 1e-300 m/s, max: 2 m/s}}"
        self.assertIn("speed", self.call("run", "small.yaml", "--quiet", "--set", law, code=2).stderr)

    def test_failed_scene(self):
        done = self.call("scene", "thrown.yaml", "--json", code=3)
        self.assertIn("a whole radius", done.stderr)
        self.assertIn("a whole radius", json.loads(done.stdout)["cause"])

    def test_locked_rotation(self):
        """A floe that cannot roll slides all the way: by the reference solutions 3 to 43 times the wear."""
        free = json.loads(self.call("scene", "scene.yaml", "--json").stdout)
        locked = json.loads(self.call("scene", "scene.yaml", "--json", "--set", "effects={rotation: off}").stdout)
        self.assertNotIn("rotation", locked["effects"])
        ratio = locked["structure"]["depth_along_contact_mm"] / free["structure"]["depth_along_contact_mm"]
        self.assertTrue(3 < ratio < 43, ratio)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
