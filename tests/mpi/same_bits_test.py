"""The same bits on any number of ranks: final state, snapshots, and every number of the history."""

import os
import re

from scree_mpi import POT, SCENARIOS, SMALL, MpiTest, main


def shipped(name):
    return os.path.join(SCENARIOS, name)


class SameBits(MpiTest):
    def check(self, name, arguments, ranks):
        self.scree("run", *arguments, "--out", f"{name}-alone", "-q", code=0)
        for n in ranks:
            with self.subTest(name, ranks=n):
                self.on(n, "run", *arguments, "--out", f"{name}-{n}", "-q", code=0)
                # The history has the sweeps and residuals of each step.
                self.assert_same_run(f"{name}-alone", f"{name}-{n}")

    def test_small_bowl(self):
        # A row of the history each step: sweeps, residuals and all else of every step are compared.
        self.check("bowl", [SMALL, "--set", "time.end=0.2", "--set", "output.history_interval=1e-3"], (1, 2, 3, 5, 8))

    def test_tiny_blocks(self):
        self.check("tiny", [SMALL, "--set", "time.end=0.08", "--set", "solver.block_size=10.5 mm"], (2, 5))

    def test_without_friction(self):
        self.check("smooth", [SMALL, "--set", "time.end=0.1", "--set", "materials.glass.friction=0"], (3,))

    def test_inlet_and_outlet(self):
        self.check("inlet", [shipped("inlet_box.yaml"), "--set", "time.end=0.12", "--set", "measures=[]"], (3,))

    def test_driven_drum(self):
        self.check("drum", [shipped("rotating_drum.yaml"), "--set", "time.end=0.01", "--set", "measures=[]"], (2, 3))

    def test_more_ranks_than_bodies(self):
        self.check("cradle", [shipped("newtons_cradle.yaml")], (7,))

    def test_random_places_and_gravity_that_turns(self):
        path = self.write("tilt.yaml", """\
scenario_version: 1
time: {end: 0.06 s, step: 1 ms}
gravity_table: [[0, 0, 0, -9.81], [1, 3.36, 0, -9.22]]
materials:
  steel: {density: 7800 kg/m3, friction: 0.2, restitution: 0.5}
bodies:
  - {generator: sphere, material: steel, radius: 1 cm, position: [0.05, 0.05, 0.3]}
  - {generator: random, material: steel, size: {distribution: uniform, lower: 6 mm, upper: 14 mm}, count: 60,
     region: {shape: box, lower: [0, 0, 0], upper: [0.1, 0.1, 0.15]}}
  - {generator: lattice, material: steel, corner: [0, 0, 0.17], pitch: 2 cm, cells: [5, 5, 2], velocity: [0, 0, -1],
     size: {distribution: fixed, diameter: 1 cm}}
walls:
  - {shape: plane, name: ground, material: steel, point: [0, 0, 0], normal: [0, 0, 1]}
output: {contacts: true, snapshot_interval: 20 ms, fields: [velocity, spin, orientation]}
""")
        self.check("tilt", [path], (2, 5))


    def test_terrain(self):
        self.check("terrain", [terrain_scene(self), "--set", "time.end=0.4"], (2, 3, 5))

    def test_rocks_from_a_release_area(self):
        self.check("avalanche", [shipped("rock_avalanche.yaml"), "--set", "time.end=0.05"], (2,))


def terrain_scene(test):
    """Grains that fall on hills, at the coordinates of a national grid."""
    rows = [" ".join(f"{2000 + 0.05 * ((7 * i + 5 * j * j) % 11) + 0.02 * abs(i - 12):.3f}" for i in range(25))
            for j in range(25)]
    rows[12] = rows[12].replace(rows[12].split()[7], "-9999", 1)
    test.write("hills.asc", "ncols 25\nnrows 25\nxllcenter 538500\nyllcenter 5576504\ncellsize 0.1\n" + "\n".join(rows))
    return test.write("hills.yaml", """\
scenario_version: 1
time: {end: 0.4 s, step: 1 ms}
materials:
  rock: {density: 2700 kg/m3, friction: 0.5, restitution: 0.3}
bodies:
  - {generator: lattice, material: rock, corner: [538500.3, 5576504.3, 2001.1], pitch: 0.18, cells: [11, 11, 2],
     jitter: 1 cm, size: {distribution: uniform, lower: 8 cm, upper: 14 cm}, velocity: [1, 0.5, -2]}
walls:
  - {shape: terrain, name: hills, material: rock, path: hills.asc}
outlets:
  - {name: gone, region: {shape: half_space, point: [0, 0, 1995], normal: [0, 0, 1]}}
measures:
  - {measure: wall_force, name: load, wall: hills}
output: {snapshot_interval: 0.1 s, fields: [velocity, spin]}
""")


class OnAnotherNumber(MpiTest):
    def test_terrain_goes_on(self):
        scene = terrain_scene(self)
        self.scree("run", scene, "--out", "whole", "-q", code=0)
        self.on(3, "run", scene, "--set", "time.end=0.2", "--out", "parts", "-q", code=0)
        self.on(2, "run", "--resume", "--set", "time.end=0.4", "--out", "parts", "-q", code=0)
        self.assert_same_run("whole", "parts")

    def test_stopped_on_three_goes_on_on_two(self):
        arguments = [SMALL, *POT, "--set", "time.end=0.3"]
        self.scree("run", *arguments, "--out", "whole", "-q", code=0)
        self.on(3, "run", SMALL, *POT, "--set", "time.end=0.1", "--out", "parts", "-q", code=0)
        self.on(2, "run", "--resume", "--out", "parts", "--set", "time.end=0.2", "-q", code=0)
        self.scree("run", "--resume", "--out", "parts", "--set", "time.end=0.25", "-q", code=0)
        self.on(4, "run", *arguments, "--resume", "--out", "parts", "-q", code=0)
        self.assert_same_run("whole", "parts")


class Reports(MpiTest):
    def test_each_rank_is_in_the_summary_and_the_log(self):
        result = self.on(3, "run", SMALL, "--set", "time.end=0.05", "--out", "run", code=0)
        self.assertIn("on 3 ranks", result.err)
        self.assertEqual(result.err.count("small bowl"), 1)
        self.assertEqual(result.out.count("complete"), 1)
        summary = self.summary("run")
        section = summary[summary.index("\nranks:"):]
        self.assertIn("number: 3", section)
        for name in ("bodies", "ghosts", "contacts", "wait", "work", "solve", "output"):
            numbers = re.search(rf"\n    {name}: \[(.*)\]", section).group(1).split(", ")
            self.assertEqual(len(numbers), 3, name)
        bodies = re.search(r"\n    bodies: \[(.*)\]", section).group(1).split(", ")
        self.assertEqual(sum(map(int, bodies)), int(self.value("run", "bodies")))
        self.assertGreaterEqual(float(re.search(r"imbalance: ([0-9.]+)", section).group(1)), 1.0)
        with open(self.path("run/run.jsonl"), encoding="utf-8") as file:
            self.assertIn('"kind":"ranks"', file.read())

    def test_overlaps_between_parts_are_counted_once(self):
        more = ["--set", "bodies[0].pitch=8 mm"]
        alone = self.scree("run", SMALL, *more, "--set", "time.end=0.002", "--out", "a", code=0).err
        self.assertIn("pairs overlap", alone)
        for n in (2, 5):
            many = self.on(n, "run", SMALL, *more, "--set", "time.end=0.002", "--out", f"n{n}", code=0).err
            warning = re.compile(r"warning: .*")
            self.assertEqual(warning.findall(alone), warning.findall(many))


if __name__ == "__main__":
    main()
