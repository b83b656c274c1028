"""Plans of datasets, and errors of wrong ones."""

from pathlib import Path

import numpy as np
import pytest

from trundle.base.diagnostics import DescriptionError
from trundle.studies.datasets import read_dataset_plan

PLAN = """\
world: table.world
count: 4
camera:
  orbit: {distance: {uniform: [1, 2]}}
objects:
  cup:
    model: cup.sdf
    surface: table
    count: {uniform: [1, 3]}
    color: any
    key_points: {rim: [0, 0, 0.1]}
  robot: {joints: any}
distractors: {count: [0, 2], size: 0.1, surface: table}
lights:
  sun: {intensity: {uniform: [0.5, 1]}}
"""


def test_keys_that_a_plan_omits_have_defaults(tmp_path: Path) -> None:
    plan = read_dataset_plan(PLAN, file="plan.yaml", folder=tmp_path)

    assert (plan.width_px, plan.height_px, plan.samples, plan.formats) == (640, 480, 2, ("coco",))
    assert plan.categories == ("cup", "robot")
    assert plan.objects[0].count.largest == 3
    assert plan.objects[1].joints == "any"
    assert plan.apart
    assert plan.lights[0].kind is None


@pytest.mark.parametrize(
    ("changed", "by", "message"),
    [
        ("count: 4", "cuont: 4", "plan.yaml:2: error: a plan has no 'cuont'; it has: world, count, seed,"),
        ("count: 4", "count: 0", "plan.yaml:2: error: count must be a whole number of at least 1, not 0"),
        ("count: 4", "count: 4\nformats: [coco, voc]", "plan.yaml:3: error: there is no format 'voc'; formats: coco,"),
        ("count: 4", "count: 4\nsize: [640]", "plan.yaml:3: error: size must be [width, height] in pixels"),
        ("orbit: {distance", "orbit: {radius", "plan.yaml:4: error: orbit has no 'radius'; it has: center, distance,"),
        ("uniform: [1, 2]", "uniform: [2, 1]", "plan.yaml:4: error: uniform: needs low < high, not [2, 1]"),
        ("uniform: [1, 2]", "uniform: [-1, 2]", "plan.yaml:4: error: distance must be between 0.001 and 1e+06, not -1"),
        (
            "model: cup.sdf",
            "moddel: cup.sdf",
            "plan.yaml:7: error: object cup has no 'moddel'; it has: model, category,",
        ),
        ("    model: cup.sdf\n", "", "plan.yaml:8: error: object cup: `count` is of what `model: FILE` adds;"),
        ("color: any", "color: [1, 2, 0]", "plan.yaml:10: error: color must be any, [red, green, blue] of 0 to 1,"),
        ("rim: [0, 0, 0.1]", "rim: [0, 0]", "plan.yaml:11: error: key point rim must be a list of three numbers"),
        (", surface: table}", "}", "plan.yaml:13: error: distractors need `surface: MODEL` or `position: [x, y, z]`"),
        ("[0, 2]", "{normal: [1, 1]}", "plan.yaml:13: error: count may be 200 at most"),
        (
            "sun: {",
            "sun: {azimuth: 1, ",
            "plan.yaml:15: error: light sun: `azimuth` alone changes nothing; add `elevat",
        ),
        ("sun: {", "sun: {type: directional, position: [0, 0, 1], ", "plan.yaml:15: error: light sun: a directional"),
        (
            "sun: {",
            "sun: {type: point, position: [0, 0, 1], elevation: 1, ",
            "plan.yaml:15: error: light sun: a point light has no `elevation`; leave it out",
        ),
        ("joints: any", "rotation: any", "plan.yaml:12: error: `rotation` turns what is placed; add `surface: MODEL`"),
        ("color: any", "repeat: 2", "plan.yaml:10: error: `repeat` is that of an image; add `textures: …`"),
        ("lights:", "materials:\n  table: {}\nlights:", "plan.yaml:15: error: materials of table need `color: …` or"),
        ("{uniform: [0.5, 1]}", "{values: [1, bright]}", "plan.yaml:15: error: intensity must be a number, a list of"),
        ("{uniform: [0.5, 1]}", "{values: [1, 2], with: a}", "plan.yaml:15: error: intensity: `with` pairs values of"),
        ("intensity", "brightness", "plan.yaml:15: error: light sun has no 'brightness'; it has: type, intensity,"),
        ("uniform: [0.5, 1]", "uniform: [.nan, 1]", "plan.yaml:15: error: "),
        ("camera:\n", "camera:\n  far: 2e6\n", "plan.yaml:4: error: far may be 1e+06 m at most"),
        (
            "count: 4",
            "count: 4\nlidar: {}",
            "plan.yaml:3: error: clouds of a lidar are written by kitti and semantic_ki",
        ),
        ("color: any", "textures: nowhere", "plan.yaml:10: error: textures: "),
    ],
)
def test_a_wrong_plan_is_refused_at_its_line(changed: str, by: str, message: str, tmp_path: Path) -> None:
    assert changed in PLAN
    with pytest.raises(DescriptionError) as caught:
        read_dataset_plan(PLAN.replace(changed, by, 1), file="plan.yaml", folder=tmp_path)
    assert str(caught.value).startswith(message)


def test_a_normal_distribution_is_cut_off_at_the_bounds_of_what_is_drawn(tmp_path: Path) -> None:
    text = PLAN.replace("size: 0.1", "size: {normal: [0.1, 1]}")
    distractors = read_dataset_plan(text, file="plan.yaml", folder=tmp_path).distractors
    assert distractors is not None
    random = np.random.default_rng(0)

    sizes = [distractors.size.draw(random) for _ in range(200)]

    assert min(sizes) == 1e-3
    assert max(sizes) > 1.0
