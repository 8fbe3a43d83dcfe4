"""tools/packages.txt, tools/lib.sh, tools/quickstart and tools/test: what can be tried without installing anything."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from helpers import ROOT, TOOLS


def bash(script, **environment):
    return subprocess.run(["bash", "-c", f"set -euo pipefail; source '{TOOLS}/lib.sh'; {script}"], text=True,
                          capture_output=True, stdin=subprocess.DEVNULL, env={**os.environ, **environment}, check=False)


class Packages(unittest.TestCase):
    def names(self):
        lines = (line.split("#")[0].strip() for line in (TOOLS / "packages.txt").read_text().splitlines())
        return [line for line in lines if line]

    def test_one_valid_name_a_line_and_none_twice(self):
        names = self.names()
        self.assertGreater(len(names), 20)
        self.assertEqual(len(names), len(set(names)))
        for name in names:  # Debian policy 5.6.1
            self.assertRegex(name, r"^[a-z0-9][a-z0-9+.-]+$")

    def test_the_scripts_read_the_same_list(self):
        self.assertEqual(bash("list_packages").stdout.split(), self.names())

    @unittest.skipUnless(shutil.which("dpkg-query"), "no dpkg")
    def test_missing_packages_are_found(self):
        with tempfile.TemporaryDirectory(prefix="a root ") as folder:
            tools = pathlib.Path(folder) / "tools"
            tools.mkdir()
            shutil.copy(TOOLS / "lib.sh", tools)
            (tools / "packages.txt").write_text("# a comment\nbash  # is always there\nno-such-package-1\n")
            got = subprocess.run(["bash", "-c", f"source '{tools}/lib.sh'; missing_packages"], text=True,
                                 capture_output=True, check=True)
            self.assertEqual(got.stdout.split(), ["no-such-package-1"])
            # Without root and sudo: what to type, and an exit code of its own.
            got = subprocess.run(["bash", "-c", f"source '{tools}/lib.sh'; root_prefix() {{ return 1; }}; "
                                  "require_packages; echo went on"], text=True, capture_output=True, check=False)
            self.assertEqual((got.returncode, got.stdout), (69, ""))
            self.assertIn("apt-get install --yes --no-install-recommends no-such-package-1", got.stderr)

    @unittest.skipUnless(shutil.which("dpkg-query"), "no dpkg")
    def test_nothing_missing_needs_no_root_and_no_apt(self):
        if bash("missing_packages").stdout:
            self.skipTest("packages are missing on this machine")
        got = bash("apt_install() { echo apt; exit 1; }; root_prefix() { echo root; exit 1; }; require_packages")
        self.assertEqual((got.returncode, got.stdout, got.stderr), (0, "", ""))

    def test_apt_is_tried_twice_and_then_given_up(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder) / "log"
            apt = pathlib.Path(folder) / "apt-get"
            apt.write_text(f'#!/bin/sh\necho "$@" >> "{log}"\n'
                           'case "$*" in *update*|*--simulate*) exit 0;; esac\nexit 100\n')
            apt.chmod(0o755)
            got = bash("apt_install '' a-package", PATH=f"{folder}:{os.environ['PATH']}")
            self.assertNotEqual(got.returncode, 0)
            calls = log.read_text().splitlines()
            installs = [call for call in calls if "install" in call and "--simulate" not in call]
            self.assertEqual(len(installs), 2)
            for call in installs:
                self.assertIn("--no-install-recommends", call)
            self.assertEqual(sum(call.endswith("update") for call in calls), 1)


class Scripts(unittest.TestCase):
    def test_syntax(self):
        for name in ("tools/lib.sh", "tools/quickstart", "tools/test", ".ci/run", "tools/completion/scree.bash"):
            self.assertEqual(subprocess.run(["bash", "-n", ROOT / name], check=False).returncode, 0, name)

    def test_help_and_wrong_arguments(self):
        for name in ("quickstart", "test"):
            for argument, code in (("--help", 0), ("--nonsense", 2)):
                got = subprocess.run([TOOLS / name, argument], cwd="/", capture_output=True, text=True, check=False)
                self.assertEqual(got.returncode, code)
                self.assertIn("Usage:", got.stdout + got.stderr)
        got = subprocess.run([TOOLS / "quickstart", "scenarios/none.yaml"], capture_output=True, text=True, check=False)
        self.assertEqual(got.returncode, 2)
        self.assertIn("no scenario 'scenarios/none.yaml'", got.stderr)

    def test_found_through_a_link(self):
        with tempfile.TemporaryDirectory() as folder:
            link = pathlib.Path(folder) / "my test"
            link.symlink_to(TOOLS / "test")
            got = subprocess.run([link, "--help"], cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(got.returncode, 0, got.stderr)

    def test_ci_calls_the_test_command_of_the_readme(self):
        readme = ROOT / "README.md"
        self.assertRegex((ROOT / ".ci" / "run").read_text(), r'(?m)^check "tests" tools/test$')
        if readme.exists():
            self.assertTrue(re.search(r"tools/test\b", readme.read_text()))


if __name__ == "__main__":
    unittest.main()
