"""The controller and the estimator in real time against their transcription."""
import json
import os
import subprocess
import unittest

import numpy as np

import correction

WRAPS = (0.0, 65.536, 1.6384)
SPEED, LEAD, DT = 20.0, 2.2e-3, 1e-3
WAVE = (np.array([3e-6, 0, 1e-6, 0, 0, -2e-6]), np.array([0, -4e-6, 0, 0.5e-6, 0, 1e-6]))


def learning():
    """A model that is off, what is measured turn by turn, and the waves that are learnt."""
    chance = np.random.default_rng(5)
    centred = lambda a: a - a.mean(axis=0)
    S = centred(chance.normal(0, 0.2, (4, 6)))
    real = S + 0.2 * centred(chance.normal(0, 0.2, (4, 6)))
    d = centred(np.array([0.3, -0.1, -0.25, 0.02]))
    estimator = correction.Estimator(S.copy(), 0.3, 0.01, 0.85, 0.7)
    v, waves = [d], []  # the first turn begins in its midst and is not learnt from
    for _ in range(25):
        v.append(d + real @ estimator.u + centred(chance.normal(0, 0.01, 4)))
        waves.append(estimator.turn(v[-1]).copy())
    return {"S": S.tolist(), "v": [each.tolist() for each in v]}, np.array(waves)


def change(kind):
    """Turns that repeat, and then a tool of which one tooth, or more, is another."""
    chance = np.random.default_rng(11)
    centred = lambda a: a - a.mean(axis=0)
    S, W = centred(chance.normal(0, 0.2, (4, 6))), centred(np.diag([0.3, 0.4, 0.35, 0.3]))
    d = centred(np.array([0.1, -0.05, 0.02, -0.07]))
    other = {"one tooth": [0, 0, -0.6, 0], "another tooth": [0.5, 0.05, 0, 0],
             "another tool": [0.5, -0.4, 0.6, -0.7]}[kind]
    e = W @ other
    estimator = correction.Estimator(S.copy(), 0.3, 0.01, 0.85, 0.7)
    v = [d]
    for turn in range(24):
        v.append(d + S @ estimator.u + (e if turn >= 20 else 0))
        if turn < 20:
            estimator.turn(v[-1])
    missed = v[21] - estimator.theta @ np.concatenate([[1.0], estimator.u])
    sent = {"S": S.tolist(), "W": W.tolist(), "v": [each.tolist() for each in v],
            "event_change": 0.05, "settled_turns": 12}
    return sent, correction.changed_tooth(W, missed)


def turning(wrap):
    """What a counter that wraps and an index pulse tell, step by step.

    The pulse is latched a little later than the position is read: changes of either sign."""
    p = 0.295 + SPEED * DT * np.arange(9000)
    at = np.floor(p + 0.011)
    index = np.concatenate([[0], np.diff(at) > 0])
    shown = lambda turns: np.mod(turns, wrap) if wrap else turns
    steps = [{"position": a, "at_index": b, "index": int(c)}
             for a, b, c in zip(shown(p), shown(at), index)]
    return {"wrap": wrap, "speed": SPEED, "lead": LEAD, "a": WAVE[0].tolist(),
            "b": WAVE[1].tolist(), "steps": steps}


class Compared(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kinds = ("one tooth", "another tooth", "another tool")
        sent = [learning()[0]] + [change(kind)[0] for kind in cls.kinds]
        sent += [turning(wrap) for wrap in WRAPS]
        done = subprocess.run([os.environ["CONTROLLER_NUMBERS"]], check=True, text=True,
                              input=json.dumps(sent), capture_output=True)
        found = json.loads(done.stdout)
        cls.learnt, cls.changes, cls.turning = found[0], found[1:4], found[4:]

    def test_waves_that_are_learnt(self):  # [L-9] [L-10] [L-11]
        _, ours = learning()
        self.assertEqual(len(self.learnt["waves"]), len(ours))
        np.testing.assert_allclose(self.learnt["waves"], ours, rtol=1e-6, atol=1e-9)

    def test_what_has_changed(self):  # [L-12]
        ones = 0
        for kind, found in zip(self.kinds, self.changes):
            i, explained, by = change(kind)[1]
            event = found["events"][0]
            self.assertEqual(event["turn"], 22, kind)  # the second in a row
            self.assertEqual(event["one"], explained > 0.8, kind)
            self.assertEqual(event["tooth"], i + 1 if explained > 0.8 else 0, kind)
            if explained > 0.8:
                ones += 1
                self.assertAlmostEqual(event["change"], by, places=9, msg=kind)
        self.assertEqual(ones, 2)

    def test_angle_and_waves(self):  # [L-7] [L-8]
        for wrap, found in zip(WRAPS, self.turning):
            self.assertEqual(found["period"], DT)
            steps = turning(wrap)["steps"]
            angle, command, running = np.array(found["steps"]).T
            since, before, seen = 0.0, 0.0, 0
            for k, step in enumerate(steps):
                came = step["position"] - (step["at_index"] if step["index"] else before)
                before = step["position"]
                start = 0.0 if step["index"] else since
                since = correction.unwrapped(start, came, wrap) if wrap else start + came
                if running[k]:
                    seen += 1
                    self.assertAlmostEqual(angle[k], since % 1, places=9, msg=wrap)
                    ahead = since + SPEED * (LEAD + DT / 2)
                    self.assertAlmostEqual(command[k] * 1e6,
                                           correction.wave(*WAVE, [ahead])[0] * 1e6, places=6)
            self.assertGreater(seen, 1000, wrap)


if __name__ == "__main__":
    unittest.main()
