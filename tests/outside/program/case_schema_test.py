"""The JSON Schema of the case file takes every case of the repository, and refuses what it can."""

import json
import pathlib
import re
import sys
import tomllib
import unittest

from in_folder import InFolder, main

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/broken"))
from broken import broken_files  # noqa: E402

try:
    import jsonschema
except ImportError:
    jsonschema = None

# Of their makers, with keys of their own.
NO_CASE = {"several_responses/truth.toml", "uncertain_stability/truth.toml"}
# What a schema can tell; the rest hangs on other tables, files, or sums of numbers.
SAYABLE = re.compile(r": no such (key|table)|: out of range|: not (a|an|true|text)\b|: unknown"
                     r"|neither true nor false|: an empty (list|text)|: has no meaning for")
ELSEWHERE = {"include_with_mistakes.toml",  # the mistakes stand in the included file
             "lookback_of_another_model.toml",  # of a choice by another choice
             "range_nan.toml"}  # TOML has it, JSON has not


@unittest.skipIf(jsonschema is None, "python3-jsonschema is not here")
class CaseSchema(InFolder):
    def setUp(self):
        super().setUp()
        text = self.run_program("new", "--schema").stdout
        self.assertEqual(text, (ROOT / "docs/formats/case.schema.json").read_text())
        schema = json.loads(text)
        jsonschema.Draft7Validator.check_schema(schema)
        self.validator = jsonschema.Draft7Validator(schema)

    def faults(self, text):
        return [f"{list(e.absolute_path)}: {e.message}"
                for e in self.validator.iter_errors(tomllib.loads(text))]

    def test_every_example_is_taken(self):
        cases = [file for file in ROOT.glob("examples/**/*.toml")
                 if str(file.relative_to(ROOT / "examples")) not in NO_CASE]
        self.assertGreater(len(cases), 25)
        for file in cases:
            self.assertEqual(self.faults(file.read_text()), [], file)

    def test_new_cases_and_the_case_as_understood_are_taken(self):
        for command in ("simulate", "identify", "surface", "calibrate", "stability", "modes",
                        "actuator", "dynamics", "correct", "plan"):
            text = self.run_program("new", command).stdout
            self.assertEqual(self.faults(text), [], command)
        (self.folder / "cut.toml").write_text(self.run_program("new", "simulate").stdout)
        self.run_program("simulate", "cut.toml", "-q", "--no-report")
        echo = (self.folder / "cut.simulate/case.toml").read_text()
        self.assertTrue(echo.startswith("schema = 1\n"), echo[:80])
        self.assertEqual(self.faults(echo), [])

    def test_broken_cases_are_refused_where_a_schema_can_tell(self):
        refused = 0
        for name, (content, said) in broken_files("case").items():
            if name in ELSEWHERE or not SAYABLE.search(said):
                continue
            try:
                faults = self.faults(content.decode())
            except (tomllib.TOMLDecodeError, UnicodeDecodeError):
                continue
            self.assertNotEqual(faults, [], f"{name}: {said}")
            refused += 1
        self.assertGreater(refused, 80)

    def test_inches_are_taken_and_one_of_the_two_is_asked_for(self):
        text = self.run_program("new", "simulate").stdout
        inches = re.sub(r"(?m)^diameter_mm = 8 ", "diameter_in = 0.3 ", text)
        self.assertNotEqual(inches, text)
        self.assertEqual(self.faults(inches), [])
        self.assertEqual(len(self.faults(inches.replace("diameter_in", "# diameter_in"))), 1)
        self.assertEqual(len(self.faults(inches.replace("diameter_in", "teeth_in"))), 2)

    def test_a_misspelt_key_and_its_place_are_told(self):
        faults = self.faults("[tool]\nteeth = 2\ndiamter_mm = 8\nhelix_deg = 30\n")
        self.assertEqual(len(faults), 2, faults)
        self.assertIn("'diamter_mm' ", faults[0])
        self.assertIn("'diameter_mm' is a required property", faults[1])

    def test_what_may_stand_in_another_file_is_not_asked_for(self):
        part = "include = \"base.toml\"\n[tool]\ncorner_radius_mm = 1\n"
        self.assertEqual(self.faults(part), [])
        self.assertNotEqual(self.faults(part.split("\n", 1)[1]), [])


if __name__ == "__main__":
    main()
