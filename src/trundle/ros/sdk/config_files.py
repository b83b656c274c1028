"""Headers of a package's .cfg files, which are Python programs that describe the parameters of a node."""

import json
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.files import read_text

from .config_header import config_header

_OPTIONS = re.compile(r"\bgenerate_dynamic_reconfigure_options\s*\(([^()]*)\)", re.IGNORECASE)
_COMMENT = re.compile(r"#[^\n]*")
_PROGRAM = """
import json, sys
from pathlib import Path
from dynamic_reconfigure.config_reader import described
output, sys.stdout = sys.stdout, sys.stderr
try:
    descriptions = described(sys.argv[1], Path(sys.argv[2]))
except ImportError as error:
    sys.exit(str(error))
json.dump(descriptions, output)
"""


def write_config_headers(package: str, folder: Path, include: Path, environment: Mapping[str, str]) -> list[str]:
    """Write the headers of the configurations that a package's CMakeLists.txt names; return what is wrong.

    Args:
        package: name of the package.
        folder: its folder.
        include: folder of headers; the package's is below.
        environment: variables by which Python finds dynamic_reconfigure.
    """
    faults: list[str] = []
    for path in _config_files(folder):
        if not path.is_file():
            faults.append(f"{folder / 'CMakeLists.txt'}: error: {path} is missing")
            continue
        command = [sys.executable, "-c", _PROGRAM, package, str(path)]
        done = subprocess.run(command, env=dict(environment), capture_output=True, text=True, check=False)
        if done.returncode:
            faults.append((done.stderr.strip().splitlines() or [f"{path}: error: it cannot be run"])[-1])
            continue
        for description in json.loads(done.stdout):
            header = include / package / f"{description['name']}Config.h"
            text = config_header(description["pkgname"], description)  # whatever the package is called
            if not header.is_file() or header.read_text(encoding="utf-8") != text:
                header.parent.mkdir(parents=True, exist_ok=True)
                write_atomically(header, text)
    return faults


def _config_files(folder: Path) -> Iterator[Path]:
    try:
        text = _COMMENT.sub("", read_text(folder / "CMakeLists.txt"))
    except (OSError, UnicodeError):
        return
    for match in _OPTIONS.finditer(text):
        yield from (folder / word.strip('"') for word in match[1].split())
