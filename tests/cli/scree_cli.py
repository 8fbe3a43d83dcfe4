"""Runs the scree program of the build as a user would, in a folder of its own a test."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
SMALL = os.path.join(HERE, "small.yaml")
SCREE = os.environ["SCREE_PROGRAM"]


def environment(**changes):
    env = {k: v for k, v in os.environ.items() if not k.startswith("SLURM") and k != "NO_COLOR"}
    env.update(changes)
    return env


class Result:
    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err


class CliTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="scree_cli_")

    def tearDown(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def scree(self, *arguments, code=None, env=None, cwd=None, **options):
        """Runs it and, if `code` is given, demands that exit code."""
        done = subprocess.run([SCREE, *arguments], cwd=cwd or self.folder, env=env or environment(), text=True,
                              stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE, timeout=100,
                              stdin=subprocess.DEVNULL, **options)
        if code is not None:
            self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return Result(done.returncode, done.stdout, done.stderr)

    def start(self, *arguments):
        """Starts it and does not wait."""
        return subprocess.Popen([SCREE, *arguments], cwd=self.folder, env=environment(), text=True,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)

    def summary(self, run):
        with open(self.path(run, "summary.yaml"), encoding="utf-8") as file:
            return file.read()

    def value(self, run, key):
        found = re.search(rf'^{key}: "?([^"#\n]*)"?', self.summary(run), re.MULTILINE)
        self.assertIsNotNone(found, f"{key} is not in the summary of {run}")
        return found.group(1).strip()

    def state_hash(self, run):
        return self.value(run, "state_hash")

    def assert_same_run(self, a, b):
        """The same final bits, snapshots and history."""
        self.assertEqual(self.state_hash(a), self.state_hash(b))
        self.scree("compare", a, b, code=0)


def main():
    unittest.main(verbosity=2)
