"""What the exit code says: 0 answered, 1 no good answer, 2 the input is wrong."""
import math
import signal
import subprocess
import time

from in_folder import InFolder, ROOT, identification, main, program, simulation


def numbers(value):
    """All numbers anywhere in a JSON value."""
    if isinstance(value, dict):
        return [n for v in value.values() for n in numbers(v)]
    if isinstance(value, list):
        return [n for v in value for n in numbers(v)]
    return [value] if isinstance(value, (int, float)) and not isinstance(value, bool) else []


class ExitCode(InFolder):
    def test_answered_is_0(self):
        self.write("cut.toml", simulation())
        done = self.run_program("simulate", "cut.toml")
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.summary("cut.simulate")["status"], "ok")

    def test_warnings_are_still_0(self):
        self.write("cut.toml", simulation(runout={"radial_offsets_mm": [0.0, -0.2]}))
        self.run_program("simulate", "cut.toml")
        codes = [w["code"] for w in self.summary("cut.simulate")["warnings"]]
        self.assertIn("idle_tooth", codes)

    def test_a_feed_of_0_cuts_nothing_and_is_answered(self):
        self.write("cut.toml", simulation(cut={"feed_per_tooth_mm": 0.0}))
        self.run_program("simulate", "cut.toml")
        result = self.summary("cut.simulate")["result"]
        self.assertEqual(result["rms_N"], [0, 0, 0])
        self.assertEqual([t["peak_chip_mm"] for t in result["teeth"]], [0, 0])

    def test_nothing_to_identify_at_a_feed_of_0_is_1(self):
        self.record()
        self.write("cut.toml", identification(cut={"feed_per_tooth_mm": 0.0}))
        done = self.run_program("identify", "cut.toml", code=1)
        summary = self.summary("cut.identify")
        self.assertEqual(summary["status"], "failed")
        self.assertTrue(summary["message"])
        self.assertIn(summary["message"], done.stderr)
        for fit in summary["result"]["fits"]:
            self.assertLessEqual(set(numbers(fit)), {0}, fit)  # the rank may be known
            self.assertIsNone(fit["runout"])
            self.assertTrue(all(v is None for v in fit["coefficients"].values()))
        self.assertIsNone(summary["result"].get("chosen"))
        self.assertFalse((self.folder / "cut.identify/material.toml").exists())

    def test_a_force_that_never_changes_is_1(self):
        self.write("record.csv", "angle_deg,Fx_N,Fy_N,Fz_N\n" + "".join(
            f"{3 * i},1,2,3\n" for i in range(120)))
        self.write("cut.toml", identification())
        self.run_program("identify", "cut.toml", code=1)
        for fit in self.summary("cut.identify")["result"]["fits"]:
            self.assertEqual(numbers(fit), [])

    def test_without_equations_to_spare_is_1(self):
        """Three more than unknowns are needed in every command that fits."""
        fixed = {"phase_deg": 0.0, "runout": "none", "chip_models": ["feed"]}
        rows = self.record().read_text().splitlines()
        for samples, phase in ((3, "free"), (2, 0.0)):
            self.write("record.csv", "\n".join([rows[0], *rows[10:61:25][:samples]]) + "\n")
            self.write("cut.toml", identification(identify={**fixed, "phase_deg": phase}))
            self.run_program("identify", "cut.toml", "--no-report", code=1)
        self.assertIn("6 equations for 6 unknowns: at least 9 are needed",
                      self.summary("cut.identify")["message"])
        wall = (ROOT / "examples/thin_wall_calibrate/case.toml").read_text()
        self.write("wall.toml", wall)
        self.write("profile.csv", "x_mm,height_mm,error_mm\n"
                   "30,0.3,0.085\n30,1.2,0.071\n30,1.8,0.062\n30,2.4,0.055\n30,2.7,0.05\n")
        self.run_program("calibrate", "wall.toml", "--no-report", code=1)
        self.assertIn("5 readings for 3 unknowns: at least 6 are needed",
                      self.summary("wall.calibrate")["message"])
        self.write("step.csv", "time_s,command_um,position_um\n" + "".join(
            f"{i / 1000},{6 * (i > 1)},{6 * (i > 3)}\n" for i in range(9)))
        self.run_program("actuator", "step.csv", "--no-report", code=1)
        self.assertIn("at least 10 are needed", self.summary("step.actuator")["message"])
        self.write("frf.csv", "freq_Hz,re_m/N,im_m/N\n" + "".join(
            f"{900 + i},{1e-7 * i},{-1e-7}\n" for i in range(7)))
        self.run_program("modes", "frf.csv", "--no-report", code=1)
        self.assertIn("need at least 8", self.summary("frf.modes")["message"])

    def test_a_failed_answer_is_said_even_when_quiet(self):
        self.record()
        self.write("cut.toml", identification(cut={"feed_per_tooth_mm": 0.0}))
        done = self.run_program("identify", "cut.toml", "--quiet", code=1)
        self.assertEqual(done.stdout, "")
        self.assertIn("trochoid identify:", done.stderr)

    def test_what_cannot_be_told_apart_is_no_number(self):
        """Without a chip that changes its length the axial edge force of a slot is a
        constant, as is the offset of channel 3."""
        self.record()
        self.write("cut.toml", identification(identify={
            "chip_models": ["none", "trochoidal"], "channel_offsets": "fit"}))
        self.run_program("identify", "cut.toml")
        fit = self.summary("cut.identify")["result"]["fits"][0]
        self.assertIsNone(fit["coefficients"]["K_ae_N_per_mm"])
        self.assertIsInstance(fit["identifiable"]["K_ae_N_per_mm"], str)
        self.assertIsNone(fit["channel_offsets"][0][2]["constant_N"])
        self.assertLess(max(map(abs, numbers(fit["channel_offsets"]))), 1e3)

    def test_numbers_that_must_not_be_used_say_so_first(self):
        """Channels in the wrong order: a fit of every harmonic, and an answer of 0."""
        self.record()
        self.write("cut.toml", identification(dynamometer={"axes": ["z", "x", "y"]}))
        done = self.run_program("identify", "cut.toml")
        summary = self.summary("cut.identify")
        self.assertTrue(summary["result"]["do_not_use"])
        self.assertTrue(summary["message"].startswith("Do not use these numbers: "))
        self.assertEqual(done.stdout.splitlines()[2].split(":")[0], "Do not use these numbers")
        self.assertEqual([w["code"] for w in summary["warnings"][:2]],
                         ["do_not_use", "likely_cause"])
        self.assertIn('axes = "auto"', summary["warnings"][1]["message"])
        self.assertIn("x, y, z", summary["warnings"][1]["message"])
        self.assertIn("warning [do_not_use]: ", done.stdout)
        folder = self.folder / "cut.identify"
        self.assertTrue((folder / "material.toml").read_text().startswith("# Do not use"))
        self.assertIn('<body class="doubtful">', (folder / "report.html").read_text())

    def test_usable_numbers_say_nothing_of_the_kind(self):
        self.record()
        self.write("cut.toml", identification())
        done = self.run_program("identify", "cut.toml")
        self.assertEqual(self.summary("cut.identify")["result"]["do_not_use"], [])
        self.assertNotIn("Do not use", done.stdout)
        report = (self.folder / "cut.identify/report.html").read_text()
        self.assertIn('<body class="ok">', report)

    def test_a_record_that_is_not_of_this_cut_is_1(self):
        self.write("record.csv", "angle_deg,Fx_N,Fy_N,Fz_N\n" + "".join(
            f"{3 * i}," + ",".join(f"{100 * math.sin(math.radians(21 * i) + q)!r}"
                                   for q in range(3)) + "\n" for i in range(120)))
        self.write("cut.toml", identification())
        done = self.run_program("identify", "cut.toml", code=1)
        summary = self.summary("cut.identify")
        self.assertIn("not noise", summary["message"])
        self.assertIn("likely_cause", [w["code"] for w in summary["warnings"]])
        self.assertIn("No answer: ", done.stdout)
        for fit in summary["result"]["fits"]:
            self.assertTrue(all(v is None for v in fit["coefficients"].values()))
            self.assertIsNone(fit["rms_N"])

    def test_a_speed_far_off_is_a_factor_and_no_percentage(self):
        rows = self.record().read_text().splitlines()
        # 120 samples of 3 degrees in 0.12 s: 500 rpm
        lines = ["time_s," + rows[0]] + [f"{0.001 * i:.3f},{r}" for i, r in enumerate(rows[1:])]
        self.write("record.csv", "\n".join(lines) + "\n")
        for stated, part in ((50, "500.00 rpm, 10 times the stated 50 rpm"),
                             (480, "500.00 rpm, +4.17 % off the stated 480 rpm")):
            self.write("cut.toml", identification(cut={"spindle_rpm": stated}))
            self.run_program("identify", "cut.toml", "--no-report")
            said, = [w["message"] for w in self.summary("cut.identify")["warnings"]
                     if w["code"] == "spindle_speed"]
            self.assertIn(part, said)

    def test_wrong_commands_are_2(self):
        self.write("cut.toml", simulation())
        before = self.everything()
        for arguments in ([], ["simulat", "cut.toml"], ["simulate"],
                          ["simulate", "cut.toml", "--nonsense"],
                          ["simulate", "cut.toml", "other.toml"],
                          ["new", "nonsense", "x.toml"], ["report"],
                          ["simulate", "cut.toml", "-o"]):
            with self.subTest(arguments):
                done = self.run_program(*arguments, code=2)
                self.assertTrue(done.stderr)
        self.assertEqual(self.everything(), before)

    def test_help_and_version_are_0(self):
        for arguments in (["--help"], ["--version"], ["simulate", "--help"],
                          ["identify", "-h"]):
            self.assertTrue(self.run_program(*arguments).stdout, arguments)

    def test_a_full_disk_behind_a_pipe_is_2(self):
        """Whether little is printed or more than a buffer holds."""
        self.record()
        self.write("cut.toml", identification())
        for arguments in (["check", "cut.toml"], ["identify", "cut.toml", "--json"],
                          ["new", "identify"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([program.PROGRAM, *arguments], cwd=self.folder,
                                      stdout=full, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertTrue(done.stderr)

    def test_threads_are_a_number(self):
        self.write("cut.toml", simulation())
        for wrong in ("0", "-1", "two", "1.5", "99999999999999999999", ""):
            done = self.run_program("simulate", "cut.toml", code=2, TROCHOID_THREADS=wrong)
            self.assertIn("TROCHOID_THREADS", done.stderr)
        self.assertFalse((self.folder / "cut.simulate").exists())

    def test_check_says_what_it_read(self):
        self.record()
        self.write("cut.toml", identification())
        said = self.run_program("check", "cut.toml").stdout
        rows = [[float(v) for v in line.split(",")] for line in
                (self.folder / "record.csv").read_text().splitlines()[1:]]
        low, high = min(r[1] for r in rows), max(r[1] for r in rows)
        for part in ("cut.toml: no mistakes found", "record.csv: 120 samples",
                     "0.99 revolutions by their angles", "angle from column angle_deg",
                     f"channel 1 from column Fx_N: {low:.4g} to {high:.4g} N"):
            self.assertIn(part, said)
        self.assertFalse(list(self.folder.glob("cut.*/")))
        self.assertEqual(self.run_program("check", "cut.toml", "-q").stdout, "")

    def test_check_for_a_command(self):
        self.write("cut.toml", simulation())
        self.run_program("check", "cut.toml", "--for", "simulate")
        for command, missing in (("identify", "measurement"), ("stability", "mode")):
            said = self.run_program("check", "cut.toml", "--for", command, code=2).stderr
            self.assertIn(missing, said)
            self.assertIn(command, said)
        self.run_program("check", "cut.toml", "--for", "simulat", code=2)

    def test_check_tells_time_and_gaps(self):
        times = [0.001 * i for i in range(400)] + [0.5 + 0.001 * i for i in range(400)]
        self.write("record.csv", "time_s,Fx_N,Fy_N,Fz_N\n" + "".join(
            f"{t:.4f},1,2,{i % 7}\n" for i, t in enumerate(times)))
        self.write("cut.toml", identification())
        said = self.run_program("check", "cut.toml").stdout
        for part in ("800 samples, 0.899 s, unevenly sampled",
                     "about 13.1 revolutions at the stated 875 rpm",
                     "time from column time_s", "warning [time_gap]: ", "0.399 s to 0.5 s"):
            self.assertIn(part, said)


class Killed(InFolder):
    def test_an_end_in_the_middle_leaves_no_half_folder(self):
        """Whenever it comes: all of the folder is there, or none of it."""
        case = ROOT / "examples/st52_slot/case.toml"
        start = time.monotonic()
        self.run_program("identify", case, "-o", "whole", "-q")
        duration = time.monotonic() - start
        names = sorted(p.name for p in (self.folder / "whole").iterdir())
        for i in range(24):
            out = self.folder / f"out{i}"
            child = subprocess.Popen([program.PROGRAM, "identify", str(case), "-o", str(out),
                                      "-q"], cwd=self.folder)
            time.sleep(duration * (i + 1) / 24)
            child.send_signal(signal.SIGKILL)
            child.wait()
            if out.exists():
                self.assertEqual(sorted(p.name for p in out.iterdir()), names)
        # what was begun hides, and does not hinder the next run
        self.run_program("identify", case, "-o", "out0", "-q")


if __name__ == "__main__":
    main()
