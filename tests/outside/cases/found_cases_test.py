"""Inputs on which the program failed once (../shared/cases/found), and what is right.

Each folder says in EXPECTED.md what was wrong, what is right and how that is known.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
import case_file as cf  # noqa: E402
import program  # noqa: E402

FOUND = cf.SHARED / "cases/found"
WITHIN = 300  # s


class FoundCases(unittest.TestCase):
    def setUp(self):
        parent = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_"))
        self.addCleanup(shutil.rmtree, parent)
        self.folder = parent / "found"
        shutil.copytree(FOUND / self.case, self.folder, copy_function=shutil.copyfile)
        self.folder.chmod(0o755)

    def asked(self, *words, code=0):
        """What a command prints, both streams."""
        done = subprocess.run([program.PROGRAM, *words], cwd=self.folder, capture_output=True,
                              timeout=WITHIN, check=False)
        said = (done.stdout + done.stderr).decode()  # all that is printed is UTF-8
        self.assertEqual(done.returncode, code, said)
        return said

    def answer(self, command, file, *words, code=0):
        self.asked(command, file, "-o", "out", "--no-report", *words, code=code)
        return json.loads((self.folder / "out/summary.json").read_text())

    def codes(self, summary):
        return {w["code"] for w in summary["warnings"]}

    def coefficients(self, summary, truth):
        """All of the truth within the intervals, and usable."""
        result = summary["result"]
        self.assertEqual(result["verdict"], "usable")
        fit = next(f for f in result["fits"] if f["chip_model"] == result["chosen"])
        for key, true in truth.items():
            one = fit["coefficients"][key]
            self.assertTrue(one["low"] - 0.01 * true <= true <= one["high"] + 0.01 * true, (key, one))


TRUTH = {"K_tc_MPa": 1200, "K_rc_MPa": 400, "K_te_N_per_mm": 12, "K_re_N_per_mm": 10}


class Actuator(FoundCases):
    case = "actuator_measured_command"

    def test_a_command_that_was_measured_is_a_step(self):
        clean, noisy = (self.answer("actuator", f"{one}_command.csv")["result"]
                        for one in ("clean", "noisy"))
        for key in ("gain", "frequency_Hz", "damping_ratio"):
            a, b = (r[key] if isinstance(r[key], float) else r[key]["value"] for r in (clean, noisy))
            self.assertAlmostEqual(a, b, delta=2e-3 * a, msg=key)


class Axes(FoundCases):
    case = "axes_none_converges"

    def test_the_number_of_teeth_is_named(self):
        self.answer("identify", "case.toml")
        said = (self.folder / "out/summary.json").read_text()
        self.assertIn("with teeth = 4", said)


class StartTimes(FoundCases):
    case = "channel_start_times"

    def test_channels_are_aligned(self):
        summary = self.answer("identify", "true05_tdms.toml")
        self.coefficients(summary, TRUTH)
        self.assertEqual(self.codes(summary) & {"channels_aligned", "dynamometer_resonance"},
                         {"channels_aligned"})


class Hammer(FoundCases):
    case = "hammer_parentheses"

    def test_units_in_parentheses_are_read(self):
        for file in ("parentheses.csv", "brackets.csv"):
            self.assertIn("no hit can be used", self.asked("modes", file, "-o", "out", code=1))


class LowPass(FoundCases):
    case = "lowpass_amplifier"

    def test_the_filter_is_found(self):
        self.coefficients(self.answer("identify", "lowpass200Hz.toml"), TRUTH)


class NoiseFree(FoundCases):
    case = "modes_noise_free"

    def test_one_mode_and_no_warning(self):
        for file in ("acc.unv", "even5.unv"):
            summary = self.answer("modes", file)
            modes = summary["result"]["modes"]
            self.assertEqual((len(modes), summary["warnings"]), (1, []), file)
            self.assertAlmostEqual(modes[0]["frequency_Hz"], 159.155, delta=1e-3)
            self.assertAlmostEqual(modes[0]["mass_kg"], 1, delta=1e-5)


class Lobes(FoundCases):
    case = "multifreq_skips_lobe"

    def test_no_lobe_is_skipped(self):
        for rpm, depth in ((8000, 4.53), (7000, 4.72)):
            self.answer("stability", "two33.toml", "--set", f"cut.spindle_rpm={rpm}", "--set",
                        f"stability.spindle_rpm=[{rpm},{rpm},1]")
            row = (self.folder / "out/multi_frequency.csv").read_text().split()[-1]
            self.assertAlmostEqual(float(row.split(",")[1]), depth, delta=0.02)


class ComplexModes(FoundCases):
    case = "stability_complex_frf"

    def test_the_response_decides(self):
        for angle, limit in ((20, 5.85), (10, 6.73)):
            result = self.answer("stability", f"turned_minus{angle}.toml", "--set",
                                 "cut.axial_depth_mm=7")["result"]
            self.assertEqual(result["verdict"], "unstable")
            self.assertAlmostEqual(result["limit_depth_mm"], limit, delta=0.01 * limit)


class Rotating(FoundCases):
    case = "rotating_dynamometer"

    def test_a_rotating_dynamometer_is_called_so(self):
        summary = self.answer("identify", "rotating.toml")
        causes = [w["message"] for w in summary["warnings"] if w["code"] == "likely_cause"]
        self.assertTrue(any('axes = ["u", "-v", "z"]' in c for c in causes), causes)


class Means(FoundCases):
    case = "sampled_mean"

    def test_the_mean_is_exact(self):
        mean = self.answer("simulate", "sim.toml")["result"]["exact_mean_N"]
        self.assertAlmostEqual(mean[0], -486.5325, delta=1e-3)
        self.assertAlmostEqual(mean[1], 254.5452, delta=1e-3)


class Texts(FoundCases):
    case = "record_text_exports"
    READ = ("h_german.csv", "i2_gbk_names.csv", "k_tdmtermite.csv", "o2_stamp_name_time.csv",
            "a_space_nohead.txt", "b2_space_head_nohash.txt", "p8_tabs_meta.txt", "p9_dewesoft.txt")
    KEY = {"c_picoscope.csv": "columns = [...]", "d_digilent.csv": "scale = [...]",
           "e_keysight.csv": "columns = [...]"}

    def check(self, file, code):
        case = (self.folder / "base.toml").read_text() + f'\n[[measurement]]\nfile = "{file}"\n'
        (self.folder / "case.toml").write_text(case)
        return self.asked("check", "case.toml", "--for", "identify", code=code)

    def test_instruments_are_read_or_the_key_is_named(self):
        for file in self.READ:
            self.assertIn("no mistakes found", self.check(file, 0), file)
        for file, key in self.KEY.items():
            self.assertIn(key, self.check(file, 2), file)


class Milliseconds(FoundCases):
    case = "time_in_ms"

    def test_the_unit_is_asked_for(self):
        self.assertIn("time_ms", self.asked("identify", "ms_without_unit.toml", "-o", "out", code=2))


def load_tests(loader, tests, pattern):
    """Without the class that others stand on."""
    suite = unittest.TestSuite()
    for kind in FoundCases.__subclasses__():
        suite.addTests(loader.loadTestsFromTestCase(kind))
    return suite


if __name__ == "__main__":
    if not FOUND.is_dir():
        print(f"skipped: {FOUND} is not here")
        sys.exit(77)
    unittest.main()
