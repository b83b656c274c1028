"""Pictures of runs at their end."""

import base64
import io
from contextlib import suppress

import numpy as np
from msgspec.structs import replace
from PIL import Image

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.sim.render import Intrinsics, scene_from_world, update_skins
from trundle.sim.renderers import RENDERERS
from trundle.sim.three_quarter_view import BACKDROP, FIELD_OF_VIEW, STUDIO_LIGHT, scene_corners, three_quarter_pose
from trundle.spatial import NS_PER_S

from .plan import Plan
from .row_runner import RowRunner
from .rows import Row

_SIZE = (480, 320)
_SAMPLES = 2
"""Supersampling per axis, for antialiasing."""


def end_picture(plan: Plan, runner: RowRunner, row: Row) -> str | None:
    """Run a row again and return a picture of its end as a data URI; None if nothing is visible.

    The view also contains its start.
    """
    try:
        with runner.start(row) as run:
            simulation = run.simulation
            start = simulation.snapshot().poses
            with suppress(TrundleError):  # the physics is unstable: the picture shows the last good state
                run.advance(round(plan.duration_s * NS_PER_S))
            scene = scene_from_world(simulation.world, Diagnostics())
            scene = replace(scene, ambient=STUDIO_LIGHT, background=BACKDROP)
            if not scene.shapes:
                return None
            renderer = RENDERERS["cpu"](scene)
            poses = simulation.snapshot().poses
            renderer.update(poses)
            update_skins(renderer, scene, simulation.animation_state)
            width, height = (side * _SAMPLES for side in _SIZE)
            lens = Intrinsics(
                width_px=width, height_px=height, horizontal_fov_rad=FIELD_OF_VIEW, near_m=0.01, far_m=1000.0
            )
            corners = np.concatenate([scene_corners(scene, state) for state in (start, poses)])
            eye = three_quarter_pose(corners, lens)
            picture = renderer.render([(eye, lens)], depth=False, segmentation=False)[0]
    except TrundleError:
        return None
    file = io.BytesIO()
    Image.fromarray(picture.rgb).resize(_SIZE, Image.Resampling.BOX).save(file, "PNG", optimize=True)
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}"
