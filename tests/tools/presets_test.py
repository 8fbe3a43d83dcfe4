"""CMakePresets.json: every preset can be configured, built and tested by one name."""
import json
import subprocess
import unittest

from helpers import ROOT


class Presets(unittest.TestCase):
    def setUp(self):
        self.presets = json.loads((ROOT / "CMakePresets.json").read_text())

    def names(self, kind):
        return [preset["name"] for preset in self.presets[kind] if not preset.get("hidden")]

    def test_same_names_everywhere(self):
        self.assertEqual(self.names("configurePresets"), self.names("buildPresets"))
        self.assertEqual(self.names("configurePresets"), self.names("testPresets"))

    def test_cmake_reads_them(self):
        got = subprocess.run(["cmake", "--list-presets=all"], cwd=ROOT, capture_output=True, text=True, check=False)
        self.assertEqual(got.returncode, 0, got.stderr)
        for name in ("release", "portable", "dev", "debug", "asan-ubsan", "coverage", "ci"):
            self.assertEqual(got.stdout.count(f'"{name}"'), 3)

    def test_every_cache_variable_is_an_option_of_the_project(self):
        known = (ROOT / "CMakeLists.txt").read_text()
        for preset in self.presets["configurePresets"]:
            for name in preset.get("cacheVariables", {}):
                self.assertTrue(name.startswith("CMAKE_") or f"option({name} " in known, name)

    def test_none_changes_the_rules_of_arithmetic(self):
        text = (ROOT / "CMakePresets.json").read_text()
        for flag in ("-ffast-math", "-Ofast", "-funsafe-math", "-ffp-contract"):
            self.assertNotIn(flag, text)


if __name__ == "__main__":
    unittest.main()
