"""The completion for bash offers the commands, options and files that the program takes."""
import pathlib
import subprocess
import tempfile
import unittest

from helpers import ROOT
from program import COMMANDS, PROGRAM, long_options

SCRIPT = ROOT / "tools" / "completion" / "scree.bash"


def complete(*words, folder="/", program="scree"):
    """What is offered for the last word."""
    quoted = " ".join(f"'{word}'" for word in (program, *words))
    script = (f"source '{SCRIPT}'; COMP_WORDS=({quoted}); COMP_CWORD={len(words)}; _scree; "
              'printf "%s\\n" "${COMPREPLY[@]}"')
    result = subprocess.run(["bash", "--norc", "-c", script], cwd=folder, capture_output=True, text=True, check=True)
    return result.stdout.split()


class Completion(unittest.TestCase):
    def test_commands(self):
        self.assertEqual(complete("")[:len(COMMANDS)], COMMANDS)
        self.assertEqual(complete("co"), ["compare"])

    def test_options(self):
        self.assertIn("--resume", complete("run", "--"))
        self.assertNotIn("--resume", complete("check", "--"))
        self.assertEqual(complete("compare", "--t"), ["--tolerance"])

    def test_scenarios_are_yaml_files_and_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.yaml", "b.h5"):
                (pathlib.Path(folder) / name).touch()
            (pathlib.Path(folder) / "sub").mkdir()
            self.assertEqual(sorted(complete("run", "", folder=folder)), ["a.yaml", "sub"])
            self.assertEqual(sorted(complete("info", "", folder=folder)), ["a.yaml", "b.h5", "sub"])

    @unittest.skipUnless(PROGRAM, "the program is not built")
    def test_offers_what_the_program_takes(self):
        for command in COMMANDS:
            offered = set(complete(command, "--", program=PROGRAM))
            self.assertEqual(offered - {"--help"}, long_options(command) - {"--help"}, command)

    @unittest.skipUnless(PROGRAM, "the program is not built")
    def test_keys_come_from_the_program(self):
        self.assertIn("solver.tolerance", complete("explain", "solver.", program=PROGRAM))
        self.assertIn("time.step=", complete("check", "x.yaml", "--set", "time.s", program=PROGRAM))


if __name__ == "__main__":
    unittest.main()
