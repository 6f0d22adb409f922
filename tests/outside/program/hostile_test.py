"""What nobody would write by mistake: the program says what is wrong and ends as ever."""
import json
import shutil
import subprocess

from in_folder import InFolder, main, program, simulation


class Hostile(InFolder):
    def refused(self, *arguments, says):
        done = self.run_program(*arguments, code=2)
        self.assertIn(says, done.stderr)
        self.assertLess(len(done.stderr), 4000)
        return done.stderr

    def test_texts_that_nest(self):
        for name, text, says in (
                ("dots", ".".join(["a"] * 20000) + " = 1\n", "1:64: a key of more than 32"),
                ("quoted", "[" + "'a' . " * 20000 + "b]\n", "a key of more than 32"),
                ("lists", "a = " + "[" * 100000 + "\n", "1:69: nested deeper than 64"),
                ("tables", "a = " + "{ b = " * 100000 + "\n", "nested deeper than 64")):
            self.write(f"{name}.toml", text)
            for command in ("simulate", "check", "identify"):
                self.refused(command, f"{name}.toml", says=f"{name}.toml:")
                self.refused(command, f"{name}.toml", says=says)

    def test_a_long_chain_of_includes(self):
        for i in range(2000):
            self.write(f"c{i}.toml", f'include = "c{i + 1}.toml"\n')
        self.write("c2000.toml", simulation())
        self.refused("simulate", "c0.toml", says="c16.toml:1:11: include")
        self.run_program("simulate", "c1990.toml", "-q", "--no-report")

    def test_files_that_include_the_next_one_three_times(self):
        """3^15 ways lead to the last of 16 files"""
        for i in range(15):
            self.write(f"c{i}.toml", f"include = {json.dumps([f'c{i + 1}.toml'] * 3)}\n")
        self.write("c15.toml", simulation())
        self.refused("simulate", "c0.toml", says="more than 256 files are included")
        self.refused("simulate", "c9.toml", says="more than 256 files are included")
        self.run_program("simulate", "c11.toml", "-q", "--no-report")  # 3 + 9 + 27 + 81

    def test_a_folder_whose_files_nest(self):
        self.write("cut.toml", simulation())
        for name, text in (("summary.json", '{"trochoid":' + "[" * 200000),
                           ("case.toml", "a = " + "[" * 200000),
                           ("case.toml", ".".join(["a"] * 200000) + " = 1\n")):
            self.run_program("simulate", "cut.toml", "-q")
            self.write(f"cut.simulate/{name}", text)
            if "json" in name:
                self.refused("report", "cut.simulate", says="summary.json:1:1: ")
                subprocess.run(["rm", "-r", self.folder / "cut.simulate"], check=True)
            else:
                self.run_program("report", "cut.simulate", "-q")

    def test_a_summary_with_another_kind_of_value_at_each_place(self):
        self.write("cut.toml", simulation(sampling={"edge_angles_deg": [90.0],
                                                    "edge_heights_mm": [0.0]}))
        self.run_program("simulate", "cut.toml", "-q")
        file = self.folder / "cut.simulate/summary.json"
        whole = json.loads(file.read_text())
        for key in whole["result"]:
            for wrong in (3, "x", None, [], {}, [[1]], [{"a": 1}]):
                changed = json.loads(json.dumps(whole))
                changed["result"][key] = wrong
                file.write_text(json.dumps(changed))
                self.assertIn(self.any_code("report", "cut.simulate", "-q"), (0, 2))
        for key in whole:
            changed = dict(whole)
            changed[key] = 3
            file.write_text(json.dumps(changed))
            self.assertIn(self.any_code("report", "cut.simulate", "-q"), (0, 2))

    def any_code(self, *arguments):
        return subprocess.run([program.PROGRAM, *arguments], cwd=self.folder, timeout=60,
                              capture_output=True, check=False).returncode

    def test_messages_that_cannot_be_printed(self):
        self.write("cut.toml", "a = 1\n")
        for where in ("2>/dev/full", "2>&-", ">&- 2>&-"):
            done = subprocess.run(["sh", "-c", f'"$0" simulate cut.toml {where}',
                                   program.PROGRAM], cwd=self.folder, check=False)
            self.assertEqual(done.returncode, 2, where)

    def test_a_file_that_the_disk_does_not_give(self):
        self.refused("check", "/proc/self/mem", says="/proc/self/mem:1:1: the file cannot be read")
        self.write("id.toml", simulation() + '[[measurement]]\nfile = "/proc/self/mem"\n')
        self.refused("check", "id.toml", says="the file cannot be read")

    def test_a_title_that_steers_the_terminal(self):
        self.write("cut.toml", simulation().replace('"a slot"', '"\\u001b[2J\\u009bm\\u007f slot"'))
        done = self.run_program("simulate", "cut.toml")
        self.assertIn("\\x1B[2J\\x9Bm\\x7F slot", done.stdout)
        self.assertNotIn("\x1b", done.stdout)
        wrong = self.write("\x1b[31mred.toml", "a = 1\n")
        self.assertNotIn("\x1b", self.run_program("check", wrong.name, code=2).stderr)

    def test_a_linked_table_is_not_followed(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-q")
        self.write("secret", "do not print this\n")
        table = self.folder / "cut.simulate/forces.csv"
        table.unlink()
        table.symlink_to(self.folder / "secret")
        said = self.refused("report", "cut.simulate", says="forces.csv:1:1: not a regular file")
        self.assertNotIn("do not print", said)

    def test_a_summary_of_another_program_is_refused_and_its_folder_left_alone(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-q", "--no-report")
        file = self.folder / "cut.simulate/summary.json"
        summary = json.loads(file.read_text())
        del summary["trochoid"]
        file.write_text(json.dumps(summary))
        before = self.everything()
        self.refused("report", "cut.simulate", says="not a summary.json of trochoid")
        self.assertEqual(self.everything(), before)

    def test_a_table_that_is_not_ours_is_not_read(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-q")
        self.write("cut.simulate/mine.csv", "what,I\nwrote\n")
        self.run_program("report", "cut.simulate", "-q")
        self.assertNotIn("mine.csv", (self.folder / "cut.simulate/report.html").read_text())

    def test_a_command_that_does_not_exist_is_named_with_the_nearest(self):
        self.refused("simulat", "x", says="trochoid simulat: there is no such command; "
                                          "did you mean simulate?")
        self.refused("xyz", says="trochoid xyz: there is no such command; there are simulate,")

    def test_a_case_alone_runs_the_command_that_its_tables_ask_for(self):
        self.write("cut.toml", simulation())
        done = self.run_program("cut.toml", "--no-report")
        self.assertIn("trochoid simulate cut.toml", done.stderr)
        self.assertTrue((self.folder / "cut.simulate/summary.json").exists())
        self.assertEqual(self.run_program("cut.toml", "-q").stderr, "")
        shutil.copy(self.folder / "cut.toml", self.folder / "CUT.TOML")
        self.assertIn("trochoid simulate CUT.TOML", self.run_program("CUT.TOML", "--no-report").stderr)
        self.refused("lost.toml", says="lost.toml:1:1: there is no such file")

    def test_check_takes_what_every_command_takes(self):
        self.write("cut.toml", simulation())
        before = self.everything()
        self.run_program("check", "cut.toml", "-o", "out", "--no-report", "--json", "-q")
        self.assertEqual(self.everything(), before)


if __name__ == "__main__":
    main()
