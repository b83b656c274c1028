"""Pictures of rviz and the page side by side, for docs/rviz: python docs/generate/rviz_pairs.py.

They need Debian's rviz, so they are committed, and regenerated when the displays change: first
`pytest tests/page/test_rviz_pictures.py`, which writes out/rviz_pictures.
"""

import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[2]
PAIRS = {
    "Scene.png": "scene.webp",
    "PointCloud2 of many as Spheres.png": "cloud.webp",
    "InteractiveMarkers of axes and a turn.png": "handles.webp",
}
"""File of the test → file of the docs."""
_WIDTH_PX = 1200
_MAX_BYTES = 60_000


def main() -> int:
    target = ROOT / "docs/rviz"
    target.mkdir(exist_ok=True)
    for source, name in PAIRS.items():
        path = ROOT / "out/rviz_pictures" / source
        if not path.exists():
            print(
                f"{path.relative_to(ROOT)} does not exist; run pytest tests/page/test_rviz_pictures.py", file=sys.stderr
            )
            return 1
        with Image.open(path) as pair:
            small = pair.resize((_WIDTH_PX, pair.height * _WIDTH_PX // pair.width), Image.Resampling.LANCZOS)
        small.save(target / name, quality=80, method=6)
        assert (target / name).stat().st_size <= _MAX_BYTES, f"{name} is too large"
    return 0


if __name__ == "__main__":
    sys.exit(main())
