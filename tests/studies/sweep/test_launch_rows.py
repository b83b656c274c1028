"""Rows of a launch file: arguments, parameters, properties of what is spawned, events and topics."""

from pathlib import Path

import pytest

import trundle
from trundle.base.diagnostics import TrundleError, UsageError
from trundle.ros import open_bag
from trundle.studies.sweep.plan_reader import load_plan
from trundle.studies.sweep.row_runner import runner_of
from trundle.studies.sweep.rows import Rows
from trundle.studies.sweep.run_sweep import open_results

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
LAUNCH = """<launch><arg name="height" default="1"/>
<param name="box_description" command="cat $(dirname)/box.urdf"/>
<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="$(dirname)/empty.world"/>
<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param box_description -model box -z $(arg height)"/>
</launch>"""
WORLD = '<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity></world></sdf>'
URDF = """<robot name="box"><link name="body"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>"""
PLAN = """\
launch: box.launch
duration: 1
every: 0.1
bag: 0.5
vary:
  arguments/height: [20, 30]
  models/box/links/body/inertial/mass: [1, 2]
set: {gravity/z: '-2', parameters/gain: '[1, 2]'}
events: [{at: 0.5, push: box/body, force: [10, 0, 0], for: 0.1}]
measure:
  z: models.box.z
  fastest: {max: models.box.vx}
  clock: topics["/clock"].clock.sec + topics["/clock"].clock.nanosec * 1e-9
  params: {function: gain.py:gain}
pass: [z > 25]
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    for name, text in (("box.launch", LAUNCH), ("empty.world", WORLD), ("box.urdf", URDF), ("plan.yaml", PLAN)):
        (tmp_path / name).write_text(text)
    (tmp_path / "gain.py").write_text("def gain(sim):\n    return len(sim.models)\n")
    return tmp_path / "plan.yaml"


@pytest.mark.slow
def test_a_launch_is_run_with_the_values_of_each_row(plan: Path) -> None:
    done = trundle.sweep(plan, workers=2)

    for row in done.table.to_pylist():
        height, mass = row["arguments/height"], row["models/box/links/body/inertial/mass"]
        assert row["status"] == ("ok" if height == 30 else "failed"), row["reason"]
        assert row["z"] == pytest.approx(height - 1, abs=0.05), "half of 2 m/s² for 1 s"
        assert row["fastest"] == pytest.approx(10 / mass * 0.1, rel=0.02)
        assert row["clock"] == pytest.approx(1, abs=0.02)
        assert row["params"] == 1
    with open_bag(done.folder / "bags/row_0.bag") as bag:
        assert {message.connection.topic for message in bag.messages()} >= {"/clock"}
    assert sorted(path.name for path in (done.folder / "bags").iterdir()) == ["row_0.bag", "row_1.bag"]


@pytest.mark.slow
def test_a_row_of_a_launch_repeats_to_the_byte(plan: Path) -> None:
    read = load_plan(plan)
    results = [runner_of(read).run(Rows(read).row(1)) for _ in range(2)]

    assert results[0] == results[1]


@pytest.mark.slow
def test_repetitions_of_a_launch_differ_by_their_seed(plan: Path) -> None:
    (plan.parent / "gain.py").write_text("def gain(sim):\n    return sim.seed\n")
    read = load_plan(plan)
    rows = [Rows(read).row(number) for number in range(2)]

    assert [runner_of(read).run(row).measures["params"] for row in rows] == [row.seed for row in rows]
    assert rows[0].seed != rows[1].seed


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changed", "by", "message"),
    [
        ("models/box/links", "models/bx/links", "no such model was spawned; models: 'box'"),
        ("links/body", "links/bdy", "has no 'bdy'; the nearest is 'body'; it has: body, *"),
        ("box/body, force", "box/bdy, force", "no link 'bdy'"),
    ],
)
def test_a_missing_model_or_link_is_the_reason_of_an_error(plan: Path, changed: str, by: str, message: str) -> None:
    plan.write_text(PLAN.replace(changed, by))
    read = load_plan(plan)

    result = runner_of(read).run(Rows(read).row(0))

    assert result.status == "error"
    assert message in result.reason


@pytest.mark.parametrize(
    ("changed", "by", "message"),
    [
        (
            "arguments/height",
            "arguments/hight",
            "plan.yaml:6: error: arguments/hight: {}/box.launch:1: no argument 'hight'",
        ),
        ("gravity/z", "gravty/z", "plan.yaml:8: error: gravty/z: the world has no 'gravty'; the nearest is 'gravity'"),
        ("links/body", "links/bdy", "plan.yaml:7: error: models/box/links/bdy/inertial/mass: models/box/links has no"),
        (
            "parameters/gain",
            "parameters/g n",
            "plan.yaml:8: error: parameters/g n: not a legal name of a ROS parameter",
        ),
    ],
)
def test_a_name_that_the_launch_cannot_have_is_refused(plan: Path, changed: str, by: str, message: str) -> None:
    plan.write_text(PLAN.replace(changed, by))
    with pytest.raises(TrundleError) as caught:
        trundle.sweep(plan)
    assert message.format(plan.parent) in str(caught.value)
    assert not plan.with_suffix(".sweep").exists()


def test_a_name_that_only_a_program_could_use_is_warned_of(plan: Path) -> None:
    """Nodes may read parameters, and programs spawn models, that the launch file does not name."""
    plan.write_text(PLAN.replace("parameters/gain", "parameters/box_descriptio").replace("models/box/l", "models/bo/l"))
    read = load_plan(plan)

    first, second = runner_of(read).check(Rows(read).row(0))

    assert first.endswith(
        "plan.yaml:8: warning: parameters/box_descriptio: the launch sets no parameter '/box_descriptio'; "
        "the nearest is '/box_description'; each run sets it nevertheless"
    )
    assert second.endswith(
        "plan.yaml:7: warning: models/bo/links/body/inertial/mass: the launch names no model 'bo'; "
        "the nearest is 'box'; models: 'box'; a program must spawn it"
    )


MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"


@pytest.mark.parametrize(
    ("name", "changed", "by"),
    [
        ("empty.world", "0 0 -10", "0 0 -9"),
        ("box.urdf", 'value="1"', 'value="1.5"'),
        ("box.obj", "v 1 0 0", "v 1.5 0 0"),
        ("table.sdf", "<mass>3</mass>", "<mass>4</mass>"),
        ("table.obj", "v 1 0 0", "v 1.5 0 0"),
        ("box.launch", 'default="1"', 'default="2"'),
        ("gain.py", "len(sim.models)", "len(sim.models) + 1"),
    ],
)
def test_a_sweep_does_not_go_on_with_a_changed_file(plan: Path, name: str, changed: str, by: str) -> None:
    """World, spawned models, their meshes, functions: by their content, wherever they are named."""
    folder = plan.parent
    mesh = '<geometry><mesh filename="file://{}"/></geometry>'.format(folder / "box.obj")
    (folder / "box.urdf").write_text(URDF.replace("</link>", f"<visual>{mesh}</visual></link>"))
    shape = f"<geometry><mesh><uri>file://{folder / 'table.obj'}</uri></mesh></geometry>"
    link = f'<link name="top"><inertial><mass>3</mass></inertial><collision name="c">{shape}</collision></link>'
    (folder / "table.sdf").write_text(f'<sdf version="1.6"><model name="table">{link}</model></sdf>')
    node = (
        '<node pkg="gazebo_ros" type="spawn_model" name="table" args="-sdf -file $(dirname)/table.sdf -model table"/>'
    )
    (folder / "box.launch").write_text(LAUNCH.replace("</launch>", f"{node}</launch>"))
    for file in ("box.obj", "table.obj"):
        (folder / file).write_text(MESH)
    read, results = load_plan(plan), folder / "out"
    open_results(read, Rows(read), results, runner_of(read)).close()
    open_results(read, Rows(read), results, runner_of(read)).close()

    text = (folder / name).read_text()
    assert changed in text
    (folder / name).write_text(text.replace(changed, by))

    with pytest.raises(UsageError, match="another plan"):
        open_results(read, Rows(read), results, runner_of(read))


@pytest.mark.parametrize(
    ("name", "changed", "by"), [("other.urdf", 'value="1"', 'value="2"'), ("more.launch", "5", "6")]
)
def test_files_that_only_another_argument_names_count(plan: Path, name: str, changed: str, by: str) -> None:
    folder = plan.parent
    (folder / "other.urdf").write_text(URDF)
    (folder / "more.launch").write_text('<launch><param name="more" value="5"/></launch>')
    chosen = LAUNCH.replace("box.urdf", "$(arg which).urdf").replace(
        '"height"', '"which" default="box"/><arg name="height"'
    )
    more = """<include if="$(eval arg('height') == 30)" file="$(dirname)/more.launch"/></launch>"""
    (folder / "box.launch").write_text(chosen.replace("</launch>", more))
    robot = "'box' if height == 20 else 'other'"
    vary = PLAN.replace("arguments/height", "height")
    plan.write_text(vary.replace("set: {", f'set: {{arguments/which: "{robot}", arguments/height: height, '))
    read, results = load_plan(plan), folder / "out"
    open_results(read, Rows(read), results, runner_of(read)).close()

    text = (folder / name).read_text()
    assert changed in text
    (folder / name).write_text(text.replace(changed, by))

    with pytest.raises(UsageError, match="another plan"):
        open_results(read, Rows(read), results, runner_of(read))


@pytest.mark.slow
def test_a_stop_condition_holds_the_world_where_it_became_true(plan: Path) -> None:
    plan.write_text(PLAN.replace("every: 0.1", "every: 0.01\nstop: [models.box.z < 19.5]"))
    read = load_plan(plan)

    result = runner_of(read).run(Rows(read).row(0))

    assert result.time == pytest.approx(0.71, abs=1e-9), "0.5 m at 2 m/s² takes 0.707 s"
    assert result.measures["z"] == pytest.approx(20 - 0.71**2, abs=0.01)
