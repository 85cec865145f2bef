"""The wheel: what is in it, what it says of itself, and that it works where it is unpacked."""

import base64
import csv
import hashlib
import io
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import hapbeam as hb

TOP = Path(__file__).resolve().parents[2]
VERSION = (TOP / "packaging" / "VERSION").read_text().strip()


def pack(package, folder):
    program = TOP / "packaging" / "wheel.py"
    return subprocess.run([sys.executable, program, package, VERSION, folder],
                          capture_output=True, text=True)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    run = pack(Path(hb.__file__).parent, tmp_path_factory.mktemp("wheel"))
    assert run.returncode == 0, run.stderr
    return Path(run.stdout.strip())


def test_the_record_lists_each_file_and_its_digest(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        record = f"hapbeam-{VERSION}.dist-info/RECORD"
        rows = list(csv.reader(io.StringIO(archive.read(record).decode())))
        assert {row[0] for row in rows} == names and len(rows) == len(names)
        for name, digest, size in rows:
            if name == record:
                continue
            data = archive.read(name)
            sha = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
            assert (digest, int(size)) == (f"sha256={sha}", len(data))
    assert {"hapbeam/__init__.py", "hapbeam/__init__.pyi", "hapbeam/py.typed"} <= names


def test_it_says_its_version_and_for_which_python_it_is(wheel):
    assert VERSION == hb.__version__
    with zipfile.ZipFile(wheel) as archive:
        info = f"hapbeam-{VERSION}.dist-info"
        assert f"\nVersion: {VERSION}\n" in archive.read(f"{info}/METADATA").decode()
        tag = "-".join(wheel.stem.split("-")[2:])
        assert f"\nTag: {tag}\n" in archive.read(f"{info}/WHEEL").decode()
    assert tag.startswith(f"cp{sys.version_info.major}{sys.version_info.minor}-")


def test_it_presses_a_beam_where_it_is_unpacked(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    program = ("import hapbeam as hb; print(hb.__file__); "
               "b = hb.Beam(1, 1e6, 1, 0.01, hb.Support.clamped, hb.Support.free); "
               "print(hb.FemModel(b, 8).press(1, 1e-6).force)")
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                         env={**os.environ, "PYTHONPATH": str(tmp_path)}, cwd=tmp_path, check=True)
    file, force = run.stdout.split()
    assert Path(file).is_relative_to(tmp_path)
    assert float(force) == pytest.approx(3e-6, rel=1e-6)


def test_a_folder_without_the_module_makes_no_wheel(tmp_path):
    (tmp_path / "__init__.py").write_text("")
    run = pack(tmp_path, tmp_path / "wheel")
    assert run.returncode != 0 and "has no module _core" in run.stderr
    assert not list(tmp_path.rglob("*.whl"))
