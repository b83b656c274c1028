"""Scenes with stored pictures; run as a program, it prints their hashes."""

import hashlib
import math

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Fog, Plane, Rgba, Sphere
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, SceneLight, Shape, ShapeGeometry
from trundle.spatial import Pose

LENS = Intrinsics(width_px=200, height_px=150, horizontal_fov_rad=1.0)
EYE = Pose.from_rpy(-4.0, -0.5, 2.0, 0.0, 0.35, 0.1)
SUN = SceneLight(direction=(0.53, -0.27, -0.8), specular=(0.6, 0.6, 0.6, 1.0), casts_shadows=True)
LAMP = SceneLight(kind="point", position=(0.0, 1.5, 1.5), diffuse=(1.0, 0.7, 0.3, 1.0), attenuation=(0.2, 0.1, 0.1))
SPOT = SceneLight(
    kind="spot", position=(-1.0, -2.0, 3.0), direction=(0.27, 0.53, -0.8), outer_angle_rad=0.7, casts_shadows=True
)


def torus(rings: int = 24, sides: int = 12) -> Mesh:
    """Torus with radii of 0.4 m and 0.15 m."""
    around, along = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    # Rounded: the sines of different C libraries differ in their last bits.
    a = np.round(np.exp(2j * math.pi * around / rings), 6)
    b = np.round(np.exp(2j * math.pi * along / sides), 6)
    radius = 0.4 + 0.15 * b.real
    vertices = np.stack([radius * a.real, radius * a.imag, 0.15 * b.imag], axis=-1).reshape(-1, 3)
    corner = lambda i, j: (i % rings) * sides + j % sides  # noqa: E731
    faces = [
        triangle
        for i in range(rings)
        for j in range(sides)
        for triangle in (
            (corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)),
            (corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)),
        )
    ]
    return Mesh(vertices.astype(np.float32), np.array(faces, dtype=np.int32))


def shape(geometry: ShapeGeometry, x: float, y: float, z: float, rgba: Rgba, turn: float = 0.0) -> Shape:
    """One shape."""
    return Shape(
        name="s",
        body=0,
        geometry=geometry,
        body_from_shape=Pose.from_rpy(x, y, z, turn, turn / 2, 0.0),
        rgba=rgba,
        specular=(0.5, 0.5, 0.5, 1.0),
    )


SHAPES = (
    Shape(name="ground", body=0, geometry=Plane((0.0, 0.0, 1.0), (0.0, 0.0)), rgba=(0.7, 0.7, 0.6, 1.0)),
    shape(Box((0.5, 0.6, 0.7)), 0.0, 1.2, 0.35, (0.9, 0.2, 0.2, 1.0)),
    shape(Sphere(0.4), 0.8, 0.4, 0.4, (0.2, 0.8, 0.3, 1.0)),
    shape(Cylinder(0.25, 0.9), 0.2, -0.4, 0.45, (0.2, 0.3, 0.9, 1.0)),
    shape(Capsule(0.15, 0.5), -0.9, 0.4, 0.3, (0.9, 0.8, 0.2, 1.0), 1.0),
    shape(Ellipsoid((0.5, 0.2, 0.3)), -0.8, -0.8, 0.3, (0.7, 0.2, 0.8, 1.0), 0.4),
    shape(torus(), 0.6, -1.4, 0.5, (0.3, 0.7, 0.8, 1.0), 0.8),
    shape(Box((0.05, 1.0, 0.6)), -1.4, 0.2, 0.3, (0.4, 0.9, 0.9, 0.4)),
)
SCENES = {
    "sun": Scene(bodies=("b",), shapes=SHAPES, lights=(SUN,), ambient=(0.3, 0.3, 0.35, 1.0)),
    "lamps": Scene(
        bodies=("b",),
        shapes=SHAPES,
        lights=(LAMP, SPOT),
        sky=((0.9, 0.9, 0.9, 1.0), (0.2, 0.4, 0.8, 1.0)),
        fog=Fog(type="exponential", density=0.05, color=(0.9, 0.9, 0.9, 1.0)),
    ),
}


SEVERAL = [(Pose.from_rpy(-4.0, -0.5, 2.0, 0.1 * i, 0.35, 0.1 * i), replace(LENS, far_m=20.0 - i)) for i in range(5)]


def ready(name: str, *, threads: int = 1) -> NativeRenderer:
    """A renderer of one of the scenes."""
    renderer = NativeRenderer(SCENES[name], threads=threads)
    renderer.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    return renderer


def draw(name: str, *, threads: int = 1) -> NDArray[np.uint8]:
    """One of the scenes."""
    (picture,) = ready(name, threads=threads).render([(EYE, LENS)])
    return picture.rgb


def scan() -> bytes:
    """Ranges and labels of rays all around in the first scene."""
    renderer = NativeRenderer(SCENES["sun"])
    renderer.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    directions = np.random.default_rng(1).normal(size=(20_001, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    ranges, shapes = renderer.cast(EYE, directions, max_range_m=100.0)
    return ranges.tobytes() + shapes.tobytes()


if __name__ == "__main__":
    for name in SCENES:
        print(name, hashlib.sha256(draw(name).tobytes()).hexdigest())
    print("rays", hashlib.sha256(scan()).hexdigest())
