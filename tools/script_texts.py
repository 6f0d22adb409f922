"""The texts of a script in JavaScript and of a page in HTML, for checks of words."""
import re

TOKEN = re.compile(r"""
    (?P<comment> //[^\n]* | /\*.*?\*/ )
  | (?P<text> "(?:[^"\\\n]|\\.)*" | '(?:[^'\\\n]|\\.)*' )
  | (?P<template> ` )
  | (?P<word> [\w$]+ )
  | (?P<space> \s+ )
  | (?P<sign> . )
""", re.VERBOSE | re.DOTALL)
PATTERN = re.compile(r"/(?:[^/\\\[\n]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/\w*")  # a regular expression
TEMPLATE = re.compile(r"((?:[^`\\$]|\\.|\$(?!\{))*)(`|\$\{)", re.DOTALL)
BEFORE_PATTERN = set("(,=:[!&|?{};+-*%<>~^") | {"", "return", "typeof", "case"}
GAP = "~"  # in place of a value within a text
PARTS = re.compile(r"<!--.*?-->|<(script|style|svg|pre)\b.*?</\1>", re.DOTALL)
SHOWN = re.compile(r"""\b(?:aria-label|title|placeholder|alt|content)=(?:"([^"]*)"|'([^']*)')""")


def of_script(text):
    """(number of the line, text) of each string; strings joined by + are one, as a reader sees them."""
    found = []
    _read(text, 0, found, inner=False)
    joined = []
    for start, end, words in sorted(found):
        gap = text[joined[-1][1]:start] if joined else None
        if gap is not None and re.fullmatch(r"\s*\+\s*", gap):
            joined[-1] = (joined[-1][0], end, joined[-1][2] + words)
        else:
            joined.append((start, end, words))
    return [(text.count("\n", 0, start) + 1, " ".join(words.replace("\\n", " ").split()))
            for start, _, words in joined]


def _read(text, at, found, inner):
    """Collect strings from `at` to the end, or to the brace that ends a value in a template."""
    before, depth = "", 0
    while at < len(text):
        token = TOKEN.match(text, at)
        kind, words = token.lastgroup, token[0]
        pattern = PATTERN.match(text, at) if words == "/" and before in BEFORE_PATTERN else None
        at = pattern.end() if pattern else token.end()
        if kind in ("comment", "space"):
            continue
        before = "a" if pattern or kind in ("text", "template") else words
        if kind == "text":
            found.append((token.start(), at, words[1:-1]))
        elif kind == "template":
            at = _template(text, at, found)
        elif words == "{":
            depth += 1
        elif words == "}":
            if inner and depth == 0:
                return at
            depth -= 1
    return at


def _template(text, start, found):
    at, words = start, ""
    while part := TEMPLATE.match(text, at):
        words += part[1]
        at = part.end()
        if part[2] == "`":
            break
        words += GAP
        at = _read(text, at, found, inner=True)
    found.append((start - 1, at, words))
    return at


def of_page(text):
    """(number of the line, text) of what a page in HTML shows before its scripts run."""
    text = PARTS.sub(lambda part: re.sub(r"[^\n]", " ", part[0]), text)
    for tag in re.finditer(r"<[^>]*>", text):
        for shown in SHOWN.finditer(tag[0]):
            yield text.count("\n", 0, tag.start()) + 1, shown[1] or shown[2] or ""
    text = re.sub(r"</?(?:b|i|em|strong|code|span|a|kbd|sub|sup)\b[^>]*>", "", text)
    place = 0
    for part in re.split(r"(<[^>]*>)", text):
        if not part.startswith("<") and part.strip():
            start = place + len(part) - len(part.lstrip())
            yield text.count("\n", 0, start) + 1, " ".join(part.split())
        place += len(part)
