#!/usr/bin/env python3
"""Check the checks: each must accept a sound small tree and refuse it wrong in one way."""
import pathlib
import tempfile
import unittest

import check_equations
import check_layers
import check_references
import check_sizes
import check_words

SOUND = {
    "ARCHITECTURE.md": "| rank | rooms |\n|---|---|\n| 0 | base |\n| 2 | chip |\n"
    "| 5 | structure, signal |\n| 8 | results |\n| 9 | report, run |\n",
    "src/trochoid/base/a.h": "#include <vector>\n",
    "src/trochoid/chip/c.h": "#include <trochoid/base/a.h>\n/// @eq C-1 h = f\n",
    "src/trochoid/chip/c.cpp": "#include <trochoid/chip/c.h>\n#include <boost/math/a.hpp>\n",
    "src/trochoid/signal/s.cpp": "#include <trochoid/chip/c.h>\n",
    "src/trochoid/results/r.h": "#include <nlohmann/json_fwd.hpp>\n",
    "src/trochoid/report/p.cpp": "#include <trochoid/results/r.h>\n",
    "src/trochoid/signal/s.h": "/// @src [kline1983] eq. 1\n/// @src derived from C-1\n",
    "docs/theory/chip.md": "$$h = f \\tag{C-1}$$\nSource: [kline1983], not [this](page.md).\n",
    "docs/references.md": "# References\n\n**[kline1983]** W. A. Kline.\n",
    "tests/unit/chip/c.cpp": "TEST(Chip, IsTheFeed) {}  // [C-1]\nint x = y[N-1];\n",
}


def answers(check, **changes):
    """What a check says of the sound tree with some files added or replaced."""
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        for name, text in {**SOUND, **changes.get("files", {})}.items():
            file = top / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return [line.replace(f"{top}/", "") for line in check(top)]


class Layers(unittest.TestCase):
    def refused(self, name, text):
        found = answers(check_layers.violations, files={name: text})
        self.assertEqual(len(found), 1, found)
        return found[0]

    def test_sound_tree_is_accepted(self):
        self.assertEqual(answers(check_layers.violations), [])

    def test_higher_room(self):
        said = self.refused("src/trochoid/base/a.h", "\n# include <trochoid/chip/c.h>\n")
        self.assertIn("src/trochoid/base/a.h:2: base (rank 0) may not include chip", said)

    def test_sibling_room(self):
        said = self.refused("src/trochoid/structure/a.h", "#include <trochoid/signal/s.h>")
        self.assertIn("structure (rank 5) may not include signal (rank 5)", said)

    def test_report_sees_base_and_results_only(self):
        said = self.refused("src/trochoid/report/p.cpp", "#include <trochoid/chip/c.h>\n")
        self.assertIn("base and results only, not chip", said)

    def test_room_that_architecture_does_not_name(self):
        said = self.refused("src/trochoid/utils/u.h", "")
        self.assertIn("utils is not a room", said)

    def test_include_of_an_unknown_room(self):
        said = self.refused("src/trochoid/chip/c.h", "#include <trochoid/utils/u.h>\n")
        self.assertIn("utils is not a room", said)

    def test_quoted_include_hides_the_room(self):
        said = self.refused("src/trochoid/base/a.h", '#include "../chip/c.h"\n')
        self.assertIn("include it as", said)

    def test_heavy_header_in_a_header(self):
        said = self.refused("src/trochoid/chip/d.h", "#include <Eigen/Dense>\n")
        self.assertIn("only in .cpp files", said)

    def test_eigen_out_of_its_room(self):
        for header in ("Eigen/LU", "unsupported/Eigen/MatrixFunctions"):
            said = self.refused("src/trochoid/chip/p.cpp", f"#include <{header}>\n")
            self.assertIn("call numerics/dense.h", said)


class Equations(unittest.TestCase):
    def refused(self, **files):
        names = {"theory": "docs/theory/chip.md", "header": "src/trochoid/chip/c.h",
                 "source": "src/trochoid/chip/c.cpp", "test": "tests/unit/chip/c.cpp"}
        found = answers(check_equations.gaps,
                        files={names[kind]: text for kind, text in files.items()})
        self.assertEqual(len(found), 1, found)
        return found[0]

    def test_sound_tree_is_accepted(self):
        self.assertEqual(answers(check_equations.gaps), [])

    def test_not_coded(self):
        self.assertIn("chip.md:1: C-1 is not coded", self.refused(header="// C-1\n"))

    def test_not_tested(self):
        self.assertIn("chip.md:1: C-1 is not tested", self.refused(test="// C-1\n"))

    def test_not_written(self):
        said = self.refused(header="/// @eq C-1 h = f\n/// @eq C-2 h = g\n")
        self.assertIn("c.h:2: C-2 is not written", said)

    def test_written_twice(self):
        said = self.refused(theory="\\tag{C-1}\n\n\\tag{C-1}\n")
        self.assertIn("chip.md:3: C-1 is already written at", said)

    def test_tested_but_not_written(self):
        said = self.refused(test="// [C-1] [C-11]\n")
        self.assertIn("C-11 is tested but not written", said)

    def test_coded_out_of_sight(self):
        self.assertIn("belongs in the header", self.refused(source="/// @eq C-1 h = f\n"))


class References(unittest.TestCase):
    def refused(self, name, text):
        found = answers(check_references.gaps, files={name: text})
        self.assertEqual(len(found), 1, found)
        return found[0]

    def test_sound_tree_is_accepted(self):
        self.assertEqual(answers(check_references.gaps), [])

    def test_source_of_a_header_is_not_listed(self):
        said = self.refused("src/trochoid/base/a.h", "\n/// @src [saad2011] ch. 6\n")
        self.assertIn("src/trochoid/base/a.h:2: [saad2011] is not in docs/references.md", said)

    def test_source_in_the_second_line_is_not_listed(self):
        said = self.refused("src/trochoid/base/a.h", "/// @src derived, as\n///      [saad2011]\n")
        self.assertIn("a.h:2: [saad2011] is not in", said)

    def test_source_of_a_page_is_not_listed(self):
        said = self.refused("docs/theory/force.md", "Source: [kienzle1952].\n")
        self.assertIn("force.md:1: [kienzle1952] is not in", said)

    def test_listed_but_not_cited(self):
        sound = SOUND["docs/references.md"]
        said = self.refused("docs/references.md", sound + "\n**[saad2011]** Y. Saad.\n")
        self.assertIn("docs/references.md:5: nothing cites [saad2011]", said)

    def test_listed_twice(self):
        sound = SOUND["docs/references.md"]
        said = self.refused("docs/references.md", 2 * sound)
        self.assertIn("references.md:6: [kline1983] is already listed in line 3", said)

    def test_name_without_a_key(self):
        said = self.refused("src/trochoid/chip/d.h", "/// @src Kline and DeVor (1983)\n///\n")
        self.assertIn("d.h:1: @src names no [key]", said)

    def test_document_that_is_not_here(self):
        for text in ("// DESIGN section 4", "# from spec 2.2", "TEST(A, AsTheSpecSays)"):
            with self.subTest(text):
                self.assertIn("is a document that is not here",
                              self.refused("tests/unit/signal/s.py", text + "\n"))

    def test_nothing_listed(self):
        found = answers(check_references.gaps, files={"docs/references.md": "none\n"})
        self.assertIn("no reference found", found[-1])


class Sizes(unittest.TestCase):
    def refused(self, name, text):
        found = answers(check_sizes.violations, files={name: text})
        self.assertEqual(len(found), 1, found)
        return found[0]

    def accepted(self, text):
        self.assertEqual(answers(check_sizes.violations, files={"src/a.cpp": text}), [])

    def test_sound_tree_is_accepted(self):
        self.assertEqual(answers(check_sizes.violations), [])

    def test_long_file(self):
        self.assertIn("tests/a.py:601: 601 lines, more than 600",
                      self.refused("tests/a.py", "\n" * 601))

    def test_long_header(self):
        self.assertIn("more than 250", self.refused("src/trochoid/chip/d.h", "\n" * 251))

    def test_too_many_short_files(self):
        short = {f"src/trochoid/chip/s{i}.h": "\n" for i in range(check_sizes.SHORT)}
        found = answers(check_sizes.violations, files=short)
        self.assertEqual(len(found), 1, found)
        self.assertIn("have less than 40 lines", found[0])

    def test_long_function(self):
        self.accepted("void f() {" + "\n" * 59 + "}\n")
        said = self.refused("src/a.cpp", "\nvoid f() {" + "\n" * 60 + "}\n")
        self.assertIn("src/a.cpp:2: f has 61 lines, more than 60", said)

    def test_lambdas_belong_to_their_function(self):
        one = "  const auto g = [&](int i) {\n    return i;\n  };\n"
        self.assertIn("f has 62 lines",
                      self.refused("src/a.cpp", f"int f() {{\n{20 * one}}}\n"))

    def test_long_tests_are_accepted(self):
        self.assertEqual(answers(check_sizes.violations, files={
            "tests/a.cpp": "TEST(A, IsLong) {" + "\n" * 90 + "}\n"}), [])

    def test_many_parameters(self):
        self.accepted("int f(int a, std::map<int, int> b, int c, int d, g<1, 2> e) { return 1; }\n")
        said = self.refused("src/a.cpp", "int f(int, int, int, int, int, int) { return 1; }\n")
        self.assertIn("f has 6 parameters, more than 5", said)

    def test_six_parameters_with_a_reason(self):
        six = "template <class T>\nint f(T, int, int, int, int, int) { return 1; }\n"
        self.accepted(f"// Two points; six parameters: both have three coordinates.\n{six}")
        self.refused("src/a.cpp", f"// six parameters: far away\n\nint x;\n{six}")
        seven = six.replace("T,", "T, int,")
        self.refused("src/a.cpp", f"// six parameters: more than that\n{seven}")


class Words(unittest.TestCase):
    def found(self, text, name="docs/guide/sweep.md"):
        return answers(check_words.faults, files={name: text})

    def refused(self, text):
        found = self.found(text)
        self.assertEqual(len(found), 1, found)
        return found[0]

    def test_sound_tree_is_accepted(self):
        self.assertEqual(answers(check_words.faults), [])

    def test_phrases(self):
        for text, phrase in (("The limit is that of the case.", "that of"),
                             ("What is wrong is told before.", "is told"),
                             ("The interval holds the truth.", "holds"),
                             ("The table stands beside it.", "beside it"),
                             ("One table, a row a case.", "a row a case"),
                             ("What the steps of it come to.", "What the steps of it come to")):
            with self.subTest(text):
                said = self.refused(f"# Sweep\n\n{text}\n")
                self.assertIn(f"docs/guide/sweep.md:3: '{phrase}'", said)

    def test_phrase_over_the_end_of_a_line(self):
        self.assertIn("sweep.md:2: 'that of'", self.refused("\nThe limit is that\nof the case.\n"))

    def test_long_sentence(self):
        self.assertEqual(self.found(40 * "word " + ".\n"), [])
        self.assertIn("sweep.md:2: a sentence of 41 words",
                      self.refused("\n" + 20 * "word " + "\n" + 21 * "word " + ".\n"))

    def test_cells_and_entries_are_sentences_of_their_own(self):
        for line in ("| " + 21 * "word " + "| " + 21 * "word " + "|\n", "* " + 30 * "word " + "\n"):
            self.assertEqual(self.found(2 * line), [])

    def test_semicolons(self):
        self.assertEqual(self.found("One; two.\n"), [])
        self.assertIn("2 semicolons", self.refused("One; two; three.\n"))

    def test_code_and_formulas_are_no_prose(self):
        self.assertEqual(self.found("```c\na; b; c; it is told\n```\n\n`a; b; c` $a; b; c$\n\n"
                                    "$$a;b;c \\tag{C-1}$$\n\nx\n$$a;\nb;c$$\n\n    a; b; c\n"), [])

    def test_after_code_the_page_goes_on(self):
        self.assertIn("sweep.md:6: 'is told'", self.refused("```\na\n```\n$$x\n\\tag{C-1}$$\nIt is told.\n"))

    def test_exception_that_is_not_needed(self):
        allowed, check_words.ALLOWED = check_words.ALLOWED, (("docs/guide/sweep.md", "is told", "why"),)
        try:
            self.assertEqual(self.found("It is told.\n"), [])
            self.assertIn("needs no exception", self.refused("It says so.\n"))
        finally:
            check_words.ALLOWED = allowed

    def test_texts_of_the_program(self):
        for line, count in (('say("It is told at once.");', 1), ("// It is told.", 0),
                            ('#include "held/a b.h"', 0), ('key("held");', 0)):
            found = answers(check_words.faults,
                            files={"src/trochoid/chip/m.cpp": f"\n{line}\n"})
            self.assertEqual(len(found), count, found)
            self.assertTrue(all(f.startswith("src/trochoid/chip/m.cpp:2: 'is told'") for f in found))

    def test_texts_of_pages(self):
        for name, text, line in (
                ("src/trochoid/report/page/a.js", "const a = 'It is told at once.';", 2),
                ("src/trochoid/report/page/a.js", "a('What is ' +\n  `told: ${b}.`);", 2),
                ("web/a.mjs", "a(`${b ? `it\n  is told ${c}` : ''} now`);", 2),
                ("web/a.js", "a(x / 2, 'so it is told', y / 2);", 2),
                ("web/a.html", "<p>a\nb</p>\n<p>It <b>is</b>\ntold.</p>", 4),
                ("web/a.html", '<a title="It is told.">a</a>', 2),
                ("web/a.js", "// It is told.\n/* is told */ a('held', \"b's\", /'is told/, `a${b}`);", 0),
                ("web/a.html", "<script>it is told</script><!-- is told --><p>b</p>", 0)):
            with self.subTest(text):
                found = answers(check_words.faults, files={name: f"\n{text}\n"})
                self.assertEqual([f.split(" '")[0] for f in found], [f"{name}:{line}:"] if line else [])

    def test_no_page(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("no page found", list(check_words.faults(pathlib.Path(folder)))[0])


if __name__ == "__main__":
    unittest.main()
