"""The Python of docs/python.md and of the tutorial runs as it stands there."""

import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest
import warnings

import numpy as np

import trochoid

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder.name)
        os.symlink(ROOT / "examples", "examples")
        slot = trochoid.Case.from_file(ROOT / "examples/st52_slot/case.toml")
        force = {"K_tc_MPa": 2600, "K_rc_MPa": 1500, "K_ac_MPa": 300}
        force |= {"K_te_N_per_mm": 7, "K_re_N_per_mm": 3, "K_ae_N_per_mm": 1}
        turns = np.arange(1000) * 875 / 60 / 1000
        F = trochoid.forces(slot.with_({"force": force}), 360 * turns)
        np.save("forces.npy", F + np.random.default_rng(1).normal(0, 5, F.shape))

    def test_the_blocks_run(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not here")
        page = (ROOT / "docs/python.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertGreater(len(blocks), 4)
        names = {}
        for block in blocks:
            said = io.StringIO()
            with self.subTest(block=block), warnings.catch_warnings():
                warnings.simplefilter("ignore", trochoid.AnswerWarning)
                with contextlib.redirect_stdout(said):
                    exec(block, names)
        self.assertIn("K_tc_MPa", str(names["found"]))
        self.assertGreater(pathlib.Path("fit.png").stat().st_size, 10000)

    def test_the_blocks_of_the_tutorial_run(self):
        page = (ROOT / "docs/guide/tutorial.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertGreater(len(blocks), 0)
        said = io.StringIO()
        with warnings.catch_warnings(), contextlib.redirect_stdout(said):
            warnings.simplefilter("ignore", trochoid.AnswerWarning)
            names = {}
            for block in blocks:
                exec(block, names)
        self.assertEqual(len(said.getvalue().splitlines()), 4)
        self.assertEqual(names["peaks"], sorted(names["peaks"]))

    def test_names_of_the_page_are_there(self):
        page = (ROOT / "docs/python.md").read_text()
        for name in re.findall(r"trochoid\.(\w+)\(", page):
            self.assertTrue(hasattr(trochoid, name), name)


if __name__ == "__main__":
    unittest.main()
