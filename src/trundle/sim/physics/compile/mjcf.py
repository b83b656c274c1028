"""Export of a world as MJCF, with physics and visuals."""

import hashlib
import warnings
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, TypeAlias
from xml.etree import ElementTree as Xml

import mujoco
import numpy as np

from trundle.base.diagnostics import Diagnostics
from trundle.robots.meshes import Mesh, Texture, mean_color
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Rgba, Sphere, World, flattened
from trundle.spatial import Pose, rotation_from_z

from .body_batches import ignore_attach_warning
from .compiler import Compiler
from .mjcf_precision import with_full_precision

if TYPE_CHECKING:  # an engine that steps needs no renderer
    from trundle.sim.render import Scene, SceneLight, Shape

_VISUAL = 2
"""Geom group of visuals, as in MuJoCo's own robots."""
_THINNEST = 1e-4
"""Smallest thickness of a visual [m]."""
_FEWEST_VERTICES = 4
"""Minimum number of vertices of a MuJoCo mesh."""
PictureOf: TypeAlias = Callable[[Texture], str | None]
"""Returns the path of a texture as PNG, relative to the MJCF; None: not available."""


def compile_mjcf(world: World, scene: "Scene", report: Diagnostics, *, picture_of: PictureOf = lambda _: None) -> str:
    """Return a world as MJCF, with inline meshes and full precision.

    Args:
        world: world, nested models allowed.
        scene: visuals of the flattened world.
        report: receives the warnings of the compile.
        picture_of: returns the texture files of meshes.

    Raises:
        DescriptionError: as `compile_world`.
    """
    world = flattened(world)
    compiler = Compiler(world, report)
    compiler.fill()
    visuals = _VisualWriter(compiler, scene, report, picture_of)
    visuals.add()
    compiler.compile_spec()
    for name in compiler.refused_moments:
        report.warn(
            world.at,
            f"body {name!r}: MJCF allows no moments that violate the triangle inequality; they are raised in it",
            "not-in-mjcf",
        )
    with warnings.catch_warnings():
        ignore_attach_warning()
        xml = compiler.spec.to_xml()
    return _with_pictures(with_full_precision(xml, compiler.spec), visuals.pictures)


def _with_pictures(xml: str, pictures: Mapping[str, str]) -> str:
    """Add textures to materials; MuJoCo would open the files before they exist.

    Args:
        xml: MJCF without textures.
        pictures: material → image file.
    """
    if not pictures:
        return xml
    root = Xml.fromstring(xml)
    names = {file: f"picture{number}" for number, file in enumerate(dict.fromkeys(pictures.values()))}
    assets = root.find("asset")
    assert assets is not None
    for material in assets.findall("material"):
        if (file := pictures.get(material.get("name", ""))) is not None:
            material.set("texture", names[file])
    for file, name in names.items():
        assets.insert(0, Xml.Element("texture", type="2d", name=name, file=file))
    return Xml.tostring(root, encoding="unicode") + "\n"


class _VisualWriter:
    """Adds visuals and lights to a specification."""

    def __init__(self, compiler: Compiler, scene: "Scene", report: Diagnostics, picture_of: PictureOf) -> None:
        self._spec = compiler.spec
        self._scene = scene
        self._bodies = [compiler.bodies[name] for name in self._scene.bodies]
        self._at, self._report = compiler.world.at, report
        self._meshes: dict[bytes, str] = {}
        """Mesh data digest → name, so that equal meshes are written once."""
        self._materials: dict[tuple[Rgba, float, float, float, str | None], str] = {}
        self._picture_of = picture_of
        self.pictures: dict[str, str] = {}
        """Material → image file."""

    def add(self) -> None:
        """Add all visuals and lights."""
        if any(shape.texture is not None and self._picture(shape) is None for shape in self._scene.shapes):
            self._report.warn(
                self._at,
                "textures are written to MJCF with -o only, and of meshes only; other shapes have mean colors",
                "not-in-mjcf",
            )
        for shape in self._scene.shapes:
            self._add_shape(shape)
        for number, light in enumerate(self._scene.lights):
            self._add_light(light, number)

    def _picture(self, shape: "Shape") -> str | None:
        painted = isinstance(shape.geometry, Mesh) and shape.geometry.uv is not None and shape.texture is not None
        return self._picture_of(shape.texture) if painted and shape.texture is not None else None

    def _add_shape(self, shape: "Shape") -> None:
        pose = shape.body_from_shape
        if isinstance(shape.geometry, Plane):
            pose = pose @ Pose(quaternion=rotation_from_z(shape.geometry.normal))
        geom = self._bodies[shape.body].add_geom(
            pos=pose.position, quat=pose.quaternion, group=_VISUAL, contype=0, conaffinity=0, mass=0.0
        )
        geom.material = self._material(shape)
        match shape.geometry:
            case Box((x, y, z)):
                geom.type, geom.size = (
                    mujoco.mjtGeom.mjGEOM_BOX,
                    [_thickness(x) / 2, _thickness(y) / 2, _thickness(z) / 2],
                )
            case Cylinder(radius, length):
                geom.type, geom.size = (
                    mujoco.mjtGeom.mjGEOM_CYLINDER,
                    [_thickness(radius), _thickness(length) / 2, 0],
                )
            case Capsule(radius, length):
                geom.type, geom.size = (
                    mujoco.mjtGeom.mjGEOM_CAPSULE,
                    [_thickness(radius), _thickness(length) / 2, 0],
                )
            case Sphere(radius):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [_thickness(radius), 0, 0]
            case Ellipsoid((x, y, z)):
                geom.type, geom.size = (
                    mujoco.mjtGeom.mjGEOM_ELLIPSOID,
                    [_thickness(x), _thickness(y), _thickness(z)],
                )
            case Plane(_, (width, height)):
                geom.type, geom.size = (
                    mujoco.mjtGeom.mjGEOM_PLANE,
                    [_thickness(width) / 2, _thickness(height) / 2, 1],
                )
            case Mesh():
                geom.type, geom.meshname = (
                    mujoco.mjtGeom.mjGEOM_MESH,
                    self._mesh(shape.geometry, shape.name, is_painted=self._picture(shape) is not None),
                )

    def _mesh(self, mesh: Mesh, name: str, *, is_painted: bool) -> str:
        uv = mesh.uv if is_painted else None
        if uv is not None:  # a vertex per face corner
            corners = np.arange(mesh.faces.size, dtype=np.int32).reshape(mesh.faces.shape)
            mesh = Mesh(mesh.vertices[mesh.faces].reshape(-1, 3), corners)
        key = hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).digest()
        if uv is not None:
            key += hashlib.sha256(uv.tobytes()).digest()
        if key not in self._meshes:
            self._meshes[key] = f"{name}#seen{len(self._meshes)}"
            vertices = mesh.vertices.astype(np.float64)
            missing = max(0, _FEWEST_VERTICES - len(vertices))
            vertices = np.concatenate([vertices, np.repeat(vertices[-1:], missing, axis=0)])
            added = self._spec.add_mesh(
                name=self._meshes[key],
                uservert=vertices.reshape(-1),
                userface=mesh.faces.reshape(-1),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,  # visuals may be flat
            )
            if uv is not None:
                down = uv.reshape(-1, 2) * np.array([1, -1], np.float32) + np.array(
                    [0, 1], np.float32
                )  # MuJoCo's v is down
                added.usertexcoord = np.concatenate([down, np.zeros((missing, 2), np.float32)]).reshape(-1)
        return self._meshes[key]

    def _material(self, shape: "Shape") -> str:
        rgba, picture = shape.rgba, self._picture(shape)
        mean = None if shape.texture is None or picture is not None else mean_color(shape.texture)
        if mean is not None:
            r, g, b, a = (value * factor for value, factor in zip(rgba, mean, strict=True))
            rgba = (r, g, b, a)
        brightest = max(*rgba[:3], 1e-9)
        shininess, emission = min(shape.shininess / 128, 1.0), max(shape.emissive[:3]) / brightest
        key = (rgba, max(shape.specular[:3]), shininess, emission, picture)
        if key not in self._materials:
            self._materials[key] = f"material{len(self._materials)}"
            self._spec.add_material(
                name=self._materials[key], rgba=rgba, specular=key[1], shininess=shininess, emission=emission
            )
            if picture is not None:
                self.pictures[self._materials[key]] = picture
        return self._materials[key]

    def _add_light(self, light: "SceneLight", number: int) -> None:
        body = self._spec.worldbody if light.body is None else self._bodies[light.body]
        kinds = {
            "directional": mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            "point": mujoco.mjtLightType.mjLIGHT_POINT,
            "spot": mujoco.mjtLightType.mjLIGHT_SPOT,
        }
        body.add_light(
            name=f"light{number}",
            type=kinds[light.kind],
            pos=light.position,
            dir=light.direction,
            diffuse=light.diffuse[:3],
            specular=light.specular[:3],
            attenuation=light.attenuation,
            cutoff=float(np.clip(np.degrees(light.outer_angle_rad) / 2, 0.0, 90.0)),
            castshadow=light.casts_shadows,
        )


def _thickness(length: float) -> float:
    return max(length, _THINNEST)
