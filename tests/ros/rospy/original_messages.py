"""Generates the Python messages of packages with Debian's genpy, for programs that run with the original."""

import subprocess
from collections.abc import Iterable
from pathlib import Path

from tests.ros.rospy.programs import DEBIAN

_GENERATORS = {"msg": "/usr/lib/genpy/genmsg_py.py", "srv": "/usr/lib/genpy/gensrv_py.py"}
_ACTIONS = "/usr/lib/actionlib_msgs/genaction.py"
_INSTALLED = sorted(Path("/usr/share").glob("*/msg"))


def generate(packages: Iterable[Path], folder: Path) -> None:
    """Write `folder`/PACKAGE/msg and srv of every package that defines messages."""
    with_messages = [
        package for package in packages if any((package / kind).is_dir() for kind in ("msg", "srv", "action"))
    ]
    search = [f"-I{path.parent.name}:{path}" for path in _INSTALLED]
    for package in with_messages:
        actions = folder / "actions" / package.name
        actions.mkdir(parents=True, exist_ok=True)
        for path in sorted(package.glob("action/*.action")):
            subprocess.run([DEBIAN, _ACTIONS, path, "-o", actions], check=True, capture_output=True)
        search += [f"-I{package.name}:{folder}" for folder in (package / "msg", actions)]
    for package in with_messages:
        messages = [*package.glob("msg/*.msg"), *(folder / "actions" / package.name).glob("*.msg")]
        for kind, files in (("msg", messages), ("srv", [*package.glob("srv/*.srv")])):
            if files:
                _generate_kind(package.name, kind, files, search, folder / package.name)


def _generate_kind(package: str, kind: str, files: list[Path], search: list[str], folder: Path) -> None:
    (folder / kind).mkdir(parents=True, exist_ok=True)
    (folder / "__init__.py").touch()
    command = [DEBIAN, _GENERATORS[kind], "-p", package, "-o", str(folder / kind)]
    for path in sorted(files):  # one that refers to a missing package does not stop the others
        subprocess.run([*command, *search, path], check=False, capture_output=True)
    subprocess.run([*command, "--initpy"], check=True, capture_output=True)
