"""Runs a notebook from top to bottom, as a reader does, and prints the text of its outputs. With ``--check`` it ends with 1
where an output is not the one that is stored, and says in which cell and lines; with ``--write`` the outputs are stored in it.

    python3 tests/python/run_notebook.py docs/notebooks/ur-arm.ipynb --write
"""

import copy
import difflib
import sys
from pathlib import Path

import nbclient
import nbformat


def shown(cell):
    """Lines of what a cell shows: of each stream, then of each result the text and the kinds of its pictures."""
    streams, results = {}, []
    for output in cell.get("outputs", []):
        if output.output_type == "stream":
            streams[output.name] = streams.get(output.name, "") + output.text
            continue
        for kind, data in sorted(output.get("data", {}).items()):
            results += [f"[{kind}]", *(data.splitlines() if kind.startswith("text/") else [])]
    return [line for name in sorted(streams) for line in [f"[{name}]", *streams[name].splitlines()]] + results


def differences(name, stored, run):
    """What differs, cell by cell and line by line: stored ``-``, printed ``+``."""
    found = []
    for index, (before, after) in enumerate(zip(stored.cells, run.cells), start=1):
        lines = list(difflib.unified_diff(shown(before), shown(after), lineterm="", n=0))[2:]
        if lines:
            found += [f"{name}, cell {index}: stored (-) is not what is printed (+)", *lines]
    return found


def main(path, options):
    stored = nbformat.read(path, as_version=4)
    notebook = copy.deepcopy(stored)
    client = nbclient.NotebookClient(
        notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}
    )
    client.execute()
    for cell in notebook.cells:
        # When a cell ran, which differs from run to run.
        cell.metadata.pop("execution", None)
        for output in cell.get("outputs", []):
            print(output.get("text", ""))
            for kind, data in output.get("data", {}).items():
                if kind.startswith("text/"):
                    print(data)
    if "--write" in options:
        notebook.metadata.language_info = {"name": "python"}
        nbformat.write(notebook, path)
    different = differences(path.name, stored, notebook) if "--check" in options else []
    if different:
        print("\n".join(different), file=sys.stderr)
        sys.exit(f"python3 tests/python/run_notebook.py docs/notebooks/{path.name} --write stores them anew")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
