"""plan: its folder, its exit codes, a case to start from; and groups, as a user meets them."""
import csv

from in_folder import ROOT, InFolder, identification, main, program, simulation, tables

EXAMPLE = ROOT / "examples/plan_next_cut/case.toml"


class Plan(InFolder):
    def rows(self, folder, file):
        with open(self.folder / folder / file) as stream:
            return list(csv.DictReader(stream))

    def test_what_it_writes(self):
        self.run_program("plan", EXAMPLE, "-o", "out")
        files = {p.name for p in (self.folder / "out").iterdir()}
        self.assertEqual(files, {"case.toml", "summary.json", "report.html", "plan.csv"})
        summary = self.summary("out")
        self.assertEqual(summary["status"], "ok")
        self.assertTrue(summary["message"].startswith("Cut next: "))
        result, rows = summary["result"], self.rows("out", "plan.csv")
        left_out = sum(one["count"] for one in result["left_out"])
        self.assertEqual(len(rows) + left_out, result["looked_at"])
        self.assertEqual(len(result["cuts"]), min(100, len(rows)))
        best = result["cuts"][0]
        self.assertEqual(float(rows[0]["feed_per_tooth_mm"]), best["feed_per_tooth_mm"])
        for key, entry in best["predicted"].items():
            width = (entry["high"] - entry["low"]) / 2
            self.assertAlmostEqual(float(rows[0][f"half_width_{key}"]), width, delta=1e-9)
            self.assertLess(entry["se"], result["before"][key]["se"])
        narrows = [float(row["narrows"]) for row in rows]
        self.assertEqual(narrows, sorted(narrows, reverse=True))
        self.assertTrue(all(float(row["peak_force_N"]) <= 450 for row in rows))

    def test_the_next_cut_for_a_power_meter(self):
        """[I-30] Power of a cut by the textbook's sums, and the posterior of two normal unknowns."""
        import numpy as np
        example = (ROOT / "examples/spindle_power/case.toml").read_text()
        self.write("plan.toml", example + "\n[plan]\nquantities = [\"coefficients\"]\n")
        self.run_program("plan", "plan.toml", "-o", "out", "-q")
        result = self.summary("out")["result"]
        R, N, Omega = 8e-3, 4, 2 * np.pi * 3000 / 60

        def column(f_z, a_p, a_e):
            """Power for K_tc of 1 MPa, K_te of 1 N/mm: N teeth in their arc, edges as long as their helix."""
            arc = np.arccos(1 - a_e / R)
            share = N / (2 * np.pi) * R * Omega * a_p
            return share * np.array([1e6 * f_z * (1 - np.cos(arc)), 1e3 * arc / np.cos(np.pi / 6)])

        def half_widths(cuts):
            information = np.diag([1 / 300 ** 2, 1 / 10 ** 2])
            for cut in cuts:
                c = column(*cut)
                information += np.outer(c, c) / 15 ** 2
            return 1.96 * np.sqrt(np.diag(np.linalg.inv(information)))

        known = [(f * 1e-3, 16e-3, 4e-3) for f in (0.04, 0.08, 0.12)]
        self.assertEqual(set(result["before"]), {"K_tc_MPa", "K_te_N_per_mm"})
        for cut in result["cuts"]:
            if cut["engagement"] != "down":
                continue
            expected = half_widths([*known, (cut["feed_per_tooth_mm"] * 1e-3, cut["axial_depth_mm"] * 1e-3,
                                             cut["radial_depth_mm"] * 1e-3)])
            for key, width in zip(("K_tc_MPa", "K_te_N_per_mm"), expected):
                entry = cut["predicted"][key]
                self.assertAlmostEqual((entry["high"] - entry["low"]) / 2, width, delta=0.02 * width)
        codes = [w["code"] for w in self.summary("out")["warnings"]]
        self.assertIn("not_planned", codes)

    def test_after_the_best_cut_the_intervals_are_as_narrow_as_promised(self):
        """Simulate the cut, put it beside the record, identify both."""
        white = EXAMPLE.read_text().replace("[identify]", '[identify]\nerrors = "white"')
        self.write("plan.toml", white.replace("..", str(ROOT / "examples")))
        self.run_program("plan", "plan.toml", "-o", "out", "-q")
        result = self.summary("out")["result"]
        best, noise = result["cuts"][0], result["noise_N"]
        cut = {"engagement": best["engagement"], **{k: best[k] for k in (
            "feed_per_tooth_mm", "axial_depth_mm")}}
        self.write("next.toml", simulation(
            cut={**cut, "spindle_rpm": 874.3},
            sampling={"samples_per_rev": 343, "revolutions": 6}))
        self.run_program("simulate", "next.toml", "-o", "next", "-q")
        import numpy as np
        rows = self.rows("next", "forces.csv")
        F = -np.array([[float(row[f"F{q}_N"]) for q in "xyz"] for row in rows])
        F += noise * np.random.default_rng(5).standard_normal(F.shape)
        angle = [float(row["angle_deg"]) for row in rows]
        np.savetxt(self.folder / "next.csv", np.column_stack([angle, F]), delimiter=",",
                   header="angle_deg,Fx_N,Fy_N,Fz_N", comments="", fmt="%.6g")
        given = tables()
        del given["runout"]
        given["force"] = {"law": "linear_edge"}
        given["dynamometer"] = {"axes": ["-x", "-y", "-z"]}
        given["identify"] = {"chip_models": ["trochoidal"], "channel_offsets": "fit",
                             "runout": "offsets", "errors": "white"}
        record = str(ROOT / "examples/st52_slot/record.csv")
        self.write("both.toml", program.case_text("both", given, [
            {"file": record}, {"file": "next.csv", "cut": cut}]))
        self.run_program("identify", "both.toml", "-q")
        fit = self.summary("both.identify")["result"]["fits"][0]
        for key in ("K_te_N_per_mm", "K_re_N_per_mm"):
            got, promised = fit["coefficients"][key], best["predicted"][key]
            # The widening of two records together is another one than of the first.
            ratio = (got["high"] - got["low"]) / (promised["high"] - promised["low"])
            self.assertAlmostEqual(ratio, 1.0, delta=0.25, msg=key)

    def test_no_answer(self):
        self.write("none.toml", simulation(plan={"max_force_N": 0.001}))
        self.run_program("plan", "none.toml", code=1)
        summary = self.summary("none.plan")
        self.assertEqual(summary["status"], "failed")
        self.assertIn("above max_force_N", summary["message"])
        self.assertEqual(summary["result"]["cuts"], [])

    def test_a_single_tooth_has_no_runout_to_plan_for(self):
        self.write("one.toml", simulation(tool={"teeth": 1}, runout={
            "radial_offsets_mm": [0.0]}))
        self.run_program("plan", "one.toml", "-q")
        self.assertEqual(list(self.summary("one.plan")["result"]["before"]),
                         ["K_tc_MPa", "K_rc_MPa"])

    def test_check_reads_a_plan(self):
        self.write("case.toml", simulation(plan={"turns": 5}))
        self.run_program("check", "case.toml")
        self.write("wrong.toml", simulation(plan={"turn": 5}))
        self.run_program("check", "wrong.toml", code=2)


class PlanOfAWall(InFolder):
    def rows(self, folder, file):
        with open(self.folder / folder / file) as stream:
            return list(csv.DictReader(stream))

    def test_what_it_writes(self):
        done = self.run_program("plan", ROOT / "examples/plan_wall/case.toml", "-o", "out")
        files = {p.name for p in (self.folder / "out").iterdir()}
        self.assertEqual(files, {"case.toml", "summary.json", "report.html", "plan.csv",
                                 "error_map.csv"})
        self.assertRegex(done.stdout, r"(?m)^\* \d+ heights")
        summary = self.summary("out")
        self.assertTrue(summary["message"].startswith("Measure "))
        result, rows = summary["result"], self.rows("out", "plan.csv")
        self.assertEqual(len(rows), len(result["designs"]))
        readings = [int(row["readings"]) for row in rows]
        self.assertEqual(readings, sorted(readings))
        enough = [row for row in rows if row["enough"] == "1"]
        self.assertEqual(int(enough[0]["readings"]), result["chosen"]["readings"])
        self.assertEqual(len(self.rows("out", "error_map.csv")), 15 * 15)
        best, limit = result["cutting"]["best"], result["cutting"]["largest_error_um"]
        self.assertLessEqual(best["peak_error_um"], limit)

    def test_what_is_promised_is_what_calibrate_then_says(self):
        """The readings of the example: planned and fitted, the same standard errors."""
        example = ROOT / "examples/thin_wall_calibrate"
        text = (example / "case.toml").read_text()
        # Everything stated: what the readings leave open is not in a plan.
        text = text.replace('"profile.csv"', f'"{example}/profile.csv"\nform = "offset"')
        text = text.replace('[surface]\n', '[surface]\nfeedback = "none"\nerrors = "white"\n')
        case = self.folder / "stated.toml"
        case.write_text(text)
        self.run_program("plan", case, "-o", "plan", "-q", "--no-report")
        self.run_program("calibrate", case, "-o", "fit", "-q", "--no-report")
        so_far = self.summary("plan")["result"]["so_far"]
        found = self.summary("fit")["result"]
        for key in ("K_tc_MPa", "K_rc_MPa"):
            self.assertAlmostEqual(so_far[key]["se"], found["coefficients"][key]["se"],
                                   delta=0.02 * so_far[key]["se"])
        self.assertAlmostEqual(so_far["eccentricity_mm"]["se"],
                               found["runout"]["eccentricity_se_mm"], delta=1e-5)

    def test_no_answer(self):
        text = (ROOT / "examples/plan_wall/case.toml").read_text()
        self.write("none.toml", text.replace("helix_deg = 45.0", "helix_deg = 0.0").replace(
            'model = "envelope"', 'model = "imprint"').replace("probe_diameter_mm = 1.0", ""))
        self.run_program("plan", "none.toml", code=1)
        self.assertEqual(self.summary("none.plan")["status"], "failed")


class Groups(InFolder):
    def test_each_group_has_a_column_and_a_material(self):
        for name, factor in (("new", 1.0), ("worn", 1.5)):
            K = {k: v * factor for k, v in tables()["force"].items() if k.startswith("K_")}
            self.write(f"{name}.toml", simulation(force=K, sampling={"samples_per_rev": 180}))
            self.run_program("simulate", f"{name}.toml", "-q", "--no-report")
        text = identification("new.simulate/forces.csv") + "group = \"new\"\n"
        text += "[[measurement]]\nfile = \"worn.simulate/forces.csv\"\ngroup = \"after 10 min\"\n"
        self.write("wear.toml", text)
        done = self.run_program("identify", "wear.toml")
        self.assertRegex(done.stdout, r"(?m)^group .* new +after 10 min$")
        result = self.summary("wear.identify")["result"]
        new, worn = (one["coefficients"]["K_tc_MPa"]["value"] for one in result["groups"])
        self.assertAlmostEqual(new, 2620, delta=1)
        self.assertAlmostEqual(worn, 3930, delta=1)
        second = (self.folder / "wear.identify/material_2.toml").read_text()
        self.assertIn('# Of "after 10 min".', second)
        self.run_program("identify", "wear.toml", "-q")  # the folder is ours to replace


if __name__ == "__main__":
    main()
