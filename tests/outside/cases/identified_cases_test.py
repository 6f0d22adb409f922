"""The worked cases of ../shared on modes and actuators from measurements, as a user would."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
SHARED = pathlib.Path(os.environ.get("TROCHOID_SHARED", ROOT.parent / "shared"))
FOLDER = SHARED / "cases/correction"


def answer(*arguments):
    with tempfile.TemporaryDirectory(prefix="trochoid_") as folder:
        out = pathlib.Path(folder) / "out"
        done = subprocess.run([os.environ["TROCHOID"], *map(str, arguments), "-o", out,
                               "--no-report"], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return json.loads((out / "summary.json").read_text())["result"]


def worked(key):
    for file in sorted(FOLDER.glob("*.json")):
        case = json.loads(file.read_text())
        if key in case["expected"] and "csv" in case["inputs"]:
            yield file.name, case


class Identified(unittest.TestCase):
    def near(self, value, expected, rel, name):
        self.assertLessEqual(abs(value / expected - 1), rel, name)

    def test_frequency_responses(self):
        tried = 0
        for name, case in worked("m_kg"):
            with self.subTest(name):
                given, wanted, within = case["inputs"], case["expected"], case["tolerance"]
                result = answer("modes", FOLDER / given["csv"])
                self.assertEqual(result["kind"], given["kind"])
                self.assertEqual(len(result["modes"]), 1)
                mode = result["modes"][0]
                for ours, theirs in (("mass_kg", "m_kg"), ("stiffness_N_per_m", "k"),
                                     ("damping_Ns_per_m", "c"), ("frequency_Hz", "fn_Hz"),
                                     ("damping_ratio", "zeta")):
                    tolerance = within[theirs.split("_")[0] + "_rel"]
                    self.near(mode[ours], wanted[theirs], tolerance, theirs)
            tried += 1
        self.assertGreater(tried, 0)

    def test_steps(self):
        tried = 0
        for name, case in worked("T1_plus_T2_s"):
            given, wanted, within = case["inputs"], case["expected"], case["tolerance"]
            start = ["--start-s", given["start_s"]] if "start_s" in given else []
            for options in ([], start):
                with self.subTest(name, options=options):
                    result = answer("actuator", FOLDER / given["csv"], *options)
                    self.near(result["gain"], wanted["K0"], within["K0_rel"], "gain")
                    self.near(result["sum_s"], wanted["T1_plus_T2_s"],
                              within["T1_plus_T2_rel"], "sum")
                    self.near(result["product_s2"], wanted["T1_times_T2_s2"],
                              within["T1_times_T2_rel"], "product")
                    self.assertLessEqual(abs(result["damping_ratio"] - wanted["zeta"]),
                                         within["zeta_abs"])
                    if "NOT identifiable" in case.get("notes", ""):
                        self.assertIsNone(result["time_constants_s"])
                        self.assertIn("time_constants_s", result["identifiable"])
            tried += 1
        self.assertGreater(tried, 0)


if __name__ == "__main__":
    if not FOLDER.is_dir():
        print(f"skipped: {FOLDER} is not here")
        sys.exit(77)
    unittest.main()
