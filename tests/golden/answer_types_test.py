"""Whether the types of answers in the Python package are those of docs/formats/results.md.

answer_types_test.py --renew [FOLDER ...]    writes dicts.py and answers.py anew, with what the
    answers show that lie below the folders (`pins_test.py --keep FOLDER` leaves those of all
    examples). A type that no answer shows is written into dicts.py by hand, before --renew.
"""
import json
import pathlib
import sys
import unittest

import answer_kinds
import answer_types


class Types(unittest.TestCase):
    def test_the_files_are_what_the_page_gives(self):
        for file, text in answer_types.texts(answer_kinds.with_types()).items():
            self.assertTrue(file.read_text() == text, f"{file.name} is out of date; renew it "
                            "with\n  /usr/bin/python3 tests/golden/answer_types_test.py --renew")

    def test_every_key_has_a_type(self):
        for command, (root, _) in answer_kinds.with_types().items():
            unknown = [path for path, kind in root.parts() if kind.unknown()]
            self.assertEqual(unknown, [], f"{command}: give them a type in dicts.py")

    def test_what_may_be_null_is_optional(self):
        for command, (root, _) in answer_kinds.with_types().items():
            for path, kind in root.parts():
                meaning = kind.meaning.replace("`null` with status failed", "")
                if "`null`" in meaning and not path.endswith("[]"):
                    self.assertTrue(any(one.null for _, one in kind.parts()),
                                    f"{command}: {path}: {kind.meaning}")


def renew(folders):
    all_of = answer_kinds.with_types()
    for folder in folders:
        for file in sorted(pathlib.Path(folder).rglob("summary.json")):
            summary = json.loads(file.read_text())
            command = answer_kinds.described_as(summary["command"], summary["result"])
            answer_kinds.learn(all_of[command][0], summary["result"], summary["status"] == "ok")
    for file, text in answer_types.texts(all_of).items():
        file.write_text(text)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--renew"]:
        renew(sys.argv[2:])
    else:
        unittest.main()
