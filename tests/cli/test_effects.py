"""`floewear plan --effects` through the real program, and what run, plan and report make of its file.

usage: test_effects.py PROGRAM SOURCE_DIR

The ledger of a campaign of seconds is made once. Every check is a law: what is stored is what is printed, shares add up, what is off both ways changes
nothing, another campaign does not take the file, and an effect is left out only where all of the conditions hold.
"""
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True
from program import PROGRAM, SOURCE, InFolder, call  # noqa: E402

try:
    import h5py
except ImportError:  # building and using the program do not need it
    h5py = None

CAMPAIGN = SOURCE / "tests/cli/commands/dense.yaml"
CORE = ["floe_contact", "friction", "rotation", "form_drag"]
CHOICES = ["water.form_drag", "contact.friction", "contact.friction", "contact.stiffness", "contact.stiffness", "contact.slip_damping_ratio",
           "ice.temperature"]


def has_key(key):
    return key in call("keys").stdout


class Made(InFolder):
    def fetch(self):
        """dense.effects.h5 of a ledger that is made once; its JSON."""
        return self.fetch_made("dense.effects.h5", "plan", CAMPAIGN, "--effects", "--effects-budget", "1s")


class Ledger(Made):
    def test_what_is_printed(self):
        out = self.fetch()
        rows = out["effects_ledger"]
        effects = [r for r in rows if r["is_effect"]]
        listed = [e["name"] for e in json.loads(call("effects", "--json").stdout)["effects"]]
        self.assertEqual([r["name"] for r in effects], listed)
        self.assertEqual([r["name"] for r in rows if not r["is_effect"]], CHOICES)
        self.assertEqual([r["name"] for r in effects if r["was_on"]], CORE)
        for r in rows:
            measured = r["not_measured"] is None
            self.assertEqual(measured, r["mean"]["change"] is not None, r)
            if measured:
                self.assertEqual(r["n_pairs"] + r["n_failed"], out["n_windows"])
                self.assertLessEqual(r["mean"]["low"], r["mean"]["change"])
                self.assertLessEqual(r["mean"]["change"], r["mean"]["high"])
        shares = [r for r in effects if r["cpu_share"] is not None]
        self.assertEqual([r["name"] for r in shares], CORE)
        cost = out["cost"]
        self.assertAlmostEqual(sum(r["evaluations_share"] for r in shares) + cost["evaluations_bare"], 1, 12)
        self.assertAlmostEqual(sum(r["cpu_share"] for r in shares) + cost["cpu_bare"], 1, delta=0.05 + 3 * cost["cpu_noise"])
        row = {r["name"]: r for r in effects}
        self.assertGreater(row["rotation"]["mean"]["low"], 0)
        self.assertIn("not asked for", row["wind"]["not_measured"])
        self.assertIn("not asked for", row["tide"]["not_measured"])
        self.assertEqual(rows[-1]["mean"]["low"], rows[-1]["mean"]["high"], "temperature is a factor")
        self.assertEqual((out["percentile"], out["confidence"]), (90, 0.95))

    @unittest.skipIf(h5py is None, "needs h5py")
    def test_what_is_stored(self):
        out = self.fetch()
        rows = out["effects_ledger"]
        with h5py.File("dense.effects.h5") as file:
            self.assertEqual(file.attrs["filetype"], "floewear effects")
            self.assertEqual(set(file), {"effects", "effects_summary"})
            for table in file.values():
                for column in table.values():
                    self.assertTrue({"units", "long_name"} <= set(column.attrs), column.name)
            stored = file["effects"]
            self.assertEqual([s.decode() for s in stored["name"]], [r["name"] for r in rows])
            for name, part in (("mean_change", "change"), ("mean_low", "low"), ("mean_high", "high")):
                self.assertEqual([None if x != x else x for x in stored[name]], [r["mean"][part] for r in rows])
            self.assertEqual(file["effects_summary/n_windows"][0], out["n_windows"])

    def test_text(self):
        self.fetch()
        done = call("plan", CAMPAIGN, "--effects", "--effects-budget", "0.1s")
        self.assertEqual(done.returncode, 0, done.stderr)
        for piece in ("rotation", "on -> off", "10 -> 0.9", "not asked for", "drift and touch", "cost shares"):
            self.assertIn(piece, done.stdout)
        self.assertNotRegex(done.stdout, r"[ x[]-0(\.0+)?[ \],]|\b(nan|inf)\b")
        self.assertIn("run, plan and report of this campaign show it", done.stderr)

    def test_same_budget_same_numbers(self):
        def numbers():
            out = json.loads(call("plan", CAMPAIGN, "--effects", "--effects-budget", "0.1s", "--json", "-q").stdout)
            out["cost"] = {k: v for k, v in out["cost"].items() if "cpu" not in k}
            out["effects_ledger"] = [{k: v for k, v in r.items() if "cpu" not in k} for r in out["effects_ledger"]]
            return out
        self.assertEqual(numbers(), numbers())

    def test_whole_windows(self):
        out = json.loads(call("plan", CAMPAIGN, "--effects", "--effects-whole", "4", "--json", "-q").stdout)
        self.assertEqual((out["n_windows"], out["way_m"]), (4, None))

    def test_stops_in_good_order(self):
        process = subprocess.Popen([PROGRAM, "plan", CAMPAIGN, "--effects"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(0.7)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (75, ""), err)
        self.assertIn("nothing is written", err)
        self.assertEqual(list(pathlib.Path(".").iterdir()), [])

    def test_refusals(self):
        self.refuse(2, "plan", CAMPAIGN, "--effects", "--effects-budget", "3 m", piece="effects-budget")
        self.refuse(2, "plan", CAMPAIGN, "--effects", "--effects-whole", "0", piece="effects-whole")
        for words in (("--effects-budget", "1s"), ("--effects-whole", "2"), ("--effects", "--effects-whole", "2", "--effects-budget", "1s"),
                      ("--effects", "--pilot", "2"), ("--effects", "--accuracy-from", "a.accuracy.h5")):
            self.refuse(2, "plan", CAMPAIGN, *words, piece=words[-2])  # would be passed over
        self.refuse(2, "plan", CAMPAIGN, "--effects", env={**os.environ, "OMPI_COMM_WORLD_SIZE": "2"}, piece="without mpirun")
        self.refuse(4, "plan", CAMPAIGN, "--effects", "-o", "nowhere/a", piece="nowhere")
        pathlib.Path("dense.effects.h5").write_text("mine")
        self.refuse(4, "plan", CAMPAIGN, "--effects", piece="will not replace")

    def test_full_disk(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
        self.refuse(4, "plan", CAMPAIGN, "--effects", "--effects-budget", "0.1s", "-q", piece="dense.effects.h5", preexec_fn=limit)


class Use(Made):
    def test_plan_shows_it(self):
        out = self.fetch()
        bare = json.loads(call("plan", CAMPAIGN, "--pilot", "0", "--json", "-o", "elsewhere").stdout)
        self.assertIn("Raahe", bare["effects_measured"])
        plan = json.loads(call("plan", CAMPAIGN, "--pilot", "0", "--json").stdout)
        self.assertEqual(plan["effects_ledger"], out["effects_ledger"])
        self.assertIn("this campaign", plan["effects_measured"])
        text = call("plan", CAMPAIGN, "--pilot", "0").stdout
        self.assertIn("CPU share", text)
        self.assertIn("measured on this campaign", text)

    def test_run_and_report(self):
        out = self.fetch()
        done = call("run", CAMPAIGN, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual(result["effects_ledger"], out["effects_ledger"])
        ledger = {row["row"]: row for row in result["ledger"]}
        off = [r for r in out["effects_ledger"] if r["is_effect"] and not r["was_on"] and r["not_measured"] is None]
        crush = [r for r in off if r["name"] == "crush_contact"][0] # another law of the same contact: not left out, set beside it
        off.remove(crush)
        self.assertIn("here a spring", ledger["contact law"]["shrinks_with"])
        self.assertGreaterEqual(ledger["contact law"]["amount"], abs(crush["percentile"]["change"]) * (1 - 1e-12))
        self.assertLessEqual({r["name"] for r in off}, set(ledger))
        self.assertAlmostEqual(ledger["switched-off effects"]["amount"], sum(ledger[r["name"]]["amount"] for r in off))
        for r in off:
            self.assertIn(f"effects: {{{r['name']}: on}}", ledger[r["name"]]["shrinks_with"])
            self.assertGreaterEqual(ledger[r["name"]]["amount"], abs(r["percentile"]["change"]) * (1 - 1e-12))
        # the results file alone gives the same, and without the file it is the same campaign still
        os.remove("dense.effects.h5")
        alone = json.loads(call("report", "dense.h5", "--json").stdout)
        self.assertEqual((alone["ledger"], alone["effects_ledger"]), (result["ledger"], result["effects_ledger"]))
        text = call("report", "dense.h5").stdout
        self.assertIn("effects and open choices", text)
        self.assertRegex(text, r"contact laws side by side, P90 at point \d+: spring [0-9.e-]+ mm \(this run\), crushing [0-9.e-]+ mm")
        again = json.loads(call("run", CAMPAIGN, "--json").stdout)
        self.assertIn("Raahe", again["effects_measured"])
        row = [r for r in again["ledger"] if r["row"] == "skin_drag"][0]
        self.assertIn("measured on the Raahe campaign", row["shrinks_with"])

    def test_another_campaign(self):
        self.fetch()
        done = call("run", CAMPAIGN, "--set", "precision.max_realisations=2", "--set", "contact.friction=0.2", "-o", "dense", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not used: dense.effects.h5 belongs to another campaign (contact.friction differs)", done.stderr)
        self.assertIn("Raahe", json.loads(done.stdout)["effects_measured"])
        pathlib.Path("dense.effects.h5").write_text("mine")
        done = call("run", CAMPAIGN, "--set", "precision.max_realisations=2", "-o", "dense", "--fresh")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("effects: not used", done.stderr)


class LeaveOut(Made):
    """Under a tolerance of 100 % floe contact may go: it is dear, and moves less."""

    def setUp(self):
        super().setUp()
        if not has_key("effects_tolerance"):
            self.skipTest("no key effects_tolerance")

    def names_on(self, *words):
        done = call("plan", CAMPAIGN, "--pilot", "0", "--json", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = json.loads(done.stdout)
        return {e["name"] for e in out["effects"] if e["on"]}, out["effects_choice"], out

    def test_by_tolerance(self):
        row = {r["name"]: r for r in self.fetch()["effects_ledger"] if r["is_effect"]}
        widest = {name: max(abs(row[name][of]["change"]) + (row[name][of]["high"] - row[name][of]["low"]) / 2 for of in ("mean", "percentile"))
                  for name in CORE}
        self.assertLess(widest["floe_contact"], 1)
        self.assertGreater(row["floe_contact"]["cpu_saved"], 0.1)
        for tolerance, left_out in ((0, set()), (0.01, set()), (1, {"floe_contact"})):
            on, line, out = self.names_on("--set", f"effects_tolerance={tolerance}")
            self.assertEqual(set(CORE) - on, left_out, line)
            self.assertEqual("is left out: floe_contact" in line, bool(left_out))
            reason = [e["reason"] for e in out["effects"] if e["name"] == "floe_contact"][0]
            self.assertEqual("left out" in reason, bool(left_out))
        # what costs nothing stays, however little it moves; and a user who says what is on has decided
        on, line, _ = self.names_on("--set", "effects_tolerance=1", "--set", "effects={floe_contact: on}")
        self.assertEqual(on, set(CORE))
        self.assertIn("as the campaign says", line)
        os.remove("dense.effects.h5")
        on, line, _ = self.names_on("--set", "effects_tolerance=1")
        self.assertEqual(on, set(CORE))
        self.assertIn("no dense.effects.h5", line)
        _, line, _ = self.names_on("--set", "effects_tolerance=1", "--set", "effects={floe_contact: on}")
        self.assertIn("as the campaign says", line)

    def test_run_names_it(self):
        """It stands in settings and hash: the same campaign without the file is another one, and says which key differs."""
        self.fetch()
        words = ("run", CAMPAIGN, "--set", "effects_tolerance=1", "--set", "precision.max_realisations=4")
        done = call(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("is left out: floe_contact", done.stderr)
        ledger = {row["row"]: row for row in json.loads(done.stdout)["ledger"]}
        self.assertGreater(ledger["floe_contact"]["amount"], 0)
        self.assertIn("effects: {floe_contact: on}", ledger["floe_contact"]["shrinks_with"])
        self.assertEqual(call("report", "dense.h5").returncode, 0)
        os.remove("dense.effects.h5")
        self.refuse(4, *words, piece="effects (journal: ")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
