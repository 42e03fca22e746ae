#!/usr/bin/env python3
"""The types of what is written in Rust: signatures of the classes and functions of the module, as they stand in the sources.

    python3 crates/python/stubs.py > crates/python/python/plumbline/_plumbline.pyi

Reads the sources and imports nothing, so that neither the module nor NumPy is needed. A type of Rust that has none of Python
here ends it, with its name.
"""

import re
import sys
from pathlib import Path

SOURCES = Path(__file__).resolve().parent / "src"

HEAD = '''"""What is written in Rust; ``plumbline`` is what a user imports.

Made of the sources by ``python3 crates/python/stubs.py``.
"""

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Optional, Union

import numpy
import numpy.typing

_Path = Union[str, PathLike[str]]
_Array = numpy.typing.NDArray[numpy.float64]
_Progress = Optional[Callable[[str, int, int], object]]

__version__: str
'''

# Types of Rust as Python has them: of an argument, of a result.
TYPES = {
    "PathBuf": ("_Path", "Path"),
    "Path": ("_Path", "Path"),
    "OsString": ("str", "str"),
    "String": ("str", "str"),
    "str": ("str", "str"),
    "f64": ("float", "float"),
    "bool": ("bool", "bool"),
    "u8": ("int", "int"),
    "u64": ("int", "int"),
    "usize": ("int", "int"),
    "PyAny": ("numpy.typing.ArrayLike", "Any"),
    "PyArrayDyn<f64>": (None, "_Array"),
    "PyArray1<f64>": (None, "_Array"),
    "PyDict": (None, "dict[str, Any]"),
    "()": (None, "None"),
}

# What holds a value of Python, and is the value there.
HOLDERS = ("PyResult", "Bound", "Py", "PyRef", "Arc")

# Arguments whose type the function checks itself, to say what it found.
CHECKED = {("Log", "on", "robot"): "Robot"}

# Names that the sources give to types.
ALIASES = {}

LONGEST_LINE = 100

# A function behind its comments and attributes, of which that of a signature may have several lines.
FUNCTION = r"((?:[ \t]*(?:///[^\n]*|#\[pyo3\([^\[\]]*\)\]|#\[[^\n]*\])\n)*)[ \t]*(?:pub )?fn (\w+)(?:<'\w+>)?\("


def split(text):
    """The parts between commas that stand in no brackets."""
    parts, depth, last = [], 0, ""
    for c in text:
        depth += (c in "([{<") - (c in ")]}>" and not last == "-")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts = parts or [""]
            parts[-1] += c
        last = c
    return [part.strip() for part in parts if part.strip()]


def inner(kind):
    """What stands in the angle brackets of a type, without lifetimes."""
    parts = split(kind[kind.index("<") + 1 : kind.rindex(">")])
    return [part for part in parts if not part.startswith("'")]


def typed(kind, classes, result):
    """A type of Rust in Python, of an argument or of a result."""
    kind = re.sub(r"^&(mut )?|'\w+ ", "", kind.strip()).strip()
    kind = re.sub(r"^(crate|std|pyo3|numpy)::(\w+::)*", "", kind)
    kind = re.sub(r"^(\w+)<'\w+>$", r"\1", kind)
    if kind in TYPES:
        found = TYPES[kind][result]
    elif kind in classes:
        found = classes[kind]
    elif kind in ALIASES:
        return typed(ALIASES[kind], classes, result)
    elif re.fullmatch(r"Option<Py<PyAny>>", kind):
        return "_Progress"
    elif kind.startswith("Option<"):
        return f"Optional[{typed(inner(kind)[0], classes, result)}]"
    elif kind.startswith(HOLDERS) and "<" in kind:
        return typed(inner(kind)[0], classes, result)
    elif kind.startswith("Vec<") or kind.startswith("["):
        of = inner(kind)[0] if kind.startswith("Vec<") else kind.strip("[]").split(";")[0]
        return f"{'list' if result else 'Sequence'}[{typed(of, classes, result)}]"
    elif kind.startswith("("):
        return f"tuple[{', '.join(typed(part, classes, result) for part in split(kind[1:-1]))}]"
    else:
        found = None
    if found is None:
        sys.exit(f"{kind}: it has no type of Python in crates/python/stubs.py")
    return found


def default(value):
    """A default as Python writes it; one that only Rust knows is not told."""
    known = {"None": "None", "true": "True", "false": "False"}
    if value in known:
        return known[value]
    return value if re.fullmatch(r'"[^"]*"|-?[\d.]+', value) else "..."


def closing(text, start):
    """Index behind the bracket that closes the one at ``start``."""
    depth = 0
    for k in range(start, len(text)):
        depth += (text[k] in "([{") - (text[k] in ")]}")
        if depth == 0:
            return k + 1
    sys.exit(f"no end of {text[start : start + 40]!r}")


def functions(text, classes, owner=None):
    """Functions behind attributes of pyo3, as lines of a stub."""
    found = []
    for match in re.finditer(FUNCTION, text):
        attributes, name = match[1], match[2]
        if owner is None and "#[pyfunction" not in attributes:
            continue
        end = closing(text, match.end() - 1)
        parameters = split(text[match.end() : end - 1])
        result = re.match(r"\s*->\s*(.*?)\s*\{", text[end:], re.DOTALL)
        result = typed(result[1], classes | {"Self": owner}, True) if result else "None"
        kinds = dict(re.split(r"\s*:\s*", p, maxsplit=1) for p in parameters if ":" in p)
        kinds = {n: k for n, k in kinds.items() if not k.startswith("Python<")}
        told = re.search(r"signature = \((.*?)\)\s*(?:\)\]|,\s*text_signature)", attributes, re.DOTALL)
        own = split(told[1]) if told else list(kinds)
        rust_name, name = name, re.search(r'name = "(\w+)"', attributes)
        getter = re.search(r"#\[getter(?:\((\w+)\))?\]", attributes)
        name = (getter and getter[1]) or (name and name[1]) or rust_name
        shown = []
        for parameter in own:
            n, _, value = (part.strip() for part in parameter.partition("="))
            if n == "*":
                shown.append("*")
                continue
            kind = CHECKED.get((owner, name, n)) or typed(kinds[n], classes, False)
            shown.append(f"{n}: {kind}" + (f" = {default(value)}" if value else ""))
        is_new, is_static = "#[new]" in attributes, "#[staticmethod]" in attributes
        if is_new:
            name, shown, result = "__new__", ["cls", *shown], owner
        elif owner and not is_static:
            shown = ["self", *shown]
        if name.startswith("__") and not is_new:
            continue
        decorator = "@property" if getter else "@staticmethod" if is_static else None
        found.append((name, decorator, shown, result))
    return found


def lines(name, decorator, shown, result, indent=""):
    out = [f"{indent}{decorator}"] if decorator else []
    line = f"{indent}def {name}({', '.join(shown)}) -> {result}: ..."
    if len(line) > LONGEST_LINE:
        line = f"{indent}def {name}(\n" + "".join(f"{indent}    {part},\n" for part in shown) + f"{indent}) -> {result}: ..."
    return [*out, line]


def page():
    """The whole stub."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted(SOURCES.glob("*.rs"))}
    exported = re.findall(r"#\[pymodule_export\]\s*use crate::(\w+)::(\{[^}]*\}|\w+);", texts["lib"])
    classes = {}
    for text in texts.values():
        ALIASES.update(re.findall(r"^(?:pub )?type (\w+)(?:<'\w+>)? = ([^;]+);", text, re.MULTILINE))
        classes.update((m[2], m[1]) for m in re.finditer(r'#\[pyclass\([^]]*?name = "(\w+)"[^]]*\]\s*pub struct (\w+)', text))
    out = ["class PlumblineError(ValueError): ..."]
    last = []
    for module, names in exported:
        text = texts[module].split("#[cfg(test)]")[0]
        for name in split(names.strip("{}")):
            if name in classes:
                python = classes[name]
                body = []
                fields = re.search(r"#\[pyclass\([^]]*get_all[^]]*\]\s*pub struct " + name + r" \{(.*?)\n\}", text, re.DOTALL)
                for field in re.findall(r"^    (?:pub )?(\w+): ([^\n]+),$", fields[1], re.MULTILINE) if fields else []:
                    body += lines(field[0], "@property", ["self"], typed(field[1], classes, True), "    ")
                for block in re.finditer(r"#\[pymethods\]\s*impl " + name + r" (?=\{)", text):
                    end = closing(text, block.end())
                    for function in functions(text[block.end() : end], classes, python):
                        body += lines(*function, "    ")
                out.append("\n".join([f"class {python}:", *body]))
            elif name != "PlumblineError":
                own = [function for function in functions(text, classes) if function[0] == name]
                if not own:
                    sys.exit(f"{name}: no #[pyfunction] of crates/python/src/{module}.rs")
                last += lines(*own[0])
    return HEAD + "\n" + "\n\n".join(out) + "\n\n" + "\n".join(last) + "\n"


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8", newline="\n")
    sys.stdout.write(page())
