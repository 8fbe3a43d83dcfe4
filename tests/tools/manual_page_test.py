"""The manual page: formatted without warnings, and complete."""
import re
import shutil
import subprocess
import unittest

from helpers import ROOT
from program import COMMANDS, PROGRAM, help_of, long_options

PAGE = ROOT / "tools" / "man" / "scree.1"


def source():
    return PAGE.read_text().replace("\\-", "-")


class ManualPage(unittest.TestCase):
    @unittest.skipUnless(shutil.which("groff"), "no groff")
    def test_groff_has_no_complaint(self):
        got = subprocess.run(["groff", "-man", "-Tutf8", "-ww", PAGE], capture_output=True, text=True, check=False)
        self.assertEqual((got.returncode, got.stderr), (0, ""))
        self.assertIn("granular flow", got.stdout)

    def test_all_commands_have_an_entry(self):
        for command in COMMANDS:
            self.assertRegex(source(), rf"(?m)^\.B {command}$")

    def test_exit_codes_are_those_of_the_program(self):
        section = source().split(".SH EXIT STATUS")[1].split(".SH ")[0]
        listed = {int(code) for code in re.findall(r"(?m)^\.B (\d+)$", section)}
        errors = (ROOT / "core" / "errors.hpp").read_text()
        declared = {int(code) for code in re.findall(r"(?m)^    \w+ = (\d+),", errors)}
        self.assertEqual(listed, declared | {1})  # 1: compare found a difference

    @unittest.skipUnless(PROGRAM, "the program is not built")
    def test_all_options_of_the_program(self):
        for command in COMMANDS:
            for option in long_options(command):
                self.assertIn(option, source(), command)

    @unittest.skipUnless(PROGRAM, "the program is not built")
    def test_commands_are_those_of_the_program(self):
        section = help_of().split("commands\n")[1].split("\n\n")[0]
        self.assertEqual(re.findall(r"(?m)^  ([a-z]+)  ", section), COMMANDS)


if __name__ == "__main__":
    unittest.main()
