"""What nobody would write by mistake: the program says what is wrong and ends as ever."""
import json
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

    def test_a_folder_whose_files_nest(self):
        self.write("cut.toml", simulation())
        for name in ("summary.json", "case.toml"):
            self.run_program("simulate", "cut.toml", "-q")
            deep = "[" * 200000
            self.write(f"cut.simulate/{name}", '{"trochoid":' + deep if "json" in name
                       else "a = " + deep)
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
        self.write("cut.toml", simulation().replace('"a slot"', '"\\u001b[2J\\u009bm slot"'))
        done = self.run_program("simulate", "cut.toml")
        self.assertIn("\\x1B[2J\\x9Bm slot", done.stdout)
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

    def test_a_command_that_does_not_exist_is_named_with_the_nearest(self):
        self.refused("simulat", "x", says="trochoid simulat: there is no such command; "
                                          "did you mean simulate?")
        self.refused("xyz", says="trochoid xyz: there is no such command; there are simulate,")

    def test_check_takes_what_every_command_takes(self):
        self.write("cut.toml", simulation())
        before = self.everything()
        self.run_program("check", "cut.toml", "-o", "out", "--no-report", "--json", "-q")
        self.assertEqual(self.everything(), before)


if __name__ == "__main__":
    main()
