"""Pictures and videos of the site, rendered by Trundle."""

import subprocess
import sys
from pathlib import Path

PICTURES: dict[str, tuple[str, ...]] = {
    "rp2w.mp4": ("model://rp2w", "--size", "360x360", "--orbit"),
    "rp2w.png": ("model://rp2w", "--size", "640x480"),
    "rp2w_camera.png": ("rp2w_at_home.world", "--camera", "my_sensor"),
    "rp2w_at_home.png": ("rp2w_at_home.world", "--size", "960x540"),
    "rp2w_seg.png": ("rp2w_at_home.world", "--seg", "--size", "640x360"),
    "smartcar.png": ("package://smartcar/urdf/smartcar.urdf.xacro", "--size", "640x480"),
    "stack.png": ("physics/stack.world", "--size", "480x360"),
    "pendulum.mp4": ("physics/double_pendulum.world", "--size", "320x320", "--duration", "5"),
}
"""File → arguments of `trundle render`."""


def draw_all(folder: Path) -> dict[str, Path]:
    """Render missing pictures; `make clean` removes existing ones."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, words in PICTURES.items():
        if not (folder / name).exists():
            draw(words, folder / name)
    return {name: folder / name for name in PICTURES}


def draw(words: tuple[str, ...], to: Path) -> None:
    """Render one picture; leave no partial file."""
    part = to.with_name(f"part_{to.name}")
    subprocess.run([sys.executable, "-m", "trundle", "render", *words, "-o", str(part)], check=True)
    part.rename(to)
