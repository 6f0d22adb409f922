"""The files on which a case is dropped: what of them can be checked without Windows."""
import pathlib
import re
import tempfile
import unittest

import drop_files


class DropFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(prefix="trochoid_")
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        drop_files.make(cls.folder)

    def texts(self):
        for name in drop_files.NAMES:
            with self.subTest(name):
                yield (self.folder / name).read_bytes().decode("ascii")

    def test_there_is_one_for_each(self):
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), sorted(drop_files.NAMES))
        check, compute = self.texts()
        self.assertIn('"!here!trochoid.exe" check "!file!"', check)
        self.assertIn('"!here!trochoid.exe" "!file!"', compute)

    def test_lines_end_as_windows_ends_them(self):
        # With other ends cmd.exe loses its place at a goto.
        for text in self.texts():
            self.assertEqual(text.count("\n"), text.count("\r\n"))
            self.assertTrue(text.startswith("@echo off\r\n") and text.endswith("\r\n"))

    def test_nothing_is_left_to_fill_in(self):
        for text in self.texts():
            self.assertIsNone(re.search(r"@\w+@", text))

    def test_every_label_is_there_once(self):
        for text in self.texts():
            labels = re.findall(r"^:(\w+)", text, re.MULTILINE)
            self.assertEqual(sorted(set(labels)), sorted(labels))
            self.assertEqual(set(re.findall(r"(?:goto |call :)(\w+)", text)), set(labels))

    def test_no_argument_stands_in_a_remark(self):
        # cmd.exe puts it in there, too, and an ampersand of it ends the remark.
        for text in self.texts():
            self.assertNotRegex(text, r"(?m)^rem.*%")


if __name__ == "__main__":
    unittest.main()
