#!/usr/bin/env python3
"""The page of the book on the module: its public names, with signatures and docstrings, as they stand in the sources.

    python3 crates/python/reference.py > docs/src/python-reference.md

Reads the sources and imports nothing, so that neither the wheel nor NumPy is needed.
"""

import ast
import inspect
import re
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent / "python/plumbline"

HEAD = """# Python reference

Every public name of `import plumbline`, made of its sources by `python3 crates/python/reference.py`. Numbers are in SI units
and radians, arrays have one column a joint in the order of `robot.joints`. [From Python](python.md) shows them at work.
"""


def parsed(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def sources():
    """Definitions by public name, in the order of ``__all__``."""
    where, public = {}, []
    for node in parsed(PACKAGE / "__init__.py").body:
        if isinstance(node, ast.ImportFrom):
            where.update({alias.name: node.module.rpartition(".")[2] for alias in node.names})
        elif isinstance(node, ast.Assign) and node.targets[0].id == "__all__":
            public = ast.literal_eval(node.value)
    modules = {name: parsed(PACKAGE / f"{name}.py") for name in where.values() if (PACKAGE / f"{name}.py").exists()}
    found = {}
    for name in public:
        body = modules[where[name]].body if where[name] in modules else []
        found[name] = next((node for node in body if getattr(node, "name", None) == name), None)
    return found


def text(docstring):
    """A docstring as Markdown: code between single backticks, an indented block behind ``::`` as a fenced one."""
    lines, fenced, out = inspect.cleandoc(docstring).split("\n"), False, []
    for line in lines:
        if fenced and line and not line.startswith(" "):
            while out[-1] == "":
                out.pop()
            out += ["```", ""]
            fenced = False
        if fenced:
            out.append(line[4:])
        elif line.endswith("::"):
            out += [line[:-1].replace("``", "`"), "", "```text"]
            fenced = True
        else:
            out.append(line.replace("``", "`"))
    if fenced:
        out.append("```")
    return re.sub(r"```text\n\n+", "```text\n", "\n".join(out))


def signature(node):
    """A function as it is called, with the names of its types in short."""
    return shortened(called(node))


def called(node):
    """A function as it is called: its parameters, one a line where they are many, and what it returns."""
    every = ast.unparse(node.args)
    parameters = re.sub(r"^(self|cls)(, )?", "", every)
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    line = f"{node.name}({parameters}){result}"
    if len(line) <= 100:
        return line
    node.args.args = [a for a in node.args.args if a.arg not in ("self", "cls")]
    pieces = re.split(r", (?=\*?[a-z_]+(?:: |$)|\*,|\*$)", ast.unparse(node.args))
    return f"{node.name}(\n" + "".join(f"    {piece},\n" for piece in pieces) + f"){result}"


def shown(words):
    return f"\n```text\n{words}\n```\n"


def function(name, node, level="##"):
    return f"\n{level} {name}\n{shown(signature(node))}\n{text(ast.get_docstring(node))}\n"


def fields(node):
    """Attributes of a class that have no ``def``: name, type and the text behind each."""
    body = list(node.body)
    for method in node.body:
        if isinstance(method, ast.FunctionDef) and method.name == "__init__":
            body += method.body
    rows = []
    for index, item in enumerate(body):
        target = item.target if isinstance(item, ast.AnnAssign) else item.targets[0] if isinstance(item, ast.Assign) else None
        name = getattr(target, "id", getattr(target, "attr", "_"))
        if name.startswith("_"):
            continue
        behind = body[index + 1] if index + 1 < len(body) else None
        told = behind.value.value if isinstance(behind, ast.Expr) and isinstance(behind.value, ast.Constant) else ""
        kind = f": {typed(item.annotation)}" if isinstance(item, ast.AnnAssign) else ""
        rows.append((f"{name}{kind}", told))
    return rows


def shortened(types):
    for long, short in (("numpy.typing.", ""), ("numpy.float64", "float64"), ("_Array", "NDArray[float64]")):
        types = types.replace(long, short)
    return types


def typed(annotation):
    return shortened(ast.unparse(annotation))


def is_property(node):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def class_(name, node):
    page = f"\n## {name}\n\n"
    methods = [m for m in node.body if isinstance(m, ast.FunctionDef)]
    begin = next((m for m in methods if m.name == "__init__"), None)
    if begin and [a.arg for a in begin.args.args] != ["self", "native"]:
        begin.name, begin.returns = name, None
        page = page.rstrip("\n") + "\n" + shown(signature(begin)) + "\n"
    page += text(ast.get_docstring(node)) + "\n"
    public = [m for m in methods if not m.name.startswith("_") and m is not begin]
    attributes = fields(node)
    attributes += [(f"{m.name}: {typed(m.returns)}", ast.get_docstring(m)) for m in public if is_property(m)]
    if attributes:
        page += "\n" + "".join(f"- `{what}`{' – ' + one_line(told) if told else ''}\n" for what, told in attributes)
    for method in public:
        if not is_property(method):
            page += function(f"{name}.{method.name}", method, "###")
    return page


def one_line(docstring):
    return " ".join(text(docstring).split())


def page():
    """The whole page."""
    found = sources()
    functions = [function(n, node) for n, node in found.items() if isinstance(node, ast.FunctionDef)]
    classes = [class_(n, node) for n, node in found.items() if isinstance(node, ast.ClassDef)]
    rest = (
        "\n## PlumblineError\n\nA robot, a log, a scenario or a model that cannot be used, in the words of the program; a "
        "`ValueError`.\n\n## \\_\\_version\\_\\_\n\nThe version, a string.\n"
    )
    lacking = [n for n, node in found.items() if node is None and n not in ("PlumblineError", "__version__")]
    if lacking:
        sys.exit(f"no source of {', '.join(lacking)}")
    return HEAD + "".join(functions + classes) + rest


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8", newline="\n")
    sys.stdout.write(page())
