"""analysis/figures.py on synthetic results files: well-formed SVG and PNG, the same bytes twice, and clear refusals.

usage: test_figures.py SOURCE_FOLDER WORK_FOLDER      WORK_FOLDER keeps the pictures for looking at
"""
import pathlib
import struct
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

import h5py
import numpy as np

import make_results

SOURCE, WORK = pathlib.Path(), pathlib.Path()


def png_size(path):
    """(width, height) after checking signature and the CRC of every chunk (PNG specification, section 5)."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, kinds = 8, []
    while at < len(data):
        (length,) = struct.unpack(">I", data[at:at + 4])
        body = data[at + 4:at + 8 + length]
        (crc,) = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        assert crc == zlib.crc32(body)
        kinds.append(body[:4])
        at += 12 + length
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND"
    return struct.unpack(">II", data[16:24])


class Figures(unittest.TestCase):
    def run_figures(self, *arguments):
        command = [sys.executable, SOURCE / "analysis/figures.py", *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def draw(self, name, **options):
        folder = WORK / name
        folder.mkdir(parents=True, exist_ok=True)
        kinds = options.pop("kinds", ("exceedance", "polar"))
        return self.check(name, folder, make_results.make(folder / f"{name}.h5", name=name, **options), kinds)

    def draw_study(self, name, **options):
        folder = WORK / name
        folder.mkdir(parents=True, exist_ok=True)
        study = make_results.make_study(folder / f"{name}.accuracy.h5", name=name, **options)
        return self.check(name, folder, study, ("budget", "work-precision"))

    def check(self, name, folder, results, kinds):
        done = self.run_figures(results)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        figures = sorted(folder.glob("*.svg")) + sorted(folder.glob("*.png"))
        self.assertEqual([f.name for f in figures], [f"{name}-{kind}.{suffix}" for suffix in ("svg", "png")
                                                     for kind in kinds])
        for figure in figures:
            self.assertIn(f"figure: {figure}", done.stdout)
            if figure.suffix == ".svg":
                root = ElementTree.parse(figure).getroot()
                self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
                self.assertGreater(len(list(root.iter("{http://www.w3.org/2000/svg}path"))), 10)
                self.assertNotIn("nan", figure.read_text(encoding="utf-8").lower().split("<metadata>")[0])
            else:
                width, height = png_size(figure)
                self.assertGreaterEqual(min(width, height), 800)
        return figures

    def test_all_round(self):
        self.draw("round")

    def test_missing_interval_ends(self):
        """Eleven points across north, constant conditions, 60 windows: P95 and P99 have no upper end (n < 72)."""
        bearings = (np.arange(-75.0, 76.0, 15.0)) % 360.0
        self.draw("front", n=60, bearings=bearings, direction="180 deg", shares={180.0: 1.0}, temperatures=(-10.0, -10.0))

    def test_failed_runs_and_few_percentiles(self):
        self.draw("failed", n=150, n_failed=3, percentiles=(90,), scale=5000.0)

    def test_no_wear_at_all(self):
        self.draw("nothing", scale=0.0)

    def test_one_window_one_point(self):
        self.draw("single", n=1, bearings=[200.0], direction="20 deg", shares={20.0: 1.0})

    def test_service_life(self):
        """With an allowance that some lives use up and a law that is not known; with one far off; over part of the wall and no water level."""
        both = ("exceedance", "life-fan", "life-map", "polar")
        path = make_results.make(WORK / "life.h5", life={"water_level": False})
        with h5py.File(path) as file:
            end = float(file["life_fan/depth_mm"][...].max())
        self.draw("life", kinds=both, life={"allowance": 0.95 * end, "with_law": True})
        self.draw("life-far", kinds=both, life={"allowance": 20.0})
        self.draw("life-front", kinds=("exceedance", "life-fan", "polar"), bearings=(np.arange(-75.0, 76.0, 15.0)) % 360.0, life={"water_level": False})
        self.draw("life-none", scale=0.0, life={})

    def test_life_grid(self):
        """A full circle is closed, bearings do not fall, and each column is its point's own profile."""
        results = Results(make_results.make(WORK / "grid.h5", bearings=(np.arange(0.0, 360.0, 30.0) + 330.0) % 360.0, life={}))
        bearings, heights, depth = life.map_grid(results)
        self.assertEqual((len(bearings), len(heights)), (13, 81))
        np.testing.assert_allclose(np.diff(bearings), 30.0)
        np.testing.assert_array_equal(depth[:, 0], depth[:, -1])
        rows = results.life["life_map"]
        for k, bearing in enumerate(bearings):
            np.testing.assert_array_equal(depth[:, k], rows["depth_mm"][rows["bearing_deg"] == bearing % 360.0])
        years, curves = life.fan_of(results, 1)
        self.assertEqual((years[0], years[-1], sorted(curves)), (0.0, 50.0, [5.0, 50.0, 90.0, 95.0, 99.0]))
        self.assertTrue(all(curve[0] == 0.0 and np.all(np.diff(curve) > 0.0) for curve in curves.values()))

    def test_accuracy_study(self):
        self.draw_study("study")

    def test_accuracy_study_of_jams(self):
        """No window stays coupled: the r.m.s. over all windows stands in."""
        self.draw_study("jams", n_coupled=0)

    def test_slopes(self):
        """Exact power laws give their exponents back."""
        cpu = np.array([1.0, 2.0, 4.0])
        self.assertAlmostEqual(accuracy.line_slope(cpu, 3.0 * cpu**-2.0), -2.0)
        self.assertIsNone(accuracy.line_slope(cpu[:1], cpu[:1]))

    def results(self, **options):
        (WORK / "laws").mkdir(parents=True, exist_ok=True)
        return Results(make_results.make(WORK / "laws/law.h5", **options))

    def test_directions(self):
        """What the arrows show: a rose with its shares, a constant, --set over the file; nothing where it is no rose."""
        for law, sets, expected in (("{rose: {0 deg: 1, 90 deg: 3}}", (), [(0.0, 0.25), (90.0, 0.75)]),
                                    ("180 deg", (), [(180.0, 1.0)]),
                                    ("180 deg", ("seed=3", "current.direction=45deg"), [(45.0, 1.0)]),
                                    ("{rose: {0 deg: 1}}", ("current.direction.rose={9 deg: 1}",), []),
                                    ("{uniform: [0 deg, 360 deg]}", (), [])):
            self.assertEqual(self.results(n=40, direction=law, sets=sets).directions, expected)

    def test_exceedance(self):
        """Against brute force over realisations, directions and 400 temperatures; to the width of one of those."""
        for options in ({}, {"temperatures": (-10.0, -10.0)}, {"direction": "180 deg", "shares": {180.0: 1.0}}):
            results = self.results(n=50, **options)
            for point in (1, 7, 20):
                depth, probability = windows.exceedance(results, point)
                shares = options.get("shares", make_results.ROSE_SHARES)
                brute, weight = make_results.depths(results.load, results.points["bearing_deg"][point - 1], shares,
                                                    options.get("temperatures", (-12.0, -2.0)))
                above = np.append(np.cumsum(weight[::-1])[::-1], 0.0)[np.searchsorted(brute, depth, side="right")]
                np.testing.assert_allclose(probability, above, atol=2.0 / make_results.N_T)

    def test_exceedance_only_when_it_agrees(self):
        """No curve against the file's own percentiles, with failed runs, or for laws that are not written out here."""
        self.assertIsNone(windows.exceedance(self.results(n=50, shares={0.0: 1.0}), 1))  # the file says: a rose
        self.assertIsNone(windows.exceedance(self.results(n=50, n_failed=1), 1))
        self.assertIsNone(windows.exceedance(self.results(n=50, sets=("ice.temperature.uniform=[-3 degC, -2 degC]",)), 1))
        self.assertIsNone(windows.exceedance(self.results(n=50, scale=0.0), 1))

    def test_same_bytes_twice(self):
        first = {f.name: f.read_bytes() for f in self.draw("twice")}
        second = {f.name: f.read_bytes() for f in self.draw("twice")}
        self.assertEqual([name for name in first if first[name] != second[name]], [])

    def test_refusals(self):
        folder = WORK / "refused"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "text.h5").write_text("no HDF5", encoding="utf-8")
        with h5py.File(folder / "empty.h5", "w"):
            pass
        make_results.make(folder / "good.h5")
        make_results.make_study(folder / "none.accuracy.h5", chosen=False)
        make_results.make_study(folder / "dry.accuracy.h5", budget=False)
        for arguments, words in (([folder / "none.accuracy.h5"], "no chosen row"), ([folder / "dry.accuracy.h5"], "/budget_cpu"),
                                 ([folder / "absent.h5"], "absent.h5"), ([folder / "text.h5"], "text.h5"),
                                 ([folder / "empty.h5"], "/percentiles"),
                                 ([folder / "good.h5", "--points", "99"], "99")):
            done = self.run_figures(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    SOURCE, WORK = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    sys.path.insert(0, str(SOURCE / "analysis"))
    import accuracy
    import life
    import windows
    from results import Results
    unittest.main(argv=sys.argv[:1], verbosity=2)
