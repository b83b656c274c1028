"""First bytes of a state log, which identify it."""

import json
from pathlib import Path

from trundle.base.files import open_file

FORMAT = "trundle state log 1"
_MAGIC = json.dumps({"format": FORMAT}).encode().removesuffix(b"}")


def is_state_log(file: Path) -> bool:
    """True if a file begins as a state log does."""
    with open_file(file) as stream:
        return stream.read(len(_MAGIC)) == _MAGIC
