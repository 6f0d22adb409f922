#!/usr/bin/env python3
"""Check that the pages are in plain English: no phrase that has to be read twice, no endless
sentence, few semicolons.

Read are docs/, README.md and examples/*/README.md without their code, and what the program
and its pages show, the texts of src and web: these for the phrases alone. The phrases and what to write instead
are PHRASES. A phrase may stay in the places of ALLOWED.
Usage: check_words.py [--counts] [REPOSITORY]. Each finding is printed as file:line: reason.
--counts prints semicolons, "what", "that of" and "hold" per 1000 words of the pages instead,
and how long sentences are.
"""
import pathlib
import re
import sys

import script_texts

PAGES = ("README.md", "docs/**/*.md", "examples/**/README.md")
LONGEST = 40  # words of a sentence
SHOWN = ("src/trochoid/report/page/*.js", "src/trochoid/report/page/*.html",
         "web/*.js", "web/*.mjs", "web/*.html")
SEMICOLONS = 4  # per 1000 words of a page

PHRASES = tuple((re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE), instead) for pattern, instead in (
    ("(?:that|those) of", "name the thing again, or use its possessive"),
    ("(?:is|are|was|were|be|been|being) (?:told|said)", "say who says it: the message names, ..."),
    ("hold|holds|held", "contain, cover, keep, stay, be true"),
    ("by (?:itself|themselves)", "alone, automatically"),
    ("beside (?:it|them|that|this)", "next to it, in addition, compared with"),
    (r"a (?:row|dataset|line|column|file|dot|part) (?:a|an) \w+", "one row per case"),
    ("what (?:[a-z]+ ){1,5}comes? to", "name the result"),
    ("as (?:little|much|well|far) as may be", "as far as possible"),
    ("one another", "each ... the other"),
    ("where nothing else can be meant", "where it is unambiguous"),
    ("give way|gives way|gave way", "deflect, be compliant"),
    ("takes? (?:it|them|this) away", "removes it"),
    ("comes along", "is included"),
    ("hangs? together", "be correlated"),
    ("whoever", "say who: you, a user, the shop"),
))

# What may stay: file, words in its line, and why.
ALLOWED = (
    ("src/trochoid/cases/schema_correct.cpp", "hold); 0: continuous", "zero-order hold, of control theory"),
)

# Lists that are made by the program or are no prose.
NOT_PROSE = ("docs/formats/case.md", "docs/formats/results.md", "docs/references.md",
             "docs/gallery.md")

TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"')  # of C++ on one line
FENCE = re.compile(r"^\s*(```|~~~|\$\$)")
WORD = re.compile(r"[^\W_][\w'’.,/-]*")
START = re.compile(r"^\s*([*+-]|\d+\.|#+|>)\s+")
END = re.compile(r"[.!?][)*\"”]*(?=\s+[(\[*\"“$]*[A-ZÄÖÜ0-9~]|\s*$)")


def without_code(line):
    """A line with code, formulas and targets of links put out of sight; their width stays a word."""
    line = re.sub(r"`[^`]*`", "~code~", line)
    line = re.sub(r"\$[^$]*\$", "~x~", line)
    line = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)
    return re.sub(r"<[^>]*>", "", line)


def prose(text):
    """(number, line) of what is neither code nor a displayed formula nor a comment."""
    fence = None
    text = re.sub(r"<!--.*?-->", lambda found: "\n" * found[0].count("\n"), text, flags=re.DOTALL)
    for number, line in enumerate(text.splitlines(), 1):
        mark = FENCE.match(line)
        if mark and fence is None:
            one_line = mark[1] == "$$" and line.strip().endswith("$$") and len(line.strip()) > 3
            fence = None if one_line else mark[1]
        elif fence and (line.strip().startswith(fence) or
                        fence == "$$" and line.strip().endswith("$$")):
            fence = None
        elif fence is None and not line.startswith("    "):
            yield number, without_code(line)
        if fence or mark:
            yield number, ""


def paragraphs(text):
    """(number of the first line, text): a paragraph, an entry of a list, a cell of a table."""
    start, words = 0, ""
    for number, line in prose(text):
        cells = line.strip().startswith("|")
        if cells or not line.strip() or START.match(line):
            if words:
                yield start, words
            start, words = number, ""
        if cells:
            yield from ((number, cell.strip()) for cell in line.strip().strip("|").split("|"))
        elif line.strip():
            start = start if words else number
            words = f"{words} {START.sub('', line).strip()}".strip()
    if words:
        yield start, words


def sentences(text):
    """(number of the line of its paragraph, sentence)"""
    for number, words in paragraphs(text):
        start = 0
        for end in END.finditer(words):
            yield number, words[start:end.end()].strip()
            start = end.end()
        if words[start:].strip():
            yield number, words[start:].strip()


def length(sentence):
    return len(WORD.findall(sentence))


def pages(top):
    for pattern in PAGES:
        for file in sorted(top.glob(pattern)):
            name = str(file.relative_to(top))
            if name not in NOT_PROSE and "node_modules" not in file.parts:
                yield name, file.read_text()


def faults_of(name, text, allowed):
    words = semicolons = 0
    lines = list(prose(text))
    for (number, line), (_, following) in zip(lines, [*lines[1:], (0, "")]):
        words += length(line)
        semicolons += line.count(";")
        for phrase, instead in PHRASES:
            for found in phrase.finditer(f"{line} {following.strip()}"):
                if found.start() < len(line) and not allowed(name, line):
                    yield f"{name}:{number}: '{found[0]}': {instead}"
    for number, sentence in sentences(text):
        if length(sentence) > LONGEST and not allowed(name, sentence):
            yield (f"{name}:{number}: a sentence of {length(sentence)} words, more than {LONGEST}: "
                   f"{sentence[:60]} ...")
    if semicolons > max(1, SEMICOLONS * words / 1000):
        yield (f"{name}:1: {semicolons} semicolons in {words} words, more than {SEMICOLONS} in "
               "1000: make two sentences")


def faults_of_messages(top, allowed):
    for file in sorted((top / "src/trochoid").rglob("*.cpp")):
        name = str(file.relative_to(top))
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if line.lstrip().startswith(("//", "#include")):
                continue
            text = " ".join(t for t in TEXT.findall(line) if " " in t)
            for phrase, instead in PHRASES:
                for found in phrase.finditer(text):
                    if not allowed(name, text):
                        yield f"{name}:{number}: '{found[0]}': {instead}"


def faults_of_scripts(top, allowed):
    """Of the pages that the program writes and of the form for browsers."""
    for file in sorted(file for pattern in SHOWN for file in top.glob(pattern)):
        name = str(file.relative_to(top))
        read = script_texts.of_page if file.suffix == ".html" else script_texts.of_script
        for number, text in read(file.read_text()):
            for phrase, instead in PHRASES:
                for found in phrase.finditer(text if " " in text else ""):
                    if not allowed(name, text):
                        yield f"{name}:{number}: '{found[0]}': {instead}"


def faults(top):
    used = set()

    def allowed(name, line):
        fitting = [entry for entry in ALLOWED if entry[0] == name and entry[1] in line]
        used.update(fitting)
        return bool(fitting)

    read = list(pages(top))
    for name, text in read:
        yield from faults_of(name, text, allowed)
    yield from faults_of_messages(top, allowed)
    yield from faults_of_scripts(top, allowed)
    for entry in sorted(set(ALLOWED) - used):
        if (top / entry[0]).exists():
            yield f"{entry[0]}:1: has no '{entry[1]}' any more, and needs no exception"
    if not read:
        yield f"{top}:1: no page found, so nothing was checked"


def counts(read):
    """How plain some pages are, as one line."""
    lines = [line for _, text in read for _, line in prose(text)]
    words = max(1, sum(map(length, lines)))
    text = " ".join(lines)
    lengths = sorted(length(s) for _, page in read for _, s in sentences(page) if length(s) > 3)
    per = " ".join(f"{1000 * len(re.findall(p, text, re.IGNORECASE)) / words:6.1f}" for p in (
        ";", r"\bwhat\b", r"\bthat of\b", r"\b(?:hold|holds|held)\b"))
    return f"{words:7} {per} {lengths[len(lengths) * 9 // 10]:6} {lengths[-1]:6}"


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    top = pathlib.Path(arguments[0] if arguments else ".")
    if "--counts" in sys.argv:
        read = list(pages(top))
        print("  words      ;   what thatof   hold  90 %  longest")
        for name, text in read:
            print(counts([(name, text)]), name)
        print(counts(read), "all")
        return 0
    found = list(faults(top))
    print("\n".join(found) or "words ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
