"""The same sweep by processes of this machine and on Ray: one table, to the byte."""

from pathlib import Path

import pytest

import trundle

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
pytest.importorskip("ray", reason="Ray, of the extra `ray`, is not installed")
WORLD = """<sdf version="1.6"><world name="w"><model name="box"><pose>0 0 5 0 0 0</pose><link name="link">
<inertial><mass>1</mass></inertial></link></model></world></sdf>"""
PLAN = """\
world: box.sdf
duration: 1
samples: 5
repeat: 2
bag: 0.2
vary: {models/box/links/link/inertial/mass: {uniform: [0.5, 2]}, push: [1, 5]}
events: [{at: 0.2, push: box/link, force: [push, 0, 0], for: 0.3}]
measure: {x: models.box.x, fastest: {max: models.box.speed}, drawn: {function: measures.py:drawn}}
pass: [x < 0.4]
"""
MEASURES = """\
def drawn(sim):
    if sim.time_ns and sim["box"].link("link").link.inertial.mass > 1.5:
        raise ValueError("too heavy")
    return sim.seed % 1000
"""


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_ray_and_processes_write_the_same_table(tmp_path: Path) -> None:
    for name, text in (("box.sdf", WORLD), ("plan.yaml", PLAN), ("measures.py", MEASURES)):
        (tmp_path / name).write_text(text)

    here = trundle.sweep(tmp_path / "plan.yaml", output=tmp_path / "here", workers=2)
    on_ray = trundle.sweep(tmp_path / "plan.yaml", output=tmp_path / "ray", address="local", workers=2)

    assert here.counts.keys() == {"ok", "failed", "error"}, "each of them is compared"
    assert sum(here.counts.values()) == 20
    tables = [sweep.folder / "results.parquet" for sweep in (here, on_ray)]
    assert tables[0].read_bytes() == tables[1].read_bytes()
    bags = [sorted((sweep.folder / "bags").iterdir()) for sweep in (here, on_ray)]
    assert [bag.name for bag in bags[0]] == [bag.name for bag in bags[1]]
    assert [bag.read_bytes() for bag in bags[0]] == [bag.read_bytes() for bag in bags[1]]
