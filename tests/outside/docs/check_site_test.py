"""What tools/check_site.py finds wrong with a site, and what it lets pass."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tools"))
import check_site  # noqa: E402

SOUND = {
    "index.html": '<link rel="stylesheet" href="site.css"><a href="sub/page.html#here">x</a>'
                  '<a href="https://example.org">elsewhere</a><img src="data:image/png;base64,">',
    "sub/page.html": '<p id="here">y</p><a href="../index.html">back</a><a href="#here">up</a>',
    "site.css": "@font-face { src: url(letters.woff2); }",
}


def found(**changes):
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        for name, text in (SOUND | changes).items():
            (top / name).parent.mkdir(exist_ok=True)
            (top / name).write_text(text)
        return list(check_site.faults(top))


class CheckSite(unittest.TestCase):
    def test_a_sound_site_passes(self):
        self.assertEqual(found(), [])

    def test_every_fault_is_named(self):
        for page, said in (
                ('<a href="gone.html">x</a>', "which is not there"),
                ('<a href="sub/page.html#gone">x</a>', "an anchor that is not there"),
                ('<a href="#gone">x</a>', "an anchor that is not there"),
                ('<img src="gone.png">', "needs gone.png"),
                ('<script src="https://cdn.example/x.js"></script>', "fetches https"),
                ('<link rel="stylesheet" href="//fonts.example/x.css">', "fetches //fonts"),
                ('<p style="background: url(http://example.org/x.png)">x</p>', "fetches http:")):
            with self.subTest(page=page):
                self.assertEqual(len(found(**{"index.html": page})), 1)
                self.assertIn(said, found(**{"index.html": page})[0])

    def test_a_style_sheet_that_fetches_is_named(self):
        for text in ('@import "https://example.org/x.css";', "p { src: url('http://x/y.woff') }"):
            self.assertEqual(len(found(**{"site.css": text})), 1)

    def test_no_pages_are_a_fault(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(check_site.faults(pathlib.Path(folder)))), 1)


if __name__ == "__main__":
    unittest.main()
