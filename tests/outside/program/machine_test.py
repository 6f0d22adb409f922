"""modes and actuator from files as programs write them: answers, refusals, wrong input."""
import json
import math

from in_folder import InFolder, main

K, M, C = 1.7e7, 0.194, 77.3


def receptance(f, k=K, m=M, c=C):
    w = 2 * math.pi * f
    return 1 / complex(k - m * w * w, c * w)


def table(frequencies, of=receptance, head="freq_Hz,re_m/N,im_m/N\n"):
    return head + "".join(f"{f},{of(f).real!r},{of(f).imag!r}\n" for f in frequencies)


def step(wn=900.0, zeta=0.6, end=2000):
    wd = wn * math.sqrt(1 - zeta * zeta)
    rows = ["time_s,command_um,position_um"]
    for i in range(end):
        t = i * 2e-5
        s = max(t - 0.001, 0.0)
        y = 1 - math.exp(-zeta * wn * s) * (math.cos(wd * s) + zeta * wn / wd * math.sin(wd * s))
        rows.append(f"{t!r},{6 if t >= 0.001 else 0},{6 * 0.98 * y!r}")
    return "\n".join(rows) + "\n"


class Modes(InFolder):
    def result(self, folder):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def test_a_bare_file_gives_modes_and_a_case_that_runs_again(self):
        self.write("tip.csv", table(range(500, 3000, 2)))
        self.run_program("modes", "tip.csv")
        mode = self.result("tip.modes")["result"]["modes"][0]
        self.assertAlmostEqual(mode["mass_kg"] / M, 1, 6)
        self.assertAlmostEqual(mode["stiffness_N_per_m"] / K, 1, 6)
        self.assertAlmostEqual(mode["damping_Ns_per_m"] / C, 1, 6)
        again = self.folder / "tip.modes/case.toml"
        self.run_program("modes", again, "-o", "again")
        self.assertEqual(self.result("again")["result"], self.result("tip.modes")["result"])

    def test_its_modes_go_into_another_case(self):
        self.write("tip.csv", table(range(500, 3000, 2)))
        self.write("tip.toml", '[frf]\nfile = "tip.csv"\nbody = "table"\naxis = "y"\n')
        self.run_program("modes", "tip.toml")
        self.write("other.toml", 'include = "tip.modes/modes.toml"\n[frf]\nfile = "tip.csv"\n')
        self.run_program("modes", "other.toml")
        echo = (self.folder / "other.modes/case.toml").read_text()
        self.assertIn("[[mode]]\nbody = \"table\"\naxis = \"y\"\nangle_deg = 0\nmass_kg = 0.19", echo)

    def test_options_say_what_a_bare_table_does_not(self):
        rows = table(range(500, 3000, 2), head="").replace(",", " ")
        self.write("tap.txt", rows)
        said = self.run_program("modes", "tap.txt", code=2).stderr
        self.assertIn("tap.txt:1:1: the file says no unit", said)
        self.run_program("modes", "tap.txt", "--kind", "receptance", "--modes", "1",
                         "--band", "1000", "2000")
        self.assertEqual(self.result("tap.modes")["result"]["band_Hz"], [1000, 2000])
        self.write("tap.toml", '[frf]\nfile = "tap.txt"\nkind = "receptance"\n')
        said = self.run_program("modes", "tap.toml", "--modes", "1", code=2).stderr
        self.assertIn("keys of [frf]", said)

    def test_no_good_answer_is_told_and_holds_no_numbers(self):
        for name, frequencies, options, words in (
                ("below", range(100, 900, 2), (), "no resonance lies in the band"),
                ("cut", range(500, 1492, 2), (), "half-power points"),
                ("kind", range(500, 3000, 2), ("--kind", "accelerance"), "turns like a rec")):
            with self.subTest(name):
                head = "" if options else "freq_Hz,re_m/N,im_m/N\n"
                self.write(f"{name}.csv", table(frequencies, head=head))
                said = self.run_program("modes", f"{name}.csv", *options, code=1).stderr
                self.assertIn(words, said)
                summary = self.result(f"{name}.modes")
                self.assertEqual(summary["status"], "failed")
                self.assertIsNone(summary["result"]["modes"])
                self.assertFalse((self.folder / f"{name}.modes/modes.toml").exists())

    def test_a_step_gives_an_actuator(self):
        self.write("step.csv", step())
        self.run_program("actuator", "step.csv", "--start-s", "0.001")
        result = self.result("step.actuator")["result"]
        self.assertAlmostEqual(result["gain"], 0.98, 6)
        self.assertAlmostEqual(result["damping_ratio"], 0.6, 5)
        self.assertAlmostEqual(result["frequency_Hz"], 900 / (2 * math.pi), 3)
        self.assertIsNone(result["time_constants_s"])
        self.assertIn("underdamped", result["identifiable"]["time_constants_s"])
        self.write("with.toml", 'include = "step.actuator/actuator.toml"\n'
                   '[step]\nfile = "step.csv"\n')
        self.run_program("actuator", "with.toml")
        self.run_program("check", "with.toml")

    def test_a_step_that_never_settles_is_refused(self):
        self.write("ring.csv", step(zeta=0.001))
        said = self.run_program("actuator", "ring.csv", code=1).stderr
        self.assertIn("settle", said)
        self.assertIsNone(self.result("ring.actuator")["result"]["gain"])

    def test_wrong_input_writes_nothing(self):
        self.write("tip.toml", '[frf]\nfile = "none.csv"\n')
        self.write("bad.csv", "freq_Hz,re_m/N,im_m/N\n1,2,3\n2,3,x\n")
        before = self.everything()
        for arguments, words in ((("modes", "tip.toml"), "tip.toml:2:8: frf.file"),
                                 (("modes", "none.csv"), "there is no such file"),
                                 (("modes", "bad.csv"), "bad.csv:3:5: "),
                                 (("modes", "bad.csv", "--band", "5", "2"), "not in order"),
                                 (("actuator", "bad.csv"), "bad.csv:1:1: "),
                                 (("actuator", "tip.toml"), "[step] is missing"),
                                 (("check", "tip.toml"), "tip.toml:2:8: frf.file")):
            with self.subTest(arguments):
                self.assertIn(words, self.run_program(*arguments, code=2).stderr)
                self.assertEqual(self.everything(), before)


if __name__ == "__main__":
    main()
