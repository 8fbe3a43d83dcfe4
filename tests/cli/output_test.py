"""What is shown: help, version, progress with and without a terminal, and the commands that only print."""

import json
import os
import pty
import re
import subprocess

from scree_cli import HERE, SCREE, SMALL, CliTest, environment, main

GOLDEN = os.path.join(HERE, "golden")


class Texts(CliTest):
    def golden(self, name, text):
        """Compares with the file of that name; SCREE_UPDATE_GOLDEN=1 rewrites it."""
        path = os.path.join(GOLDEN, name)
        if os.environ.get("SCREE_UPDATE_GOLDEN"):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        with open(path, encoding="utf-8") as file:
            self.assertEqual(text, file.read())

    def test_help(self):
        self.golden("help.txt", self.scree("--help", code=0).out)
        self.assertEqual(self.scree("-h", code=0).out, self.scree("help", code=0).out)

    def test_help_of_each_command(self):
        for command in ("run", "check", "info", "compare", "explain", "schema"):
            with self.subTest(command):
                text = self.scree(command, "--help", code=0).out
                self.golden(f"help_{command}.txt", text)
                self.assertLess(max(map(len, text.splitlines())), 131)

    def test_the_scenario_of_the_help_runs(self):
        lines = self.scree("--help", code=0).out.splitlines()
        first = next(i for i, line in enumerate(lines) if line.startswith("a first scenario"))
        last = next(i for i, line in enumerate(lines) if line.startswith("Numbers are SI"))
        self.write("first.yaml", "\n".join(line[2:] for line in lines[first + 1:last]))
        self.assertNotIn("warning", self.scree("check", "first.yaml", code=0).out.replace("no warnings", ""))
        self.scree("run", "first.yaml", "--set", "time.end=0.02", code=0)

    def test_bad_scenario_golden(self):
        self.write("bad.yaml", """\
scenario_version: 1
time: {end: 1 s, step: 6 kg}
materials:
  glass: {density: 2.5 g/cm3, frictoin: 0.4}
bodies:
  - {generator: lattice, material: glas, corner: [0, 0, 0], pitch: 1 cm, cells: [2, 2, 0],
     size: {distribution: fixed, diameter: 5 mm}}
walls:
  - {shape: plain, name: floor, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}
""")
        self.golden("bad_scenario.txt", self.scree("run", "bad.yaml", code=3).err)

    def test_version(self):
        text = self.scree("--version", code=0).out
        for word in ("scree 0.", "revision", "HDF5", "Eigen", "yaml-cpp"):
            self.assertIn(word, text)

    def test_check(self):
        text = self.scree("check", SMALL, code=0).out
        for word in ("small.yaml: valid", "96 bodies", "wall        bowl: cone", "stirrer: disc, moves", "300 steps",
                     "on   friction", "off  inlets", "snapshots", "no warnings"):
            self.assertIn(word, text)
        self.assertEqual(os.listdir(self.folder), [])

    def test_check_shares_bodies_out(self):
        text = self.scree("check", SMALL, "--ranks", "3", code=0).out
        self.assertIn("3 ranks at the start", text)
        rows = re.findall(r"(?m)^  (\d+) +(\d+) +(\d+) +(\d+) +\S+ \S+$", text)
        self.assertEqual([int(row[0]) for row in rows], [0, 1, 2])
        self.assertEqual(sum(int(row[1]) for row in rows), 96)
        self.assertGreater(min(int(row[1]) for row in rows), 0)
        self.assertGreater(sum(int(row[3]) for row in rows), 0)
        # Few lines for many ranks, and more ranks than bodies.
        text = self.scree("check", SMALL, "--ranks", "5000", code=0).out
        self.assertLess(len(text.splitlines()), 60)
        self.assertRegex(text, r"imbalance [0-9]{2,}[.]")  # of 96 / 5000 bodies a rank

    def test_check_warns(self):
        text = self.scree("check", SMALL, "--set", "time.step=0.02", "--set", "time.end=0.05", "--set",
                          "bodies[0].pitch=8 mm", "--set", "bodies[0].velocity=[0, 0, -5]", code=0).out
        for word in ("pairs overlap", "sqrt(d/g)", "moves 100 mm", "no multiple of time.step"):
            self.assertIn(word, text)

    def test_a_wall_in_the_bodies_is_found(self):
        wall = "walls[+]={shape: plane, name: knife, material: glass, point: [0, 0, 60 mm], normal: [0, 0, 1]}"
        self.assertIn("wall 'knife'", self.scree("check", SMALL, "--set", wall, code=0).out)
        result = self.scree("run", SMALL, "--set", wall, "--set", "time.end=0.002", code=0)
        self.assertIn("wall 'knife'", result.err)
        self.assertIn("wall 'knife'", self.summary("out/small"))

    def test_info(self):
        self.scree("run", SMALL, "--set", "time.end=0.02", code=0)
        self.assertIn("96", self.scree("info", "out/small/snapshots/000000.h5", code=0).out)
        self.assertIn("small bowl", self.scree("info", "out/small", code=0).out)
        self.scree("info", "out/small/summary.yaml", code=0)
        self.assertIn("nothing.h5", self.scree("info", "nothing.h5", code=4).err)
        self.write("text.h5", "not HDF5")
        self.assertIn("text.h5", self.scree("info", "text.h5", code=4).err)

    def test_explain_and_schema(self):
        text = self.scree("explain", "time.step", code=0).out
        self.assertIn("time.step", text)
        self.assertIn("solver", self.scree("explain", code=0).out)
        schema = json.loads(self.scree("schema", code=0).out)
        self.assertIn("properties", schema)
        self.assertTrue(self.scree("schema", "--reference", code=0).out.startswith("# "))

    def test_run_log(self):
        self.scree("run", SMALL, "--set", "time.end=0.02", code=0)
        with open(self.path("out/small/run.jsonl"), encoding="utf-8") as file:
            kinds = [json.loads(line)["kind"] for line in file]
        self.assertEqual(kinds, ["provenance", "progress", "status"])


class Progress(CliTest):
    LONG = ["run", SMALL, "--set", "time.end=600", "--walltime", "2", "--out", "run"]

    def on_terminal(self, **env):
        """What it writes to a terminal."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen([SCREE, *self.LONG], cwd=self.folder, env=environment(TERM="xterm", **env),
                                   stdout=subprocess.DEVNULL, stderr=theirs, stdin=subprocess.DEVNULL)
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # the terminal is closed
                break
            if not part:
                break
            text += part
        os.close(ours)
        self.assertEqual(process.wait(), 75)
        return text.decode()

    def test_one_line_is_rewritten(self):
        text = self.on_terminal()
        self.assertGreater(text.count("\r\x1b[K"), 2)
        for word in ("%", "contacts", " left"):
            self.assertIn(word, text)
        for line in text.replace("\r\x1b[K", "\n").splitlines():
            self.assertLess(len(line), 80 if "|" in line else 200)

    def test_no_color(self):
        wall = "walls[+]={shape: plane, name: knife, material: glass, point: [0, 0, 60 mm], normal: [0, 0, 1]}"
        self.LONG = [*self.LONG, "--set", wall]
        self.assertIn("\x1b[33m", self.on_terminal())
        self.LONG = [*self.LONG, "--force"]
        self.assertNotIn("\x1b[3", self.on_terminal(NO_COLOR="1"))

    def test_plain_lines_without_a_terminal(self):
        result = self.scree(*self.LONG, "--set", "output.report_interval=0.5", code=75)
        self.assertNotIn("\x1b", result.err + result.out)
        self.assertNotIn("\r", result.err)
        self.assertGreater(result.err.count("residual"), 1)

    def test_quiet(self):
        result = self.scree("run", SMALL, "--set", "time.end=0.02", "-q", code=0)
        self.assertEqual((result.out, result.err), ("", ""))

    def test_verbose(self):
        result = self.scree("run", SMALL, "--set", "time.end=0.02", "-v", code=0)
        for word in ("on  friction", "snapshot 000000", "checkpoint"):
            self.assertIn(word, result.err)


if __name__ == "__main__":
    main()
