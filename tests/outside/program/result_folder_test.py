"""Where answers go: the folder of a result, what is printed, what is never lost."""
import json
import os
import re
import statistics
import tomllib

from in_folder import InFolder, ROOT, identification, main, simulation

FILES = {"case.toml", "chip.csv", "chip_curve.csv", "edges.csv", "forces.csv", "report.html",
         "summary.json"}


class ResultFolder(InFolder):
    def setUp(self):
        super().setUp()
        self.write("cut.toml", simulation(
            sampling={"edge_angles_deg": [90.0], "edge_heights_mm": [0.0]}))

    def names(self, folder):
        return {p.name for p in (self.folder / folder).iterdir()}

    def test_beside_the_case_by_default(self):
        self.write("deep/my cut.v2.toml", simulation())
        self.run_program("simulate", "deep/my cut.v2.toml", "-q")
        self.assertEqual(self.names("deep/my cut.v2.simulate"), FILES - {"edges.csv"})
        self.assertEqual(self.names("deep"), {"my cut.v2.toml", "my cut.v2.simulate"})

    def test_where_o_says(self):
        for i, option in enumerate((["-o", "out0"], ["--output", "out1"], ["-oout2"],
                                    ["--output=a/b/out3"], ["-o", "out4/"])):
            self.run_program("simulate", "cut.toml", "-q", *option)
        for folder in ("out0", "out1", "out2", "a/b/out3", "out4"):
            self.assertEqual(self.names(folder), FILES)
        self.assertFalse((self.folder / "cut.simulate").exists())

    def test_nothing_else_is_left_beside_it(self):
        self.run_program("simulate", "cut.toml")
        self.run_program("simulate", "cut.toml")
        self.assertEqual(self.names("."), {"cut.toml", "cut.simulate"})

    def test_long_records_leave_small_folders(self):
        """Of 61 200 samples the mean turn is written; --curves keeps every sample."""
        self.write("cut.toml", simulation(sampling={"samples_per_rev": 180,
                                                    "revolutions": 340}))
        self.run_program("simulate", "cut.toml", "-q", "--no-report")
        rows = (self.folder / "cut.simulate/forces.csv").read_text()
        self.write("record.csv", rows)
        self.write("id.toml", identification(identify={"chip_models": ["trochoidal"]}))
        lines = {}
        for option in ([], ["--curves"]):
            self.run_program("identify", "id.toml", "-q", "--no-report", *option)
            for name in ("fitted.csv", "residual.csv"):
                text = (self.folder / "id.identify" / name).read_text()
                lines[name, *option] = text.count("\n") - 1
        self.assertEqual(lines["fitted.csv",], 180)
        self.assertEqual(lines["residual.csv",], 180)
        self.assertEqual(lines["fitted.csv", "--curves"], rows.count("\n") - 1)

    def test_json_prints_exactly_the_summary(self):
        done = self.run_program("simulate", "cut.toml", "--json")
        summary = (self.folder / "cut.simulate/summary.json").read_text()
        self.assertEqual(done.stdout.strip(), summary.strip())
        self.assertEqual(list(json.loads(done.stdout)),
                         ["trochoid", "command", "status", "message", "warnings", "result"])
        self.assertEqual(done.stderr, "")

    def test_a_failed_answer_is_json_too(self):
        self.record()
        self.write("cut.toml", identification(cut={"feed_per_tooth_mm": 0.0}))
        done = self.run_program("identify", "cut.toml", "--json", code=1)
        self.assertEqual(json.loads(done.stdout), self.summary("cut.identify"))

    def test_quiet_prints_nothing(self):
        for option in ("-q", "--quiet"):
            done = self.run_program("simulate", "cut.toml", option)
            self.assertEqual(done.stdout + done.stderr, "")

    def test_no_report_leaves_none_from_before(self):
        self.run_program("simulate", "cut.toml")
        done = self.run_program("simulate", "cut.toml", "--no-report")
        self.assertEqual(self.names("cut.simulate"), FILES - {"report.html"})
        self.assertNotIn("report.html", done.stdout)

    def test_every_number_is_finite_and_no_file_is_empty(self):
        self.run_program("simulate", "cut.toml")
        for file in (self.folder / "cut.simulate").iterdir():
            text = file.read_text()
            self.assertTrue(text.endswith("\n"), file.name)
            if file.suffix in (".csv", ".json"):
                for word in ("nan", "inf"):
                    self.assertNotRegex(text.lower(), rf"\b{word}\b", file.name)

    def test_the_report_needs_no_network(self):
        self.run_program("simulate", "cut.toml")
        page = (self.folder / "cut.simulate/report.html").read_text()
        for word in (" src=", "<link rel=\"stylesheet", "@import", "fetch("):
            self.assertFalse(word in page, word)
        self.assertNotRegex(page, r"url\((?!#)")  # but for a part of a picture itself

    # what is never lost

    def keeps(self, *arguments):
        before = self.everything()
        done = self.run_program(*arguments, code=2)
        self.assertEqual(self.everything(), before)
        self.assertTrue(done.stderr)
        return done.stderr

    def test_a_folder_of_somebody_else_is_kept(self):
        self.write("mine/thesis.doc", "years of work")
        self.assertIn("thesis.doc", self.keeps("simulate", "cut.toml", "-o", "mine"))

    def test_a_file_put_into_a_result_folder_is_kept(self):
        self.run_program("simulate", "cut.toml", "-o", "out")
        self.write("out/notes.txt", "mine")
        self.assertIn("notes.txt", self.keeps("simulate", "cut.toml", "-o", "out"))

    def test_a_folder_with_a_summary_of_another_program_is_kept(self):
        self.write("out/summary.json", "{\"result\": 1}")
        self.keeps("simulate", "cut.toml", "-o", "out")

    def test_the_folder_of_the_case_is_kept(self):
        for place in (".", "./", self.folder, "cut.toml", "cut.toml/sub"):
            self.keeps("simulate", "cut.toml", "-o", place)

    def test_a_place_that_cannot_be_written(self):
        places = ["/proc/trochoid", "/dev/null", "/dev/null/out", "/"]
        if os.geteuid() != 0:
            (self.folder / "locked").mkdir(mode=0o500)
            places.append("locked/out")
        for place in places:
            with self.subTest(place):
                self.keeps("simulate", "cut.toml", "-o", place)

    def test_a_wrong_case_leaves_the_old_answer(self):
        self.run_program("simulate", "cut.toml")
        self.write("cut.toml", simulation(cut={"axial_depth_mm": -1.0}))
        self.keeps("simulate", "cut.toml")

    def test_a_failed_answer_replaces_the_old_one(self):
        self.record()
        self.write("cut.toml", identification())
        self.run_program("identify", "cut.toml")
        self.write("cut.toml", identification(cut={"feed_per_tooth_mm": 0.0}))
        self.run_program("identify", "cut.toml", code=1)
        self.assertEqual(self.summary("cut.identify")["status"], "failed")
        self.assertNotIn("material.toml", self.names("cut.identify"))

    def test_a_link_is_not_followed_into_the_folder_of_somebody_else(self):
        self.write("mine/thesis.doc", "years of work")
        (self.folder / "out").symlink_to("mine")
        self.keeps("simulate", "cut.toml", "-o", "out")


class NewCase(InFolder):
    def test_a_new_case_is_right_as_it_stands(self):
        self.run_program("new", "simulate", "fresh.toml")
        self.run_program("check", "fresh.toml")
        self.run_program("simulate", "fresh.toml", "-q")

    def test_a_new_identification_misses_nothing_but_its_record(self):
        self.run_program("new", "identify", "fresh.toml")
        done = self.run_program("check", "fresh.toml", code=2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(".csv", done.stderr)

    def test_a_new_surface_is_right_as_it_stands(self):
        self.run_program("new", "surface", "fresh.toml")
        self.run_program("check", "fresh.toml")

    def test_a_new_motion_is_right_as_it_stands(self):
        self.run_program("new", "dynamics", "fresh.toml")
        self.run_program("check", "fresh.toml")
        self.run_program("dynamics", "fresh.toml", "-q")
        self.assertEqual(self.summary("fresh.dynamics")["result"]["verdict"], "periodic")

    def test_a_new_calibration_misses_nothing_but_its_surface(self):
        self.run_program("new", "calibrate", "fresh.toml")
        done = self.run_program("check", "fresh.toml", code=2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("wall.csv", done.stderr)
        self.write("wall.csv", "x_mm,height_mm,error_mm\n30,0.5,0.05\n30,1.5,0.03\n")
        self.run_program("check", "fresh.toml")

    def test_a_tool_of_another_program(self):
        self.write("thin.fctb", '{"shape": "endmill.fcstd", "name": "thin", '
                                '"parameter": {"Diameter": "0.5 mm"}}')
        self.run_program("new", "surface", "thin.toml", "--tool", "thin.fctb")
        text = (self.folder / "thin.toml").read_text()
        for line in (r"diameter_mm = 0\.5", r"radial_depth_mm = 0\.5"):
            self.assertRegex(text, f"(?m)^{line}\\b")
        done = self.run_program("new", "modes", "--tool", "thin.fctb", code=2)
        self.assertIn("tool", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_every_material_is_taken_and_names_its_source(self):
        listed = set(re.findall(r"(?m)^\*\*\[(\w+)\]\*\*", (ROOT / "docs/references.md").read_text()))
        materials = sorted((ROOT / "examples/materials").glob("*.toml"))
        self.assertGreater(len(materials), 5)
        page = (ROOT / "examples/materials/README.md").read_text()
        for file in materials:
            named = set(re.findall(r"\[([a-z]+\d{4})\]", file.read_text()))
            self.assertTrue(named and named <= listed, file.name)
            self.assertIn(f"]({file.name})", page)
            self.run_program("new", "simulate", "its.toml", "--material", file)
            done = self.run_program("check", "its.toml", "--for", "simulate")
            self.assertNotIn("warning", done.stdout + done.stderr, file.name)
            (self.folder / "its.toml").unlink()

    def test_the_prior_of_7075_is_the_spread_of_its_four_papers(self):
        def material(name):
            return tomllib.loads((ROOT / f"examples/materials/{name}.toml").read_text())

        papers = [material(name)["force"]
                  for name in ("al7075_t6", "al7075_t6_flat", "al7075_high", "al7075_hss")]
        known = material("al7075")
        for key, prior in known["prior"].items():
            values = [paper[key] for paper in papers if paper[key]]
            self.assertGreaterEqual(len(values), 3)
            self.assertAlmostEqual(prior["mean"] / statistics.mean(values), 1, delta=0.005)
            self.assertAlmostEqual(prior["sd"] / statistics.stdev(values), 1, delta=0.02)
            self.assertEqual(known["force"][key], prior["mean"])
        self.assertEqual(len(known["prior"]), 6)

    def test_power_at_one_feed_and_a_published_prior_tell_all_coefficients(self):
        self.write("power.toml", f"""include = "{ROOT}/examples/materials/al7075.toml"
[tool]
shape = "cylinder"
teeth = 4
diameter_mm = 16.0
helix_deg = 30.0
[cut]
engagement = "slot"
axial_depth_mm = 2.0
feed_per_tooth_mm = 0.08
spindle_rpm = 3000
[dynamometer]
axes = ["power"]
[identify]
chip_models = ["trochoidal"]
runout = "none"
[[measurement]]
mean = [500]
mean_sd = [15]
""")
        self.run_program("identify", "power.toml", "-q", "--no-report")
        fit = json.loads((self.folder / "power.identify/summary.json").read_text())
        fit = fit["result"]["fits"][0]
        self.assertEqual(fit["prior"]["K_tc_MPa"], {"mean": 910, "sd": 310})
        self.assertLess(fit["coefficients"]["K_tc_MPa"]["se"], 310 / 2)
        self.assertIsNone(fit["data_alone"]["K_tc_MPa"])
        self.assertAlmostEqual(fit["coefficients"]["K_rc_MPa"]["se"], 300, places=6)

    def test_a_material_is_found_from_the_new_case(self):
        (self.folder / "cases").mkdir()
        self.write("steel.toml", "[force]\nK_tc_MPa = 1234\nK_rc_MPa = 500\nK_ac_MPa = 100\n"
                                 "K_te_N_per_mm = 9\nK_re_N_per_mm = 8\nK_ae_N_per_mm = 1\n")
        self.run_program("new", "simulate", "cases/its.toml", "--material", "steel.toml")
        text = (self.folder / "cases/its.toml").read_text()
        self.assertIn('include = "../steel.toml"', text)
        self.assertNotIn("[force]  ", text)
        self.run_program("simulate", "cases/its.toml", "-q")
        self.assertIn("K_tc_MPa = 1234", (self.folder / "cases/its.simulate/case.toml").read_text())
        self.write("none.toml", "[tool]\nteeth = 2\n")
        for command, file, says in (("simulate", "none.toml", "[force]"),
                                    ("simulate", "gone.toml", "gone.toml"),
                                    ("identify", "steel.toml", "--material")):
            done = self.run_program("new", command, "no.toml", "--material", file, code=2)
            self.assertIn(says, done.stderr)
            self.assertFalse((self.folder / "no.toml").exists())

    def test_it_is_printed_where_no_file_is_named(self):
        for command in ("simulate", "identify", "surface", "calibrate", "stability",
                        "dynamics", "modes", "actuator"):
            text = self.run_program("new", command).stdout
            self.run_program("new", command, f"{command}.toml")
            self.assertEqual((self.folder / f"{command}.toml").read_text(), text)
            self.assertIn("#", text)

    def test_it_never_overwrites(self):
        self.write("mine.toml", "title = \"mine\"\n")
        (self.folder / "loose.toml").symlink_to("nowhere.toml")
        (self.folder / "folder").mkdir()
        for place in ("mine.toml", "loose.toml", "folder"):
            with self.subTest(place):
                self.run_program("new", "simulate", place, code=2)
        self.assertEqual((self.folder / "mine.toml").read_text(), "title = \"mine\"\n")
        self.assertFalse((self.folder / "nowhere.toml").exists())

    def test_a_place_that_does_not_exist(self):
        done = self.run_program("new", "simulate", "no/such/folder/x.toml", code=2)
        self.assertIn("no/such/folder/x.toml", done.stderr)


class Report(InFolder):
    def page(self, folder):
        """What a report shows: all but the table for those without scripts, which is in
        no file. The order of the tables is free."""
        text = (self.folder / folder / "report.html").read_text()
        text = re.sub("<noscript>.*?</noscript>", "", text, flags=re.S)
        data = re.search('<script[^>]*id="data"[^>]*>(.*?)</script>', text, flags=re.S)
        shown = json.loads(data[1])
        shown["tables"].sort(key=lambda table: table["file"])
        return text.replace(data[1], ""), shown

    def unchanged_but_the_report(self, before):
        after = self.everything()
        self.assertEqual(list(after), list(before))
        changed = [name for name in after if after[name] != before[name]]
        self.assertLessEqual({name.split("/")[-1] for name in changed}, {"report.html"})

    def test_it_is_made_again_from_the_files(self):
        case = ROOT / "examples/st52_slot/case.toml"
        self.run_program("identify", case, "-o", "out", "-q")
        before, page = self.everything(), self.page("out")
        (self.folder / "out/report.html").unlink()
        self.assertIn("report.html", self.run_program("report", "out").stdout)
        self.assertEqual(self.page("out"), page)
        self.unchanged_but_the_report(before)

    def test_a_report_left_out_can_be_made_later(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-q")
        before, page = self.everything(), self.page("cut.simulate")
        self.run_program("simulate", "cut.toml", "-q", "--no-report")
        self.run_program("report", "cut.simulate", "-q")
        self.assertEqual(self.page("cut.simulate"), page)
        self.unchanged_but_the_report(before)

    def test_two_results_on_one_page(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-q", "-o", "slow")
        self.run_program("simulate", "cut.toml", "-q", "-o", "fast", "--set",
                         "cut.spindle_rpm=9000")
        done = self.run_program("report", "slow", "fast/.")
        self.assertIn("power_W", done.stdout)
        text = (self.folder / "compare.html").read_text()
        data = json.loads(re.search('<script[^>]*id="data"[^>]*>(.*?)</script>', text,
                                    flags=re.S)[1])
        self.assertEqual([one["key"] for one in data["summary"]["result"]["inputs"]],
                         ["cut.spindle_rpm"])
        self.assertEqual(data["summary"]["result"]["b"]["name"], "fast")
        self.run_program("report", "slow", "slow", "-o", "compare.html", "-q")
        self.run_program("report", self.folder / "slow", self.folder / "fast", "-q")
        self.assertIn('"name":"slow"', (self.folder / "compare.html").read_text().replace(": ", ":"))
        self.write("mine.html", "mine")
        before = self.everything()
        self.run_program("report", "slow", "fast", "-o", "mine.html", code=2)
        self.run_program("report", "slow", "-o", "mine.html", code=2)
        self.run_program("report", "slow", "nowhere", code=2)
        self.run_program("report", "slow", "fast", "-o", "nowhere/compare.html", code=2)
        self.assertEqual(self.everything(), before)

    def test_what_is_no_result_is_refused(self):
        self.write("mine/summary.json", "{\"result\": 1}")
        self.write("rubbish/summary.json", bytes(range(256)) * 4096)
        self.write("cut.toml", simulation())
        before = self.everything()
        for place in ("nowhere", "mine", "rubbish", ".", "cut.toml", "/dev/null"):
            with self.subTest(place):
                self.run_program("report", place, code=2)
        self.assertEqual(self.everything(), before)

    def test_a_damaged_result_is_refused(self):
        self.write("cut.toml", simulation())
        for file, content in (("forces.csv", "angle_deg,Fx_N\n1,x\n"),
                              ("forces.csv", "angle_deg,Fx_N\n1\n"),
                              ("summary.json", "{\"trochoid\": 1}"),
                              ("summary.json", "{\"trochoid\": {}, \"command\": 7}")):
            with self.subTest(content):
                self.run_program("simulate", "cut.toml", "-q")
                good = (self.folder / "cut.simulate" / file).read_text()
                self.write(f"cut.simulate/{file}", content)
                before = self.everything()
                self.run_program("report", "cut.simulate", code=2)
                self.assertEqual(self.everything(), before)
                self.write(f"cut.simulate/{file}", good)


if __name__ == "__main__":
    main()
