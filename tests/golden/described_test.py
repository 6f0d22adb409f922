"""Whether the pages of report.html ask for what the program writes: keys and columns that
docs/formats/results.md has."""
import re
import unittest

import described

PAGES = described.ROOT / "src/trochoid/report/page"


class Pages(unittest.TestCase):
    def test_the_keys_that_a_page_knows_are_written(self):
        for command, (keys, _) in described.described().items():
            page = PAGES / f"{command}.js"
            if not page.exists():
                continue
            listed = re.search(rf"const {command}Known = \[(.*?)\];", page.read_text(), re.DOTALL)
            for key in re.findall(r"'(\w+)'", listed[1] if listed else ""):
                self.assertTrue(described.known(key, keys), f"{page.name}: {key}")

    def test_the_columns_that_pages_draw_are_written(self):
        # Columns of a sweep have any name.
        columns = {c for command, (_, all_of) in described.described().items()
                   if command != "sweep" for _, c in all_of}
        for page in PAGES.glob("*.js"):
            for name in re.findall(r"columnNamed\(\w+, '(\w+)'\)", page.read_text()):
                self.assertTrue(described.known(name, columns) or name in described.WORDS,
                                f"{page.name}: {name}")


if __name__ == "__main__":
    unittest.main()
