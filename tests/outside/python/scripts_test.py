"""The scripts of examples/python run in an empty folder and find what they start from."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import matplotlib  # noqa: F401
except ImportError:
    matplotlib = None

SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "examples/python"


@unittest.skipIf(matplotlib is None, "matplotlib is not here")
class Scripts(unittest.TestCase):
    def printed(self, name):
        """What a script prints; its picture is there when it ends."""
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-W", "ignore", SCRIPTS / f"{name}.py"],
                                  cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            picture = pathlib.Path(folder) / f"{name}.png"
            self.assertGreater(picture.stat().st_size, 10000)
        return done.stdout

    def test_there_is_a_test_for_each(self):
        tests = {name[5:] for name in dir(self) if name.startswith("test_")}
        self.assertLessEqual({script.stem for script in SCRIPTS.glob("*.py")}, tests)

    def test_dynoware_to_coefficients(self):
        said = self.printed("dynoware_to_coefficients")
        rows = re.findall(r"^(K_\w+) +[\d.]+ +95 %: ([\d.]+) to ([\d.]+) +true (\d+)$", said, re.M)
        self.assertEqual(len(rows), 6, said)
        for name, low, high, true in rows:
            self.assertTrue(float(low) < float(true) < float(high), name)
        self.assertLess(float(re.search(r"differs by ([\d.]+) N rms", said)[1]), 15)

    def test_uncertain_lobes(self):
        said = self.printed("uncertain_lobes")
        rows = re.findall(r"rpm: limit ([\d.]+) mm, in 95 of 100 above ([\d.]+) mm", said)
        self.assertEqual(len(rows), 5, said)
        for limit, surely in rows:
            self.assertTrue(0.5 * float(limit) < float(surely) < float(limit), rows)

    def test_correction_and_controller(self):
        said = self.printed("correction_and_controller")
        running = re.search(r"([\d.]+) % before, ([\d.]+) % running", said)
        self.assertTrue(30 < float(running[1]) and float(running[2]) < 1, said)
        self.assertIn("the controller refuses its configuration", said)


if __name__ == "__main__":
    unittest.main()
