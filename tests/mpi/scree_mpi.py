"""Runs the scree program under mpirun, on more ranks than there are cores."""

import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))

from scree_cli import SCREE, SMALL, CliTest, Result, environment, main  # noqa: E402  (the path must be set first)

MPIRUN = os.environ.get("SCREE_MPIRUN", "mpirun")
SCENARIOS = os.path.join(os.path.dirname(SMALL), "..", "..", "scenarios")

# The grains stay in a pot and are stirred: enough steps to be stopped in the middle.
POT = ["--set", "walls[0]={shape: disc, name: bowl, material: glass, centre: [0, 0, 0], radius: 70 mm}"]


def command(ranks, *arguments, wrapper=()):
    return [MPIRUN, "--oversubscribe", "-n", str(ranks), *wrapper, SCREE, *arguments]


def said(text):
    """What scree itself wrote to standard error, without what mpirun adds about exit codes."""
    lines, inside = [], False
    for line in text.splitlines():
        if line.startswith("-----"):
            inside = not inside
        elif not inside and not line.startswith("mpirun:"):
            lines.append(line)
    return lines


class MpiTest(CliTest):
    def on(self, ranks, *arguments, code=None, wrapper=()):
        """Runs it on so many ranks and, if `code` is given, demands that exit code of mpirun."""
        done = subprocess.run(command(ranks, *arguments, wrapper=wrapper), cwd=self.folder, env=environment(), text=True,
                              timeout=300, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              check=False)
        if code is not None:
            self.assertEqual(done.returncode, code, f"{ranks} ranks: {arguments}\n{done.stdout}\n{done.stderr}")
        return Result(done.returncode, done.stdout, done.stderr)

    def started(self, ranks, out, *arguments, after="snapshots/000001.h5"):
        """Starts a run and waits until it has written the file `after`."""
        process = subprocess.Popen(command(ranks, "run", *arguments, "--out", out), cwd=self.folder, env=environment(),
                                   text=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE)
        for _ in range(6000):
            if os.path.exists(self.path(out, after)):
                return process
            if process.poll() is not None:
                break
            time.sleep(0.01)
        process.kill()
        self.fail(f"the run did not start: {process.stderr.read()}")
        return None

    def ended(self, process, timeout=60):
        """Its exit code and what it said; it must not hang."""
        try:
            _, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            self.fail("the run hangs")
        return Result(process.returncode, "", err)

    def pids_of_ranks(self, process):
        """Process ids of the ranks that an mpirun started, by rank."""
        pids = {}
        for entry in os.listdir("/proc"):
            if not entry.isdigit():
                continue
            try:
                with open(f"/proc/{entry}/stat", encoding="utf-8") as file:
                    parent = int(file.read().rsplit(")", 1)[1].split()[1])
                if parent != process.pid:
                    continue
                with open(f"/proc/{entry}/environ", encoding="utf-8", errors="replace") as file:
                    env = dict(item.split("=", 1) for item in file.read().split("\0") if "=" in item)
            except OSError:  # it has ended
                continue
            if "OMPI_COMM_WORLD_RANK" in env:
                pids[int(env["OMPI_COMM_WORLD_RANK"])] = int(entry)
        return pids
