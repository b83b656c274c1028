"""Videos of a simulation."""

import os
from pathlib import Path

import numpy as np

from trundle.app.picture.render import PictureOptions, PictureRenderer
from trundle.app.picture.video import simulated_frames
from trundle.base.diagnostics import Diagnostics

WORLD = """<sdf version="1.6"><world name="w">
<model name="m"><link name="arm"><pose>0 0 1 0 0 0</pose><inertial><pose>0.5 0 0 0 0 0</pose></inertial>
<visual name="v"><pose>0.5 0 0 0 0 0</pose><geometry><box><size>1 0.05 0.05</size></box></geometry></visual></link>
<joint name="hinge" type="revolute"><parent>world</parent><child>arm</child><axis><xyz>0 1 0</xyz></axis></joint>
</model>
<model name="lost"><pose>0 0 1 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>0.05 0.05 0.05</size></box></geometry></visual></link></model></world></sdf>"""


def test_the_view_contains_a_pendulum_that_swings_but_not_what_falls_out_of_the_world(tmp_path: Path) -> None:
    """The arm starts level, and swings a metre below; the box falls by 20 m."""
    (tmp_path / "w.sdf").write_text(WORLD)
    options = PictureOptions(size=(64, 64))
    renderer = PictureRenderer(str(tmp_path / "w.sdf"), os.environ, Diagnostics(), start=tmp_path, options=options)

    frames = [np.asarray(frame) for frame in simulated_frames(renderer, 2.0)]

    arms = [(np.abs(frame.astype(int) - frame[0, 0]).max(axis=-1) > 8) for frame in frames]
    edges = [np.concatenate([arm[0], arm[:, 0], arm[:, -1]]) for arm in arms]
    assert not any(edge.any() for edge in edges)
    assert min(arm.sum() for arm in arms) > 5
    heights = [np.flatnonzero(arm.any(axis=1)).max() for arm in arms[20:]]
    assert max(heights) - min(heights) > 10, "it swings"
