"""Names the script that an installer writes: where cpp/start.cc is the command, that one starts `_trundle`."""

import sys


def dynamic_metadata(*_: object) -> dict[str, str]:
    """`[project.scripts]` on this platform; scikit-build-core asks for it while it builds."""
    return {"_trundle" if sys.platform in ("linux", "darwin") else "trundle": "trundle.__main__:main"}
