"""Where the development kit is, for a CMake that runs alone; see `sdk/gazebo/cmake/gazebo-config.cmake`.

Prints a list of CMake: the kit's sources, its compiled folder, and a Boost outside the compiler's folders.
"""

import os
import sys
from pathlib import Path

from trundle.base.diagnostics import UsageError

from .headers import Headers
from .kit import compiled_kit
from .toolchain import find_toolchain


def main(compiler: str, sources: str) -> int:
    """Compile the kit on first use, and generate the headers of messages that the sources below a folder include."""
    environment = {**os.environ, "CXX": compiler}
    try:
        toolchain = find_toolchain(environment)
        kit = compiled_kit(toolchain, environment)
    except UsageError as error:
        print(f"trundle: error: {error}", file=sys.stderr)
        return 1
    generated = kit.folder / "include"
    Headers({}, generated, generated, provided=kit.sources).write_included([Path(sources)])
    print(";".join(str(part) for part in (*kit, *([] if toolchain.boost is None else [toolchain.boost]))))
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
