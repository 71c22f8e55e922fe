"""A campaign in parts: `run --ids` and `merge` as a user meets them.

usage: test_merge.py PROGRAM SOURCE_FOLDER
"""
import json
import pathlib
import resource
import sys
import unittest

sys.dont_write_bytecode = True
from program import InFolder, call  # noqa: E402

# Loose enough that a whole run stops at its first look.
CAMPAIGN = """
name: small
structure: {diameter: 7.4 m, measuring_points: 4}
ice:
  temperature: {uniform: [-12 degC, -2 degC]}
  thickness_mixes: [{probability: 1, classes: {0.3 m: 1}}]
  concentration: 30 %
current: {speed: {uniform: [1 m/s, 1.5 m/s]}, direction: 0 deg}
exposure: {window: 20 s, warm_up: 5 s}
precision: {quantity: P90, half_width: 900 %, max_realisations: 160}
seed: 3
"""


class Merge(InFolder):
    parts = {}  # bytes of A.h5, 0:40; B.h5, 40:130; C.h5, 130:160

    def setUp(self):
        super().setUp()
        pathlib.Path("small.yaml").write_text(CAMPAIGN, encoding="utf-8")
        if not Merge.parts:
            for name, ids in (("A", "0:40"), ("B", "40:130"), ("C", "130:160")):
                self.run_part(name, ids)
                Merge.parts[name] = pathlib.Path(f"{name}.h5").read_bytes()
                pathlib.Path(f"{name}.journal").unlink()
        for name, content in Merge.parts.items():
            pathlib.Path(f"{name}.h5").write_bytes(content)

    def run_part(self, name, ids, *more):
        done = call("run", "small.yaml", "-o", name, "--ids", ids, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def merged(self, *words, code=0):
        done = call("merge", *words)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_a_part_says_what_it_is(self):
        done = self.run_part("D", "40:150")  # a whole run has its look at 100
        self.assertIn("a part: realisations 40 to 149; it does not stop by precision", done.stderr)
        self.assertIn("D.h5: realisations 40 to 149", done.stderr)
        self.assertIn("a part of the campaign: realisations 40 to 149\n", done.stdout)
        self.assertIn("a part of the campaign: realisations 40 to 149\n", call("report", "D.h5").stdout)
        out = json.loads(call("report", "D.h5", "--json").stdout)
        self.assertEqual((out["n"], out["first_id"], out["last_id"]), (110, 40, 149))
        self.assertIn("a part        of realisations 40 to 149\n", call("status", "D.journal").stdout)

    def test_a_part_goes_on(self):
        self.run_part("D", "40:60")
        done = self.run_part("D", "40:130")
        self.assertIn("D.journal: going on from 20 of 90 realisations", done.stderr)
        self.assertEqual(json.loads(call("report", "D.h5", "--json").stdout)["percentiles"],
                         json.loads(call("report", "B.h5", "--json").stdout)["percentiles"])

    def test_wrong_ranges(self):
        for ids in ("5", "5:", ":5", "5:5", "6:5", "-1:5", "0:5x", "0-5", "1e1:20"):
            self.refuse(2, "run", "small.yaml", "--ids", ids, piece="FIRST:END is wanted")
        self.refuse(2, "run", "small.yaml", "--ids", "0:161", piece="the campaign has realisations 0 to 159 (precision.max_realisations 160)")
        self.refuse(2, "run", "small.yaml", "--ids", "0:5", "--only-id", "3", piece="not both")

    def test_the_whole(self):
        done = self.merged("C.h5", "A.h5", "B.h5", "-o", "M")
        self.assertIn("B.h5: 90 realisations, 40 to 129\n", done.stderr)
        self.assertIn("M.h5: 160 realisations\n", done.stderr)
        self.assertNotIn("a part of", done.stdout)
        self.assertNotIn("missing", done.stderr)
        self.assertEqual(done.stdout, call("report", "M.h5").stdout)
        status = json.loads(call("status", "M.journal", "--json").stdout)
        self.assertEqual((status["done"], status["prefix"]), (160, 160))
        # the campaign of one place, to the look that it stops at: nothing is left to compute
        again = call("run", "small.yaml", "-o", "M")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("M.h5: the first 100 realisations", again.stderr)
        self.assertEqual(json.loads(call("merge", "C.h5", "A.h5", "B.h5", "-o", "N", "--json", "--quiet").stdout)["n"], 160)

    def test_quiet(self):
        self.assertEqual(self.merged("A.h5", "B.h5", "-o", "M", "--quiet").stderr, "")

    def test_gaps_are_told(self):
        done = self.merged("C.h5", "A.h5", "-o", "M.h5", "--quiet")
        self.assertIn("missing: realisations 40 to 129\n", done.stderr)
        head = "a part of the campaign: realisations 0 to 159, of which 90 are missing, the first gap from 40 to 129\n"
        self.assertIn(head, done.stdout)
        self.assertIn(head, call("report", "M.h5").stdout)
        done = self.merged("B.h5", "-o", "N")  # one part alone
        self.assertIn("missing: realisations 0 to 39\n", done.stderr)

    def test_goes_on_and_starts_anew(self):
        self.merged("A.h5", "-o", "M")
        done = self.merged("A.h5", "B.h5", "-o", "M")
        self.assertIn("M.journal: 40 realisations are there already", done.stderr)
        self.assertIn("M.h5: 130 realisations", done.stderr)
        done = self.merged("A.h5", "-o", "M", "--fresh")
        self.assertIn("M.h5: 40 realisations", done.stderr)

    def test_refusals(self):
        self.refuse(2, "merge", piece="which results files?")
        self.refuse(2, "merge", "A.h5", "B.h5", piece="-o OUT is wanted")
        self.refuse(2, "merge", "A.h5", "A.h5", "-o", "M", piece="realisation 0 is in both A.h5 and A.h5")
        self.refuse(2, "merge", "A.h5", "B.h5", "-o", "B.h5", piece="B.h5 is one of the files to be merged")
        self.refuse(2, "merge", "A.h5", "./B.h5", "-o", "B", piece="./B.h5 is one of the files to be merged")
        self.refuse(4, "merge", "A.h5", "none.h5", "-o", "M", piece="none.h5")
        self.refuse(4, "merge", "A.h5", "small.yaml", "-o", "M", piece="small.yaml is no whole file of floewear")
        self.refuse(4, "merge", "A.h5", "B.h5", "-o", "nowhere/M", piece="nowhere")

    def test_overlap(self):
        self.run_part("D", "39:41")
        self.refuse(2, "merge", "A.h5", "C.h5", "D.h5", "-o", "M", piece="realisation 39 is in both A.h5 and D.h5")

    def test_foreign(self):
        self.run_part("D", "40:50", "--set", "contact.stiffness=1000 kN/m")
        self.refuse(4, "merge", "A.h5", "D.h5", "-o", "M", piece="A.h5 and D.h5 are of different campaigns (contact.stiffness differs)")
        self.run_part("M", "40:50", "--seed", "4")
        self.refuse(4, "merge", "A.h5", "B.h5", "-o", "M", piece="belongs to another campaign")

    def test_damaged(self):
        content = bytearray(Merge.parts["B"])
        content[len(content) // 2] ^= 1
        pathlib.Path("B.h5").write_bytes(content)
        self.refuse(4, "merge", "A.h5", "B.h5", "-o", "M", piece="B.h5 is damaged")
        pathlib.Path("B.h5").write_bytes(Merge.parts["B"][:-100])
        self.refuse(4, "merge", "A.h5", "B.h5", "-o", "M", piece="B.h5 is no whole file of floewear")

    def test_full_disk(self):
        """A file size limit stands in for a full disk; with room again the same merge goes on."""
        whole = self.merged("A.h5", "B.h5", "-o", "W", "--quiet").stdout
        journal = pathlib.Path("W.journal").stat().st_size

        def limit(n):
            return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (n, n))

        done = call("merge", "A.h5", "B.h5", "-o", "M", "--quiet", preexec_fn=limit(journal // 2))
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("M.journal", done.stderr)
        self.assertIn("make room", done.stderr)
        self.assertFalse(pathlib.Path("M.h5").exists())
        self.assertEqual(self.merged("A.h5", "B.h5", "-o", "M", "--quiet").stdout, whole)
        self.assertFalse(pathlib.Path("M.h5.tmp").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
