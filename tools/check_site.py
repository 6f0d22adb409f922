#!/usr/bin/env python3
"""Check a site of HTML: every link within it leads somewhere, nothing is fetched from elsewhere.

    links     href of <a>: the file is there, and in it the anchor
    resources src, stylesheets, url(...) of style sheets: files of the site

Links to other sites are left alone. Usage: check_site.py FOLDER. Each fault: file: reason.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

STYLE_URL = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")
ELSEWHERE = ("http:", "https:", "//", "ftp:")


class Page(html.parser.HTMLParser):
    """Anchors, links and resources of a page."""

    def __init__(self, file):
        super().__init__()
        self.anchors = set()
        self.links = []
        self.resources = []
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.anchors.update(given[name] for name in ("id", "name") if given.get(name))
        if tag in ("a", "area"):
            self.links.append(given.get("href") or "")
        elif tag == "link" and given.get("rel") not in ("next", "prev", "index", "search"):
            self.resources.append(given.get("href") or "")
        self.resources.extend(given[name] for name in ("src", "data", "poster")
                              if given.get(name) and tag != "a")
        self.resources.extend("".join(url) for url in STYLE_URL.findall(given.get("style") or ""))


def target(folder, page, link):
    """File and anchor of a link within the site."""
    parts = urllib.parse.urlsplit(link)
    place = urllib.parse.unquote(parts.path)
    file = (page.parent / place).resolve() if place else page
    return (file / "index.html" if file.is_dir() else file), urllib.parse.unquote(parts.fragment)


def faults(folder):
    pages = {file: Page(file) for file in sorted(folder.rglob("*.html"))}
    for file, page in pages.items():
        name = file.relative_to(folder)
        for resource in page.resources:
            if resource.startswith(ELSEWHERE):
                yield f"{name}: fetches {resource}"
            elif not resource.startswith("data:") and not target(folder, file, resource)[0].is_file():
                yield f"{name}: needs {resource}, which is not there"
        for link in page.links:
            if not link or link.startswith(("mailto:", "javascript:", *ELSEWHERE)):
                continue
            to, anchor = target(folder, file, link)
            if not to.is_file():
                yield f"{name}: leads to {link}, which is not there"
            elif anchor and to in pages and anchor not in pages[to].anchors:
                yield f"{name}: leads to {link}, an anchor that is not there"
    for file in sorted(folder.rglob("*.css")):
        for url in ("".join(pair) for pair in STYLE_URL.findall(file.read_text())):
            if url.startswith(ELSEWHERE):
                yield f"{file.relative_to(folder)}: fetches {url}"
    if not pages:
        yield f"{folder}: no pages, so nothing was checked"


def main():
    found = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(found) or "site ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
