"""The program as its users meet it: commands, exit codes, JSON names that scripts rely on, bad input, full disks.

usage: test_program.py PROGRAM SOURCE_DIR
Expected numbers come from tests/reference (an independent code's solutions to 1e-10).
"""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
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
service: {life: 50 year, ice_hours_per_year: 1200 h, allowance: 20 mm}
seed: 3
"""


def call(*words, **more):
    more.setdefault("stdout", subprocess.PIPE)
    more.setdefault("timeout", 60)
    return subprocess.run([PROGRAM, *words], stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True, **more)


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        os.chdir(self.folder.name)
        with open("small.yaml", "w", encoding="utf-8") as f:
            f.write(CAMPAIGN)

    def run_small(self):
        done = call("run", "small.yaml", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done


class Commands(Program):
    def test_usage(self):
        self.assertEqual(call().returncode, 2)
        wrong = call("repport")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("report", wrong.stderr)
        self.assertEqual(call("--version").returncode, 0)
        for command in ("run", "plan", "scene", "report", "status", "keys", "effects", "laws"):
            asked = call(command, "--help")
            self.assertEqual(asked.returncode, 0, command)
            self.assertIn("Usage", asked.stdout)
            self.assertEqual(call(command, "--no-such-option").returncode, 2, command)
        for command in ("run", "plan", "scene", "report", "status"):
            self.assertEqual(call(command).returncode, 2, command + " without its file")
        later = call("accuracy", "small.yaml")
        self.assertEqual(later.returncode, 2)
        self.assertIn("not in this version", later.stderr)

    def test_reference_tables(self):
        effects = {e["name"] for e in json.loads(call("effects", "--json").stdout)["effects"]}
        self.assertEqual(effects, {"floe_contact", "friction", "rotation", "form_drag"})
        laws = {law["name"]: law for law in json.loads(call("laws", "--json").stdout)["laws"]}
        self.assertEqual(laws["bekker2011"]["exponent"], 1.121)  # eq. (1) of the source paper
        self.assertTrue(json.loads(call("keys", "--json").stdout))
        for command in ("keys", "effects", "laws"):
            self.assertGreater(len(call(command).stdout), 200)

    def test_plan(self):
        plan = json.loads(call("plan", "small.yaml", "--pilot", "3", "--json").stdout)
        self.assertEqual({e["name"]: e["on"] for e in plan["effects"]}["rotation"], True)
        self.assertEqual(plan["pilot"]["n"], 3)
        self.assertGreater(plan["predicted"]["cpu_s"], 0)
        self.assertIn("floe_contact", call("plan", "small.yaml", "--pilot", "0").stdout)
        self.assertEqual(sorted(os.listdir(".")), ["small.yaml"], "a plan writes nothing")


class Scenes(Program):
    def scene(self, row, accuracy):
        reach = 3.7 + float(row["D"]) / 2
        y0 = float(row["y0"])
        x0 = -((reach**2 - y0**2) ** 0.5 + 0.2)
        with open("scene.yaml", "w", encoding="utf-8") as f:
            f.write(f"""structure: {{diameter: 7.4 m}}
ice: {{density: 900 kg/m3, temperature: -10 degC}}
current: {{speed: 2 m/s}}
contact: {{stiffness: 2000 kN/m, damping_ratio: 1, friction: 0.1}}
water: {{density: 1025 kg/m3, form_drag: 10}}
duration: {float(row['t_release']) + 1} s
accuracy: {accuracy}
floes:
  - {{x: {x0!r} m, y: {y0} m, diameter: {row['D']} m, thickness: {row['h']} m, vx: 2 m/s, vy: 0 m/s, spin: 0 rad/s}}
""")

    def test_reference_scenes(self):
        with open(os.path.join(SOURCE, "tests/reference/single_floe.csv"), encoding="utf-8") as f:
            rows = [r for r in csv.DictReader(f) if r["outcome"] == "leaves"]
        for row in rows:
            for accuracy, target in (("1 %", 0.01), ("0.1 %", 0.001)):
                self.scene(row, accuracy)
                done = call("scene", "scene.yaml", "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                out = json.loads(done.stdout)
                s = out["structure"]
                self.assertAlmostEqual(s["depth_along_contact_mm"] / float(row["depth_total_mm"]), 1, delta=target)
                self.assertAlmostEqual(s["depth_x_wall_mm_m"] / float(row["W_mm_m"]), 1, delta=target)
                self.assertAlmostEqual(s["normal_impulse_N_s"] / float(row["J_N"]), 1, delta=target)
                arcs = out["arcs"]
                width = 2 * 3.14159265358979 * 3.7 / len(arcs["angle_deg"])
                self.assertAlmostEqual(sum(arcs["depth_mm"]) * width / s["depth_x_wall_mm_m"], 1, delta=1e-9)

    def test_names_and_text(self):
        self.scene({"D": "2.5", "h": "0.5", "y0": "2.0", "t_release": "3.7"}, "1 %")
        out = json.loads(call("scene", "scene.yaml", "--json").stdout)
        names = {
            "structure": ["normal_impulse_N_s", "peak_force_N", "contacts", "contact_time_s", "path_m", "depth_along_contact_mm", "depth_x_wall_mm_m"],
            "arcs": ["angle_deg", "path_m", "depth_mm"],
            "ledger": ["energy_relative", "energy_truncation", "momentum_relative", "max_overlap_m", "overlap_beyond_range_share"],
            "cost": ["force_evaluations", "steps", "cpu_s"],
        }
        for group, keys in names.items():
            for key in keys:
                self.assertIn(key, out[group])
        self.assertEqual(set(out["floes"][0]), {"x_m", "y_m", "vx_m_s", "vy_m_s", "spin_rad_s"})
        self.assertEqual(out["status"], "ok")
        self.assertIn("rotation", out["effects"])
        self.assertIn("deepest arc", call("scene", "scene.yaml").stdout)
        locked = json.loads(call("scene", "scene.yaml", "--json", "--set", "effects={rotation: off}").stdout)
        self.assertNotIn("rotation", locked["effects"])
        ratio = locked["structure"]["depth_along_contact_mm"] / out["structure"]["depth_along_contact_mm"]
        self.assertGreater(ratio, 3)  # a floe that cannot roll slides all the way: 3 to 43 times the wear

    def test_trajectory(self):
        self.scene({"D": "2.5", "h": "0.5", "y0": "2.0", "t_release": "3.7"}, "1 %")
        done = call("scene", "scene.yaml", "--trajectory", "t.h5", "--interval", "0.5 s")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open("t.h5", "rb") as f:
            self.assertEqual(f.read(8), b"\x89HDF\r\n\x1a\n")

    def test_failed_scene(self):
        with open("scene.yaml", "w", encoding="utf-8") as f:
            f.write("""structure: {diameter: 7.4 m}
ice: {temperature: -10 degC}
current: {speed: 2 m/s}
contact: {stiffness: 1 kN/m}
duration: 5 s
floes: [{x: -12 m, y: 0.1 m, diameter: 12 m, thickness: 3 m, vx: 50 m/s, vy: 0 m/s}]
""")
        done = call("scene", "scene.yaml", "--json")
        self.assertEqual(done.returncode, 3)
        self.assertIn("inside the structure", done.stderr)
        self.assertIn("inside the structure", json.loads(done.stdout)["cause"])


class Campaigns(Program):
    def test_run_report_status(self):
        table = self.run_small().stdout
        self.assertIn("governing", table)
        again = call("run", "small.yaml", "--json")  # nothing left to do: the same answer
        self.assertEqual(again.returncode, 0)
        report = call("report", "small.h5", "--json")
        self.assertEqual(report.returncode, 0, report.stderr)
        out = json.loads(report.stdout)
        self.assertEqual(out, json.loads(again.stdout))
        self.assertEqual((out["campaign"], out["n"], out["failed"]), ("small", 40, 0))
        row = out["percentiles"][0]
        for key in ("point", "bearing_deg", "percentile", "depth_mm", "low_mm", "high_mm", "coverage"):
            self.assertIn(key, row)
        for key in ("point", "bearing_deg", "mean_mm", "path_km", "impact_share"):
            self.assertIn(key, out["points"][0])
        for key in ("row", "amount", "shrinks_with", "cost_to_halve"):
            self.assertIn(key, out["ledger"][0])
        self.assertEqual(len(out["points"]), 8)
        some = json.loads(call("report", "small.h5", "--json", "--points", "1,6", "--percentiles", "50,90").stdout)
        self.assertEqual([(r["point"], r["percentile"]) for r in some["percentiles"]], [(1, 50), (1, 90), (6, 50), (6, 90)])
        lines = list(csv.reader(call("report", "small.h5", "--csv").stdout.splitlines()))
        self.assertTrue(all(len(line) == len(lines[0]) for line in lines))
        self.assertEqual(call("report", "small.h5", "--points", "99").returncode, 2)
        status = call("status", "small.journal")
        self.assertEqual(status.returncode, 0)
        self.assertIn("40", status.stdout)
        one = call("run", "small.yaml", "--only-id", "5")
        self.assertEqual(one.returncode, 0, one.stderr)
        self.assertIn("hits", one.stdout)

    def test_symmetry_of_the_rose(self):
        """Current to the north and to the south alike: points 1 and 5 (0 and 180 deg) have the same law."""
        self.run_small()
        out = json.loads(call("report", "small.h5", "--json").stdout)
        mean = {p["point"]: p["mean_mm"] for p in out["points"]}
        self.assertAlmostEqual(mean[1], mean[5], delta=1e-12 * mean[1] + 1e-300)

    def test_another_campaign_is_refused(self):
        self.run_small()
        with open("small.journal", "rb") as f:
            before = f.read()
        other = call("run", "small.yaml", "--seed", "4")
        self.assertEqual(other.returncode, 4)
        self.assertIn("seed", other.stderr)
        with open("small.journal", "rb") as f:
            self.assertEqual(f.read(), before, "nothing is overwritten")

    def test_bad_input(self):
        for words, piece in (
            (["--set", "current.sped=2 m/s"], "speed"),
            (["--set", "current.speed=2"], "unit"),
            (["--set", "current.speed=2 kg"], "2 kg"),
            (["--set", "current.speed=2 m/s x"], "2 m/s x"),
            (["--set", "current.speed=nan m/s"], "nan"),
            (["--set", "current.speed=1e999 m/s"], "1e999"),
            (["--set", "ice.concentration=66 %"], "65 %"),
            (["--set", "ice.temperature=-1 degC"], "1.8"),
            (["--set", "exposure.window=0 s"], "window"),
        ):
            done = call("run", "small.yaml", *words, timeout=5)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(piece, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(sorted(os.listdir(".")), ["small.yaml"])
        for text, place in (("", ":1:1"), ("[" * 1000000, ":1:"), ("\0\1\2", ":1:1"), (CAMPAIGN + "seed: 4\n", ":13:1")):
            with open("bad.yaml", "w", encoding="utf-8") as f:
                f.write(text)
            done = call("run", "bad.yaml", timeout=5)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("bad.yaml" + place, done.stderr)

    def test_output_that_cannot_be_written(self):
        self.run_small()
        with open("/dev/full", "w", encoding="utf-8") as full:
            for words in (["report", "small.h5"], ["report", "small.h5", "--json"], ["keys"], ["run", "small.yaml"], ["laws"], ["effects"]):
                self.assertEqual(call(*words, stdout=full).returncode, 4, words)
        self.assertEqual(call("run", "small.yaml", "-o", "no/such/folder/x").returncode, 4)
        self.assertEqual(call("report", "small.yaml").returncode, 4)
        self.assertEqual(call("report", "absent.h5").returncode, 4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
