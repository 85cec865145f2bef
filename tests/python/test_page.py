"""The programs of docs/python.md run as they are printed there."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import hapbeam

DOCS = Path(__file__).resolve().parents[2] / "docs"
PROGRAMS = re.findall(r"^```python\n(.*?)^```", (DOCS / "python.md").read_text(encoding="utf-8"),
                      re.MULTILINE | re.DOTALL)
# What draws is another's: it takes whatever is drawn.
CANVAS = """class Anything:
    def __getattr__(self, name):
        return Anything()
    def __call__(self, *args, **named):
        return Anything()
    def __iter__(self):
        return iter([Anything()])
def subplots(rows, columns, **named):
    return Anything(), [Anything()] * columns
"""


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_program_of_the_page_runs(program, tmp_path):
    (tmp_path / "matplotlib").mkdir()
    (tmp_path / "matplotlib" / "__init__.py").write_text("")
    (tmp_path / "matplotlib" / "pyplot.py").write_text(CANVAS)
    path = os.pathsep.join([str(tmp_path), str(Path(hapbeam.__file__).parents[1])])
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                         env={**os.environ, "PYTHONPATH": path}, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "matplotlib" in program or re.search(r"\d.* ok ", run.stdout), run.stdout


def test_the_picture_is_drawn_by_the_program_beside_it():
    assert (DOCS / "images" / "python.py").read_text(encoding="utf-8") in PROGRAMS
