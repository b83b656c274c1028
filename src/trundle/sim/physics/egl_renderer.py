"""MuJoCo's OpenGL renderer behind `Renderer`, for machines with a GPU and for comparison with the native one."""

from collections.abc import Sequence
from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.render import Intrinsics, Picture, Scene, SceneLight, Shape, size_of
from trundle.spatial import Pose, rotation_from_z

_NOWHERE = (0.0, 0.0, -1e6)
"""Position of a body without a pose [m]."""
_SHININESS = 128.0
"""OpenGL's largest exponent; MuJoCo's shininess is relative to it."""
_THINNEST = 1e-4
_LIGHTS = {
    "directional": mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
    "point": mujoco.mjtLightType.mjLIGHT_POINT,
    "spot": mujoco.mjtLightType.mjLIGHT_SPOT,
}
_SHADED_M, _SHADOW_PX = 20.0, 4096
"""MuJoCo's single shadow map has a pixel per centimetre."""
_DEFAULT_LIGHTS = (SceneLight(direction=(-0.3, 0.5, -0.8)),)


class EglRenderer:
    """`Renderer` with OpenGL over EGL; without textures, fog and ambient colors of materials."""

    def __init__(self, scene: Scene, *, shadow_radius_m: float = _SHADED_M, shadow_px: int = _SHADOW_PX) -> None:
        """Load a scene into MuJoCo.

        Args:
            scene: scene to draw.
            shadow_radius_m: radius of shadows around a directional light's position [m].
            shadow_px: width and height of the shadow map [pixels].

        Raises:
            UsageError: no EGL on this machine, or its package is missing.
        """
        self._context = _make_context()
        self._background = np.array([round(255 * value) for value in scene.background[:3]], dtype=np.uint8)
        self._model = model_from_scene(scene)
        self._model.vis.map.shadowclip = shadow_radius_m
        self._model.vis.quality.shadowsize = shadow_px
        self._data = mujoco.MjData(self._model)
        names = [self._model.geom(i).name for i in range(self._model.ngeom)]
        self._shape_of_geom = np.array([*(int(name[1:]) for name in names), -1], dtype=np.int32)
        self._mocaps = [int(self._model.body(f"b{i}").mocapid[0]) for i in range(len(scene.bodies))]
        self._drawn = mujoco.MjvScene(self._model, maxgeom=self._model.ngeom + 10)
        flags = self._drawn.flags
        flags[mujoco.mjtRndFlag.mjRND_SHADOW] = any(light.casts_shadows for light in scene.lights)
        for flag in (mujoco.mjtRndFlag.mjRND_REFLECTION, mujoco.mjtRndFlag.mjRND_SKYBOX, mujoco.mjtRndFlag.mjRND_HAZE):
            flags[flag] = False
        self._gl = mujoco.MjrContext(self._model, mujoco.mjtFontScale.mjFONTSCALE_100)
        self._gl.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._gl)

    def update(self, poses: NDArray[np.float64]) -> None:
        """See `Renderer.update`."""
        for mocap, pose in zip(self._mocaps, poses, strict=True):
            has_pose = bool(np.isfinite(pose).all())
            self._data.mocap_pos[mocap] = pose[:3] if has_pose else _NOWHERE
            self._data.mocap_quat[mocap] = pose[3:] if has_pose else (1.0, 0.0, 0.0, 0.0)
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)

    def set_vertices(self, shape: int, vertices: NDArray[np.float32]) -> None:
        """See `Renderer.set_vertices`; the normals stay unchanged."""
        mesh = int(self._model.geom(f"s{shape}").dataid[0])
        first, count = int(self._model.mesh_vertadr[mesh]), int(self._model.mesh_vertnum[mesh])
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, self._model.mesh_quat[mesh])
        # MuJoCo keeps vertices in the mesh's principal frame.
        self._model.mesh_vert[first : first + count] = (vertices - self._model.mesh_pos[mesh]) @ rotation.reshape(3, 3)
        self._context.make_current()
        mujoco.mjr_uploadMesh(self._model, self._gl, mesh)

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        """See `Renderer.render`."""
        self._context.make_current()
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(
            self._model, self._data, mujoco.MjvOption(), None, mujoco.MjvCamera(), everything, self._drawn
        )
        height, width = size_of(views)
        if (self._gl.offWidth, self._gl.offHeight) != (width, height):
            mujoco.mjr_resizeOffscreen(width, height, self._gl)
        return [self._draw(eye, lens, depth=depth, segmentation=segmentation) for eye, lens in views]

    def _draw(self, world_from_camera: Pose, intrinsics: Intrinsics, *, depth: bool, segmentation: bool) -> Picture:
        width, height = intrinsics.width_px, intrinsics.height_px
        near = intrinsics.near_m
        for camera in self._drawn.camera:
            camera.pos = world_from_camera.position
            camera.forward = world_from_camera.transform_vector((1.0, 0.0, 0.0))
            camera.up = world_from_camera.transform_vector((0.0, 0.0, 1.0))
            camera.frustum_center, camera.frustum_width = 0.0, near * width / 2.0 / intrinsics.focal_px
            camera.frustum_top = near * height / 2.0 / intrinsics.focal_px
            camera.frustum_bottom = -camera.frustum_top
            camera.frustum_near, camera.frustum_far = near, intrinsics.far_m
        viewport = mujoco.MjrRect(0, 0, width, height)
        rgb = np.empty((height, width, 3), dtype=np.uint8)
        z_buffer = np.empty((height, width), dtype=np.float32)
        mujoco.mjr_render(viewport, self._drawn, self._gl)
        mujoco.mjr_readPixels(rgb, z_buffer, viewport, self._gl)
        is_background = z_buffer <= 0.0
        rgb[is_background] = self._background
        depths = segments = None
        if depth:
            closest, farthest = np.float32(1.0 / near), np.float32(1.0 / intrinsics.far_m)
            depths = np.float32(1.0) / (z_buffer * (closest - farthest) + farthest)
            depths[is_background] = np.inf
            depths = np.ascontiguousarray(depths[::-1])
        if segmentation:
            segments = self._segments(viewport)
        return Picture(np.ascontiguousarray(rgb[::-1]), depths, segments)

    def _segments(self, viewport: mujoco.MjrRect) -> NDArray[np.int32]:
        flags = self._drawn.flags
        segment_flags = (mujoco.mjtRndFlag.mjRND_SEGMENT, mujoco.mjtRndFlag.mjRND_IDCOLOR)
        for flag in segment_flags:
            flags[flag] = True
        ids = np.empty((viewport.height, viewport.width, 3), dtype=np.uint8)
        mujoco.mjr_render(viewport, self._drawn, self._gl)
        mujoco.mjr_readPixels(ids, None, viewport, self._gl)
        for flag in segment_flags:
            flags[flag] = False
        geoms = np.full(self._drawn.ngeom + 1, -1, dtype=np.int32)
        for geom in self._drawn.geoms[: self._drawn.ngeom]:
            geoms[geom.segid + 1] = self._shape_of_geom[geom.objid]
        numbers = ids.astype(np.int32) @ np.array([1, 256, 65536], dtype=np.int32)
        return np.ascontiguousarray(geoms[numbers][::-1])


def model_from_scene(scene: Scene) -> mujoco.MjModel:
    """Return a scene as a model for rendering only: bodies `b0`, `b1`, … are mocap bodies."""
    spec = mujoco.MjSpec()
    spec.visual.quality.offsamples = 0
    spec.visual.headlight.ambient = scene.ambient[:3]
    spec.visual.headlight.diffuse = spec.visual.headlight.specular = (0.0, 0.0, 0.0)
    spec.stat.extent = 1.0
    bodies = [spec.worldbody.add_body(name=f"b{i}", mocap=True) for i in range(len(scene.bodies))]
    meshes: dict[int, str] = {}
    for number, shape in enumerate(scene.shapes):
        _add_shape(spec, bodies[shape.body], shape, f"s{number}", meshes)
    for light in scene.lights or _DEFAULT_LIGHTS:
        _add_light(spec.worldbody if light.body is None else bodies[light.body], light)
    return spec.compile()


class _Context(Protocol):
    def make_current(self) -> None: ...


def _make_context() -> _Context:
    try:
        from mujoco.egl import GLContext

        context = GLContext(64, 64)
        context.make_current()
    except (ImportError, AttributeError, RuntimeError, OSError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        if isinstance(error, AttributeError):  # PyOpenGL's error for a missing library
            reason = "libEGL cannot be loaded"
        remedy = "pip install 'trundle[egl]' and a driver provide it; --renderer cpu works without"
        raise UsageError(f"no OpenGL over EGL here ({reason}); {remedy}") from None
    return context


def _add_light(body: mujoco.MjsBody, light: SceneLight) -> None:
    constant, linear, quadratic = light.attenuation
    body.add_light(
        type=_LIGHTS[light.kind],
        pos=light.position,
        dir=light.direction,
        ambient=(0.0, 0.0, 0.0),
        diffuse=light.diffuse[:3],
        specular=light.specular[:3],
        attenuation=(constant, linear, quadratic),
        cutoff=min(np.degrees(light.outer_angle_rad) / 2.0, 90.0),
        exponent=light.falloff,
        castshadow=light.casts_shadows,
    )


def _add_shape(spec: mujoco.MjSpec, body: mujoco.MjsBody, shape: Shape, name: str, meshes: dict[int, str]) -> None:
    kinds, pose, size, mesh = mujoco.mjtGeom, shape.body_from_shape, (0.0, 0.0, 0.0), ""
    match shape.geometry:
        case Box((x, y, z)):
            kind, size = kinds.mjGEOM_BOX, (x / 2, y / 2, z / 2)
        case Cylinder(radius, length):
            kind, size = kinds.mjGEOM_CYLINDER, (radius, length / 2, 0.0)
        case Capsule(radius, length):
            kind, size = kinds.mjGEOM_CAPSULE, (radius, length / 2, 0.0)
        case Sphere(radius):
            kind, size = kinds.mjGEOM_SPHERE, (radius, 0.0, 0.0)
        case Ellipsoid(radii):
            kind, size = kinds.mjGEOM_ELLIPSOID, radii
        case Plane(normal, (width, height)):
            kind, size = kinds.mjGEOM_PLANE, (width / 2, height / 2, 1.0)
            pose = pose @ Pose(quaternion=rotation_from_z(normal))
        case Mesh(vertices, faces):
            kind = kinds.mjGEOM_MESH
            mesh = meshes.get(id(shape.geometry), "")
            if not mesh:
                mesh = meshes[id(shape.geometry)] = f"m{len(meshes)}"
                flat = vertices.astype(float).reshape(-1)
                # Shell inertia, as its volume may be zero.
                inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
                spec.add_mesh(name=mesh, uservert=flat, userface=faces.reshape(-1), inertia=inertia)
    material = spec.add_material(
        name=name,
        rgba=shape.rgba,
        specular=max(shape.specular[:3]),
        shininess=shape.shininess / _SHININESS,
        emission=max(shape.emissive[:3]),
    )
    geom = body.add_geom(
        name=name, pos=pose.position, quat=pose.quaternion, contype=0, conaffinity=0, material=material.name
    )
    geom.type = kind
    if mesh:
        geom.meshname = mesh
    else:
        geom.size = [side if kind == kinds.mjGEOM_PLANE else max(side, _THINNEST) for side in size]
