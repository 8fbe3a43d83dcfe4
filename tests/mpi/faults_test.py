"""Stops, errors and killed ranks under mpirun: the documented exit code, one message, no hang, and the same bits after
--resume on another number of ranks."""

import os
import resource
import signal

from scree_mpi import POT, SMALL, MpiTest, main, said

LONG = [SMALL, *POT, "--set", "time.end=20", "--set", "output.snapshot_interval=0.05", "-q"]


class Stops(MpiTest):
    def goes_on(self, out):
        """Goes on until 20 steps after where it stood, and compares with a run that was not stopped."""
        self.assertEqual(self.value(out, "status"), "stopped_early")
        steps = int(self.value(out, "steps"))
        self.assertGreater(steps, 0)
        end = f"time.end={(steps + 20) * 1e-3}"
        self.on(2, "run", "--resume", "--out", out, "--set", end, "-q", code=0)
        self.scree("run", *LONG, "--set", end, "--out", f"{out}-whole", code=0)
        self.assertEqual(self.state_hash(f"{out}-whole"), self.state_hash(out))

    def test_signal_to_mpirun(self):
        process = self.started(3, "run", *LONG)
        process.send_signal(signal.SIGUSR1)
        result = self.ended(process)
        self.assertEqual(result.code, 75, result.err)
        self.assertIn("SIGUSR1", self.value("run", "reason"))
        self.goes_on("run")

    def test_signal_to_one_rank(self):
        process = self.started(3, "run", *LONG)
        os.kill(self.pids_of_ranks(process)[2], signal.SIGUSR1)
        self.assertEqual(self.ended(process).code, 75)

    def test_stop_file(self):
        process = self.started(3, "run", *LONG)
        self.write("run/stop_now", "")
        self.assertEqual(self.ended(process).code, 75)
        self.assertFalse(os.path.exists(self.path("run/stop_now")))
        self.assertIn("stop_now", self.value("run", "reason"))

    def test_wall_time(self):
        self.on(2, "run", *LONG, "--out", "run", "--walltime", "2", code=75)
        self.assertIn("wall-time limit", self.value("run", "reason"))
        self.goes_on("run")


class Errors(MpiTest):
    def one_message(self, result, word):
        lines = [line for line in said(result.err) if "error:" in line]
        self.assertEqual(len(lines), 1, result.err)
        self.assertIn(word, lines[0])

    def test_wrong_scenario(self):
        self.write("wrong.yaml", "scenario_version: 1\ntime: {end: 1 s, step: 1 ms}\nmaterials: {}\nfrictoin: 1\n")
        self.one_message(self.on(3, "run", "wrong.yaml", code=3), "frictoin")
        self.one_message(self.on(3, "run", "missing.yaml", code=3), "missing.yaml")
        self.assertEqual(os.listdir(self.folder), ["wrong.yaml"])

    def test_fault_in_a_file_of_bodies(self):
        self.write("bed.txt", "0 0 1 0.1\n" * 50 + "0 0 x 0.1\n")
        bodies = "bodies=[{generator: file, path: bed.txt, material: glass}]"
        self.write("bed.yaml", "scenario_version: 1\ntime: {end: 1 s, step: 1 ms}\n"
                               "materials: {glass: {density: 2500, friction: 0.1, restitution: 0}}\n")
        self.one_message(self.on(3, "run", "bed.yaml", "--set", bodies, code=3), "bed.txt:51:5")

    def test_wrong_usage_and_files(self):
        self.one_message(self.on(3, "run", SMALL, "--walltime", "soon", code=2), "--walltime soon")
        self.one_message(self.on(3, "run", "--resume", "--out", "nothing", code=4), "no checkpoint")
        self.one_message(self.on(2, "info", "nothing.h5", code=4), "nothing.h5")

    def test_failed_physics(self):
        result = self.on(3, "run", SMALL, "--set", "bodies[0].velocity=[1e200, 0, 0]", "--set", "time.max_travel=0",
                         "-q", code=5)
        self.one_message(result, "no longer finite")
        self.assertEqual(self.value("out/small", "status"), "failed")

    def test_other_commands_run_once(self):
        self.assertEqual(self.on(3, "check", SMALL, code=0).out.count("valid"), 1)
        self.on(1, "run", SMALL, "--set", "time.end=0.01", "--out", "a", "-q", code=0)
        self.on(2, "run", SMALL, "--set", "time.end=0.01", "--set", "seed=9", "--out", "b", "-q", code=0)
        self.on(3, "compare", "a", "b", code=1)

    def test_memory_of_one_rank(self):
        # All bodies are made by rank 1, which has little memory; rank 0 waits for it.
        limited = ["sh", "-c", 'test "$OMPI_COMM_WORLD_RANK" = 1 && ulimit -v 1000000; exec "$0" "$@"']
        clip = "bodies[0].clip={shape: half_space, point: [0, 0, 360], normal: [0, 0, -1]}"
        more = ["--set", "bodies[0].cells=[1000, 1000, 60]", "--set", "bodies[0].pitch=12", "--set", clip]
        result = self.on(2, "run", SMALL, *more, code=70, wrapper=limited)
        self.one_message(result, "rank 1 of 2: there is not enough memory")
        self.assertEqual(os.listdir(self.folder), [])


class Kills(MpiTest):
    def test_killed_rank(self):
        for rank in (0, 2):
            with self.subTest(rank=rank):
                out = f"killed-{rank}"
                process = self.started(3, out, *LONG, "--set", "output.checkpoint_interval=0.3",
                                       after="snapshots/000004.h5")
                os.kill(self.pids_of_ranks(process)[rank], signal.SIGKILL)
                self.assertNotEqual(self.ended(process).code, 0)
                end = "time.end=0.3"
                self.on(2, "run", *LONG, "--set", end, "--resume", "--out", out, code=0)
                left = [f for _, _, files in os.walk(self.path(out)) for f in files if f.endswith((".tmp", ".part"))]
                self.assertEqual(left, [])
                self.scree("run", *LONG, "--set", end, "--out", f"{out}-whole", code=0)
                self.assert_same_run(f"{out}-whole", out)

    def test_full_disk_of_one_rank(self):
        process = self.started(3, "full", *LONG, "--set", "output.checkpoint_interval=0.3",
                               after="snapshots/000002.h5")
        # A limit on the size of files makes write() fail as a full disk does.
        resource.prlimit(self.pids_of_ranks(process)[1], resource.RLIMIT_FSIZE, (2000, 2000))
        result = self.ended(process)
        self.assertEqual(result.code, 4, result.err)
        self.assertEqual(len([line for line in said(result.err) if "error:" in line]), 1, result.err)
        left = [f for _, _, files in os.walk(self.path("full")) for f in files if f.endswith((".tmp", ".part"))]
        self.assertEqual(left, [], "half-written files")
        self.scree("info", "full/snapshots/000002.h5", code=0)
        self.on(2, "run", *LONG, "--set", "time.end=0.3", "--resume", "--out", "full", code=0)


if __name__ == "__main__":
    main()
