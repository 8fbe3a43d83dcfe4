"""Terrain from the command line: what check and explain say, faults of its file, a moved scene, a run that goes on."""

import json
import os
import subprocess
import unittest

from scree_cli import CliTest, main

# The system's Python has h5py where the one that runs this may not.
PYTHON = "/usr/bin/python3"
BODIES = """import h5py, json, sys
with h5py.File(sys.argv[1]) as file: print(json.dumps([file["bodies/" + name][:].tolist() for name in sys.argv[2:]]))"""
HAS_H5PY = os.path.exists(PYTHON) and subprocess.run([PYTHON, "-c", "import h5py"], capture_output=True,
                                                     check=False).returncode == 0

SCENE = """\
scenario_version: 1
time: {{end: 0.5 s, step: 1 ms}}
materials:
  rock: {{density: 2700 kg/m3, friction: 0.5, restitution: 0.3}}
bodies:
  - {{generator: lattice, material: rock, corner: [{x}.25, {y}.25, 1.5], pitch: 0.25, cells: [6, 6, 1],
     size: {{distribution: fixed, diameter: 0.2}}, velocity: [1, 0.5, 0]}}
walls:
  - {{shape: terrain, name: hills, material: rock, path: data/hills.asc}}
output: {{fields: [velocity], snapshot_interval: 0.25 s}}
"""


class Terrain(CliTest):
    def scene(self, name, x=0, y=0):
        rows = [" ".join(f"{0.03 * ((7 * i + 5 * j * j) % 11):.2f}" for i in range(25)) for j in range(25)]
        os.makedirs(self.path(name, "data"), exist_ok=True)
        self.write(f"{name}/data/hills.asc", f"ncols 25\nnrows 25\nxllcenter {x}\nyllcenter {y}\ncellsize 0.125\n" +
                   "\n".join(rows))
        return self.write(f"{name}/scene.yaml", SCENE.format(x=x, y=y))

    def final(self, out):
        """Positions and velocities of all bodies, one row a body."""
        done = subprocess.run([PYTHON, "-c", BODIES, self.path(out, "snapshots/000002.h5"), "position", "velocity"],
                              capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    def test_check_says_what_it_is(self):
        out = self.scree("check", self.scene("a"), code=0).out
        self.assertIn("hills: terrain of 1152 triangles, 25 x 25 nodes 0.125 x 0.125 m apart, (0, 0, 0) m to "
                      "(3, 3, 0.3) m, open border", out)
        self.assertIn("on   terrain          wall `hills` is one", out)
        low = self.scree("check", self.scene("a"), "--set", "bodies[0].corner=[0.25, 0.25, -0.3]", code=0).out
        self.assertIn("36 ", low[low.index("warning"):])  # every one of them lies in the ground

    def test_explain(self):
        out = self.scree("explain", "walls[terrain].path", code=0).out
        self.assertIn(".asc.gz", out)
        self.assertIn("open", self.scree("explain", "walls[terrain].border", code=0).out)

    def test_faults_of_the_file(self):
        scene = self.scene("a")
        with open(self.path("a/data/hills.asc"), encoding="utf-8") as file:
            text = file.read()
        self.write("a/data/hills.asc", text.replace("0.30", "high", 1))
        result = self.scree("check", scene, code=3)
        self.assertRegex(result.err, r"data/hills\.asc:\d+:1: error: 'high' is no number")
        os.remove(self.path("a/data/hills.asc"))
        self.assertRegex(self.scree("run", scene, code=3).err, r"scene\.yaml:9:\d+: error: walls\[0\]\.path: .*hills\.asc")

    @unittest.skipUnless(HAS_H5PY, "no h5py")
    def test_a_scene_far_away_is_the_same(self):
        self.scree("run", self.scene("here"), "--out", "near", "-q", code=0)
        self.scree("run", self.scene("there", 5000000, 3000000), "--out", "far", "-q", code=0)
        (x, v), (far_x, far_v) = self.final("near"), self.final("far")
        self.assertEqual(len(x), 36)
        for near, far, shift in ((x, far_x, (5000000, 3000000, 0)), (v, far_v, (0, 0, 0))):
            for a, b in zip(near, far):
                for p, q, s in zip(a, b, shift):
                    self.assertLess(abs(q - s - p), 1e-6)
        self.assertGreater(max(abs(c) for row in v for c in row), 0.1)

    def test_goes_on_where_it_stopped(self):
        scene = self.scene("a")
        self.scree("run", scene, "--out", "whole", "-q", code=0)
        for again in (["--set", "time.end=0.5"], [scene]):  # by the checkpoint alone, and with the scenario
            self.scree("run", scene, "--out", "parts", "--set", "time.end=0.25", "--force", "-q", code=0)
            self.scree("run", *again, "--resume", "--out", "parts", "-q", code=0)
            self.assert_same_run("whole", "parts")

    def test_goes_on_with_the_same_terrain_only(self):
        scene = self.scene("a")
        self.scree("run", scene, "--out", "parts", "--set", "time.end=0.25", "-q", code=0)
        with open(self.path("a/data/hills.asc"), encoding="utf-8") as file:
            text = file.read()
        self.write("a/data/hills.asc", text.replace("0.30", "0.31", 1))
        for arguments in ([], [scene]):
            result = self.scree("run", *arguments, "--resume", "--out", "parts", "--set", "time.end=0.5", code=3)
            self.assertRegex(result.err, r"hills\.asc' is not the file that is meant: its checksum is sum-[0-9a-f]{16}, sum-")


if __name__ == "__main__":
    main()
