"""`floewear plan --levels` through the real program.

usage: test_levels.py PROGRAM SOURCE_DIR

Laws on a campaign of seconds: gains are those of correlation and cost by the formula, text says what the JSON says, a campaign and its budget give the
same windows, and options that would be passed over are refused.
"""
import json
import math
import os
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
from program import SOURCE, InFolder, call  # noqa: E402

CAMPAIGN = SOURCE / "tests/cli/commands/dense.yaml"
LEVELS = ["coarse steps", "third of window", "no floe contact", "swept strip"]


def measure(*words):
    done = call("plan", CAMPAIGN, "--levels", "--levels-budget", "0.1s", "--json", "-q", *words)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


class Levels(InFolder):
    def test_what_is_printed(self):
        out = measure()
        self.assertEqual(([r["name"] for r in out["levels"]], out["n_windows"], out["n_failed"]), (LEVELS, 128, 0))
        for r in out["levels"]:
            rho, cheap = r["correlation"], 1 / r["cost_ratio"] if r["cost_ratio"] else 0
            gain = 1 / (math.sqrt(1 - rho**2) + math.sqrt(rho**2 * cheap))**2
            self.assertAlmostEqual(r["gain"] / gain, 1, 9)
            self.assertTrue(r["gain_low"] <= r["gain"] <= r["gain_high"], r)
            self.assertIn(f"x{r['gain']:.2f} [{r['gain_low']:.2f}, {r['gain_high']:.2f}]", r["verdict"])
            self.assertFalse(r["is_promising"])  # coarse steps save too little, the others know too little of this ice
        self.assertEqual(list(pathlib.Path(".").iterdir()), [])

    def test_text(self):
        done = call("plan", CAMPAIGN, "--levels", "--levels-budget", "0.1s")
        self.assertEqual(done.returncode, 0, done.stderr)
        for piece in LEVELS + ["refused: promises x0.", "wanted more than x2", "no control variates", "none promises more than x2"]:
            self.assertIn(piece, done.stdout)
        self.assertNotRegex(done.stdout, r"\b(nan|inf)\b")

    def test_crushing_ice_has_the_spring(self):
        rows = {r["name"]: r for r in measure("--set", "contact.law=crush", "--set", "contact.pressure=1.1 MPa")["levels"]}
        self.assertGreater(rows["spring"]["cost_ratio"], 1)

    def test_same_budget_same_numbers(self):
        def numbers():
            out = measure()
            del out["cpu_s_window"], out["cpu_s_study"]
            out["levels"] = [{k: v for k, v in r.items() if k != "cost_ratio" and k != "verdict" and "gain" not in k} for r in out["levels"]]
            return out
        self.assertEqual(numbers(), numbers())

    def test_refusals(self):
        for words in (("--levels-budget", "1s"), ("--levels", "--pilot", "2"), ("--levels", "--output", "a")):
            self.refuse(2, "plan", CAMPAIGN, *words, piece=words[-2])
        self.refuse(2, "plan", CAMPAIGN, "--levels", "--effects", piece="one of them")
        self.refuse(2, "plan", CAMPAIGN, "--levels", env={**os.environ, "OMPI_COMM_WORLD_SIZE": "2"}, piece="without mpirun")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
