"""Every worked case of ../shared/cases/edges_sensors that identifies something: means, and
records of rotating dynamometers, holders, torque and power, with and without a prior.

The expected values and the tolerances stand in the files. Other files of the same kind are
run just the same.
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
import case_file as cf  # noqa: E402
import program  # noqa: E402
from worked_folder import WorkedFolder, main  # noqa: E402

KEYS = ("K_tc_MPa", "K_rc_MPa", "K_ac_MPa",
        "K_te_N_per_mm", "K_re_N_per_mm", "K_ae_N_per_mm")
TOOTH = {"rad": "radial_offsets", "ax": "axial_offsets"}


class ChannelCases(WorkedFolder):
    CASES = cf.SHARED / "cases/edges_sensors"

    def test_identify(self):
        self.of_kind("identify", self.check_identify)

    def test_check_names_every_channel(self):
        case = program.ROOT / "examples/rotating_dynamometer/case.toml"
        said = subprocess.run([program.PROGRAM, "check", str(case)], capture_output=True,
                              text=True, check=True).stdout
        self.assertRegex(said, r"channel 4 from column Mz_Nm: .* Nm, mean .* Nm\n")

    def answer_to(self, c):
        tables = {k: dict(v) for k, v in c["case"].items() if k not in ("title", "measurement")}
        tables["cut"].setdefault("spindle_rpm", 1200)
        for file in self.CASES.glob(c["id"] + "*.csv"):
            shutil.copy(file, self.folder)
        text = program.case_text(c["id"], tables, c["case"]["measurement"])
        return text, program.run("identify", text, self.folder, c["id"])

    def check_identify(self, c, want, tol, out):
        text, answer = self.answer_to(c)
        want.setdefault("identifiable", {key: True for key in KEYS})
        nothing_told = not any(want["identifiable"].values())
        self.assertEqual(answer.code, 1 if nothing_told else 0,
                         f"{c['id']}: exit {answer.code}\n{answer.stderr}\n{text}")
        fit = answer.result["fits"][0]
        self.check_coefficients(fit, want, tol, out)
        self.check_quality(fit, want, tol, out)
        self.check_unknowns(fit, want, tol, out)
        if want["covariance"] is not None and not nothing_told:
            self.check_covariance(answer.result, want, tol, out)

    def check_coefficients(self, fit, want, tol, out):
        for key in KEYS:
            told, got = want["identifiable"].get(key), fit["coefficients"][key]
            if (fit["identifiable"][key] is True) != bool(told):
                out.append(f"identifiable {key}: {fit['identifiable'][key]}, expected {told}")
            if not told or got is None:
                out.near(got and got["value"], None if not told else 0, 0, key)
                continue
            out.near(got["value"], want["K"][key], tol["K"][key], key)
            out.near(got["se"], want["se_K"][key],
                     max(tol["se_relative"] * want["se_K"][key], 1e-7 * abs(want["K"][key])),
                     f"se of {key}")

    def check_quality(self, fit, want, tol, out):
        for ours, theirs in (("rank", "rank_of_data"), ("rank_with_prior", "rank_with_prior")):
            if theirs in want:
                out.near(fit[ours], want[theirs], 0, ours)
        exact = want["weighted_rss"] < 1e-3  # rounding of the input is all that is left
        if not exact:
            out.near(fit["weighted_rss"], want["weighted_rss"], 1e-5 * want["weighted_rss"],
                     "weighted_rss")
            out.near(fit["variance_factor"], want["scale2"], 1e-5 * want["scale2"],
                     "variance_factor")
            out.all_near([ch["rms"] for ch in fit["channels"]], want["rms_per_channel"],
                         1e-4 * max(want["rms_per_channel"]), "rms of channels")
        singular = [s for s in want.get("singular_values_of_data_unit_columns", []) if s > 1e-8]
        if singular:
            condition = singular[0] / singular[-1]
            out.near(fit["condition"], condition, 1e-5 * condition, "condition")
        elif "condition" in want:
            out.near(fit["condition"], want["condition"], 1e-2 * want["condition"], "condition")

    def unknown(self, fit, name):
        """value and standard error of an unknown of the case, mm and deg"""
        runout = fit["runout"]
        kind, _, tooth = name.partition(":")
        if kind in TOOTH:
            return (runout[f"{TOOTH[kind]}_mm"][int(tooth)],
                    runout[f"{TOOTH[kind]}_se_mm"][int(tooth)])
        if name in ("e1", "e2", "ex", "ey", "e_1", "e_2"):
            rho, angle = runout["eccentricity_mm"], math.radians(runout["angle_deg"])
            first = name[-1] in "1x"
            return rho * (math.cos(angle) if first else math.sin(angle)), None
        if name.startswith(("phase", "phi")):
            return math.radians(fit["phase_deg"]), math.radians(fit["phase_se_deg"])
        if name.startswith("sensor"):
            return math.radians(fit["sensor_deg"]), math.radians(fit["sensor_se_deg"])
        raise KeyError(f"an unknown this test does not know: {name}")

    def check_unknowns(self, fit, want, tol, out):
        for i, name in enumerate(want.get("unknowns", [])):
            value, se = self.unknown(fit, name)
            out.near(value, want["p"][i], tol["p"][i], name)
            if se is not None:
                out.near(se, want["se_p"][i], tol["se_relative"] * want["se_p"][i], f"se of {name}")

    def check_covariance(self, result, want, tol, out):
        names = [f"force.{key}" for key in KEYS if want["identifiable"][key]]
        got, all_names = result["covariance"]["matrix"], result["covariance"]["names"]
        for i, a in enumerate(names):
            for j, b in enumerate(names):
                size = math.sqrt(want["covariance"][i][i] * want["covariance"][j][j])
                out.near(got[all_names.index(a)][all_names.index(b)], want["covariance"][i][j],
                         max(2 * tol["se_relative"] * size, 1e-14), f"covariance {a} {b}")


if __name__ == "__main__":
    main(ChannelCases.CASES)
