"""`trundle convert`: converts a description or a recorded run to another format."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal, TypeAlias

from msgspec.structs import replace

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import DescriptionError, Diagnostics, UsageError
from trundle.base.files import is_stream
from trundle.robots.description import LoadedDescription, UriOf, write_sdf, write_urdf, written_uri
from trundle.robots.load_input import load_input
from trundle.robots.meshes import Texture
from trundle.robots.model import flattened
from trundle.robots.packages import Packages
from trundle.sim.simulation import is_state_log
from trundle.spatial import rows_from_poses

from .file_copies import FileCopies

_DescriptionFormat: TypeAlias = Literal["sdf", "urdf", "mjcf", "glb"]
Format: TypeAlias = _DescriptionFormat | Literal["html"]
"""A recorded run is written as GLB or HTML."""


def convert(
    file: str,
    to: Format,
    environment: Mapping[str, str],
    report: Diagnostics,
    *,
    start: Path,
    output: Path | None = None,
) -> str | bytes:
    """Read a description and convert it.

    Args:
        file: path, folder with model.config, model://NAME, or "-" for standard input.
        to: output format.
        environment: environment variables that locate packages and models.
        report: collects findings of reading and writing.
        start: packages are searched around it too.
        output: path of the file to write, with copies of the meshes beside it; None: only return the content.

    Returns:
        The content: text, or the bytes of a GLB.

    Raises:
        DescriptionError: the file cannot be read, or not written in that format.
        UsageError: no such model, no such format of a recording, or the output cannot be written.
    """
    path = Path(file)
    if not is_stream(file) and path.is_file() and is_state_log(path):
        content = _convert_recording(path, to, report)
        if output is not None:
            write_atomically(output, content)
        return content
    if to == "html":
        raise UsageError(f"{file} is not a recording; for an HTML replay, record one with trundle run --record")
    loaded = load_input(file, report, packages=Packages(environment, start=start), start=start)
    if output is None:
        return _convert_description(loaded, to, written_uri, lambda _: None, report)
    copies = FileCopies(output, report)
    content = _convert_description(loaded, to, copies.relative_uri, copies.png_path, report)
    copies.copy()
    write_atomically(output, content)
    return content


def _convert_recording(file: Path, to: Format, report: Diagnostics) -> str | bytes:
    if to not in ("glb", "html"):
        raise UsageError(f"{file} is a recording; it is converted to glb or html")
    from trundle.page.replay.page_file import replay_page
    from trundle.page.replay.recorded_motion import animated_world, motion_of_log

    from .recorded_run import open_recording  # lazy: these modules import the physics, which only few formats need

    motion = motion_of_log(*open_recording(file, report), title=file.name)
    return replay_page(motion, report) if to == "html" else animated_world(motion, report)


def _convert_description(
    loaded: LoadedDescription,
    to: _DescriptionFormat,
    uri_of: UriOf,
    picture_of: Callable[[Texture], str | None],
    report: Diagnostics,
) -> str | bytes:
    match to:
        case "sdf":
            return write_sdf(loaded.world, is_world=loaded.kind == "world", uri_of=uri_of, report=report)
        case "mjcf":
            from trundle.sim.physics import compile_mjcf  # lazy: slow to load, and no other format needs it
            from trundle.sim.render import scene_from_world

            return compile_mjcf(
                loaded.world, scene_from_world(flattened(loaded.world), report), report, picture_of=picture_of
            )
        case "glb":
            return _glb(loaded, report)
        case "urdf" if loaded.urdf is not None:
            return loaded.urdf
        case "urdf":
            models = flattened(loaded.world).models
            if len(models) != 1:
                raise DescriptionError(
                    loaded.world.at, f"a URDF describes one robot, not {len(models)} models", "not-writable-urdf"
                )
            return write_urdf(models[0], uri_of=uri_of, report=report)


def _glb(loaded: LoadedDescription, report: Diagnostics) -> bytes:
    """Return the visuals with joints at zero; a model outside a world has only its own lights."""
    from trundle.sim.gltf import glb_from_scene
    from trundle.sim.render import DEFAULT_LIGHTS, report_unreadable_textures, scene_from_world
    from trundle.sim.simulation import with_actors

    world = flattened(with_actors(loaded.world, report))
    scene = scene_from_world(world, report)
    if loaded.kind == "world":
        scene = replace(scene, lights=scene.lights or DEFAULT_LIGHTS)
    report_unreadable_textures(scene, report)
    poses = [
        model.world_from_model @ (link.initial_pose or link.model_from_link)
        for model in world.models
        for link in model.links
    ]
    return glb_from_scene(scene, rows_from_poses(poses))
