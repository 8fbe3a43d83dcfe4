"""plot_run.py draws what a history holds, and says what is wrong with its input."""
import pathlib
import tempfile
import unittest

import numpy as np

from helpers import picture, share_coloured, tool, write_history

from pictures import panels, series
from pictures.runs import History


def columns(rows):
    time = np.linspace(0.0, 1.0, rows)
    return {"time": time, "kinetic_energy": np.exp(-time), "potential_energy": -time, "work.friction": -0.5 * time,
            "work.walls": 0 * time, "energy_imbalance": 1e-16 * time, "residual_rms": 0.01 + 0 * time,
            "sweeps": 20 + 0 * time, "penetration_max": 1e-6 * time, "contacts": 1000 * time, "bodies": 100 + 0 * time,
            "out.mass_rate": time, "floor.force_z": -time, "bed.packing_fraction": np.outer(time, np.ones(5))}


class Plotting(unittest.TestCase):
    def setUp(self):
        self.run_folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "a run"
        self.run_folder.mkdir()

    def draw(self, data, coloured=0.003):
        write_history(self.run_folder / "history.h5", data)
        code, out, err = tool("plot_run.py", self.run_folder)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(out.strip(), str(self.run_folder / "run.png"))
        image = picture(self.run_folder / "run.png")
        self.assertGreater(share_coloured(image), coloured)
        return image

    def test_all_panels(self):
        (self.run_folder / "summary.yaml").write_text(
            "title: A title\nstatus: complete\ntime_by_phase: {solve: 2.0, detection: 1.0, output: 0.0}\n")
        few = self.draw({name: columns(40)[name] for name in ("time", "sweeps")})
        many = self.draw(columns(5000))
        self.assertGreater(many.shape[0], few.shape[0])

    def test_one_row_and_numbers_that_are_not_finite(self):
        data = columns(1)
        data["residual_rms"] = [np.nan]
        self.draw(data, coloured=3e-4)  # single points

    def test_choice_follows_the_columns(self):
        write_history(self.run_folder / "history.h5", columns(10))
        history = History(self.run_folder / "history.h5")
        # flow rate, force, energy, imbalance, residual, sweeps, penetration, counts, profile
        self.assertEqual(len(panels.choose(history, {})), 9)
        self.assertEqual(len(panels.choose(history, {"time_by_phase": {"solve": 1.0}})), 10)

    def test_bins_keep_the_mean_and_the_extremes(self):
        time = np.linspace(0.0, 1.0, 1000)
        values = np.random.default_rng(3).normal(size=1000)
        middle, mean, low, high = series.binned(time, values, 10)
        self.assertEqual(len(middle), 10)
        for i in range(10):
            inside = values[(time >= i / 10) & ((time < (i + 1) / 10) | (i == 9))]
            np.testing.assert_allclose([mean[i], low[i], high[i]], [inside.mean(), inside.min(), inside.max()])

    def test_last_row_half_written(self):
        data = columns(10)
        data["sweeps"] = data["sweeps"][:9]
        write_history(self.run_folder / "history.h5", data)
        history = History(self.run_folder / "history.h5")
        self.assertEqual({len(column.values) for column in history.columns.values()}, {9})


class Errors(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def expect(self, message, *arguments):
        code, out, err = tool("plot_run.py", *arguments)
        self.assertEqual((code, out), (4, ""), err)
        self.assertIn(message, err)
        self.assertNotIn("Traceback", err)

    def test_no_folder(self):
        self.expect("no folder", self.folder / "nothing")

    def test_no_history(self):
        self.expect("no file", self.folder)

    def test_no_rows(self):
        write_history(self.folder / "history.h5", {"time": []})
        self.expect("has no rows", self.folder)

    def test_only_time(self):
        write_history(self.folder / "history.h5", {"time": [0.0, 1.0]})
        self.expect("nothing to draw", self.folder)

    def test_summary_that_is_no_yaml(self):
        write_history(self.folder / "history.h5", columns(5))
        (self.folder / "summary.yaml").write_text("a: [1\n")
        self.expect("summary.yaml cannot be read", self.folder)


if __name__ == "__main__":
    unittest.main()
