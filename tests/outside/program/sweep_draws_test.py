"""What was found, drawn through another case: from a record to a force with its interval."""
import csv
import json
import random

import numpy as np

from in_folder import InFolder, identification, main, program, simulation
import uncertainty

NEXT = {"axial_depth_mm": 3.0, "feed_per_tooth_mm": 0.06}
FRF = ("[frf]\nfile = \"tip.csv\"\nkind = \"receptance\"\nbody = \"tool\"\n"
       "axis = \"x\"\n")


class Draws(InFolder):
    def identified(self, name="known.toml"):
        """A record of the slot with noise, identified."""
        self.write("made.toml", simulation(sampling={"samples_per_rev": 120, "revolutions": 4}))
        self.run_program("simulate", "made.toml", "-q", "--no-report")
        chance = random.Random(5)
        with open(self.folder / "made.simulate/forces.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        lines = ["angle_deg,Fx_N,Fy_N,Fz_N"]
        for row in rows:
            lines.append(",".join([row["angle_deg"]] + [
                str(float(row[f"F{q}_N"]) + chance.gauss(0, 20)) for q in "xyz"]))
        self.write("record.csv", "\n".join(lines) + "\n")
        self.write(name, identification() + "\n[identify]\nrunout = \"offsets\"\n"
                   "errors = \"white\"\nchip_models = [\"trochoidal\"]\nband_harmonics = 0\n")
        self.run_program("identify", name, "-q", "--no-report")
        return self.result("known.identify")

    def modes(self):
        chance = np.random.default_rng(3)
        f = np.arange(700.0, 1100.0, 4.0)
        w = 2 * np.pi * f
        H = 1 / (0.04 * ((2 * np.pi * 900)**2 - w**2 + 2j * 0.02 * 2 * np.pi * 900 * w))
        H = H * (1 + 0.05 * (chance.standard_normal(f.size) + 1j * chance.standard_normal(f.size)))
        rows = [f"{x:g},{h.real:.8g},{h.imag:.8g}" for x, h in zip(f, H)]
        self.write("tip.csv", "\n".join(["frequency_Hz,re_m/N,im_m/N", *rows]) + "\n")
        self.write("tip.toml", FRF)
        self.run_program("modes", "tip.toml", "-q", "--no-report")
        return self.result("tip.modes")

    def result(self, folder):
        return json.loads((self.folder / folder / "summary.json").read_text())["result"]

    def case(self, sweep, **changes):
        return self.write("next.toml", simulation(**{"cut": NEXT, **changes})
                          + '\n[sweep]\ncommand = "simulate"\ntake = ["result.peak_xy_N"]\n'
                          + sweep)

    def table(self, name):
        with open(self.folder / "next.sweep" / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_the_covariance_is_that_of_the_intervals(self):  # [U-1]
        found = self.identified()
        half = uncertainty.half_widths(found["covariance"])
        for key, K in found["fits"][0]["coefficients"].items():
            self.assertAlmostEqual(2 * half[f"force.{key}"] / (K["high"] - K["low"]), 1, 9)
        runout = found["fits"][0]["runout"]
        self.assertAlmostEqual(
            half["runout.radial_offsets_mm[2]"] / runout["radial_offsets_se_mm"][1]
            / found["fits"][0]["interval_factor"], 1, 9)
        found = self.modes()
        half = uncertainty.half_widths(found["covariance"])
        for key in ("frequency_Hz", "damping_ratio", "mass_kg"):
            self.assertAlmostEqual(
                half[f"mode[1].{key}"] / found["modes"][0]["se"][key] / 1.96, 1, 9)

    def test_draws_are_those_of_the_covariance_and_carry_the_force(self):  # [U-4]
        found = self.identified()["covariance"]
        self.case('covariance = "known.identify"\ndraws = 1000\nmethod = "latin_hypercube"')
        printed = self.run_program("sweep", "next.toml", "--no-report").stdout
        self.assertIn("95 % from", printed)
        self.assertIn("the lower one lies within", printed)
        rows = self.table("sweep.csv")
        self.assertEqual(list(rows[0])[:2], ["draw", "force.K_tc_MPa"])
        x = np.array([[float(row[name]) for name in found["names"]] for row in rows])
        wanted = np.array(found["matrix"])
        sd = np.sqrt(np.diag(wanted))
        np.testing.assert_allclose(np.corrcoef(x.T), wanted / np.outer(sd, sd), atol=0.1)
        np.testing.assert_allclose(x.std(0), sd, rtol=0.12)
        np.testing.assert_allclose(x.mean(0), found["found"], atol=0.02 * sd.max())
        peaks = [float(row["peak_xy_N"]) for row in rows]
        told = self.result("next.sweep")["quantities"][0]
        own = uncertainty.spread(peaks)
        for key in ("median", "low", "high", "sd", "mean"):
            self.assertAlmostEqual(told[key], own[key], 6)
        np.testing.assert_allclose([told["low_between"], told["high_between"]], own["bounds"])
        self.assertEqual(told["without_answer"], 0)
        # The truth is known, and the first row of all is the case itself.
        self.write("true.toml", simulation(cut=NEXT))
        self.run_program("simulate", "true.toml", "-q", "--no-report")
        truth = self.result("true.simulate")["peak_xy_N"]
        self.assertTrue(told["low"] < truth < told["high"], (truth, told))

    def test_a_grid_has_a_band_and_the_same_bits_again(self):  # [U-7]
        self.identified()
        self.case('covariance = "known.identify/summary.json"\ndraws = 30\n'
                  'over = { "cut.spindle_rpm" = { values = [800, 1600] }, '
                  '"cut.axial_depth_mm" = { values = [1, 3] } }')
        printed = self.run_program("sweep", "next.toml", "--no-report",
                                   TROCHOID_THREADS="1").stdout
        self.assertIn("hardly known", printed)
        rows, bands = self.table("sweep.csv"), self.table("bands.csv")
        self.assertEqual((len(rows), len(bands)), (120, 4))
        for i, band in enumerate(bands):
            own = uncertainty.spread(
                [float(r["peak_xy_N"]) for r in rows[30 * i:30 * i + 30]])
            self.assertEqual(band["cut.axial_depth_mm"], ["1", "3"][i % 2])
            for key in ("median", "low", "high", "sd"):
                self.assertAlmostEqual(float(band[f"{key}_peak_xy_N"]), own[key], 6)
            self.assertEqual([r["force.K_tc_MPa"] for r in rows[30 * i:30 * i + 30]],
                             [r["force.K_tc_MPa"] for r in rows[:30]])
        bits = (self.folder / "next.sweep/sweep.csv").read_bytes()
        for again in (["next.toml"], ["next.sweep/case.toml", "-o", "copy"]):
            self.run_program("sweep", *again, "-q", "--no-report", TROCHOID_THREADS="3")
            folder = "copy" if "copy" in again else "next.sweep"
            self.assertEqual((self.folder / folder / "sweep.csv").read_bytes(), bits)

    def test_modes_replace_those_of_the_case(self):  # [U-5]
        self.modes()
        self.case('covariance = ["tip.modes"]\ndraws = 40\n')
        case = self.folder / "next.toml"
        case.write_text(case.read_text().replace('"simulate"', '"stability"').replace(
            "result.peak_xy_N", "result.limit_depth_mm") + "\n[stability]\n"
            "spindle_rpm = [875, 875, 1]\naxial_depth_mm = [0.01, 3, 2]\n"
            '[[mode]]\nbody = "tool"\naxis = "y"\nfrequency_Hz = 890\nmass_kg = 1\n'
            'damping_ratio = 0.1\n')
        done = self.run_program("sweep", "next.toml", code=2)
        self.assertIn("a mode of the tool along x at ", done.stderr)
        self.assertIn("no such mode", done.stderr)
        case.write_text(case.read_text().replace('axis = "y"', 'axis = "x"'))
        self.run_program("sweep", "next.toml", "-q", "--no-report")
        rows = self.table("sweep.csv")
        self.assertTrue(all(0.03 < float(row["mode[1].mass_kg"]) < 0.05 for row in rows))
        self.assertGreater(self.result("next.sweep")["quantities"][0]["sd"], 0)

    def test_what_cannot_be_drawn_is_told(self):
        self.identified()
        good = json.loads((self.folder / "known.identify/summary.json").read_text())
        self.write("old.json", json.dumps({**good, "result": {
            k: v for k, v in good["result"].items() if k != "covariance"}}))
        self.write("failed.json", json.dumps({**good, "status": "failed", "message": "why"}))
        self.write("other.json", json.dumps({**good, "command": "simulate"}))
        bent = json.loads(json.dumps(good))
        bent["result"]["covariance"]["matrix"][0][0] = -1.0
        self.write("bent.json", json.dumps(bent))
        none = json.loads(json.dumps(good))
        none["result"]["covariance"]["found"][0] = None
        self.write("none.json", json.dumps(none))
        for i, name in enumerate(("mode[x].mass_kg", "runout.e_x_mm", "cut.spindle_rpm",
                                  "runout.radial_offsets_mm[9]", "force.a.b", "")):
            odd = json.loads(json.dumps(good))
            odd["result"]["covariance"]["names"][-1] = name
            self.write(f"odd{i}.json", json.dumps(odd))
            self.case(f'covariance = "odd{i}.json"')
            self.assertIn("something else than what the command finds",
                          self.run_program("sweep", "next.toml", code=2).stderr, name)
        self.write("text.json", "{}")
        for sweep, says in (
                ('covariance = "gone"', "there is no such file"),
                ('covariance = "text.json"', "not a summary.json of trochoid"),
                ('covariance = "old.json"', "run identify again"),
                ('covariance = "failed.json"', "had no answer there (why)"),
                ('covariance = "other.json"', "must be of identify, modes or calibrate"),
                ('covariance = "bent.json"', "a variance below zero"),
                ('covariance = "none.json"', "not one finite number"),
                ('covariance = { file = "known.identify", group = "a" }', 'no group "a"'),
                ("covariance = 3", "its folder"),
                ("draws = 3", "`covariance` is missing"),
                ('covariance = "known.identify"\ndraws = 0', "from 1 to"),
                ('covariance = "known.identify"\nmethod = "random"\ncount = 3', "`draws` says"),
                ('covariance = "known.identify"\nover = { "force.K_tc_MPa" = '
                 '{ values = [1] } }', "either of them")):
            self.case(sweep)
            done = self.run_program("sweep", "next.toml", code=2)
            self.assertIn(says, done.stderr, sweep)
            self.assertIn("next.toml:", done.stderr, sweep)
            self.assertFalse((self.folder / "next.sweep").exists())
        self.case('covariance = "known.identify"',
                  tool={"teeth": 3}, runout={"radial_offsets_mm": [0, 0, 0]})
        self.assertIn("the runout of 2 teeth, but the case has tool.teeth = 3",
                      self.run_program("sweep", "next.toml", code=2).stderr)

    def test_what_was_not_found_stays_with_a_warning(self):
        self.identified()
        summary = self.folder / "known.identify/summary.json"
        told = json.loads(summary.read_text())
        told["result"]["covariance"]["not_found"] = [
            {"name": "force.K_ae_N_per_mm", "why": "no reason"}]
        told["result"]["covariance"]["chip_model"] = "none"
        summary.write_text(json.dumps(told))
        self.case('covariance = "known.identify"\ndraws = 5',
                  force={"K_tc_MPa": 1000})
        printed = self.run_program("sweep", "next.toml", "--no-report").stdout
        for says in ("warning [other_chip_model]", "warning [not_drawn]", "K_ae_N_per_mm stays", "[other_value]",
                     "force.K_tc_MPa = 1000"):
            self.assertIn(says, printed)


if __name__ == "__main__":
    main()
