"""Run the program in a fresh folder on small cases."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/reference"))
import program  # noqa: E402

TABLES = {
    "tool": {"shape": "cylinder", "teeth": 2, "diameter_mm": 8.0, "helix_deg": 30.0},
    "runout": {"radial_offsets_mm": [0.0, -0.008]},
    "cut": {"engagement": "slot", "axial_depth_mm": 2.0, "feed_per_tooth_mm": 0.04,
            "spindle_rpm": 875},
    "force": {"law": "linear_edge", "K_tc_MPa": 2620, "K_rc_MPa": 1560, "K_ac_MPa": 331,
              "K_te_N_per_mm": 7, "K_re_N_per_mm": 3, "K_ae_N_per_mm": 1},
}


def tables(**changes):
    """TABLES with changed keys: tables(cut={"feed_per_tooth_mm": 0.0})"""
    out = {name: dict(table) for name, table in TABLES.items()}
    for name, keys in changes.items():
        out.setdefault(name, {}).update(keys)
    return out


def simulation(**changes):
    return program.case_text("a slot", tables(**changes))


def identification(file="record.csv", **changes):
    given = tables(**changes)
    del given["runout"]
    given["force"] = {"law": "linear_edge"}
    return program.case_text("a slot measured", given, [{"file": file}])


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_")).resolve()
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, content):
        file = self.folder / name
        file.parent.mkdir(exist_ok=True)
        if isinstance(content, bytes):
            file.write_bytes(content)
        else:
            file.write_text(content)
        return file

    def run_program(self, *arguments, code=0, **environment):
        """What the program answers, started in the folder; the exit code is checked."""
        done = subprocess.run(
            [program.PROGRAM, *map(str, arguments)], cwd=self.folder, timeout=program.HANGS,
            stdin=subprocess.DEVNULL, capture_output=True, env={**os.environ, **environment})
        done.stdout = done.stdout.decode(errors="replace")
        done.stderr = program.PROGRESS.sub("", done.stderr.decode(errors="replace"))
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def record(self, name="record.csv", phase_deg=20.0, **changes):
        """A record of one turn, made by the program."""
        angles = [3.0 * i for i in range(120)]
        sampling = {"angles_deg": [a + phase_deg for a in angles]}
        self.write("made.toml", simulation(sampling=sampling, **changes))
        self.run_program("simulate", "made.toml", "-q", "--no-report")
        rows = (self.folder / "made.simulate/forces.csv").read_text().splitlines()[1:]
        lines = ["angle_deg,Fx_N,Fy_N,Fz_N"]
        lines += [f"{a!r}," + ",".join(row.split(",")[2:5]) for a, row in zip(angles, rows)]
        shutil.rmtree(self.folder / "made.simulate")
        (self.folder / "made.toml").unlink()
        return self.write(name, "\n".join(lines) + "\n")

    def summary(self, folder):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def everything(self):
        """Each file and folder with a digest of its bytes."""
        return {str(p.relative_to(self.folder)):
                hashlib.sha256(p.read_bytes()).hexdigest() if p.is_file() else "folder"
                for p in sorted(self.folder.rglob("*"))}


def main():
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
