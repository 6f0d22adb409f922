"""Every worked case of ../shared/cases/force through the program, as a user would.

The expected values and the tolerances stand in the files. Other files of the same kinds
are run just the same.
"""
import math
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
import case_file as cf  # noqa: E402
import program  # noqa: E402


def near(a, b, tolerance, what):
    """Problem text, or nothing."""
    if a is None or not abs(a - b) <= tolerance:
        return [f"{what}: {a!r}, expected {b!r} within {tolerance:.3g}"]
    return []


def all_near(a, b, tolerances, what):
    if a is None or len(a) != len(b):
        return [f"{what}: {a!r}, expected {b!r}"]
    tol = tolerances if isinstance(tolerances, list) else [tolerances] * len(b)
    return sum((near(x, y, t, f"{what}[{i}]") for i, (x, y, t) in
                enumerate(zip(a, b, tol))), [])


def turned(intervals):
    """Each interval with its start in [-90, 270) deg, in order."""
    out = []
    for a, b in intervals:
        turns = math.floor((a + 90) / 360)
        out.append([a - 360 * turns, b - 360 * turns])
    return sorted(out)


class WorkedCases(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="trochoid_")
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, command, content, name, code=0):
        answer = program.run(command, content, self.folder, name)
        self.assertEqual(answer.code, code,
                         f"{name}: exit {answer.code}\n{answer.stderr}\n{content}")
        return answer

    def check(self, problems):
        shown = problems[:12] + ([f"and {len(problems) - 12} more"]
                                 if len(problems) > 12 else [])
        self.assertFalse(problems, "\n" + "\n".join(shown))

    # chip

    def chip_case(self, c, model):
        angles = sorted({s["theta_deg"] for s in c["samples"]})
        tables = cf.tables(c, model)
        tables["sampling"] = {"angles_deg": [0.137], "edge_angles_deg": angles,
                              "edge_heights_mm": [c["z"]]}
        return tables

    def chip_problems(self, c, model):
        name = f"{c['id']} {model}"
        answer = self.run_program("simulate", program.case_text(name, self.chip_case(c, model)),
                                  f"{c['id']}_{model}")
        col = answer.columns("chip.csv")
        h = {(int(t), round(a, 9)): v for t, a, v in
             zip(col["tooth"], col["edge_angle_deg"], col["h_mm"])}
        tol, out = c["tolerance"], []
        for s in c["samples"]:
            out += near(h.get((s["tooth"], round(s["theta_deg"], 9))), s["h"][model], tol["h_mm"],
                        f"{name} tooth {s['tooth']} at {s['theta_deg']}: h_mm")
        for tooth, want in enumerate(c["engagement_deg"][model]):
            got = turned(answer.result["teeth"][tooth]["intervals_deg"])
            flat = [x for i in got for x in i]
            out += all_near(flat, [x for i in turned(want) for x in i],
                            tol["engagement_deg"], f"{name} tooth {tooth + 1} in cut")
        if model == "exact" and "area_per_rev_mm2" in c:
            want = c["area_per_rev_mm2"]
            out += near(answer.result["volume_check"]["removed_mm2_per_rev"], want,
                        tol["area_rel"] * want, f"{name} removed_mm2_per_rev")
        return out

    def test_chips(self):  # [C-2] [C-3] [C-4] [C-5] [C-6] [C-7] [C-8] [G-11]
        for c in cf.worked("chip"):
            for model in c["samples"][0]["h"]:
                with self.subTest(case=c["id"], model=model):
                    self.check(self.chip_problems(c, model))

    # force

    def channels(self, c, answer):
        col = answer.columns("forces.csv")
        names = (["channel1_N", "channel2_N", "channel3_N"] if "output_map" in c
                 else ["Fx_N", "Fy_N", "Fz_N"])
        return list(zip(*(col[n] for n in names)))

    def at_angles(self, c):
        tables = cf.tables(c, c["model"])
        tables["sampling"] = {"angles_deg": c["phi_deg"]}
        answer = self.run_program("simulate", program.case_text(c["id"], tables), c["id"])
        tol = c["tolerance"].get("F_converged_N", c["tolerance"]["F_N"])
        out = []
        for phi, got, want in zip(c["phi_deg"], self.channels(c, answer), c["F_N"]):
            out += all_near(got, want, tol, f"{c['id']} F at {phi} deg")
        return out

    def on_grid(self, c):
        grid, tol = c["grid"], c["tolerance"]
        tables = cf.tables(c, c["model"])
        tables["sampling"] = {"samples_per_rev": grid["n"], "revolutions": 1,
                              "start_deg": grid["offset_deg"]}
        answer = self.run_program("simulate", program.case_text(c["id"], tables), c["id"] + "_grid")
        F = self.channels(c, answer)
        mean_tol = max(tol["grid_mean_N"], tol.get("F_converged_N", 0.0))
        end_tol = max(tol["grid_extreme_N"], tol.get("F_converged_N", 0.0))
        axes = list(zip(*F))
        n = len(F)
        stats = {"mean_N": [sum(a) / n for a in axes], "max_N": [max(a) for a in axes],
                 "min_N": [min(a) for a in axes],
                 "rms_N": [math.sqrt(sum(v * v for v in a) / n) for a in axes]}
        peak = max(math.hypot(f[0], f[1]) for f in F)
        out = [] if n == grid["n"] else [f"{c['id']}: {n} rows, expected {grid['n']}"]
        for key, got in stats.items():
            t = end_tol if key in ("max_N", "min_N") else mean_tol
            out += all_near(got, grid[key], t, f"{c['id']} forces.csv {key}")
        out += near(peak, grid["peak_xy_N"], end_tol, f"{c['id']} forces.csv peak")
        if "output_map" not in c:  # summary.json speaks of the force on the tool
            of_samples = {k: v for k, v in stats.items() if k != "mean_N"}  # that of the turn
            for key, want in {**of_samples, "peak_xy_N": peak}.items():
                compare = all_near if isinstance(want, list) else near
                out += compare(answer.result[key], want, 1e-9, f"{c['id']} summary {key}")
            size = max(abs(v) for f in F for v in f)
            for key in ("mean_exact_N", "closed_form_mean_N"):
                if key in c:
                    out += all_near(answer.result["mean_N"], c[key],
                                    tol["mean_rel_of_peak"] * size, f"{c['id']} {key}")
        return out

    def test_forces(self):  # [F-1] [F-3] [F-4] [F-8] [G-2] [G-3] [G-4]
        for c in cf.worked("force"):
            with self.subTest(case=c["id"], what="angles"):
                self.check(self.at_angles(c))
            with self.subTest(case=c["id"], what="grid"):
                self.check(self.on_grid(c))

    # identification

    def measurement(self, c):
        return [{"file": str(cf.SHARED / "cases/force" / c["csv"]), "format": "csv"}]

    def identify(self, c, model, name, identify, runout=None, code=0):
        tables = cf.tables(c, model)
        chip = tables["chip"].pop("model")
        if not tables["chip"]:
            del tables["chip"]
        tables["runout"].update(runout or {})
        tables["force"] = {"law": "linear_edge"}
        tables["identify"] = {"chip_models": [chip], "band_harmonics": 0, "errors": "white",
                              **identify}
        return self.run_program("identify", program.case_text(name, tables, self.measurement(c)),
                                name.replace(" ", "_"), code)

    def coefficient_problems(self, fit, K, tol, name, se=None, se_rel=0.0):
        got = [fit["coefficients"].get(k) for k in cf.COEFFICIENTS.values()]
        if any(not isinstance(v, dict) for v in got):
            return [f"{name}: coefficients {fit['coefficients']}"]
        out = all_near([v["value"] for v in got], K, tol, f"{name} K")
        if se:
            out += all_near([v["se"] for v in got], se, [se_rel * s for s in se],
                            f"{name} se(K)")
        return out

    def test_fits_at_fixed_runout(self):  # [I-1] [I-2] [I-5] [I-6]
        for c in cf.worked("ident"):
            for f in c.get("fits", []):
                name = f"{c['id']} {f['label']}"
                with self.subTest(fit=name):
                    answer = self.identify(
                        c, f["model"], name,
                        {"runout": "fixed", "phase_deg": f["phase_deg"]},
                        cf.runout(f["shift_mm"], f["rho_mm"], f["lambda_deg"],
                                  c["runout"]["order"]))
                    fit, tol = answer.result["fits"][0], f["tolerance"]
                    out = self.coefficient_problems(fit, f["K"], tol["K"], name, f["se"],
                                                    tol["se_rel"])
                    out += near(fit["rms_N"], f["rms_vec_N"], tol["rms_N"], f"{name} rms")
                    out += all_near(fit["rms_axis_N"], f["rms_axis_N"], tol["rms_N"],
                                    f"{name} rms of axes")
                    out += near(fit["condition"], f["cond_scaled"],
                                tol["cond_rel"] * f["cond_scaled"], f"{name} condition")
                    self.check(out)

    def unknowns(self, c, f):
        """[identify] for the named parameters, or why not."""
        names = set(f["parameters"])
        shifts = {n for n in names if n.startswith("shift:")}
        rest = names - shifts - {"ex", "ey", "phase"}
        want = {f"shift:{k}" for k in range(1, c["tool"]["N"])}
        phase = "free" if "phase" in names else f.get("phase_deg", 0.0)
        if rest or (shifts and shifts != want) or (shifts and names & {"ex", "ey"}):
            return None
        if names & {"ex", "ey"} and not {"ex", "ey"} <= names:
            return None
        kind = "offsets" if shifts else "eccentricity" if "ex" in names else "fixed"
        return {"runout": kind, "phase_deg": phase}

    def test_joint_fits(self):  # [I-3] [I-4]
        for c in cf.worked("ident"):
            for f in c.get("joint", []):
                name = f"{c['id']} joint {f['label']}"
                with self.subTest(fit=name):
                    identify = self.unknowns(c, f)
                    if identify is None:
                        self.skipTest(f"{name}: no such choice: {f['parameters']}")
                    self.check(self.joint_problems(c, f, name, identify))

    def joint_problems(self, c, f, name, identify):
        start = {"radial_offsets_mm": [0.0] * c["tool"]["N"], "eccentricity_mm": 0.0}
        given = None if identify["runout"] == "fixed" else start
        answer = self.identify(c, f["model"], name, identify, given)
        fit, tol = answer.result["fits"][0], f["tolerance"]
        out = self.coefficient_problems(fit, f["K"], tol["K"], name, f["se_K"],
                                        tol["se_rel"])
        out += near(fit["rms_N"], f["rms_vec_N"], tol["rms_N"], f"{name} rms")
        out += all_near(fit["rms_axis_N"], f["rms_axis_N"], tol["rms_N"], f"{name} axes")
        want, se = dict(zip(f["parameters"], f["p"])), dict(zip(f["parameters"], f["se_p"]))
        t = dict(zip(f["parameters"], tol["p"]))
        got = min((relabelled(c, fit, k) for k in range(c["tool"]["N"])),
                  key=lambda g: sum(abs(g[n] - want[n]) / t[n] for n in want))
        for n in want:
            out += near(got[n], want[n], t[n], f"{name} {n}")
        if identify["runout"] == "offsets":
            sigma = fit["runout"]["radial_offsets_se_mm"]
            for n in (n for n in want if n.startswith("shift:")):
                k = int(n[6:])
                if len(sigma) == 2 or got["numbered from"] == 0:
                    out += near(sigma[k], se[n], tol["se_rel"] * se[n], f"{name} se({n})")
        if identify["runout"] == "eccentricity" and "corr" in f:
            want_se = eccentricity_se(f, want, se)
            out += near(fit["runout"]["eccentricity_se_mm"], want_se,
                        tol["se_rel"] * want_se, f"{name} se(eccentricity)")
        return out

    def test_sweeps(self):  # Fig. 9 of the paper
        for c in (c for c in cf.worked("ident") if "sweep" in c):
            s = c["sweep"]
            x = s["shift2_um"]
            for model, want in s["rms_vec_N"].items():
                with self.subTest(case=c["id"], model=model):
                    answer = self.identify(
                        c, model, f"{c['id']} sweep {model}",
                        {"runout": "fixed", "phase_deg": c["truth"]["phase_deg"],
                         "sweep_um": [x[0], x[-1], len(x)]})
                    col = answer.columns("sweep.csv")
                    key = f"rms_{cf.MODELS[model][0]}_N"
                    self.check(all_near(col["offset_um"], x, 1e-9, "offset_um")
                               + all_near(col[key], want, s["tolerance_N"], key))

    def test_refusals(self):  # [I-6]
        for c in (c for c in cf.worked("ident") if "expected_error" in c):
            code = 2 if "finite" in c["expected_error"] else 1
            with self.subTest(case=c["id"], expected=c["expected_error"]):
                answer = self.identify(c, c["truth"]["model"], c["id"],
                                       {"runout": "fixed",
                                        "phase_deg": c["truth"]["phase_deg"]}, code=code)
                if code == 2:
                    continue
                self.assertEqual(answer.summary["status"], "failed")
                self.assertTrue(answer.summary["message"])
                for fit in answer.result.get("fits", []):
                    self.assertTrue(all(v is None for v in fit["coefficients"].values()))


def eccentricity_se(f, p, se):
    """Standard error of rho from those of ex, ey and their correlation."""
    names = f["parameters"]
    i, j = (len(f["corr"]) - len(names) + names.index(n) for n in ("ex", "ey"))
    rho = math.hypot(p["ex"], p["ey"])
    a, b = p["ex"] / rho * se["ex"], p["ey"] / rho * se["ey"]
    return math.sqrt(a * a + b * b + 2 * f["corr"][i][j] * a * b)


def relabelled(c, fit, first):
    """The fit's unknowns when counting from another tooth: the same answer."""
    pitch, r = c["tool"]["pitch_deg"], fit["runout"]
    N = len(pitch)
    moved = sum(pitch[:first])
    offsets = (r.get("radial_offsets_mm") or [0.0] * N)
    offsets = [offsets[(k + first) % N] - offsets[first] for k in range(N)]
    rho, angle = r.get("eccentricity_mm") or 0.0, math.radians((r.get("angle_deg") or 0.0) - moved)
    phase = (fit["phase_deg"][0] if isinstance(fit["phase_deg"], list)
             else fit["phase_deg"]) - moved
    out = {f"shift:{k}": v for k, v in enumerate(offsets)}
    out.update({"ex": rho * math.cos(angle), "ey": rho * math.sin(angle),
                "numbered from": first,
                "phase": phase - 360 * round((phase - 0.0) / 360)})
    return out


if __name__ == "__main__":
    if not (cf.SHARED / "cases/force").is_dir():
        print(f"SKIPPED: there are no worked cases at {cf.SHARED / 'cases/force'}")
        sys.exit(77)
    if not pathlib.Path(program.PROGRAM).exists():
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main(verbosity=1)
