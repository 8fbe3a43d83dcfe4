"""Every exit code, and that what goes wrong leaves nothing behind and nothing damaged."""

import os
import resource
import signal
import unittest

from scree_cli import SMALL, CliTest, main


class ExitCodes(CliTest):
    def test_complete(self):
        result = self.scree("run", SMALL, "--set", "time.end=0.05", code=0)
        self.assertIn("complete", result.out)
        self.assertEqual(self.value("out/small", "status"), "complete")
        for name in ("history.h5", "run.xdmf", "run.jsonl", "summary.yaml", "snapshots/000000.h5", "checkpoint"):
            self.assertTrue(os.path.exists(self.path("out/small", name)), name)

    def test_wrong_usage(self):
        for arguments, said in (
                ([], "usage: scree COMMAND"),
                (["rnu", SMALL], "did you mean 'run'?"),
                (["run"], "which scenario?"),
                (["run", "--resume"], "which run is to go on?"),
                (["run", SMALL, "--walltime", "soon"], "--walltime soon"),
                (["run", SMALL, "--resume", "--force"], "one of them"),
                (["run", SMALL, "-q", "-v"], "contradict"),
                (["run", SMALL, "--ouy", "x"], "--ouy"),
                (["run", SMALL, "another.yaml"], "another.yaml"),
                (["run", SMALL, "--set"], "--set"),
                (["check", SMALL, "--ranks", "0"], "--ranks"),
                (["compare", "a"], "b is required"),
                (["compare", "a", "b", "--tolerance", "-1"], "--tolerance"),
                (["explain", "solver.tolerence"], "tolerance"),
        ):
            with self.subTest(arguments):
                result = self.scree(*arguments, code=2)
                self.assertIn(said, result.err)
                self.assertEqual(result.out, "")
        self.assertEqual(os.listdir(self.folder), [])

    def test_wrong_scenario_writes_nothing(self):
        self.write("wrong.yaml", "scenario_version: 1\ntime: {end: 1 s, step: 6 kg}\n")
        for arguments in (["run", "wrong.yaml"], ["run", "missing.yaml"], ["run", SMALL, "--set", "time.end=-1"],
                          ["run", SMALL, "--set", "solver.tolerence=1"], ["check", "wrong.yaml"]):
            with self.subTest(arguments):
                result = self.scree(*arguments, code=3)
                self.assertIn("error:", result.err)
                self.assertEqual(result.out, "")
        self.assertEqual(os.listdir(self.folder), ["wrong.yaml"])

    def test_errors_name_their_place(self):
        self.write("wrong.yaml", "scenario_version: 1\ntime: {end: 1 s, step: 6 kg}\n")
        self.assertIn("wrong.yaml:2:", self.scree("run", "wrong.yaml", code=3).err)
        self.assertIn("^", self.scree("run", "wrong.yaml", code=3).err)

    def test_failed_physics(self):
        # A body so fast that its kinetic energy overflows.
        result = self.scree("run", SMALL, "--set", "bodies[0].velocity=[1e200, 0, 0]", "--set", "time.max_travel=0", code=5)
        self.assertIn("error:", result.err)
        self.assertEqual(self.value("out/small", "status"), "failed")
        self.assertNotIn("step_", "".join(os.listdir(self.path("out/small/checkpoint")))
                         if os.path.exists(self.path("out/small/checkpoint")) else "")

    def test_not_enough_memory(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        result = self.scree("check", SMALL, "--set", "bodies[0].cells=[1000, 1000, 60]", preexec_fn=limit)
        if "AddressSanitizer" in result.err:
            self.skipTest("the address sanitizer itself needs more memory than the test leaves")
        self.assertEqual(result.code, 70, result.err)
        self.assertIn("memory", result.err)

    def test_stopped_early(self):
        result = self.scree("run", SMALL, "--set", "time.end=1000", "--walltime", "1", code=75)
        self.assertIn("wall-time limit", result.out)
        self.assertIn("--resume --out", result.err)
        self.assertEqual(self.value("out/small", "status"), "stopped_early")

    def test_differing_results(self):
        self.scree("run", SMALL, "--set", "time.end=0.02", "--out", "a", "-q", code=0)
        self.scree("run", SMALL, "--set", "time.end=0.02", "--set", "seed=4", "--out", "b", "-q", code=0)
        self.scree("compare", "a", "a", code=0)
        self.assertIn("position", self.scree("compare", "a", "b", code=1).out)
        self.scree("compare", "a", "b", "--tolerance", "100", code=0)


class Files(CliTest):
    def test_folder_that_cannot_be_made(self):
        self.write("file", "")
        for out in ("file", "file/below", "/proc/scree"):
            self.assertIn(out, self.scree("run", SMALL, "--out", out, code=4).err)

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_folder_that_cannot_be_written(self):
        os.mkdir(self.path("locked"), 0o500)
        self.assertIn("locked", self.scree("run", SMALL, "--out", "locked", code=4).err)

    def test_results_are_not_overwritten(self):
        self.scree("run", SMALL, "--set", "time.end=0.02", code=0)
        before = self.state_hash("out/small")
        result = self.scree("run", SMALL, "--set", "time.end=0.03", code=4)
        for hint in ("--resume", "--force", "--out"):
            self.assertIn(hint, result.err)
        self.assertEqual(self.state_hash("out/small"), before)
        self.write("out/small/notes.txt", "mine")
        self.scree("run", SMALL, "--set", "time.end=0.03", "--force", code=0)
        self.assertNotEqual(self.state_hash("out/small"), before)
        self.assertTrue(os.path.exists(self.path("out/small/notes.txt")))

    def test_full_disk(self):
        # A limit on the size of files makes write() fail as a full disk does.
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (14000, 14000))
        result = self.scree("run", SMALL, "--set", "output.compression=0", "--set", "output.fields=[velocity, spin]",
                            preexec_fn=limit)
        self.assertEqual(result.code, 4, result.err)
        self.assertIn("error:", result.err)
        left = [f for _, _, files in os.walk(self.path("out")) for f in files]
        self.assertEqual([f for f in left if "tmp" in f], [], "half-written files")

    def test_full_disk_later_leaves_the_earlier_files_whole(self):
        self.scree("run", SMALL, "--set", "time.end=0.1", "--out", "run", code=0)
        kept = self.state_hash("run")
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
        self.assertEqual(self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.3", preexec_fn=limit).code, 4)
        self.scree("info", "run/snapshots/000002.h5", code=0)
        self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.1", code=0)
        self.assertEqual(self.state_hash("run"), kept)

    def test_standard_output_full(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = self.scree("schema", stdout=full)
            self.assertEqual(result.code, 4)
            self.assertIn("error:", result.err)

    def test_standard_error_full_does_not_end_a_run(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            import subprocess
            from scree_cli import SCREE, environment
            done = subprocess.run([SCREE, "run", SMALL, "--set", "time.end=0.02"], cwd=self.folder, env=environment(),
                                  stdout=subprocess.DEVNULL, stderr=full, check=False)
        self.assertEqual(done.returncode, 0)

    def test_reader_of_standard_output_goes_away(self):
        import subprocess
        from scree_cli import SCREE, environment
        done = subprocess.run(f"'{SCREE}' run '{SMALL}' --set time.end=0.02 2>&1 | true", shell=True, cwd=self.folder,
                              env=environment(), check=False)
        self.assertEqual(done.returncode, 0)
        # The run itself goes on to its end.
        self.assertEqual(self.value("out/small", "status"), "complete")


if __name__ == "__main__":
    main()
