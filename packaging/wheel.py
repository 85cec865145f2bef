"""Packs the package hapbeam, as CMake has built it, into a wheel.

    python3 wheel.py PACKAGE VERSION FOLDER

PACKAGE is the folder hapbeam of the build, with its module and stub; the wheel lands in FOLDER.
Standard library alone.  The same files give the same bytes.
"""

import base64
import hashlib
import sys
import sysconfig
import zipfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent


def tag():
    """Of the Python that runs this: another one cannot load the module."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata(version):
    return f"""Metadata-Version: 2.1
Name: hapbeam
Version: {version}
Summary: Force and shape of slender beams and rods that a hand presses
License: MIT
License-File: LICENSE
Requires-Python: =={sys.version_info.major}.{sys.version_info.minor}.*
Requires-Dist: numpy
Description-Content-Type: text/markdown

{(TOP / "docs" / "python.md").read_text(encoding="utf-8")}"""


def contents(package, version):
    """Names in the wheel, and what they hold."""
    info = f"hapbeam-{version}.dist-info"
    files = {f"hapbeam/{path.name}": path.read_bytes() for path in sorted(package.iterdir())
             if path.is_file()}
    if not any(name.startswith("hapbeam/_core.") for name in files):
        raise SystemExit(f"{package}: has no module _core; build the target hapbeam_python")
    files[f"{info}/METADATA"] = metadata(version).encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: hapbeam {version}\n"
                              f"Root-Is-Purelib: false\nTag: {tag()}\n").encode()
    files[f"{info}/LICENSE"] = (TOP / "LICENSE").read_bytes()
    record = "".join(f"{name},sha256={digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    return files


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def write(package, version, folder):
    files = contents(package, version)
    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"hapbeam-{version}-{tag()}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, data)
    return wheel


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    print(write(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])))
