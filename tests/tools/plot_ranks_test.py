"""plot_ranks.py draws how work was shared, of few ranks and many, and says what is wrong with its input."""
import json
import pathlib
import tempfile
import unittest

from helpers import picture, share_coloured, tool

from pictures import rank_panels

PHASES = ("detection", "setup", "solve", "integration", "correction", "measures", "output")


def record(time, ranks, most=1.2):
    spread = {"min": 0.8, "mean": 1.0, "max": most}
    names = ("work", "wait", "bodies", "ghosts", "contacts", "messages", "bytes")
    return {"kind": "ranks", "time": time, "step": int(time * 1000), "ranks": ranks, "imbalance": most,
            "repartitions": 1, **{name: spread for name in names}}


def section(ranks):
    counts = [100 + r % 5 for r in range(ranks)]
    lists = {name: counts for name in ("bodies", "ghosts", "contacts", "neighbours", "messages", "bytes")}
    lists |= {name: [1.0 + 0.1 * (r % 3) for r in range(ranks)] for name in (*PHASES, "work", "wait")}
    return {"number": ranks, "imbalance": 1.2, "communication_share": 0.1, "repartitions": 1, "migrated": 5,
            "messages": 1000, "bytes": 1e6, "time_by_phase": {name: {"mean": 1.0, "max": 1.2} for name in PHASES},
            "each": lists}


class Plotting(unittest.TestCase):
    def setUp(self):
        self.run_folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "a run"
        self.run_folder.mkdir()

    def write(self, ranks, records, summary=True):
        lines = [json.dumps({"kind": "provenance"})] + [json.dumps(r) for r in records]
        (self.run_folder / "run.jsonl").write_text("\n".join(lines) + "\n")
        if summary:  # JSON is YAML
            (self.run_folder / "summary.yaml").write_text(json.dumps({"title": "A", "ranks": section(ranks)}))

    def draw(self):
        code, out, err = tool("plot_ranks.py", self.run_folder)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(out.strip(), str(self.run_folder / "ranks.png"))
        image = picture(self.run_folder / "ranks.png")
        self.assertGreater(share_coloured(image), 0.003)
        return image

    def test_few_ranks_and_many(self):
        for ranks in (2, 300):
            self.write(ranks, [record(0.1 * i, ranks) for i in range(10)])
            self.draw()

    def test_a_run_that_goes_on(self):
        self.write(4, [record(0.1, 4), record(0.2, 4)], summary=False)
        over_time = self.draw()
        self.write(4, [record(0.1, 4), record(0.2, 4)])
        self.assertGreater(self.draw().shape[0], over_time.shape[0])

    def test_what_a_resumed_run_repeats_counts_once(self):
        times = (0.1, 0.2, 0.3, 0.2, 0.4)
        self.write(2, [record(t, 2, most=1.0 + i) for i, t in enumerate(times)])
        with open(self.run_folder / "run.jsonl", "a", encoding="utf-8") as file:
            file.write('{"kind": "ranks", "ti')  # killed here
        records = rank_panels.read_records(self.run_folder)
        self.assertEqual([r["time"] for r in records], [0.1, 0.2, 0.4])
        self.assertEqual(records[1]["imbalance"], 4.0)

    def test_one_rank_and_no_run(self):
        self.write(1, [])
        code, _, err = tool("plot_ranks.py", self.run_folder)
        self.assertEqual(code, 4)
        self.assertIn("one rank", err)
        (self.run_folder / "run.jsonl").unlink()
        code, _, err = tool("plot_ranks.py", self.run_folder)
        self.assertEqual(code, 4)
        self.assertIn("run.jsonl", err)


if __name__ == "__main__":
    unittest.main()
