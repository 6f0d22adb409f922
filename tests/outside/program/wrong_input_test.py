"""Inputs wrong in one way each: exit 2, every problem with its place, nothing written."""
import os
import random
import re

from in_folder import InFolder, identification, main, simulation

HEAD = "angle_deg,Fx_N,Fy_N,Fz_N\n"
ROWS = [f"{3 * i},{10 + i % 7},{5 - i % 5},{i % 3}" for i in range(120)]


def record(change=None, at=40):
    rows = list(ROWS)
    if change is not None:
        rows[at] = change
    return HEAD + "\n".join(rows) + "\n"


class WrongInput(InFolder):
    def refused(self, command, *arguments, where=None, says=()):
        """Exit 2 and nothing written, with the same words when quiet."""
        before = self.everything()
        loud = self.run_program(command, *arguments, code=2)
        quiet = self.run_program(command, *arguments, "--quiet", code=2)
        self.assertEqual(loud.stderr, quiet.stderr)
        self.assertEqual(loud.stdout + quiet.stdout, "")
        self.assertEqual(self.everything(), before)
        for line in loud.stderr.splitlines():
            self.assertRegex(line, r"^(\S.*:\d+:\d+: .|and \d+ more)")
        if where:
            self.assertRegex(loud.stderr, re.compile("^" + re.escape(where), re.M))
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, loud.stderr)
        return loud.stderr

    def wrong_case(self, text, **expected):
        self.write("cut.toml", text)
        for command in ("simulate", "check"):
            said = self.refused(command, "cut.toml", **expected)
        return said

    def wrong_record(self, content, **expected):
        if content is not None:
            self.write("record.csv", content)
        self.write("cut.toml", identification())
        for command in ("identify", "check"):
            said = self.refused(command, "cut.toml", **expected)
        return said

    def wrong_surface(self, rows, **expected):
        self.write("wall.csv", "x_mm,height_mm,error_mm\n" + rows)
        self.write("cut.toml", self.run_program("new", "calibrate").stdout)
        return self.refused("check", "cut.toml", **expected)

    # the case

    def test_no_such_case(self):
        self.refused("simulate", "cut.toml", where="cut.toml:1:1: ")

    def test_a_folder_as_a_case(self):
        (self.folder / "cut.toml").mkdir()
        self.refused("simulate", "cut.toml", where="cut.toml:1:1: ")

    def test_devices_and_pipes_as_a_case(self):
        os.mkfifo(self.folder / "pipe")
        for file in ("pipe", "/dev/zero", "/dev/null", "/dev/stdin"):
            with self.subTest(file):
                before = self.everything_but_pipes()
                done = self.run_program("simulate", file, "-o", "out", code=2)
                self.assertIn("regular file", done.stderr)
                self.assertEqual(self.everything_but_pipes(), before)

    def everything_but_pipes(self):
        return sorted(p.name for p in self.folder.iterdir())

    def test_a_value_out_of_range_has_its_line_and_column(self):
        text = simulation(cut={"axial_depth_mm": -2.0})
        line = text[:text.index("axial_depth_mm")].count("\n") + 1
        column = len("axial_depth_mm = ") + 1
        self.wrong_case(text, where=f"cut.toml:{line}:{column}: ", says="axial_depth_mm")

    def test_all_mistakes_at_once(self):
        text = simulation(cut={"axial_depth_mm": -2.0, "spindle_rpm": "fast"},
                          tool={"diametr_mm": 8.0})
        said = self.wrong_case(text, says=["axial_depth_mm", "spindle_rpm", "diametr_mm",
                                           "did you mean"])
        self.assertGreaterEqual(len(said.splitlines()), 3)

    def test_no_more_than_50_problems(self):
        tool = {f"nonsense_{i}": i for i in range(80)}
        said = self.wrong_case(simulation(tool=tool)).splitlines()
        self.assertEqual(len(said), 51)
        self.assertEqual(said[-1], "and 30 more")

    def test_numbers_that_are_none(self):
        for value in ("nan", "inf", "-inf", "1e999"):
            text = simulation().replace("axial_depth_mm = 2.0", f"axial_depth_mm = {value}")
            self.wrong_case(text, where="cut.toml:", says="")

    def test_rubbish_as_a_case(self):
        rubbish = random.Random(1).randbytes(1 << 20)
        for content in (rubbish, b"", b"\0" * (1 << 20), b"[" * (1 << 20),
                        b"a = [" + b"[" * 100000, b"a=1\n" * 100000,
                        "title = \"ä".encode("latin-1")):
            with self.subTest(content[:12]):
                self.wrong_case(content, where="cut.toml:")

    # the measurement

    def test_no_such_measurement(self):
        self.wrong_record(None, says="record.csv")

    def test_a_whole_record_is_no_mistake(self):
        self.write("record.csv", record())
        self.write("cut.toml", identification())
        self.run_program("check", "cut.toml")

    def test_what_is_no_number_has_its_line(self):
        for row in ("120,nan,1,2", "120,1,inf,2", "120,1,-Inf,2", "120,1,,2", "120,1,x,2",
                    "120,1,2", "120,1,2,3,4", "120,1,1e999,2", "120,1,0x10,2", "nan,1,2,3",
                    "120,1 2,2,3"):
            with self.subTest(row):
                self.wrong_record(record(row), where="record.csv:42:")

    def test_decimal_commas_in_a_comma_separated_file(self):
        rows = [row.replace(",", ",0,", 1) + ",0" for row in ROWS]
        self.wrong_record(HEAD + "\n".join(rows) + "\n", where="record.csv:")

    def test_decimal_commas_between_semicolons_are_read(self):
        rows = [row.replace(",", ",5;") for row in ROWS]
        self.write("record.csv", HEAD.replace(",", ";") + "\n".join(rows) + "\n")
        self.write("cut.toml", identification())
        self.run_program("check", "cut.toml")

    def test_too_short_a_record(self):
        for content in ("", HEAD, HEAD + ROWS[0] + "\n", "\n\n\n", "# only a comment\n"):
            with self.subTest(content):
                self.wrong_record(content, where="record.csv:")

    def test_channels_that_are_missing(self):
        without_z = record().replace("Fz_N", "temperature_C")
        self.write("record.csv", without_z)
        self.write("cut.toml", identification())
        said = self.run_program("check", "cut.toml").stdout
        self.assertIn("warning [channel_missing]: record.csv: no column is named Fz", said)
        self.assertIn("channel 3 was not measured", said)
        self.wrong_record(without_z.replace("Fx_N", "a_N").replace("Fy_N", "b_N"),
                          where="record.csv:1:", says="Fz")
        self.wrong_record(record().replace("Fz_N", "Fz1_N"), where="record.csv:1:", says="Fz")

    def test_rubbish_as_a_record(self):
        rubbish = random.Random(2).randbytes(1 << 20)
        for content in (rubbish, b"\0" * (1 << 20), b"," * (1 << 20), b"\n" * (1 << 20),
                        b"9" * (1 << 20), HEAD.encode() + rubbish,
                        b"\xff\xfe" + record().encode("utf-16-le")):
            with self.subTest(content[:12]):
                self.wrong_record(content, where="record.csv:")

    # a measured surface: 3 mm deep on a wall 60 mm long

    def test_every_bad_row_of_a_surface(self):
        said = self.wrong_surface("30,0.5,0.05\n30,1.5,inf\n30,2.5\n30,x,0.05\n",
                                  where="wall.csv:3:8: ")
        self.assertEqual(len(said.splitlines()), 3, said)

    def test_mostly_gaps(self):
        said = self.wrong_surface("30,0.5,0.05\n30,1.5,nan\n30,,0.05\n30,2.5\n",
                                  where="wall.csv:3:1: 2 of 3 rows")
        self.assertEqual(len(said.splitlines()), 2, said)

    def test_readings_outside_the_cut_and_the_wall(self):
        said = self.wrong_surface("30,3.5,0.05\n-1,0.5,0.05\n60,3.0,0.05\n61,-1,0\n",
                                  where="wall.csv:2:",
                                  says=["axial_depth_mm = 3", "length_mm = 60"])
        self.assertEqual(len(said.splitlines()), 4, said)

    def test_a_surface_that_is_no_text(self):
        for content in (b"", b"\0\1\2", bytes(range(256)), b"PK\3\4"):
            with self.subTest(content[:12]):
                self.write("cut.toml", self.run_program("new", "calibrate").stdout)
                self.write("wall.csv", content)
                self.refused("check", "cut.toml", where="wall.csv:")

    def test_only_regular_files_are_read(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "folder").mkdir()
        for file in ("pipe", "folder", "/dev/zero", "/dev/null"):
            with self.subTest(file):
                self.write("cut.toml", identification(file))
                done = self.run_program("identify", "cut.toml", code=2)
                self.assertRegex(done.stderr, "regular file|is a folder")
                self.assertRegex(done.stderr, r"^\S*:\d+:\d+: ")
                self.assertFalse((self.folder / "cut.identify").exists())

    def test_a_mistake_in_an_included_file_names_that_file(self):
        self.write("material.toml", "[force]\nK_tc_MPa = \"hard\"\n")
        self.wrong_case("include = \"material.toml\"\n" + simulation().replace(
            "K_tc_MPa = 2620\n", ""), where="material.toml:2:")

    def test_a_name_with_a_newline_stays_on_one_line(self):
        self.write("cut.toml", identification("a\nb.csv"))
        self.refused("identify", "cut.toml")


if __name__ == "__main__":
    main()
