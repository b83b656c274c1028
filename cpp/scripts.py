"""Name of the console script: `_trundle` where cpp/launcher/launcher.cc is the command `trundle` and starts it."""

import sys


def dynamic_metadata(*_: object) -> dict[str, str]:
    """`[project.scripts]` on this platform; scikit-build-core asks for it while it builds."""
    return {"_trundle" if sys.platform in ("linux", "darwin") else "trundle": "trundle.__main__:main"}
