"""The shipped scenarios on real ground run: no warning, no energy from nowhere, little overlap, and a run that stops
goes on to the same bits."""

import os
import re
import unittest

from scree_cli import CliTest, HERE, main

SCENARIOS = os.path.join(os.path.dirname(os.path.dirname(HERE)), "scenarios")


class MassMovements(CliTest):
    def run_short(self, name, end, out, *more):
        return self.scree("run", os.path.join(SCENARIOS, f"{name}.yaml"), "--out", out, "--set", f"time.end={end}",
                          "--set", "output.snapshot_interval=10", *more, code=0)

    def check(self, name, end, bodies):
        err = self.run_short(name, end, name, "-q").err
        self.assertEqual(err, "")
        self.assertEqual(int(self.value(name, "bodies")), bodies)
        self.assertLess(abs(float(self.value(name, "  drift"))), 1e-9)
        self.assertLess(float(self.value(name, "  max_relative_to_diameter")), 0.05)
        self.assertGreater(float(self.value(name, "  kinetic")), 0.0)
        self.assertEqual(float(self.value(name, "  volume_beyond")), 0.0)

    def test_rock_avalanche(self):
        self.check("rock_avalanche", 0.2, 5751)

    def test_landslide(self):
        self.check("landslide", 0.1, 22796)

    def test_rockfall(self):
        self.check("rockfall", 2, 93)

    def test_check_tells_the_released_volume(self):
        out = self.scree("check", os.path.join(SCENARIOS, "rock_avalanche.yaml"), code=0).out
        found = re.search(r"release     ([0-9.e+]+) m3 above the sliding planes of 'ground'", out)
        self.assertIsNotNone(found, out)
        self.assertAlmostEqual(float(found.group(1)), 1.0e6, delta=5e4)

    def test_a_resumed_avalanche_has_the_same_scar(self):
        self.run_short("rock_avalanche", 0.1, "whole", "-q")
        self.run_short("rock_avalanche", 0.05, "parts", "-q")
        self.scree("run", "--resume", "--out", "parts", "--set", "time.end=0.1", "-q", code=0)
        self.assertEqual(self.state_hash("whole"), self.state_hash("parts"))


if __name__ == "__main__":
    main()
