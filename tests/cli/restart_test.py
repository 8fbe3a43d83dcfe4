"""A run that is stopped or killed and goes on ends with the bits of one that was not."""

import os
import random
import shutil
import signal
import subprocess
import tempfile
import time

from scree_cli import SCREE, SMALL, CliTest, environment, main

# The grains stay in a pot and are stirred: long enough to be stopped in the middle. A stop file is looked for twice a
# second; the run takes some seconds.
POT = "walls[0]={shape: disc, name: bowl, material: glass, centre: [0, 0, 0], radius: 70 mm}"
LONG = ["--set", "time.end=40", "--set", POT, "--set", "output.snapshot_interval=0.8"]


class Stops(CliTest):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp(prefix="scree_cli_")
        cls.whole = os.path.join(cls.shared, "whole")
        subprocess.run([SCREE, "run", SMALL, *LONG, "--out", cls.whole, "-q"], check=True, env=environment())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def running(self, out, *more):
        process = self.start("run", SMALL, *LONG, "--out", out, *more)
        for _ in range(500):  # until it steps
            if os.path.exists(self.path(out, "snapshots/000001.h5")):
                return process
            time.sleep(0.01)
        self.fail("the run did not start")
        return None

    def goes_on(self, out):
        self.assertEqual(self.value(out, "status"), "stopped_early")
        steps = int(self.value(out, "steps"))
        self.assertGreater(steps, 0)
        self.assertLess(steps, 40000)
        self.scree("run", "--resume", "--out", out, code=0)
        self.assert_same_run(self.whole, out)

    def test_signals(self):
        for name in ("SIGUSR1", "SIGTERM", "SIGINT"):
            with self.subTest(name):
                process = self.running(name)
                process.send_signal(getattr(signal, name))
                self.assertEqual(process.wait(timeout=30), 75, process.stderr.read())
                process.stderr.close()
                self.goes_on(name)

    def test_stop_file(self):
        process = self.running("file")
        self.write("file/stop_now", "")
        self.assertEqual(process.wait(timeout=30), 75)
        process.stderr.close()
        self.assertFalse(os.path.exists(self.path("file/stop_now")))
        self.goes_on("file")

    def test_wall_time_and_the_same_command_again(self):
        # As a batch script does: the same line until it does not say 75.
        # The first time the limit is so near that one step is all that fits.
        codes = [self.scree("run", SMALL, *LONG, "--out", "batch", "--resume", "--walltime", "0").code]
        while codes[-1] == 75 and len(codes) < 60:
            codes.append(self.scree("run", SMALL, *LONG, "--out", "batch", "--resume", "--walltime", "1").code)
        self.assertEqual(codes[-1], 0)
        self.assertEqual(codes[0], 75)
        self.assert_same_run(self.whole, "batch")

    def test_end_of_a_slurm_job(self):
        end = str(int(time.time()) + 2)
        self.scree("run", SMALL, *LONG, "--set", "time.end=60000", "--out", "slurm", code=75,
                   env=environment(SLURM_JOB_END_TIME=end))


class Kills(CliTest):
    def test_killed_at_random_moments(self):
        more = [*LONG, "--set", "time.end=4", "--set", "output.checkpoint_interval=0.02"]
        begin = time.monotonic()
        self.scree("run", SMALL, *more, "--out", "whole", "-q", code=0)
        whole = time.monotonic() - begin
        seed = random.randrange(1 << 32)
        choose = random.Random(seed)
        killed = 0
        for _ in range(60):
            process = self.start("run", SMALL, *more, "--out", "killed", "--resume", "-q")
            try:
                process.wait(timeout=choose.uniform(0.0, 0.25 * whole) if killed < 10 else 60)
                break
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                killed += 1
            finally:
                process.stderr.close()
        self.assertEqual(process.returncode, 0, f"seed {seed}")
        self.assertGreater(killed, 3, f"seed {seed}")
        self.assert_same_run("whole", "killed")
        left = [f for _, _, files in os.walk(self.path("killed")) for f in files]
        self.assertEqual([f for f in left if f.endswith((".tmp", ".part"))], [], f"seed {seed}")


class Resumes(CliTest):
    def short(self, *more):
        return self.scree("run", SMALL, "--set", "time.end=0.1", "--out", "run", *more)

    def test_complete_run_says_so(self):
        self.assertEqual(self.short().code, 0)
        before = self.summary("run")
        self.assertIn("is complete", self.scree("run", "--resume", "--out", "run", code=0).err)
        self.assertEqual(self.summary("run"), before)

    def test_longer_than_planned(self):
        self.scree("run", SMALL, "--set", "time.end=0.2", "--out", "whole", code=0)
        self.short()
        self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.2", code=0)
        self.assert_same_run("whole", "run")

    def test_what_would_alter_steps_is_refused(self):
        self.short()
        for change in ("time.step=2e-4", "solver.tolerance=1e-3", "materials.glass.friction=0.1"):
            result = self.scree("run", "--resume", "--out", "run", "--set", change, code=3)
            self.assertIn(change.split("=", maxsplit=1)[0], result.err)
        self.scree("run", SMALL, "--resume", "--out", "run", "--set", "seed=9", code=3)
        self.scree("run", SMALL, "--resume", "--out", "run", "--set", "time.end=0.1", code=0)

    def test_nothing_to_go_on_from(self):
        self.assertIn("run", self.scree("run", "--resume", "--out", "run", code=4).err)
        os.mkdir(self.path("run"))
        self.assertIn("no checkpoint", self.scree("run", "--resume", "--out", "run", code=4).err)
        self.assertEqual(self.short("--resume").code, 0)  # with the scenario it starts

    def two_checkpoints(self):
        self.short()
        first = os.listdir(self.path("run/checkpoint"))
        self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.2", code=0)
        names = sorted(os.listdir(self.path("run/checkpoint")))
        self.assertEqual(len(names), 2)
        self.assertEqual(names[:1], first)
        return [self.path("run/checkpoint", name) for name in names]

    def cut(self, path):
        os.truncate(path, os.path.getsize(path) // 2)

    def test_truncated_checkpoint_falls_back(self):
        _, newest = self.two_checkpoints()
        kept = self.state_hash("run")
        self.cut(newest)
        result = self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.2", code=0)
        self.assertIn("warning", result.err)
        self.assertIn(os.path.basename(newest), result.err)
        self.assertEqual(self.state_hash("run"), kept)

    def test_flipped_bit_falls_back(self):
        _, newest = self.two_checkpoints()
        kept = self.state_hash("run")
        with open(newest, "r+b") as file:
            file.seek(os.path.getsize(newest) // 2)
            byte = file.read(1)
            file.seek(-1, os.SEEK_CUR)
            file.write(bytes([byte[0] ^ 0x10]))
        self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.2", code=0)
        self.assertEqual(self.state_hash("run"), kept)

    def test_no_readable_checkpoint(self):
        for path in self.two_checkpoints():
            self.cut(path)
        before = sorted(os.listdir(self.path("run")))
        self.scree("run", "--resume", "--out", "run", code=4)
        self.scree("run", SMALL, "--resume", "--out", "run", code=4)
        self.assertEqual(sorted(os.listdir(self.path("run"))), before)

    def test_a_run_in_use_is_left_alone(self):
        process = self.start("run", SMALL, *LONG, "--out", "run", "-q")
        while not os.path.exists(self.path("run/snapshots/000001.h5")):
            time.sleep(0.01)
        result = self.scree("run", SMALL, "--out", "run", "--force")
        process.kill()
        process.wait()
        process.stderr.close()
        self.assertEqual(result.code, 4)
        self.assertIn("another scree", result.err)

    def test_from_another_folder_and_a_moved_run(self):
        # The scenario may be gone when the run goes on: the checkpoint holds it.
        os.mkdir(self.path("elsewhere"))
        self.scree("run", SMALL, "--set", "time.end=0.2", "--out", "whole", code=0)
        shutil.copy(SMALL, self.path("here.yaml"))
        self.scree("run", "here.yaml", "--set", "time.end=0.1", "--out", "run", code=0)
        os.remove(self.path("here.yaml"))
        os.rename(self.path("run"), self.path("elsewhere/moved"))
        self.scree("run", "--resume", "--out", "moved", "--set", "time.end=0.2", code=0, cwd=self.path("elsewhere"))
        self.assert_same_run("whole", "elsewhere/moved")

    def test_far_from_the_origin(self):
        far = "bodies=[{generator: file, path: far.txt, material: glass}]"
        walls = "walls=[{shape: plane, name: floor, material: glass, point: [0, 0, 2000], normal: [0, 0, 1]}]"
        self.write("far.txt", "538500.5 5576504.25 2000.02 0.01\n538500.5 5576504.251 2000.05 0.012\n")
        shutil.copy(SMALL, self.path("far.yaml"))
        more = ["--set", far, "--set", walls, "--set", "outlets=[]", "--set", "measures=[]"]
        self.scree("run", "far.yaml", *more, "--set", "time.end=0.2", "--out", "whole", code=0)
        self.scree("run", "far.yaml", *more, "--set", "time.end=0.1", "--out", "run", code=0)
        os.remove(self.path("far.txt"))
        self.scree("run", "--resume", "--out", "run", "--set", "time.end=0.2", code=0)
        self.assert_same_run("whole", "run")


if __name__ == "__main__":
    main()
