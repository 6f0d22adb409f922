"""One case over many values: rows as the single commands say, the same after a kill."""
import csv
import json
import os
import signal
import subprocess
import time

from in_folder import InFolder, main, program, simulation

TAKE = ("--command", "simulate", "--take", "result.peak_xy_N", "--take", "result.mean_N[2]")


def whole_rows(part):
    """Rows of the parts that are whole."""
    lines = part.read_text().split("\n")[1:-1] if part.exists() else []
    rows = 0
    while lines:
        first, count, _ = lines[0].split(" ")
        if len(lines) <= int(count):
            break
        assert int(first) == rows
        rows += int(count)
        lines = lines[1 + int(count):]
    return rows


class Sweep(InFolder):
    def case(self, sweep, name="cut.toml", **changes):
        return self.write(name, simulation(**changes) + "\n[sweep]\n" + sweep)

    def rows(self, folder="cut.sweep"):
        with open(self.folder / folder / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def summary(self, folder="cut.sweep"):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def test_every_row_is_what_the_command_says(self):
        self.case('over = { "cut.spindle_rpm" = { from = 800, to = 1000, count = 2 }, '
                  '"tool.helix_deg" = { values = [0, 25.5] }, '
                  '"chip.model" = { values = ["radial", "trochoidal"] } }')
        done = self.run_program("sweep", "cut.toml", *TAKE)
        self.assertIn("peak_xy_N", done.stdout)
        rows = self.rows()
        self.assertEqual(len(rows), 8)
        self.assertEqual([row["chip.model"] for row in rows], ["radial", "trochoidal"] * 4)
        for row in rows:
            self.write("one.toml", simulation(
                cut={"spindle_rpm": float(row["cut.spindle_rpm"])},
                tool={"helix_deg": float(row["tool.helix_deg"])},
                chip={"model": row["chip.model"]}))
            self.run_program("simulate", "one.toml", "-q", "--no-report")
            result = self.summary("one.simulate")["result"]
            self.assertEqual(float(row["peak_xy_N"]), result["peak_xy_N"])
            self.assertEqual(float(row["mean_N[2]"]), result["mean_N"][1])
            self.assertEqual(row["status"], "ok")

    def test_the_case_it_writes_is_the_same_sweep(self):
        self.case('over = { "cut.feed_per_tooth_mm" = { mean = 0.04, sd = 0.004 } }\n'
                  'method = "latin_hypercube"\ncount = 20\nseed = 7\n')
        self.run_program("sweep", "cut.toml", *TAKE)
        result = self.summary()["result"]
        self.assertEqual(result["rows"], 20)
        q = result["quantities"][0]
        self.assertLess(q["low"], q["median"])
        self.assertLess(q["median"], q["high"])
        self.run_program("sweep", "cut.sweep/case.toml", "-o", "again", "-q")
        self.assertEqual(self.rows(), self.rows("again"))
        self.assertEqual((self.folder / "cut.sweep/sweep.csv").read_bytes(),
                         (self.folder / "again/sweep.csv").read_bytes())
        data = lambda: (self.folder / "again/report.html").read_text().split("id=\"data\"")[1]
        before = data()
        self.run_program("report", "again", "-q")
        self.assertEqual(before, data())

    def test_the_table_as_hdf5(self):
        self.case('hdf5 = true\nover = { "cut.spindle_rpm" = { values = [800, 900] } }')
        self.run_program("sweep", "cut.toml", *TAKE, "-q")
        table = (self.folder / "cut.sweep/sweep.h5").read_bytes()
        self.assertEqual(table[:8], b"\x89HDF\r\n\x1a\n")
        for column in self.rows()[0]:
            self.assertIn(column.encode(), table)
        self.run_program("sweep", "cut.sweep/case.toml", "-o", "again", "-q")
        self.assertEqual(table, (self.folder / "again/sweep.h5").read_bytes())
        self.run_program("report", "again", "-q")

    def test_other_commands_do_not_mind(self):
        self.case('over = { "cut.spindle_rpm" = { values = [800] } }')
        self.run_program("simulate", "cut.toml", "-q", "--no-report")
        self.run_program("check", "cut.toml")

    def test_a_case_without_answer_is_a_row_with_its_reason(self):
        self.case('over = { "cut.axial_depth_mm" = { values = [2, 60000, 3] } }')
        done = self.run_program("sweep", "cut.toml", *TAKE)
        self.assertIn("rows_without_answer", done.stdout)
        rows = self.rows()
        self.assertEqual([row["status"] for row in rows], ["ok", "wrong_input", "ok"])
        self.assertIn("axial_depth_mm", rows[1]["message"])
        self.assertEqual(rows[1]["peak_xy_N"], "")
        self.assertEqual(self.summary()["result"]["failed"], 1)

    def test_columns_of_a_file(self):
        self.write("cuts.csv", "rpm,feed\n900,0.03\n1000,0.05\n")
        self.case('method = "list"\nover = { "cut.spindle_rpm" = { file = "cuts.csv", '
                  'column = "rpm" }, "cut.feed_per_tooth_mm" = { file = "cuts.csv", '
                  'column = "feed" } }')
        self.run_program("sweep", "cut.toml", *TAKE, "-q")
        self.assertEqual([(row["cut.spindle_rpm"], row["cut.feed_per_tooth_mm"])
                          for row in self.rows()], [("900", "0.03"), ("1000", "0.05")])

    def test_what_is_wrong_is_told_before_the_work(self):
        for sweep, says in (
                ('over = { "cut.spindel_rpm" = { values = [1] } }',
                 ["cut.toml:", "cut.spindel_rpm", "spindle_rpm"]),
                ('over = { "cut.spindle_rpm" = { values = [-3] } }', ["cut.spindle_rpm = -3"]),
                ('over = { "cut.spindle_rpm" = { from = 1, to = 2 } }', ["count"]),
                ('over = { "cut.spindle_rpm" = { mean = 1, sd = 2 } }', ["latin_hypercube"]),
                ('over = { "cut.spindle_rpm" = { mean = 1, sd = 0 } }', ["sd"]),
                ('over = { "cut.spindle_rpm" = { form = 1, to = 2, count = 3 } }', ["form"]),
                ('hdf5 = 1\nover = { "cut.spindle_rpm" = { values = [1] } }',
                 ["sweep.hdf5 = 1", "true or false"]),
                ('over = { "cut.spindle_rpm" = 3 }', ["{ from, to, count }"]),
                ('over = { cut.spindle_rpm = { values = [3] } }', ["sweep.over.cut"]),
                ('over = {}', ["sweep.over"]),
                ('method = "gird"\nover = { "cut.spindle_rpm" = { values = [3] } }',
                 ["gird", "latin_hypercube"]),
                ('over = { "cut.spindle_rpm" = { file = "none.csv", column = "a" } }',
                 ["none.csv"]),
                ('over = { "tool.diameter_mm" = { values = [8] }, '
                 '"tool.diameter_in" = { values = [0.3] } }', ["is swept as well"]),
                ('over = { "mode[1].mass_kg" = { values = [3] } }', ["[[mode]]"])):
            self.case(sweep)
            done = self.run_program("sweep", "cut.toml", *TAKE, code=2)
            for text in says:
                self.assertIn(text, done.stderr, sweep)
            self.assertFalse((self.folder / "cut.sweep").exists())
        self.case('over = { "cut.spindle_rpm" = { values = [800] } }')
        for wrong, says in ((("--command", "simulat", "--take", "result.peak_xy_N"), "simulate"),
                            (("--take", "result.peak_xy_N"), "which command"),
                            (("--command", "simulate"), "result.peak_xy_N"),
                            (("--command", "simulate", "--take", "result.peak_x_N"),
                             "result.peak_xy_N")):
            self.assertIn(says, self.run_program("sweep", "cut.toml", *wrong, code=2).stderr)
        self.write("plain.toml", simulation())
        self.assertIn("[sweep] is missing",
                      self.run_program("sweep", "plain.toml", *TAKE, code=2).stderr)

    def test_a_time_limit_keeps_what_is_done(self):
        self.case('over = { "cut.spindle_rpm" = { from = 100, to = 9000, count = 200000 } }')
        done = self.run_program("sweep", "cut.toml", *TAKE, "-q", "--time-limit", 1, code=1)
        self.assertIn("the same command goes on there", done.stderr)
        first = whole_rows(self.folder / ".cut.sweep.part")
        self.assertGreater(first, 0)
        self.run_program("sweep", "cut.toml", *TAKE, "-q", "--time-limit", 1, code=1)
        self.assertGreater(whole_rows(self.folder / ".cut.sweep.part"), first)

    def test_the_same_bits_on_any_number_of_threads_and_after_kills(self):
        self.case('over = { "cut.spindle_rpm" = { from = 100, to = 9000, count = 3000 } }')
        self.run_program("sweep", "cut.toml", *TAKE, "-q", "--no-report", "-o", "one",
                         TROCHOID_THREADS="1")
        whole = (self.folder / "one/sweep.csv").read_bytes()
        part = self.folder / ".two.part"
        kills, done = 0, []
        while kills < 200:
            work = subprocess.Popen([program.PROGRAM, "sweep", "cut.toml", *TAKE, "-q",
                                     "--no-report", "-o", "two"], cwd=self.folder)
            try:
                # Longer from time to time: something is done between two kills.
                self.assertEqual(work.wait(0.2 + 0.05 * kills), 0)
                break
            except subprocess.TimeoutExpired:
                os.kill(work.pid, signal.SIGKILL)
                work.wait()
                kills += 1
                if (self.folder / "two/sweep.csv").exists() and not part.exists():
                    break  # it was done, and killed on its way out
                done.append(whole_rows(part))
            time.sleep(0.01)
        self.assertEqual(done, sorted(done), "what was done is never lost")
        self.assertEqual((self.folder / "two/sweep.csv").read_bytes(), whole)
        self.assertFalse(part.exists())


if __name__ == "__main__":
    main()
