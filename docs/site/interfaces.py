"""Pages of every name in Python, C++ and C, from the docstrings; tools/site.py writes them."""

import collections
import re
import xml.etree.ElementTree

HEADER = re.compile(r"`([a-z_]+(?:/[a-z_]+)+\.h)`")
ROOMS = {"base": "Units, errors, warnings", "geometry": "Cutter, cut, runout",
         "chip": "Uncut chip thickness", "force": "Forces", "signal": "Records of forces",
         "identification": "Coefficients from forces", "structure": "Structures and their modes",
         "surface": "Surfaces of thin walls", "dynamics": "Stability and motion",
         "stock": "Stock along a program", "engagement": "Forces along a program",
         "correction": "Correction of runout", "files": "Files of measurements", "cases": "Case files",
         "results": "Answers", "report": "The report", "run": "Commands"}
IN_C = ("correction/controller.h", "correction/online.h")


def headers(page):
    """The headers that docs/cpp.md names, by room."""
    rooms = {}
    for header in dict.fromkeys(HEADER.findall(page)):
        if header not in IN_C:
            rooms.setdefault(header.split("/")[0], []).append(header)
    return rooms


def in_xml(xml):
    """By header: (line, directive) of what it declares in its namespace."""
    found = collections.defaultdict(list)
    functions = collections.Counter()
    for file in xml.glob("namespace*.xml"):
        for member in xml_tree(file).iter("memberdef"):
            functions[member.findtext("qualifiedname")] += member.get("kind") == "function"
    for file in [*xml.glob("namespace*.xml"), *xml.glob("struct*.xml"), *xml.glob("class*.xml")]:
        compound = xml_tree(file).find("compounddef")
        if compound.get("kind") == "namespace":
            declared = list(compound.iter("memberdef"))
        else:
            declared = [compound]
        for each in declared:
            place = each.find("location")
            name = each.findtext("qualifiedname") or each.findtext("compoundname")
            nested = each is compound and name.count("::") > 2
            if not nested and "<" not in name:
                found[place.get("file")].append((int(place.get("line")),
                                                 directive(each, name, functions[name])))
    return found


def xml_tree(file):
    return xml.etree.ElementTree.parse(file)


def directive(element, name, overloads):
    kind = element.get("kind")
    if kind == "function" and overloads > 1:
        name += re.sub(r" noexcept.*| ?= ?[\w.:{}]+", "", element.findtext("argsstring"))
    options = "   :members:\n   :undoc-members:\n" if kind in ("struct", "class") else ""
    return f".. doxygen{kind}:: {name}\n{options}\n"


def title(text, mark="="):
    return f"{text}\n{mark * len(text)}\n\n"


def pages(page, xml):
    """Name and text of each page. page: text of docs/cpp.md; xml: what Doxygen wrote."""
    yield "api/python.rst", (title("Python: every name") +
                             ".. automodule:: trochoid\n   :members:\n   :imported-members:\n")
    rooms = headers(page)
    of = "".join(f"   cpp_{room}\n" for room in ROOMS if room in rooms)
    yield "api/cpp.rst", (
        title("C++: every header") + "What stands in the headers that :doc:`/docs/cpp` names, "
        "room by room. SI and radians.\n\n.. toctree::\n\n" + of)
    found = in_xml(xml)
    for room, names in rooms.items():
        parts = [title(ROOMS[room])]
        for name in names:
            declared = [text for _, text in sorted(found[f"trochoid/{name}"])]
            parts += [title(name, "-"), *declared]
        yield f"api/cpp_{room}.rst", "".join(parts)
    yield "api/controller.rst", title("C: the controller") + "".join(
        title(name, "-") + f".. doxygenfile:: trochoid/{name}\n\n" for name in IN_C)
