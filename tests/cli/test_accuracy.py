"""`floewear accuracy` through the real program, and what run, plan and report make of its file.

usage: test_accuracy.py PROGRAM SOURCE_DIR

The study of a campaign of seconds is made once (some seconds). Every check is a law: what is stored is what is printed, the choice is
one of the rows and within the wanted accuracy, a run with it says so and has another hash, another campaign does not take it.
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


class Made(InFolder):
    def fetch(self):
        """dense.accuracy.h5 of a study that is made once; its JSON."""
        return self.fetch_made("dense.accuracy.h5", "accuracy", CAMPAIGN, "--cpu-budget", "6s")


class Study(Made):
    def test_what_is_printed(self):
        out = self.fetch()
        rows = out["work_precision"]
        reference = [r for r in rows if r["is_reference"]]
        self.assertEqual([r["depth"]["error"] for r in reference], [0])
        self.assertLess(out["reference"]["hit_error"], 1e-4)
        chosen = [r for r in rows if r["is_chosen"]]
        self.assertEqual(len(chosen), 1)
        self.assertIn("hermite", chosen[0]["method"])
        self.assertTrue(out["choice"]["is_within"])
        self.assertLessEqual(out["choice"]["error"], out["accuracy"])
        self.assertIn(f"numerics.tolerance={chosen[0]['level']:.6g}", out["choice"]["sets"])
        for method in ("euler, naive", "euler, hermite", "verlet, hermite", "rk4, hermite"):
            self.assertGreaterEqual(len([r for r in rows if r["method"].endswith(method)]), 2)
        for r in rows + out["domain"]:
            self.assertGreater(r["force_evaluations"], 0)
            self.assertGreater(r["cpu_s"], 0)
        self.assertEqual({r["group"] for r in out["domain"]}, {"ring", "strip width", "downstream", "warm-up", "window"})
        errors = [r["error"] for r in out["percentile_error"]]
        self.assertGreater(errors[0], errors[-1])

    @unittest.skipIf(h5py is None, "needs h5py")
    def test_what_is_stored(self):
        out = self.fetch()
        with h5py.File("dense.accuracy.h5") as file:
            self.assertEqual(file.attrs["filetype"], "floewear accuracy")
            self.assertEqual(file.attrs["name"], "dense")
            self.assertEqual(set(file), {"work_precision", "domain", "percentile_error", "budget_cpu", "choice", "summary", "accuracy"})
            for table in file.values():
                for column in table.values():
                    self.assertTrue({"units", "long_name"} <= set(column.attrs), column.name)
            stored = file["work_precision"]
            self.assertEqual(list(stored["level"]), [r["level"] for r in out["work_precision"]])
            self.assertEqual(list(stored["coupled_error"]), [r["coupled"]["error"] for r in out["work_precision"]])
            self.assertEqual([s.decode() for s in file["choice/set"]], out["choice"]["sets"])
            self.assertEqual([s.decode() for s in file["accuracy/row"]],
                             ["discretisation", "ring", "strip width", "downstream", "warm-up"])

    def test_text(self):
        self.fetch()
        done = call("accuracy", "--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("--quick", done.stdout)

    def test_stops_in_good_order(self):
        process = subprocess.Popen([PROGRAM, "accuracy", CAMPAIGN], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(0.7)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (75, ""), err)
        self.assertIn("nothing is written", err)
        self.assertEqual(list(pathlib.Path(".").iterdir()), [])
        self.refuse(75, "accuracy", CAMPAIGN, "--time-budget", "0.3 s", piece="time budget")

    def test_refusals(self):
        self.refuse(2, "accuracy", piece="which campaign file")
        self.refuse(2, "accuracy", CAMPAIGN, "--set", "ice", piece="KEY=VALUE")
        self.refuse(2, "accuracy", CAMPAIGN, "--set", "exposure.windw=1s", piece="window")
        self.refuse(2, "accuracy", CAMPAIGN, "--time-budget", "3 m", piece="time-budget")
        self.refuse(2, "accuracy", CAMPAIGN, env={**os.environ, "OMPI_COMM_WORLD_SIZE": "2"}, piece="without mpirun")
        self.refuse(4, "accuracy", CAMPAIGN, "-o", "nowhere/a", piece="nowhere")
        pathlib.Path("dense.accuracy.h5").write_text("mine")
        self.refuse(4, "accuracy", CAMPAIGN, piece="will not replace")

    def test_full_disk(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
        self.refuse(4, "accuracy", CAMPAIGN, "--quiet", "--cpu-budget", "1 s", piece="dense.accuracy.h5", preexec_fn=limit)


class Use(Made):
    def test_run_plan_report(self):
        sets = self.fetch()["choice"]["sets"]
        done = call("plan", CAMPAIGN, "--pilot", "0", "--json")
        self.assertIn("chosen by dense.accuracy.h5", json.loads(done.stdout)["numerics"])
        tolerance = float([s for s in sets if "tolerance" in s][0].split("=")[1])
        values = {line["name"]: line["value"] for line in json.loads(done.stdout)["accuracy"]}
        self.assertEqual(values["tolerance"], tolerance)

        done = call("run", CAMPAIGN, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("numerics: chosen by dense.accuracy.h5: " + " ".join(sets), done.stderr)
        ledger = {row["row"]: row for row in json.loads(done.stdout)["ledger"]}
        self.assertLessEqual({"sampling", "discretisation", "window, domain and warm-up", "ring", "strip width", "downstream",
                              "warm-up"}, set(ledger))
        self.assertIn("measured on this campaign", ledger["discretisation"]["shrinks_with"])
        self.assertGreater(ledger["discretisation"]["cost_to_halve_cpu_s"], 0)
        parts = [ledger[name]["amount"] or 0 for name in ("ring", "strip width", "downstream", "warm-up")]
        self.assertAlmostEqual(ledger["window, domain and warm-up"]["amount"], sum(parts))

        # the results file alone gives the same ledger, and the same command goes on without a word
        os.remove("dense.accuracy.h5")
        alone = {row["row"]: row for row in json.loads(call("report", "dense.h5", "--json").stdout)["ledger"]}
        self.assertEqual(alone, ledger)
        # without the file it is another campaign: the differing keys are named
        self.refuse(4, "run", CAMPAIGN, piece="numerics.tolerance (journal: ")
        self.fetch()
        self.assertEqual(call("run", CAMPAIGN, "--quiet").returncode, 0)

    def test_without_a_file(self):
        done = call("run", CAMPAIGN, "--set", "precision.max_realisations=2", "--json")
        self.assertIn("numerics: built in for accuracy 1 % (no dense.accuracy.h5", done.stderr)
        ledger = {row["row"]: row for row in json.loads(done.stdout)["ledger"]}
        self.assertIn("measured on the Raahe campaign", ledger["discretisation"]["shrinks_with"])
        self.assertGreater(ledger["discretisation"]["amount"], 0)

    def test_another_campaign(self):
        self.fetch()
        other = ("run", CAMPAIGN, "--set", "precision.max_realisations=2", "--set", "contact.friction=0.2", "-o", "dense")
        done = call(*other)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not used: dense.accuracy.h5 belongs to another campaign (contact.friction differs)", done.stderr)
        self.refuse(4, *other, "--accuracy-from", "dense.accuracy.h5", piece="contact.friction differs")
        self.refuse(4, "run", CAMPAIGN, "--accuracy-from", "absent.h5", piece="absent.h5")
        self.refuse(2, "run", CAMPAIGN, "--accuracy-from", "dense.accuracy.h5", "--set", "numerics.order=3", piece="its own numerics")

    def test_numerics_of_the_file(self):
        """Keys like any other: checked, and part of what names a campaign."""
        done = call("run", CAMPAIGN, "--set", "precision.max_realisations=2", "--set", "numerics.tolerance=1e-3")
        self.assertIn("numerics: as the campaign says", done.stderr)
        self.refuse(4, "run", CAMPAIGN, "--set", "precision.max_realisations=2", piece="numerics.tolerance (journal: 0.001")
        self.refuse(2, "run", CAMPAIGN, "-o", "x", "--set", "numerics.order=5", piece="numerics.order")
        self.refuse(2, "run", CAMPAIGN, "-o", "x", "--set", "numerics.order=2.5", piece="2, 3 or 4")
        # what --set said stands in the results file: a report reads the campaign that was run
        done = call("run", CAMPAIGN, "-o", "ring", "--set", "precision.max_realisations=2", "--set", "ring.arcs=72", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(call("report", "ring.h5").returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
