"""Rasters, runout and trajectories: the same on any number of ranks, and in a run that goes on."""

import re

from scree_mpi import MpiTest, main

TERRAIN = """\
scenario_version: 1
time: {end: 2 s, step: 10 ms}
materials:
  rock: {density: 2600, friction: 0.4, restitution: 0.2}
walls:
  - {shape: terrain, name: ground, material: rock, path: slope.asc}
bodies:
  - {generator: random, material: rock, size: {distribution: uniform, lower: 0.4, upper: 1}, count: 80,
     region: {shape: box, lower: [4, 4, 11], upper: [10, 14, 15]}}
rasters: {interval: 20 ms, solid_fraction: 0.6, covered: 1 cm, at_snapshots: true}
trajectories: {count: 7, interval: 50 ms}
output: {snapshot_interval: 0.2 s, history_interval: 0.1 s}
"""


class Runout(MpiTest):
    def setUp(self):
        super().setUp()
        rows = "\n".join(" ".join(f"{12 - 0.4 * i + 0.3 * ((i * j) % 3):g}" for i in range(20)) for j in range(12))
        self.write("slope.asc", f"ncols 20\nnrows 12\nxllcorner 0\nyllcorner 0\ncellsize 1.5\n{rows}\n")
        self.scenario = self.write("slope.yaml", TERRAIN)

    def read(self, *parts):
        with open(self.path(*parts), encoding="utf-8") as file:
            return file.read()

    def assert_same_maps(self, one, other):
        self.assert_same_run(one, other)
        for name in ("deposit", "flow_depth_max", "flow_height_max", "speed_max", "arrival_time"):
            a, b = (self.read(run, "rasters", name + ".asc") for run in (one, other))
            self.assertEqual(a, b, name)
            self.assertGreater(len(set(a.split())), 20, name)
        deepest, deposit = ([float(x) for x in self.read(one, "rasters", name + ".asc").split("-9999\n")[1].split()]
                            for name in ("flow_depth_max", "deposit"))
        self.assertTrue(all(a >= b for a, b in zip(deepest, deposit)))
        for number in (0, 4, 10):
            self.scree("compare", *(f"{run}/rasters/{number:06}.h5" for run in (one, other)), code=0)
        self.assertIn("rasters     20 x 12 cells", self.scree("info", other, code=0).out)
        self.assertIn("trajectories of 7 bodies, 41 rows", self.scree("info", other, code=0).out)
        runouts = [re.search(r"(?m)^runout:\n(?:  .*\n)+", self.summary(run)).group() for run in (one, other)]
        self.assertEqual(*runouts)
        self.assertIn("height_over_length", runouts[0])

    def test_maps_and_trajectories(self):
        self.scree("run", self.scenario, "--out", "alone", "-q", code=0)
        for ranks in (2, 5):
            self.on(ranks, "run", self.scenario, "--out", f"on{ranks}", "-q", code=0)
            self.assert_same_maps("alone", f"on{ranks}")

    def test_maps_go_on_on_another_number(self):
        self.scree("run", self.scenario, "--out", "whole", "-q", code=0)
        self.on(3, "run", self.scenario, "--set", "time.end=0.8", "--out", "parts", "-q", code=0)
        self.on(2, "run", self.scenario, "--resume", "--out", "parts", "-q", code=0)
        self.assert_same_maps("whole", "parts")


if __name__ == "__main__":
    main()
