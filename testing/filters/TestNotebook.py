# SPDX-License-Identifier: BSD-3-Clause
"""examples/detect.ipynb: no output is stored, and its cells run one after the other and show what they say, as a script and in a kernel
of Jupyter. The latter needs the Debian packages python3-nbclient and python3-ipykernel."""
import ast
import json
import os
import re
import tempfile
import webbrowser

from meamtest import check, read, skip
from ppfmeam.report import page

try:
    page.require_three()
except page.scripting.Failure as failure:
    skip(str(failure))

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples"))
cells = [cell for cell in json.loads(read("detect.ipynb"))["cells"] if cell["cell_type"] == "code"]
check(all(not cell["outputs"] and cell["execution_count"] is None for cell in cells), "no output is stored")
opened = []
webbrowser.open = opened.append
shown, names = [], {}
with tempfile.TemporaryDirectory() as tempfile.tempdir:
    for cell in cells:
        body = ast.parse("".join(cell["source"])).body
        last = body.pop() if isinstance(body[-1], ast.Expr) else None
        exec(compile(ast.Module(body, []), "detect.ipynb", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "detect.ipynb", "eval"), names) if last else None
        shown.append(value._repr_html_() if hasattr(value, "_repr_html_") else repr(value))
    check(shown[0].startswith("<ppfmeam.Model of handle, "), shown[0])
    count = len(names["found"])
    check(count > 5 and shown[2].count("<path data-rank") == shown[2].count("<tr data-rank") == count, f"{count} outlines and rows")
    check(len(opened) == 1 and os.path.getsize(opened[0][len("file://"):]) > 1e6, f"a page is opened: {opened}")
check(shown[4].startswith("array([["), shown[4])
check(names["why"].lost_in == "" and "For it, " in names["why"].reasons, names["why"].reasons)

# In a kernel: the same poses, and the page stands below its cell.
try:
    import ipykernel  # noqa: F401, of the kernel
    import nbformat
    from nbclient import NotebookClient
except ImportError as error:
    skip(f"the notebook in a kernel: {error}")
tempfile.tempdir = None
with tempfile.TemporaryDirectory() as folder:
    os.environ.update(IPYTHONDIR=folder, JUPYTER_RUNTIME_DIR=folder, BROWSER="false")
    notebook = nbformat.read("detect.ipynb", as_version=4)
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
outputs = [cell["outputs"] for cell in notebook["cells"] if cell["cell_type"] == "code"]
check([len(of) for of in outputs] == [1, 0, 1, 1, 1, 1], f"each cell but the second shows one thing, and none warns: {outputs}")
model, _, table, frame, matrix, why = [of[0].get("data", of[0]) if of else {} for of in outputs]
check(model["text/plain"] == shown[0] and matrix["text/plain"] == shown[4], f"{model} {matrix}")
check(re.findall("<td>.*?</td>", table["text/html"]) == re.findall("<td>.*?</td>", shown[2]), "the same table")
check(table["text/plain"] == str(names["found"]), table["text/plain"])
check(frame["text/html"].startswith("<iframe srcdoc=") and frame["text/plain"] == "<a page that a notebook shows>", frame["text/plain"])
check(why["text"] == f"{names['why']}\n{names['why'].reasons}\n", why["text"])
