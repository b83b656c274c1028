"""A world as MuJoCo's own XML: what is simulated, and what is seen."""

import hashlib
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from trundle.diagnostics import Diagnostics
from trundle.meshes import Mesh, mean_colour
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Rgba, Sphere, World, flattened
from trundle.spatial import Pose, upright

from .compile import Compiler
from .precise import in_full

if TYPE_CHECKING:  # an engine that steps needs no renderer
    from trundle.render import Scene, SceneLight, Shape

_VISUAL = 2
"""The geom group of what is seen and never touched, as MuJoCo's own robots have it."""
_THINNEST = 1e-4
"""[m] What a thickness of zero becomes."""
_FEWEST_VERTICES = 4
"""MuJoCo takes no mesh of fewer."""


def compile_mjcf(world: World, scene: "Scene", report: Diagnostics) -> str:
    """A world as MuJoCo's own XML, shapes of meshes inside, every number in full.

    Args:
        world: as read.
        scene: how the flattened world looks.
        report: takes what physics has to mend.

    Raises:
        DescriptionError: as `compile_world`.
    """
    world = flattened(world)
    compiler = Compiler(world, report)
    compiler.fill()
    _Looks(compiler, scene, report).add()
    compiler.compile_spec()
    return in_full(compiler.spec.to_xml(), compiler.spec)


class _Looks:
    """Adds visuals and lights to what is simulated."""

    def __init__(self, compiler: Compiler, scene: "Scene", report: Diagnostics) -> None:
        self._spec = compiler.spec
        self._scene = scene
        self._bodies = [compiler.bodies[name] for name in self._scene.bodies]
        self._at, self._report = compiler.world.at, report
        self._meshes: dict[bytes, str] = {}
        """By what the mesh is made of; one may be seen many times."""
        self._materials: dict[tuple[Rgba, float, float, float], str] = {}

    def add(self) -> None:
        """Add everything that is seen."""
        if any(shape.texture is not None for shape in self._scene.shapes):
            self._report.warn(self._at, "textures are not written to MJCF; each shape has its mean colour")
        for shape in self._scene.shapes:
            self._add_shape(shape)
        for number, light in enumerate(self._scene.lights):
            self._add_light(light, number)

    def _add_shape(self, shape: "Shape") -> None:
        pose = shape.body_from_shape
        if isinstance(shape.geometry, Plane):
            pose = pose @ Pose(quaternion=upright(shape.geometry.normal))
        geom = self._bodies[shape.body].add_geom(
            pos=pose.position, quat=pose.quaternion, group=_VISUAL, contype=0, conaffinity=0, mass=0.0
        )
        geom.material = self._material(shape)
        match shape.geometry:
            case Box((x, y, z)):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_BOX, [_thick(x) / 2, _thick(y) / 2, _thick(z) / 2]
            case Cylinder(radius, length):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CYLINDER, [_thick(radius), _thick(length) / 2, 0]
            case Capsule(radius, length):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CAPSULE, [_thick(radius), _thick(length) / 2, 0]
            case Sphere(radius):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [_thick(radius), 0, 0]
            case Ellipsoid((x, y, z)):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_ELLIPSOID, [_thick(x), _thick(y), _thick(z)]
            case Plane(_, (width, height)):
                geom.type, geom.size = mujoco.mjtGeom.mjGEOM_PLANE, [_thick(width) / 2, _thick(height) / 2, 1]
            case Mesh():
                geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, self._mesh(shape.geometry, shape.name)

    def _mesh(self, mesh: Mesh, name: str) -> str:
        key = hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).digest()
        if key not in self._meshes:
            self._meshes[key] = f"{name}#seen{len(self._meshes)}"
            vertices = mesh.vertices.astype(np.float64)
            missing = max(0, _FEWEST_VERTICES - len(vertices))
            vertices = np.concatenate([vertices, np.repeat(vertices[-1:], missing, axis=0)])
            self._spec.add_mesh(
                name=self._meshes[key],
                uservert=vertices.reshape(-1),
                userface=mesh.faces.reshape(-1),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,  # what is seen may be flat
            )
        return self._meshes[key]

    def _material(self, shape: "Shape") -> str:
        rgba = shape.rgba
        mean = None if shape.texture is None else mean_colour(shape.texture)
        if mean is not None:
            r, g, b, a = (value * by for value, by in zip(rgba, mean, strict=True))
            rgba = (r, g, b, a)
        brightest = max(*rgba[:3], 1e-9)
        look = (rgba, max(shape.specular[:3]), min(shape.shininess / 128, 1.0), max(shape.emissive[:3]) / brightest)
        if look not in self._materials:
            self._materials[look] = f"material{len(self._materials)}"
            rgba, specular, shininess, emission = look
            self._spec.add_material(
                name=self._materials[look], rgba=rgba, specular=specular, shininess=shininess, emission=emission
            )
        return self._materials[look]

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


def _thick(length: float) -> float:
    return max(length, _THINNEST)
