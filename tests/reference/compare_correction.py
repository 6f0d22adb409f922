"""Chips, forces and commands of a moving table against their transcription."""
import itertools
import json
import os
import subprocess
import unittest

import numpy as np

import correction

LAWS = ({"kt": 166.718603, "mt": 0.598, "kr": 58.35151106, "mr": 0.598, "ka": 0, "ma": 0},
        {"kt": 420, "mt": 0.28, "kr": 95, "mr": 0.42, "ka": 60, "ma": 0.30})
RHO = ([0.013, -0.013], [0.030, -0.028], [0.012, -0.003, -0.009], [0.005, -0.009, 0.008, -0.004])
ACT = {"K0": 0.99536, "T1": 1.1303e-3, "T2": 1.1376e-3}
TABLE = {"m": 0.194, "c": 77.3, "k": 1.7e7}
R, AE, WIDTH = 4.0, 2.5, 1.1
STROKE = 0.06
RPM = [400, 1200, 2000, 3000, 4000, 6000]
PHI = list(np.linspace(0.0123, 6.2, 61))


def cases():
    """Every combination of teeth, cut, law, marks and motion."""
    motions = (("none", 1.0), ("square", 1.0), ("sine", 0.9), ("quintic", 1.2))
    for rho, way, law, all_marks, (shape, factor) in itertools.product(
            RHO, ("slot", "up", "down"), LAWS, (True, False), motions):
        yield {"rho": rho, "engagement": way, "law": law, "shape": shape, "factor": factor,
               "marks": len(rho) if all_marks else 1, "R": R, "ae": AE, "ap": 1.0,
               "ft": 0.05, "Omega": 1200 * np.pi / 30, "width": WIDTH, "phi": PHI,
               "act": ACT, "table": TABLE, "ks": 1.5e7, "cs": 60.0, "Ts": 5e-4,
               "more": law is LAWS[1] and all_marks,
               "alike": law is LAWS[1] and all_marks and way == "slot" and shape == "none",
               "rpm": RPM if rho is RHO[0] and way == "slot" and law is LAWS[0]
               and all_marks and shape == "none" else []}


def motion(case, arc):
    if case["shape"] == "none":
        return np.zeros_like
    made = {"square": lambda: correction.square(case["rho"], arc),
            "sine": lambda: correction.sine(case["rho"], arc),
            "quintic": lambda: correction.quintic(case["rho"], arc, WIDTH)}
    shape = made[case["shape"]]()
    return lambda phi: case["factor"] * shape(phi)


class Compared(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cases = list(cases())
        done = subprocess.run([os.environ["CORRECTION_NUMBERS"]], check=True, text=True,
                              input=json.dumps(cls.cases),
                              capture_output=True)
        cls.found = json.loads(done.stdout)

    def each(self):
        self.assertEqual(len(self.found), len(self.cases))
        for case, found in zip(self.cases, self.found):
            arc = correction.arc_of(case["engagement"], R, AE)
            yield dict(case, arc=arc), motion(case, arc), found

    def near(self, ours, theirs, cut, **allowed):
        said = ", ".join(f"{k} {cut[k]}" for k in ("rho", "engagement", "shape", "marks"))
        np.testing.assert_allclose(ours, theirs, err_msg=said, **allowed)

    def test_forces_and_motion(self):
        phi = np.array(PHI)
        for cut, X, found in self.each():
            self.near(found["table"], X(phi), cut, atol=1e-12)
            self.near(np.array(found["force"]).T, correction.forces(phi, X, cut), cut,
                      atol=1e-6)

    def test_flutes(self):
        for cut, X, found in self.each():
            ours = np.array(found["flutes"])
            theirs = correction.flutes(X, cut, 20001)
            self.near(ours[:, 0], theirs[:, 0], cut, rtol=1e-6)
            self.near(ours[:, 1], theirs[:, 1], cut, rtol=1e-4, atol=1e-7)

    def test_commands(self):  # [R-6]
        phi = np.array(PHI)
        for cut, X, found in self.each():
            c = correction.harmonics(X, 9)
            ours = np.array(found["harmonics"]) @ [1, 1j]
            self.near(ours, c, cut, atol=1e-6)
            U = correction.inverse(ours, cut["Omega"], ACT, TABLE, cut["ks"], cut["cs"],
                                   cut["Ts"])
            self.near(np.array(found["inverse"]) @ [1, 1j], U, cut, rtol=1e-9, atol=1e-15)
            self.assertAlmostEqual(found["lead"], correction.lead(ACT, cut["Ts"]), places=12)
            if cut["shape"] in ("sine", "quintic"):
                self.near(found["in_time"],
                          correction.inverse_in_time(X, phi, cut["Omega"], ACT), cut,
                          atol=2e-7)
            elif cut["shape"] == "square":
                self.assertNotIn("in_time", found)

    def few(self):
        for cut, X, found in self.each():
            if cut["more"]:
                yield cut, X, found

    def test_least_chip_differences(self):
        for cut, _, found in self.few():
            for (rms, bound), axes in zip(np.reshape(found["axes"], (2, 2)), (False, True)):
                ours = correction.least_chip_rms(cut["rho"], cut["arc"], 3, axes)
                self.near([rms, bound], ours, cut, rtol=1e-6, atol=1e-11)

    def test_flutes_made_alike(self):
        for cut, _, found in self.each():
            if "alike" in found:
                c = np.array(found["alike"]) @ [1, 1j]
                self.assertGreater(correction.unevenness(0 * c, cut), 1e-3)
                self.assertLess(correction.unevenness(c, cut), 1e-7, cut["rho"])

    def test_model_of_waves_and_teeth(self):
        seen = 0
        for cut, _, found in self.each():
            if "S" in found:
                seen += 1
                S = np.array(found["S"])
                ours = correction.wave_model(cut, S.shape[1], ACT, TABLE, cut["ks"], cut["cs"])
                self.near(S, ours, cut, rtol=1e-6, atol=1e-6 * np.max(np.abs(S)))
                W = correction.runout_model(cut)
                self.near(found["W"], W, cut, rtol=1e-6, atol=1e-6 * np.max(np.abs(W)))
        self.assertEqual(seen, len(RHO))

    def test_width_by_speed(self):
        cut, found = next((c, f) for c, _, f in self.each() if "chosen" in f)
        there = np.array(found["candidates"])
        ours = np.array([correction.transition_candidate(cut, w, int(n)) for w, n in there[:, :2]])
        np.testing.assert_allclose(ours[:, 1:], there[:, 2:], atol=1e-5)
        most = 0.27 * np.sqrt(TABLE["k"] / TABLE["m"]) / correction.TURN
        for rpm, chosen in zip(RPM, found["chosen"]):
            at_speed = dict(cut, Omega=rpm * np.pi / 30)
            keep = [n * rpm / 60 <= most and STROKE > correction.command_range(
                at_speed, w, int(n), f, ACT, TABLE, cut["ks"], cut["cs"])
                for (w, n), (f, _, _) in zip(there[:, :2], ours)]
            rows = np.column_stack([there[:, :2], ours[:, 1:]])[keep]
            best = correction.choose_transition(rows)
            self.assertEqual(best[1], chosen[1], rpm)
            area = {tuple(row[:2]): row[3] for row in rows}
            self.assertAlmostEqual(area[tuple(chosen)], area[tuple(best)], places=5)

    def test_own_forces(self):  # of own_force
        theta = np.linspace(0, correction.TURN, 20001)
        for cut, X, found in self.few():
            for j, own in enumerate(found["own"]):
                alone = dict(cut, rho=cut["rho"])
                h = correction.chip(theta, j, X, cut["ft"], cut["rho"], cut["arc"], cut["marks"])
                law, at = cut["law"], theta - j * correction.TURN / len(cut["rho"])
                t, r = (law["k" + s] * np.where(h > 0, h, 1) ** (1 - law["m" + s]) * (h > 0)
                        * cut["ap"] for s in "tr")
                self.near(own, np.max(np.abs(np.sin(at) * t - np.cos(at) * r)), alone, rtol=3e-4)

    def test_spindle_speed(self):
        seen = 0
        for cut, X, found in self.few():
            if found.get("part") == 1:
                seen += 1
                phi, speed, torque = np.array(found["spindle"]).T
                f = cut["ft"] * len(cut["rho"])
                self.near(speed, correction.spindle_speed(X, phi, f, cut["Omega"]), cut,
                          rtol=1e-6)
                self.near(torque, correction.inertia_torque(X, phi, f, cut["Omega"], 1e-3), cut,
                          rtol=1e-4, atol=1e-5)
        self.assertGreater(seen, 2)

    def test_ratio(self):
        # for a law of one exponent the ratio undoes the law
        F = np.array([0.076, 0.024]) ** (1 - 0.3)
        self.assertAlmostEqual(correction.ratio(*F, 0.05, 0.3), 0.026, places=12)


if __name__ == "__main__":
    unittest.main()
