"""Runs a notebook from top to bottom, as a reader does, and prints the text of its outputs. With ``--write`` the outputs are
stored in it.

    python3 tests/python/run_notebook.py docs/notebooks/ur-arm.ipynb --write
"""

import sys
from pathlib import Path

import nbclient
import nbformat

path = Path(sys.argv[1])
notebook = nbformat.read(path, as_version=4)
client = nbclient.NotebookClient(
    notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}
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
if "--write" in sys.argv[2:]:
    notebook.metadata.language_info = {"name": "python"}
    nbformat.write(notebook, path)
