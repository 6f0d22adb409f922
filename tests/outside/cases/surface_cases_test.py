"""Every worked case of ../shared/cases/surface through the program, as a user would.

The expected values and the tolerances stand in the files. Other files of the same kinds
are run just the same; a kind that nobody has met fails.
"""
import csv
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
import case_file as cf  # noqa: E402
import program  # noqa: E402
import surface_case as sc  # noqa: E402


def near(got, want, rel, absolute, what):
    """Problem text, or nothing."""
    if got is None or not abs(got - want) <= rel * abs(want) + absolute:
        return [f"{what}: {got!r}, expected {want!r} within {rel:g} and {absolute:g}"]
    return []


def all_near(got, want, rel, absolute, what):
    if got is None or len(got) != len(want):
        return [f"{what}: {got!r}, expected {len(want)} values {want!r}"]
    return sum((near(a, b, rel, absolute, f"{what}[{i}]")
                for i, (a, b) in enumerate(zip(got, want))), [])


def close_to(column, value):
    return [i for i, v in enumerate(column) if abs(v - value) < 1e-9]


class SurfaceCases(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, command, tables, name, measurement=None):
        text = program.case_text(name, tables)
        if measurement:
            text += "\n[[surface_measurement]]\n" + "".join(
                f"{k} = {program.toml(v)}\n" for k, v in measurement.items())
        answer = program.run(command, text, self.folder, name)
        self.assertEqual(answer.code, 0, f"{name}: exit {answer.code}\n{answer.stderr}\n{text}")
        return answer

    def test_cases(self):
        for c in sc.worked():
            with self.subTest(case=c["id"], kind=c["kind"]):
                check = getattr(self, f"check_{c['kind']}", None)
                self.assertIsNotNone(check, f"{c['id']}: kind {c['kind']} is not known")
                problems = check(c, c["inputs"], c["expected"], c["tol"])
                shown = problems[:12] + ([f"and {len(problems) - 12} more"]
                                         if len(problems) > 12 else [])
                self.assertFalse(problems, f"{c['id']}\n" + "\n".join(shown))

    # structure

    def influence(self, given, name, heights):
        """(height, load height) -> (cutter, wall) of influence.csv"""
        surface = {"heights_mm": [0.0], "influence_heights_mm": sorted(set(heights))}
        tables = sc.tables({**given, "KT": 500.0, "KR": 200.0}, "imprint", **surface)
        col = self.run_program("surface", tables, name).columns("influence.csv")
        wall = col.get("wall_mm_per_N", [None] * len(col["height_mm"]))
        return {(round(h, 9), round(z, 9)): (a, b) for h, z, a, b in
                zip(col["height_mm"], col["load_height_mm"], col["cutter_mm_per_N"], wall)}

    def check_cutter_compliance(self, c, g, want, tol):
        G = self.influence(g, c["id"], g["z_obs"] + g["z_load"])
        got = [G[round(h, 9), round(z, 9)][0] for h, z in zip(g["z_obs"], g["z_load"])]
        return all_near(got, want["G"], tol["rel"], tol["abs"], c["id"])

    def check_plate_uniform(self, c, g, want, tol):
        # D = 1 N mm for a wall 1 mm thick; the cut is there because surface needs one.
        nu, a, b = g["nu"], g["length"], g["height"]
        scale = 100.0  # mm, so that a cutter fits before the wall
        wall = {"length": scale * a, "height": scale * b, "thickness": 1.0,
                "E": 12e3 * (1 - nu**2), "nu": nu}
        tables = sc.tables({"wall": wall, "KT": 500.0, "KR": 200.0, "cut": {**sc.CUT, "ae": 0.1}},
                           "imprint", heights_mm=[1.0])
        height = {"w_free_edge_mid": b, "w_centre": b / 2}
        tables["wall"].update(pressure_kPa=1e-3, loads_x_mm=[scale * a / 2],
                              loads_heights_mm=sorted(scale * height[k] for k in want))
        answer = self.run_program("surface", tables, c["id"])
        col = answer.columns("wall_loads.csv")
        out = []
        for key, value in want.items():
            i = close_to(col["wall_height_mm"], scale * height[key])[0]
            # p = 1 Pa = 1e-6 N/mm^2 and D = 1e3 N mm
            w = col["pressure_deflection_mm"][i] * 1e3 / (1e-6 * (scale * a)**4)
            out += near(w, value, tol["rel"], tol["abs"], f"{c['id']} {key}")
        if "w_free_edge_mid" in want:
            out += near(answer.result["wall_loads"]["pressure"]["coefficient"],
                        want["w_free_edge_mid"], tol["rel"], tol["abs"], f"{c['id']} coefficient")
        return out

    def check_plate_line(self, c, g, want, tol):
        # Gauss nodes make of the answers to single loads that to a load spread evenly.
        nodes = [(0.0, 128 / 225)] + [(s * x, w) for s in (-1, 1) for x, w in
                                      ((0.5384693101056831, 0.47862867049936647),
                                       (0.9061798459386640, 0.23692688505618908))]
        ap, foot = g["ap"], g["wall"]["height"] - g["ap"]
        loads = [(round(ap * (1 + x) / 2, 9), w / 2) for x, w in nodes]
        heights = [round(y - foot, 9) for y in g["y_obs"]]
        given = {"wall": g["wall"], "x": g["x"], "cut": {**sc.CUT, "ap": ap}}
        G = self.influence(given, c["id"], heights + [z for z, _ in loads])
        got = [sum(w * G[h, z][1] for z, w in loads) for h in heights]
        return (all_near(got, want["w"], tol["rel"], tol["abs"], f"{c['id']} influence.csv")
                + self.line_problems(c, given, heights, want, tol)
                + self.line_load_problems(c, given, want, tol))

    def line_load_problems(self, c, given, want, tol):
        """The same as a load of [wall]: 1 N over the axial depth"""
        g = c["inputs"]
        tables = sc.tables({**given, "KT": 500.0, "KR": 200.0}, "imprint", heights_mm=[1.0])
        tables["wall"].update(line_load_N_per_mm=1 / g["ap"], loads_x_mm=[g["x"]],
                              loads_heights_mm=g["y_obs"])
        col = self.run_program("surface", tables, c["id"] + "_load").columns("wall_loads.csv")
        return all_near(col["line_load_deflection_mm"], want["w"], tol["rel"], tol["abs"],
                        f"{c['id']} wall_loads.csv")

    def line_problems(self, c, given, heights, want, tol):
        """The same from the compliance for the concentrated load, less the cutter's part"""
        ap = c["inputs"]["ap"]
        G = self.influence(given, c["id"] + "_cutter", heights + [ap / 2])
        tables = sc.tables({**given, "KT": 500.0, "KR": 200.0, "load": "paper"}, "imprint",
                           heights_mm=heights)
        answer = self.run_program("surface", tables, c["id"] + "_paper")
        got = [h["compliance_mm_per_N"] - G[h["height_mm"], ap / 2][0]
               for h in answer.result["heights"]]
        return all_near(got, want["w"], tol["rel"], tol["abs"], f"{c['id']} compliance")

    # chip and force

    def check_chip(self, c, g, want, tol):
        tables = sc.tables({**g, "cut": {**sc.CUT, "fz": g["fz"], "ap": max(g["z"])},
                            "KT": 500.0, "KR": 200.0}, "imprint")
        for name in ("surface", "cutter_body"):
            del tables[name]
        tables["cut"]["engagement"] = "slot"
        del tables["cut"]["radial_depth_mm"]
        tables["sampling"] = {"angles_deg": [0.137], "edge_angles_deg": g["theta_deg"],
                              "edge_heights_mm": g["z"]}
        col = self.run_program("simulate", tables, c["id"]).columns("chip.csv")
        h = {(int(t), round(z, 9), round(a, 9)): v for t, z, a, v in
             zip(col["tooth"], col["height_mm"], col["edge_angle_deg"], col["h_mm"])}
        places = [(i + 1, round(z, 9), round(a, 9)) for i in range(g["tool"]["N"])
                  for z in g["z"] for a in g["theta_deg"]]
        return all_near([h.get(p) for p in places], want["h"], tol["rel"], tol["abs"], c["id"])

    def check_force(self, c, g, want, tol):
        n, sign = g["n_samples"], 1 if g["cut"]["mode"] == "down" else -1
        tables = sc.tables(g, "quasi_static", phase_deg=g["phi0_deg"], heights_mm=[0.5])
        tables["sampling"] = sc.rotation(g, n)
        col = self.run_program("surface", tables, c["id"]).columns("forces.csv")
        out = self.force_problems(c, col, want, tol["abs"])
        for name in ("surface", "cutter_body"):
            del tables[name]
        tables["sampling"] = {"angles_deg": sc.angles(g, n)}
        col = self.run_program("simulate", tables, c["id"] + "_simulate").columns("forces.csv")
        col["F_normal_N"] = [sign * F for F in col["Fy_N"]]
        return out + self.force_problems(c, col, want, tol["abs"])

    def force_problems(self, c, col, want, absolute):
        rel = c["tol"]["rel"]
        return (all_near(col["F_normal_N"], want["F_normal"], rel, absolute,
                         f"{c['id']} F_normal_N")
                + all_near(col["Fx_N"], want["F_x"], rel, absolute, f"{c['id']} Fx_N"))

    # the three meanings of surface error

    def rotations(self, c, g, count, name=""):
        tables = sc.tables(g, "quasi_static", phase_deg=g["phi0_deg"], heights_mm=[g["height"]])
        tables["sampling"] = sc.rotation(g, count)
        return self.run_program("surface", tables, c["id"] + name)

    def check_surface_error_qs(self, c, g, want, tol):
        count, K = len(want["e"]), g["samples_per_tooth"]
        answer = self.rotations(c, g, count)
        col, bent = answer.columns("surface.csv"), answer.columns("deflection.csv")
        x = [k * g["cut"]["fz"] / K for k in range(count)]
        e = col["error_mm"]
        means = [sum(e[k::K]) * K / count for k in range(K)]
        rel, least, name = tol["rel"], tol["abs"], c["id"]
        out = (all_near(col["x_mm"], x, 0, 1e-9, f"{name} x_mm")
               + all_near(e, want["e"], rel, least, f"{name} error_mm")
               + all_near(bent["deflection_mm"], want["delta"], rel, least, f"{name} deflection")
               + all_near(means, want["nominal"], rel, least, f"{name} nominal")
               + all_near(col["tooth"], want["owner_tooth"], 0, 0, f"{name} tooth"))
        if "c_paper" in want:
            out += near(answer.result["heights"][0]["compliance_mm_per_N"], want["c_paper"],
                        rel, 0.0, f"{name} compliance_mm_per_N")
        return out

    def check_imprint(self, c, g, want, tol):
        answer = self.run_program("surface", sc.tables(g, "imprint", heights_mm=g["heights"]),
                                  c["id"])
        col, out = answer.columns("surface.csv"), []
        for i, h in enumerate(g["heights"]):
            rows = close_to(col["height_mm"], h)
            e = {int(col["tooth"][r]): col["error_mm"][r] for r in rows}
            got = [e.get(t + 1) for t in range(g["tool"]["N"])]
            out += all_near(got, want["e_per_tooth"][i], tol["rel"], tol["abs"],
                            f"{c['id']} error_mm at {h}")
            operator = answer.result["heights"][i]["operator"]
            got = [operator["K_tc_mm_per_MPa"], operator["K_rc_mm_per_MPa"]]
            out += all_near(got, want["M"][i], tol["rel"], tol["M_abs"],
                            f"{c['id']} operator at {h}")
        return out

    def check_envelope(self, c, g, want, tol):
        tables = sc.tables(g, "envelope", heights_mm=[g["height"]])
        tables["sampling"] = {"samples_per_rev": 900, "revolutions": 1}
        answer = self.run_program("surface", tables, c["id"])
        col, at = answer.columns("surface.csv"), answer.result["heights"][0]
        e, tooth = col["error_mm"], col["tooth"]
        seen = {"mean": sum(e) / len(e), "min": min(e), "max": max(e)}
        out = []
        for key, value in seen.items():
            for where, got in (("surface.csv", value), ("summary", at[f"{key}_error_mm"])):
                out += near(got, want[key], tol["rel"], tol["abs"], f"{c['id']} {where} {key}")
        share = [tooth.count(t + 1) / len(tooth) for t in range(g["tool"]["N"])]
        for got in (share, at["share"]):
            out += all_near(got, want["share"], 0.0, tol["share_abs"], f"{c['id']} share")
        return out

    def check_flexible(self, c, g, want, tol):
        answer = self.rotations(c, g, len(want["delta"]))
        out = self.force_problems(c, answer.columns("forces.csv"), want, tol["F_abs"])
        bent = answer.columns("deflection.csv")["deflection_mm"]
        return out + all_near(bent, want["delta"], tol["rel"], tol["abs"], f"{c['id']} delta")

    # calibration

    def calibrate(self, c, g, model, keep=None, **surface):
        """Run on the csv of the case, or on the named columns of it"""
        file = sc.FOLDER / g["csv"]
        if keep:
            with open(file, newline="") as f:
                rows = [[r[k] for k in keep] for r in csv.DictReader(f)]
            file = self.folder / f"{c['id']}.csv"
            with open(file, "w", newline="") as f:
                csv.writer(f).writerows([keep] + rows)
        tables = sc.tables(g, model, **surface)
        tables["force"] = {"law": "linear_edge"}
        if model == "quasi_static":
            tables["sampling"] = {"samples_per_rev": g["samples_per_tooth"] * g["tool"]["N"]}
        # Everything stated: what the readings would decide is asked of other tests.
        tables["surface"] = {"feedback": "none", "errors": "white", **tables["surface"]}
        measurement = {"file": str(file), "form": "offset" if g.get("fit_offset") else "none"}
        return self.run_program("calibrate", tables, c["id"], measurement).result

    def coefficient_problems(self, c, coefficients, want, prefix, what):
        out, keys = [], {"KT": "K_tc_MPa", "KR": "K_rc_MPa"}
        for short, key in keys.items():
            got = coefficients.get(key)
            got = got["value"] if isinstance(got, dict) else got
            out += near(got, want[prefix + short], c["tol"][f"{short}_rel"], 0.0,
                        f"{c['id']} {what} {key}")
        return out

    def error_problems(self, c, coefficients, pairs):
        """Standard errors: either of several accepted pairs.

        Without noise and with a wall the residual is the difference of two plates.
        """
        if c["inputs"].get("wall") and not c["inputs"].get("noise_mm"):
            return []
        got = [coefficients[k]["se"] for k in ("K_tc_MPa", "K_rc_MPa")]
        if any(not all_near(got, pair, 0.05, 0.0, "") for pair in pairs):
            return []
        return [f"{c['id']} se: {got}, expected one of {pairs}"]

    def runout_problems(self, c, runout, want):
        tol = c["tol"]
        turn = (runout.get("angle_deg") or 0.0) - want["lambda_deg"]
        return (near(runout.get("eccentricity_mm"), want["rho"], tol["rho_rel"],
                     tol["rho_abs"], f"{c['id']} eccentricity_mm")
                + near((turn + 180) % 360 - 180, 0.0, 0.0, tol["lambda_abs_deg"],
                       f"{c['id']} angle_deg - expected"))

    def check_calibrate_qs(self, c, g, want, tol):
        result = self.calibrate(c, g, "quasi_static", phase_deg=g["phi0_deg"])
        K, joint = result["coefficients"], want["joint"]
        out = self.runout_problems(c, result["runout"], want)
        pairs = [[w["se_KT"], w["se_KR"]] for w in (want, joint)]
        one = self.coefficient_problems(c, K, want, "", "fit")
        both = self.coefficient_problems(c, K, joint, "", "joint fit")
        return out + (one and both) + self.error_problems(c, K, pairs)

    def check_calibrate_kin(self, c, g, want, tol):
        keep = None if g["use_tooth"] else ["x_mm", "feed_offset_mm", "height_mm",
                                            "deviation_mm"]
        result = self.calibrate(c, g, "imprint", keep)
        pairs = [[want["se_KT"], want["se_KR"]]]
        if "se_KT_grouped" in want:
            pairs += [[want["se_KT_grouped"], want["se_KR_grouped"]]]
        out = self.coefficient_problems(c, result["coefficients"], want, "", "fit")
        out += self.error_problems(c, result["coefficients"], pairs)
        if g["use_tooth"] and "rho" in want:
            out += self.runout_problems(c, result["runout"], want)
        if g["fit_offset"] and "offset" in want:
            out += near(result["offset_mm"], want["offset"], 0.0,
                        tol.get("offset_abs", 1e-3), f"{c['id']} offset_mm")
        return out

    def check_calibrate_envelope(self, c, g, want, tol):
        result = self.calibrate(c, g, "envelope")
        out = self.coefficient_problems(c, result["coefficients"], want, "envelope_", "fit")
        for model in ("imprint", "envelope"):
            answers = [a for a in result["answers"]
                       if a["model"] == model and a["feedback"] == "none"]
            if not answers:
                out += [f"{c['id']}: no answer of {model} in {result['answers']}"]
                continue
            out += self.coefficient_problems(c, answers[0].get("coefficients", answers[0]),
                                             want, f"{model}_", model)
        return out


if __name__ == "__main__":
    if not sc.worked():
        print(f"SKIPPED: there are no worked cases at {sc.FOLDER}")
        sys.exit(77)
    if not pathlib.Path(program.PROGRAM).exists():
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main(verbosity=1)
