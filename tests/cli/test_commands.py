"""Every command end to end through the real program: what it prints, what it writes, how it refuses.

usage: test_commands.py PROGRAM SOURCE_DIR

test_program.py walks through the ordinary use; here are the reference scenes with several floes, trajectories, every file of
tests/cli/bad through the program, streams that cannot be written, and files that must survive. Scenes and campaigns lie in
tests/cli/commands. Expected numbers: tests/reference (an independent code's solutions to 1e-10); everything else is a law.
"""
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import h5py
except ImportError:  # building and using the program do not need it
    h5py = None

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
HERE = SOURCE / "tests/cli/commands"
BAD = SOURCE / "tests/cli/bad"
EXIT_CODES = {"FW_E_INPUT": 2, "FW_E_ARG": 2, "FW_E_UNSUPPORTED": 2, "FW_E_IO": 4, "FW_E_FORMAT": 4, "FW_E_MISMATCH": 4}


def environment(words):
    """In a sanitizer build every command counts its leaks, except the one that starts Open MPI: that leaves some behind."""
    return {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"} if words[:1] == ("run",) else dict(os.environ)


def call(*words, **more):
    more.setdefault("env", environment(words))
    more.setdefault("stdout", subprocess.PIPE)
    more.setdefault("timeout", 120)
    return subprocess.run([PROGRAM, *map(str, words)], stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True, **more)


class InFolder(unittest.TestCase):
    """A folder of its own for every test; the campaign's results are made once."""

    results = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        self.addCleanup(os.chdir, "/")

    def fetch_results(self):
        if InFolder.results is None:
            done = call("run", HERE / "small.yaml", "--quiet", "-o", "made")
            self.assertEqual(done.returncode, 0, done.stderr)
            InFolder.results = {name: pathlib.Path(name).read_bytes() for name in ("made.h5", "made.journal")}
        for name, content in InFolder.results.items():
            pathlib.Path(name).write_bytes(content)

    def refuse(self, code, *words, piece=None):
        """One clear line on stderr, nothing on stdout, an answer within a second (a loaded machine gets three)."""
        before = {p.name: p.read_bytes() for p in pathlib.Path(".").iterdir() if p.is_file()}
        start = time.monotonic()
        done = call(*words)
        self.assertLess(time.monotonic() - start, 3, words)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        self.assertEqual(done.stdout, "", words)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("floewear"), done.stderr)
        if piece is not None:
            self.assertIn(piece, done.stderr)
        after = {p.name: p.read_bytes() for p in pathlib.Path(".").iterdir() if p.is_file()}
        self.assertEqual(before, after, "a refused command writes nothing")
        return done.stderr


class Usage(InFolder):
    def test_no_command_and_mistyped_ones(self):
        done = call()
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        for command in ("run", "plan", "scene", "accuracy", "report", "merge", "status", "keys", "effects", "laws"):
            self.assertIn(command, done.stderr)
            self.refuse(2, command + "x", piece=f"did you mean '{command}'?")
        self.refuse(2, "Q7!")
        self.refuse(2, "", piece="no command")

    def test_help(self):
        for words in (["--help"], ["-h"], ["help"]):
            done = call(*words)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("Exit codes", done.stdout)
        for command in ("run", "plan", "scene", "report", "merge", "status", "keys", "effects", "laws"):
            done = call(command, "--help")
            self.assertEqual((done.returncode, done.stderr), (0, ""), command)
            self.assertIn(f"Usage: floewear {command}", done.stdout)
            self.assertIn("--json", done.stdout, command)

    def test_wrong_arguments(self):
        small, scene = HERE / "small.yaml", HERE / "scene-M01.yaml"
        for words in (
            ["plan", small, "--pilot", "two"], ["plan", small, "--pilot", "-1"], ["plan", small, "--seed", "x"], ["plan", small, small],
            ["scene", scene, scene], ["scene", "--interval"], ["run", small, "--time-budget", "3"], ["run", small, "--seed", "-1"],
            ["run", small, "--set", "nothing"], ["run", small, "--only-id", "1.5"], ["report", "a.h5", "--points", "0"],
            ["report", "a.h5", "--points", "1,,2"], ["report", "a.h5", "--percentiles", "100"], ["report", "a.h5", "--csv", "--json"],
            ["merge"], ["merge", "a.h5"], ["status"], ["status", "a", "b"], ["keys", "x"], ["laws", "x"], ["effects", "--yaml"],
        ):
            done = call(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertTrue(done.stderr.startswith(f"floewear {words[0]}: "), done.stderr)
        self.assertEqual(os.listdir("."), [])


class Tables(InFolder):
    def test_reference_tables(self):
        keys = call("keys").stdout
        for word in ("structure", "measuring_points", "thickness_mixes", "slip_damping_ratio", "strip_width", "max_realisations"):
            self.assertIn(word, keys)
        for command in ("keys", "effects", "laws"):
            self.assertIsInstance(json.loads(call(command, "--json").stdout), dict)
        effects = call("effects").stdout
        for effect in json.loads(call("effects", "--json").stdout)["effects"]:
            self.assertIsInstance(effect["on"], bool)
            for key in ("name", "reason", "does", "equation", "source", "range", "limit", "off"):
                self.assertTrue(effect[key])
                self.assertIn(effect[key], effects)
        for law in json.loads(call("laws", "--json").stdout)["laws"]:
            self.assertTrue(0 < law["exponent"] < 2)
            self.assertIn(law["name"], call("laws").stdout)


class Plans(InFolder):
    def test_pilot_of_two(self):
        done = call("plan", HERE / "small.yaml", "--pilot", "2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("pilot of 2", done.stdout)
        plan = json.loads(call("plan", HERE / "small.yaml", "--pilot", "2", "--json").stdout)
        self.assertEqual([e["name"] for e in plan["effects"] if e["on"]], ["floe_contact", "friction", "rotation", "form_drag"])
        self.assertTrue(all(e["name"] and e["reason"] for e in plan["effects"]))
        self.assertEqual((plan["campaign"], plan["pilot"]["n"], plan["pilot"]["failed"]), ("small", 2, 0))
        self.assertEqual(os.listdir("."), [], "a plan writes nothing")

    def test_effects_that_are_not_needed(self):
        plan = json.loads(call("plan", HERE / "small.yaml", "--pilot", "0", "--json", "--set", "contact.friction=0").stdout)
        self.assertEqual([e["name"] for e in plan["effects"] if e["on"]], ["floe_contact", "form_drag"])


    def test_a_campaign_with_everything(self):
        everything = SOURCE / "tests/cli/good/effects.yaml"
        plan = json.loads(call("plan", everything, "--pilot", "0", "--json").stdout)
        self.assertEqual({e["name"] for e in plan["effects"]}, {e["name"] for e in json.loads(call("effects", "--json").stdout)["effects"]})
        self.assertEqual([e["name"] for e in plan["effects"] if not e["on"]], [])
        lines = [line.split()[:2] for line in call("plan", everything, "--pilot", "0", "--set", "effects={wind: off}").stdout.splitlines()]
        self.assertIn(["effect", "on"], lines)
        self.assertIn(["wind", "off"], lines)
        self.assertIn(["tide", "on"], lines)

    def test_why_not_auto(self):
        plan = json.loads(call("plan", HERE / "small.yaml", "--pilot", "0", "--json", "--set", "effects={skin_drag: on, rotation: off}").stdout)
        why = {e["name"]: e["reason"] for e in plan["effects"]}
        self.assertIn("asked for by the file (auto: off, no water.skin_drag", why["skin_drag"])
        self.assertIn("switched off by the file", why["rotation"])


class Readme(InFolder):
    """Keys that README shows are keys, and call for something."""

    def test_keys_of_the_table(self):
        text = (SOURCE / "README.md").read_text(encoding="utf-8")
        keys = re.findall(r"^\| `(\w+): (\{.*?\})`(?=,| \|)", text[text.index("| key | effect |"):], re.M)
        self.assertGreaterEqual(len(keys), 9)
        bare = call("plan", HERE / "small.yaml", "--pilot", "0", "--json").stdout
        for section, value in keys:
            own = value.replace("{", "{speed: 1 m/s, ", 1) if section == "current" else value
            done = call("plan", HERE / "small.yaml", "--pilot", "0", "--json", "--set", f"{section}={own}")
            self.assertEqual((done.returncode, done.stderr), (0, ""), value)
            self.assertNotEqual(json.loads(done.stdout)["effects"], json.loads(bare)["effects"], value)


class OffIsAbsent(InFolder):
    """An effect whose keys stand in the file and that is switched off leaves every number as if there were no such keys."""

    KEYS = {
        "wind": "wind={speed: {weibull: {scale: 6 m/s, shape: 2}}, angle: 40 deg}",
        "tide": "current.tide={minor_ratio: 0.5}",
        "skin_drag": "water.skin_drag=0.01",
        "added_mass": "water.added_mass=on",
        "deflected_flow": "water.deflected_flow=on",
        "crushing_limit": "abrasion.crushing_limit={pressure: 1 MPa}",
        "ice_on_ice": "contact.floe_friction=0.5",
    }

    @unittest.skipIf(h5py is None, "needs h5py")
    def test_to_the_bit(self):
        self.fetch_results()
        with h5py.File("made.h5") as f:
            settings, want = f.attrs["settings"], {k: v[()].tobytes() for k, v in f["realisations"].items() if "host" not in k}
        for name, key in self.KEYS.items():
            done = call("run", HERE / "small.yaml", "--quiet", "-o", name, "--set", key, "--set", f"effects={{{name}: off}}")
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(f"{name}.h5") as f:
                self.assertEqual(f.attrs["settings"], settings, name)
                self.assertEqual({k: v[()].tobytes() for k, v in f["realisations"].items() if "host" not in k}, want, name)


class Scenes(InFolder):
    @staticmethod
    def reference():
        with open(SOURCE / "tests/reference/multi_floe.csv", encoding="utf-8") as f:
            scenes = {}
            for row in csv.DictReader(f):
                scenes.setdefault(row["scene"], []).append(row)
        return scenes.items()

    def test_reference_scenes(self):
        """At 0.1 %: depth within 0.1 %, final positions within 5 mm; at 1 %: depth within 1 %."""
        for name, rows in self.reference():
            file = HERE / f"scene-{name.split('_')[0]}.yaml"
            for accuracy, target in ((0.001, 0.001), (0.01, 0.01)):
                done = call("scene", file, "--json", "--set", f"accuracy={100 * accuracy} %")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                out = json.loads(done.stdout)
                self.assertEqual(out["status"], "ok")
                wanted = {"depth_along_contact_mm": "depth_mm", "depth_x_wall_mm_m": "W_mm_m", "normal_impulse_N_s": "J_N", "path_m": "path"}
                for ours, theirs in wanted.items():
                    one, other = out["structure"][ours], float(rows[0][theirs])
                    allowed = 5 * target if ours == "path_m" else target  # rolling is half of the path and none of the wear
                    self.assertLessEqual(abs(one - other), allowed * other, (name, ours))
                if accuracy == 0.001:
                    for floe, row in zip(out["floes"], rows, strict=True):
                        self.assertLess(abs(floe["x_m"] - float(row["x"])), 5e-3, name)
                        self.assertLess(abs(floe["y_m"] - float(row["y"])), 5e-3, name)
                        self.assertLess(abs(floe["spin_rad_s"] - float(row["spin"])), 5e-3, name)
                self.check_ledger(out["ledger"], accuracy)

    def check_ledger(self, ledger, accuracy):
        self.assertLess(ledger["energy_relative"], 1e-10)
        self.assertLess(ledger["momentum_relative"], 1e-10)
        self.assertLess(ledger["energy_truncation"], accuracy)

    def test_names(self):
        """The names of the interface, no more floes than given, arcs of equal number."""
        out = json.loads(call("scene", HERE / "scene-M08.yaml", "--json", "--set", "ring.arcs=72").stdout)
        self.assertLessEqual({"structure", "arcs", "floes", "ledger", "cost", "effects", "status"}, set(out))
        self.assertLessEqual({"normal_impulse_N_s", "peak_force_N", "contacts", "contact_time_s", "path_m", "depth_along_contact_mm",
                              "depth_x_wall_mm_m"}, set(out["structure"]))
        self.assertLessEqual({"energy_relative", "energy_truncation", "momentum_relative", "max_overlap_m",
                              "overlap_beyond_range_share"}, set(out["ledger"]))
        self.assertLessEqual({"force_evaluations", "steps", "cpu_s"}, set(out["cost"]))
        self.assertEqual([len(out["arcs"][k]) for k in ("angle_deg", "path_m", "depth_mm")], [72] * 3)
        self.assertEqual(out["arcs"]["angle_deg"][:2], [2.5, 7.5])  # the middles of the arcs
        self.assertEqual(len(out["floes"]), 3)
        self.assertEqual(out["effects"], ["floe_contact", "friction", "rotation", "form_drag"])

    def test_text(self):
        text = call("scene", HERE / "scene-M01.yaml").stdout
        for piece in ("normal impulse", "depth along the contact", "floes at the end", "force evaluations"):
            self.assertIn(piece, text)

    def test_mirror(self):
        """The scene's mirror image wears the mirror image of the ring and moves the floes the same way."""
        text = (HERE / "scene-M08.yaml").read_text(encoding="utf-8")
        mirrored = re.sub(r"\b(y|spin): (-?)([0-9.]+)", lambda m: f"{m[1]}: {'' if m[2] else '-'}{m[3]}", text)
        self.assertNotEqual(mirrored, text)
        pathlib.Path("mirror.yaml").write_text(mirrored, encoding="utf-8")
        one = json.loads(call("scene", HERE / "scene-M08.yaml", "--json").stdout)
        two = json.loads(call("scene", "mirror.yaml", "--json").stdout)
        depth, scale = one["arcs"]["depth_mm"], max(one["arcs"]["depth_mm"])
        for a, b in zip(depth, reversed(two["arcs"]["depth_mm"]), strict=True):
            self.assertLess(abs(a - b), 1e-6 * scale)
        for a, b in zip(one["floes"], two["floes"], strict=True):
            self.assertLess(abs(a["x_m"] - b["x_m"]) + abs(a["y_m"] + b["y_m"]) + abs(a["spin_rad_s"] + b["spin_rad_s"]), 1e-6)

    def test_same_bits_twice(self):
        one, two = (json.loads(call("scene", HERE / "scene-raft.yaml", "--json", env={**os.environ, "MALLOC_PERTURB_": p}).stdout)
                    for p in ("0", "165"))
        for out in (one, two):
            del out["cost"]["cpu_s"]
        self.assertEqual(one, two)

    def test_raft_laid_rim_to_rim(self):
        """Nineteen floes that touch without closing speed: no slivers of steps, and no energy from nothing."""
        out = json.loads(call("scene", HERE / "scene-raft.yaml", "--json", timeout=20).stdout)
        self.assertEqual(out["status"], "ok")
        self.check_ledger(out["ledger"], 0.01)
        self.assertLess(out["cost"]["steps"], 20000)

    def test_trajectory(self):
        done = call("scene", HERE / "scene-M05.yaml", "--json", "--trajectory", "t.h5", "--interval", "0.25 s")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(os.listdir("."), ["t.h5"])
        if h5py is None:
            self.skipTest("no h5py")
        with h5py.File("t.h5", "r") as f:
            self.assertEqual(f.attrs["filetype"], "floewear trajectory")
            times = f["time"][:]
            self.assertEqual((len(times), times[0], times[-1]), (33, 0, 8))
            self.assertEqual(f["x"].shape, (33, 2))
            for name, unit in (("x", "m"), ("y", "m"), ("vx", "m s-1"), ("vy", "m s-1"), ("spin", "rad s-1"), ("time", "s")):
                self.assertEqual(f[name].attrs["units"], unit)
                self.assertTrue(f[name].attrs["long_name"])
            self.assertEqual(list(f["x"][0]), [-6.0, -6.3])
            last = json.loads(done.stdout)["floes"]
            for name, key in (("x", "x_m"), ("y", "y_m"), ("vx", "vx_m_s"), ("spin", "spin_rad_s")):
                self.assertEqual(list(f[name][-1]), [floe[key] for floe in last])
        again = call("scene", HERE / "scene-M01.yaml", "--trajectory", "t.h5")  # a trajectory may be replaced by the next
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_trajectory_takes_no_other_files_place(self):
        self.fetch_results()
        pathlib.Path("mine.yaml").write_text("name: mine\n", encoding="utf-8")
        for place in ("made.h5", "made.journal", "mine.yaml"):
            self.refuse(4, "scene", HERE / "scene-M01.yaml", "--trajectory", place, piece=place)
        self.refuse(4, "scene", HERE / "scene-M01.yaml", "--trajectory", ".", piece="not a regular file")
        self.refuse(4, "scene", HERE / "scene-M01.yaml", "--trajectory", "no/folder/t.h5", piece="no/folder/t.h5")
        self.refuse(2, "scene", HERE / "scene-M01.yaml", "--trajectory", "t.h5", "--interval", "2", piece="no unit")


class Reports(InFolder):
    def test_status(self):
        self.fetch_results()
        text = call("status", "made.journal")
        self.assertEqual((text.returncode, text.stderr), (0, ""))
        self.assertIn("complete", text.stdout)
        facts = json.loads(call("status", "made.journal", "--json").stdout)
        self.assertEqual((facts["campaign"], facts["done"], facts["failed"], facts["running"]), ("small", 40, 0, False))
        torn = pathlib.Path("made.journal").read_bytes()[:-7]
        pathlib.Path("made.journal").write_bytes(torn)
        facts = json.loads(call("status", "made.journal", "--json").stdout)
        self.assertEqual((facts["done"], facts["state"]), (39, "stopped"))
        self.assertEqual(pathlib.Path("made.journal").read_bytes(), torn, "status changes nothing")
        self.refuse(4, "status", "absent.journal", piece="absent.journal")
        self.refuse(4, "status", "made.h5", piece="made.h5")

    def test_report(self):
        self.fetch_results()
        table = call("report", "made.h5")
        self.assertEqual((table.returncode, table.stderr), (0, ""))
        self.assertIn("governing", table.stdout)
        out = json.loads(call("report", "made.h5", "--json", "--points", "2,1", "--percentiles", "50,90").stdout)
        self.assertEqual({(r["point"], r["percentile"]) for r in out["percentiles"]}, {(1, 50), (1, 90), (2, 50), (2, 90)})
        for row in out["percentiles"]:
            self.assertLessEqual({"point", "bearing_deg", "percentile", "depth_mm", "low_mm", "high_mm", "band_low_mm", "band_high_mm", "n_effective", "coverage"}, set(row))
            self.assertEqual(row["bearing_deg"], 45 * (row["point"] - 1))  # eight points, the first one at 0 deg, clockwise
            if row["low_mm"] is not None:
                self.assertLessEqual(row["low_mm"], row["depth_mm"])
            if row["high_mm"] is not None:
                self.assertLessEqual(row["depth_mm"], row["high_mm"])
        self.assertLessEqual({"campaign", "n", "failed", "percentiles", "points", "service_life", "ledger"}, set(out))
        together = call("report", "made.h5", "--simultaneous")
        self.assertEqual((together.returncode, together.stderr), (0, ""))
        self.assertIn("all points together]", together.stdout)
        rows = list(csv.DictReader(call("report", "made.h5", "--csv", "--points", "3", "--percentiles", "50,95").stdout.splitlines()))
        whole = json.loads(call("report", "made.h5", "--json", "--points", "3", "--percentiles", "50,95").stdout)
        self.assertEqual(len(rows), 2)
        for row, wanted in zip(rows, whole["percentiles"], strict=True):
            self.assertEqual(float(row["depth_mm"]), wanted["depth_mm"])
        self.refuse(2, "report", "made.h5", "--points", "9", piece="9")
        self.refuse(2, "report", "made.h5", "--law", "archimedes", piece="archimedes")

    def test_damaged_results(self):
        self.fetch_results()
        whole = pathlib.Path("made.h5").read_bytes()
        for name, content in (("cut.h5", whole[:-100]), ("flipped.h5", whole[:2000] + b"X" + whole[2001:]), ("empty.h5", b""), ("text.h5", b"no\n")):
            pathlib.Path(name).write_bytes(content)
            self.refuse(4, "report", name, piece=name)

    def test_files_that_must_survive(self):
        """A journal or results file of another campaign, or of nobody, is neither read as ours nor replaced."""
        self.fetch_results()
        self.refuse(4, "run", HERE / "small.yaml", "--quiet", "-o", "made", "--set", "current.speed=1.5 m/s", piece="current.speed")
        pathlib.Path("junk.journal").write_bytes(b"somebody's diary\n")
        self.refuse(4, "run", HERE / "small.yaml", "--quiet", "-o", "junk", piece="junk.journal")
        pathlib.Path("alien.h5").write_bytes(b"somebody's results\n")
        self.refuse(4, "run", HERE / "small.yaml", "--quiet", "-o", "alien", piece="alien.h5")
        self.refuse(4, "run", HERE / "small.yaml", "--quiet", "-o", "no/folder/x", piece="no/folder")


class BadInput(InFolder):
    def test_every_bad_file(self):
        """The first line of each file says status and place; run and plan or scene must say so in one line."""
        n = 0
        for path in sorted(BAD.glob("*.yaml")):
            with open(path, encoding="utf-8", errors="replace") as f:
                wanted = f.readline().removeprefix("# wants: ").rstrip("\n").split(" | ")
            code = EXIT_CODES[wanted[0]]
            commands = [["scene", path]] if path.name.startswith("scene-") else [["plan", path, "--pilot", "0"], ["run", path, "-o", "out"]]
            for words in commands:
                said = self.refuse(code, *words)
                for piece in wanted[1:]:
                    self.assertIn(piece, said)
                if ".csv" not in said:
                    self.assertRegex(said, rf"{path.name}:\d+")
            n += 1
        self.assertGreater(n, 120)

    def test_files_that_are_no_text(self):
        contents = {"empty": b"", "brackets": b"[" * 10_000_000, "deep": b"[" * 1_000_000, "junk": bytes(range(256)) * 4000,
                    "elf": b"\x7fELF\2\1\1" + b"\0" * 5000}
        for name, content in contents.items():
            pathlib.Path(name).write_bytes(content)
        for name in contents:
            for words in (["run", name, "-o", "out"], ["plan", name, "--pilot", "0"], ["scene", name]):
                self.refuse(2, *words, piece=name)
        for command in ("run", "plan", "scene", "report", "status"):
            self.refuse(4, command, "absent", piece="absent")
            self.refuse(4, command, "/", piece="/")

    def test_set(self):
        for setting, piece in (
            ("current.speed=2", "no unit"), ("current.speed=2 kg", "2 kg"), ("current.speed=2 m/s and more", "2 m/s and more"),
            ("current.speed=nan m/s", "nan"), ("current.speed=1e999 m/s", "1e999"), ("curent.speed=1 m/s", "current"),
            ("ice.concentration=0 %", "concentration"), ("ice.concentration=80.1 %", "80 %"), ("ice.temperature=-1 degC", "temperature_floor"),
            ("ice.temperature=1 degC", "temperature"), ("exposure.window=-1 s", "window"), ("accuracy=50 %", "accuracy"), ("seed=-1", "seed"),
            ("ice.thickness_mixes=[{probability: 0.5, classes: {0.3 m: 1}}]", "sum"), ("=", "--set"), ("name=", "name"),
        ):
            self.refuse(2, "run", HERE / "small.yaml", "-o", "out", "--set", setting, piece=piece)


class Streams(InFolder):
    def every_command(self):
        self.fetch_results()
        return (["scene", HERE / "scene-M01.yaml"], ["scene", HERE / "scene-M01.yaml", "--json"], ["keys"], ["keys", "--json"], ["effects"],
                ["effects", "--json"], ["laws"], ["laws", "--json"], ["plan", HERE / "small.yaml", "--pilot", "0"],
                ["plan", HERE / "small.yaml", "--pilot", "0", "--json"], ["report", "made.h5"], ["report", "made.h5", "--csv"],
                ["report", "made.h5", "--json"], ["status", "made.journal"], ["status", "made.journal", "--json"],
                ["run", HERE / "small.yaml", "-o", "made", "--quiet"], ["run", HERE / "small.yaml", "--only-id", "1", "--quiet"])

    def test_full_disk(self):
        for words in self.every_command():
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = call(*words, stdout=full)
            self.assertEqual(done.returncode, 4, words)
            self.assertEqual(done.stderr.count("\n"), 1, (words, done.stderr))

    def test_closed_stdout(self):
        for words in self.every_command():
            quoted = " ".join(f"'{w}'" for w in [PROGRAM, *words])
            done = subprocess.run(["sh", "-c", quoted + " >&-"], stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True, timeout=60,
                                  check=False, env=environment(tuple(words)))
            self.assertEqual(done.returncode, 4, (words, done.stderr))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
