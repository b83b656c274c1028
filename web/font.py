"""Makes the page's font again: `pip install fonttools brotli`, then `python web/font.py`.

It is Inter as npm brings it, in Latin, with the weights and the features that the page uses.
"""

import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from npm import npm

FONTS = Path(__file__).resolve().parent / "src" / "theme" / "fonts"
PACKAGE = "@fontsource-variable/inter@5.3.0"
FILE = "package/files/inter-latin-wght-normal.woff2"
WEIGHTS = "wght=400:700"
FEATURES = "kern,mark,mkmk,ccmp,locl,calt,tnum,case"


def main() -> int:
    """Write inter.woff2 and its licence; return an exit code."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if npm("pack", PACKAGE, "--pack-destination", name, "--silent") != 0:
            return 1
        with tarfile.open(next(folder.glob("*.tgz"))) as package:
            package.extractall(folder, filter="data")
        limited = folder / "limited.ttf"
        fonttools = [sys.executable, "-m", "fontTools"]
        subprocess.run([*fonttools, "varLib.instancer", folder / FILE, WEIGHTS, "-o", limited], check=True)
        options = ["--unicodes=*", f"--layout-features={FEATURES}", "--flavor=woff2"]
        output = f"--output-file={FONTS / 'inter.woff2'}"
        subprocess.run([*fonttools, "subset", limited, *options, output], check=True)
        (FONTS / "inter.txt").write_bytes((folder / "package/LICENSE").read_bytes())
    return 0


if __name__ == "__main__":
    sys.exit(main())
