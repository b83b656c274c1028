"""Pictures per CPU second of `trundle dataset`, against its renderer alone on the same views.

The renderer alone draws colors (four samples per pixel), depths and segmentation; `trundle dataset` also computes
arrangements, appearances, boxes, masks, occlusion and key points. Files are not written.
"""

import tempfile
import time
from pathlib import Path

from bench.table import Row
from trundle.studies.dataset.dataset_world import picture_maker
from trundle.studies.datasets import PictureMaker, draw_view, read_dataset_plan

_PICTURES, _ROUNDS = 30, 3
_TABLE = """<sdf version="1.6"><world name="w">
<include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>
<model name="table"><static>1</static><pose>0 0 0.7 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>1.2 0.8 0.04</size></box></geometry></collision>
<visual name="v"><geometry><box><size>1.2 0.8 0.04</size></box></geometry></visual></link></model></world></sdf>"""
_CUP = """<sdf version="1.6"><model name="cup"><link name="body">
<collision name="c"><geometry><cylinder><radius>0.04</radius><length>0.1</length></cylinder></geometry></collision>
<visual name="v"><geometry><cylinder><radius>0.04</radius><length>0.1</length></cylinder></geometry></visual>
<visual name="handle"><pose>0.055 0 0 0 0 0</pose><geometry><box><size>0.05 0.012 0.06</size></box></geometry></visual>
</link></model></sdf>"""
_PLAN = """
world: table.world
count: 1000
camera:
  orbit: {center: [0, 0, 0.75], distance: {uniform: [0.8, 1.6]}, elevation: {uniform: [0.2, 1.0]}}
objects:
  cup: {model: cup.sdf, count: {uniform: [1, 6]}, surface: table, color: any, key_points: {rim: [0.04, 0, 0.05]}}
distractors: {count: {uniform: [0, 6]}, size: {uniform: [0.04, 0.15]}, surface: table, color: any, textures: any}
lights: {sun: {elevation: {uniform: [0.6, 1.4]}}}
materials: {table: {textures: any}, ground_plane: {textures: any}}
"""


def run() -> list[Row]:
    """Measure in alternation; the best round of each is the least disturbed by other programs."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "table.world").write_text(_TABLE, encoding="utf-8")
        Path(folder, "cup.sdf").write_text(_CUP, encoding="utf-8")
        plan = read_dataset_plan(_PLAN, file="plan.yaml", folder=Path(folder))
        maker = picture_maker(plan)
        arrangements = [maker.placer.arrange(number) for number in range(_PICTURES)]
        views = [draw_view(plan, number, arrangement) for number, arrangement in enumerate(arrangements)]

        def alone_s() -> float:
            total_s = 0.0
            for number, (arrangement, view) in enumerate(zip(arrangements, views, strict=True)):
                maker.renderer.restyle(maker.looks.scene(number, arrangement))
                start = time.process_time()
                maker.renderer.update(arrangement.poses)
                maker.draw(view)
                total_s += time.process_time() - start
            return total_s

        complete = alone = 0.0
        for _ in range(_ROUNDS):
            alone = max(alone, _PICTURES / alone_s())
            complete = max(complete, _rate(maker))
    return [Row("dataset, 640x480, up to 6 cups", complete, "pictures/s", "the renderer alone", complete / alone)]


def _rate(maker: PictureMaker) -> float:
    start = time.process_time()
    for number in range(_PICTURES):
        maker.make(number)
    return _PICTURES / (time.process_time() - start)
