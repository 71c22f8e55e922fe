"""What a user sees of failed realisations: counts, both ends of the percentiles, a scene of its own, a run of them again.

usage: test_failures.py PROGRAM
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
# A spring that floes of 1.3 m may go through: some windows fail by "a whole radius".
SOFT = """
name: soft
structure: {diameter: 7.4 m, measuring_points: 4}
ice:
  temperature: -10 degC
  thickness_mixes: [{probability: 1, classes: {1.3 m: 1}}]
  concentration: 3 %
current: {speed: 2 m/s, direction: 0 deg}
contact: {stiffness: 60 kN/m}
exposure: {window: 600 s}
precision: {quantity: P50, max_realisations: 30, max_failed: 29}
seed: 7
"""


class Failures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        pathlib.Path("soft.yaml").write_text(SOFT, encoding="utf-8")

    def call(self, *words, code=0):
        # In a sanitizer build Open MPI leaves memory behind that no suppression can name.
        environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"} if words[0] == "run" else None
        done = subprocess.run([PROGRAM, *words], capture_output=True, stdin=subprocess.DEVNULL, text=True, timeout=300,
                              check=False, env=environment)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def failed_ids(self, done):
        return [int(line.split()[2]) for line in done.stderr.splitlines() if line.startswith("failed: id")]

    def test_counted_and_shown_at_both_ends(self):
        done = self.call("run", "soft.yaml")
        ids = self.failed_ids(done)
        self.assertTrue(1 <= len(ids) <= 10, done.stderr)
        self.assertIn("a whole radius", done.stderr)
        self.assertIn("(seed 7)", done.stderr)
        self.assertIn(f"{len(ids)} of 30 failed; counted as 0 and as infinity they give P50", done.stdout)
        report = json.loads(self.call("report", "soft.h5", "--json").stdout)
        self.assertEqual((report["n"], report["failed"]), (30, len(ids)))

    def test_too_many(self):
        done = self.call("run", "soft.yaml", "--set", "precision.max_failed=1", "--set", "contact.stiffness=10 kN/m", code=3)
        self.assertIn("more than 1 (precision.max_failed) of the first", done.stderr)

    def test_alone_and_as_a_scene(self):
        first = self.failed_ids(self.call("run", "soft.yaml"))[0]
        journal = pathlib.Path("soft.journal").read_bytes()
        done = self.call("run", "soft.yaml", "--only-id", str(first), "--json", code=3)
        record = json.loads(done.stdout)
        self.assertEqual((record["id"], record["status"], record["tries"]), (first, "FW_E_NUMERIC", 2))
        self.assertGreater(record["failed_at"], 0)
        self.assertIn(record["cause"], done.stderr)
        self.assertEqual(journal, pathlib.Path("soft.journal").read_bytes())
        name = f"soft.failed-{first}.yaml"
        self.assertIn(f"floewear scene {name}", done.stderr)
        self.assertIn("a whole radius", self.call("scene", name, code=3).stderr)
        # it is the same failure: a stiffer spring holds
        self.call("scene", name, "--set", "contact.stiffness=2000 kN/m")

    def check_scenes(self, name, text):
        pathlib.Path(name + ".yaml").write_text(text.replace("name: soft", f"name: {name}"), encoding="utf-8")
        failed = self.failed_ids(self.call("run", name + ".yaml"))
        written = []
        for one in failed[:4]:
            self.call("run", name + ".yaml", "--only-id", str(one), code=3)
            scene = f"{name}.failed-{one}.yaml"
            if os.path.exists(scene):
                self.assertIn("a whole radius", self.call("scene", scene, code=3).stderr)
                written.append(pathlib.Path(scene).read_text(encoding="utf-8"))
        self.assertTrue(len(written) >= 2, f"{name}: {len(written)} scenes of {failed}")
        return written

    def test_scenes_that_a_file_would_refuse(self):
        """A calm that a law of the wind has drawn, and a flat that has no moment since rotation is locked, are no scene as they stand."""
        calm = "wind: {speed: {values: [0 m/s, 1 m/s], probabilities: [0.99, 0.01]}}\n"
        self.assertIn("speed: 1.0000000000000001e-09 m/s", self.check_scenes("calm", SOFT + calm)[0])
        locked = "effects: [floe_contact, friction, form_drag, crush_contact]\n"
        crush = SOFT.replace("stiffness: 60 kN/m", "law: crush, pressure: 0.02 MPa")
        self.assertIn("flat: off", self.check_scenes("locked", crush + locked)[0])

    def test_failure_is_told_whatever_becomes_of_the_scene(self):
        first = self.failed_ids(self.call("run", "soft.yaml"))[0]
        done = self.call("run", "soft.yaml", "--only-id", str(first), "-o", "missing/x.h5", code=3)
        self.assertIn("no scene file: missing/x.failed-", done.stderr)
        self.assertIn(f"realisation {first} failed: finer steps too: floe", done.stderr)
        self.call("run", "soft.yaml", "--only-id", str(first), "-o", "there.h5", code=3)
        self.assertIn(f"there.failed-{first}.yaml", os.listdir())

    def test_nothing_but_failures(self):
        """Even where so many may fail there is no answer then."""
        done = self.call("run", "soft.yaml", "--set", "precision.max_failed=30", "--set", "contact.stiffness=1 kN/m", code=3)
        self.assertIn("no realisation succeeded (30 failed)", done.stderr)
        self.assertFalse(os.path.exists("soft.h5"))

    def test_a_good_one_alone_writes_nothing(self):
        failed = self.failed_ids(self.call("run", "soft.yaml"))
        good = next(i for i in range(30) if i not in failed)
        before = sorted(os.listdir())
        self.call("run", "soft.yaml", "--only-id", str(good))
        self.assertEqual(before, sorted(os.listdir()))

    def test_run_again(self):
        """The same program fails again: same journal, same answer. What had not failed is not computed again."""
        first = self.call("run", "soft.yaml", "--json")
        journal = pathlib.Path("soft.journal").read_bytes()
        again = self.call("run", "soft.yaml", "--json", "--rerun-failed")
        self.assertIn(f"going on from {30 - len(self.failed_ids(first))} of 30", again.stderr)
        self.assertEqual(json.loads(first.stdout), json.loads(again.stdout))
        self.assertEqual(journal, pathlib.Path("soft.journal").read_bytes())

    def test_limit_is_part_of_the_campaign(self):
        done = self.call("run", "soft.yaml", "--set", "exposure.max_force_evaluations=900")
        self.assertIn("more than 900 force evaluations at t = ", done.stderr)
        done = self.call("run", "soft.yaml", code=4)
        self.assertIn("exposure.max_force_evaluations (journal: 900, campaign: auto", done.stderr)
        done = self.call("run", "soft.yaml", "-o", "x", "--set", "exposure.max_force_evaluations=0", code=2)
        self.assertIn("exposure.max_force_evaluations", done.stderr)
        done = self.call("run", "soft.yaml", "-o", "y", "--set", "exposure.max_force_evaluations=1", code=3)
        self.assertIn("more than 29 (precision.max_failed)", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
