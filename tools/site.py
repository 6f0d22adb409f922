#!/usr/bin/env python3
"""Make the documentation as a site: the Markdown of the repository, theory with its formulas
set, and the interfaces of Python, C++ and C from their docstrings.

    site.py OUTPUT --module FOLDER     FOLDER holds the built Python module `trochoid`

Needs Sphinx, Furo, MyST, Breathe, Doxygen, KaTeX and node (tools/setup.sh: site_libraries).
Nothing is fetched. A warning is an error. Then every link within the site is followed, and
every page looked through for what a browser would fetch from elsewhere.
"""
import argparse
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[1]
SITE = TOP / "docs/site"
sys.path.insert(0, str(SITE))
import interfaces  # noqa: E402

PAGES = ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE", "docs",
         "examples", "linuxcnc")
INDEXED = ("docs/guide/README.md", "docs/theory/README.md", "examples/README.md")
NOT_HERE = 77


def tracked():
    """What belongs to the repository, or will once it is committed."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "--", *PAGES],
                            cwd=TOP, capture_output=True, text=True)
    if listed.returncode == 0:
        return [TOP / name for name in listed.stdout.splitlines()]
    return [file for page in PAGES for file in [TOP / page, *(TOP / page).rglob("*")]
            if file.is_file()]


def write(file, text):
    """Only what is new, so that Sphinx reads again only what changed."""
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.is_file() or file.read_text() != text:
        file.write_text(text)


def stage_indexed(source, page):
    """A page that lists its folder, with that folder as its chapters."""
    folder = page.parent
    elsewhere = {page, TOP / "docs/guide/tutorial.md"}
    chapters = sorted({*folder.glob("*.md"), *folder.glob("*/README.md")} - elsewhere)
    names = "\n".join(str(each.relative_to(folder).with_suffix("")) for each in chapters)
    write(source / page.relative_to(TOP),
          f"{page.read_text()}\n```{{toctree}}\n:hidden:\n{names}\n```\n")


def stage_script(source, script):
    """A page of a script in percent format: its cells, and the picture that it leaves."""
    _, about, cells = script.read_text().split('"""', 2)
    name, _, rest = about.partition("\n")
    parts = [f"# {name.rstrip('.')}\n{rest}"]
    for cell in cells.split("# %% ")[1:]:
        head, _, code = cell.partition("\n")
        parts.append(f"## {head}\n\n```python\n{code.strip()}\n```\n")
    parts.append(f"![What the script draws](../../docs/pictures/{script.stem}.png)\n")
    write(source / script.relative_to(TOP).with_suffix(".md"), "\n".join(parts))


def stage_scripts(source):
    page = TOP / "examples/python/README.md"
    scripts = sorted(page.parent.glob("*.py"))
    for script in scripts:
        stage_script(source, script)
    names = "\n".join(script.stem for script in scripts)
    write(source / page.relative_to(TOP),
          f"{page.read_text()}\n```{{toctree}}\n{names}\n```\n")


def stage(source):
    """The repository's pages as they lie there, so that their links hold."""
    wanted = set()
    for file in tracked():
        if SITE in file.parents or not file.is_file():
            continue
        to = source / file.relative_to(TOP)
        wanted.add(to)
        if str(file.relative_to(TOP)) in INDEXED:
            stage_indexed(source, file)
        elif not to.is_file() or to.stat().st_mtime != file.stat().st_mtime:
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, to)
    shutil.copy2(SITE / "index.md", source / "index.md")
    for old in set(source.rglob("*.md")) - wanted - {source / "index.md"}:
        old.unlink()
    stage_scripts(source)


def write_interfaces(work):
    page = (TOP / "docs/cpp.md").read_text()
    inputs = [*interfaces.IN_C, *(name for names in interfaces.headers(page).values()
                                  for name in names)]
    shutil.rmtree(work / "doxygen", ignore_errors=True)
    (work / "doxygen").mkdir()
    settings = (SITE / "Doxyfile").read_text() + f"""
INPUT = {" ".join(f"src/trochoid/{name}" for name in inputs)}
OUTPUT_DIRECTORY = "{work / 'doxygen'}"
"""
    subprocess.run(["doxygen", "-"], cwd=TOP, input=settings, text=True).check_returncode()
    for name, text in interfaces.pages(page, work / "doxygen/xml"):
        write(work / "source" / name, text)


def version():
    return re.search(r"VERSION (\d+\.\d+\.\d+)", (TOP / "CMakeLists.txt").read_text())[1]


def missing():
    """What the site is made with, and is not here."""
    modules = [name for name in ("sphinx", "furo", "myst_parser", "breathe")
               if importlib.util.find_spec(name) is None]
    programs = [name for name in ("doxygen", "node") if shutil.which(name) is None]
    katex = [] if pathlib.Path("/usr/share/javascript/katex/katex.js").is_file() else ["KaTeX"]
    return modules + programs + katex


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    arguments.add_argument("output", type=pathlib.Path)
    arguments.add_argument("--module", type=pathlib.Path, required=True)
    given = arguments.parse_args()
    if missing():
        print(f"not here: {', '.join(missing())}; ./run docs installs what the site needs")
        return NOT_HERE
    output = given.output.resolve()
    work = output.with_name(output.name + "-work")
    source = work / "source"
    source.mkdir(parents=True, exist_ok=True)
    stage(source)
    write_interfaces(work)
    environment = {**os.environ, "TROCHOID_MODULE": str(given.module.resolve()),
                   "TROCHOID_DOXYGEN": str(work / "doxygen/xml"),
                   "TROCHOID_VERSION": version(), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run([sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-a",
                           "-c", SITE, "-d", work / "doctrees", source, output],
                          env=environment)
    if done.returncode:
        return done.returncode
    return subprocess.run([sys.executable, TOP / "tools/check_site.py", output]).returncode


if __name__ == "__main__":
    sys.exit(main())
