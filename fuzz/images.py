"""Pictures: textures of meshes, heights of terrain, and maps."""

from pathlib import Path

from trundle.gazebo.nodes.map_server.occupancy_grid import read_cells
from trundle.robots.meshes import mean_color, png_of, read_heights
from trundle.sim.render import load_texture

from .seeds import picture
from .target import Open, Target, call_all, reads_file


def _textures(name: str) -> Open:
    def read(file: Path) -> None:
        mean_color(file)
        data = file.read_bytes()
        load_texture(data)
        png_of(data)

    return reads_file(name, read)


def _read_terrain(file: Path) -> None:
    """Read heights and the cells of a map."""
    call_all(lambda: read_heights(file), lambda: read_cells(file, negate=False, occupied=0.65, free=0.196))


TARGETS = {
    "png": Target(
        open=_textures("t.png"),
        seeds=lambda: [picture("PNG", mode) for mode in ("RGB", "RGBA", "L", "P", "1", "I;16")],
        words=(b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND", b"gAMA", b"zTXt", b"iCCP", b"acTL", b"fcTL"),
        corpus=("repos/**/*.png",),
    ),
    "jpeg": Target(
        open=_textures("t.jpg"),
        seeds=lambda: [picture("JPEG"), picture("JPEG", "L"), picture("JPEG", progressive=True)],
        words=(b"\xff\xd8", b"\xff\xc0", b"\xff\xc2", b"\xff\xda", b"\xff\xdb", b"\xff\xc4", b"\xff\xe1Exif\0\0",
        b"\xff\xd9"), corpus=("repos/**/*.jpg",),
    ),
    "tiff": Target(
        open=_textures("t.tif"),
        seeds=lambda: [
            picture("TIFF"), picture("TIFF", "L", compression="tiff_lzw"),
            picture("TIFF", compression="tiff_adobe_deflate"), picture("TIFF", "I;16"), picture("TIFF", "F"),
        ],
        words=(b"II*\0", b"MM\0*", b"II+\0", b"\x01\x01", b"\x53\x01", b"\x03\x01"),
    ),
    "dem": Target(
        open=reads_file("h.png", _read_terrain),
        seeds=lambda: [
            picture("PNG", "L"), picture("PNG", "I;16"), picture("TIFF", "F"), picture("TIFF", "I;16"),
            picture("PPM", "L"),
        ],
    ),
}  # fmt: skip
