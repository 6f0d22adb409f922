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
PHI = list(np.linspace(0.0123, 6.2, 61))


def cases():
    """Every combination of teeth, cut, law, marks and motion."""
    motions = (("none", 1.0), ("square", 1.0), ("sine", 0.9), ("quintic", 1.2))
    for rho, way, law, all_marks, (shape, factor) in itertools.product(
            RHO, ("slot", "up", "down"), LAWS, (True, False), motions):
        yield {"rho": rho, "engagement": way, "law": law, "shape": shape, "factor": factor,
               "marks": len(rho) if all_marks else 1, "R": R, "ae": AE, "ap": 1.0,
               "ft": 0.05, "Omega": 1200 * np.pi / 30, "width": WIDTH, "phi": PHI,
               "act": ACT, "table": TABLE, "ks": 1.5e7, "cs": 60.0, "Ts": 5e-4}


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
                              input=json.dumps(cls.cases), capture_output=True)
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
            self.near(ours[:, 0], theirs[:, 0], cut, rtol=2e-4)
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

    def test_ratio(self):
        # for a law of one exponent the ratio undoes the law
        F = np.array([0.076, 0.024]) ** (1 - 0.3)
        self.assertAlmostEqual(correction.ratio(*F, 0.05, 0.3), 0.026, places=12)


if __name__ == "__main__":
    unittest.main()
