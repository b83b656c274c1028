"""cmd_vel_mux, the nodelet that passes a TurtleBot 2 its commands."""

from pathlib import Path

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

_TWIST = "geometry_msgs/Twist"
_LOAD = "load yocs_cmd_vel_mux/CmdVelMuxNodelet manager cmd_vel_mux/output:=/base/velocity"
_SOURCES = """subscribers:
  - {name: navi, topic: input/navi, timeout: 60, priority: 5}
  - {name: teleop, topic: input/teleop, timeout: 60, priority: 7, short_desc: "keys"}
  - {name: brief, topic: input/brief, timeout: 0.1, priority: 9}
publisher: output
"""


def test_whoever_has_the_highest_priority_drives_until_it_is_silent(stage, tmp_path: Path) -> None:
    (tmp_path / "mux.yaml").write_text(_SOURCES)
    stage.start("nodelet/nodelet", _LOAD, name="cmd_vel_mux", yaml_cfg_file=str(tmp_path / "mux.yaml"))
    heard = stage.listen("/base/velocity", _TWIST)
    active = stage.listen("/cmd_vel_mux/active", "std_msgs/String")
    navi, teleop, brief = (stage.speak(f"/cmd_vel_mux/input/{name}", _TWIST) for name in ("navi", "teleop", "brief"))
    stage.until(lambda: stage.connected("/base/velocity") and active)
    for count, (source, speed) in enumerate(((brief, 1.0), (navi, 2.0), (teleop, 3.0))):
        source.publish({"linear": {"x": speed}})
        stage.until(lambda count=count: len(heard) == count + 1)
        if source is brief:
            stage.until(lambda: active[-1].data == "idle" and len(active) > 1)  # it was silent for its timeout
    navi.publish({"linear": {"x": 4.0}})
    teleop.publish({"linear": {"x": 5.0}})
    stage.until(lambda: len(heard) == 4)

    assert [message.linear.x for message in heard] == [1.0, 2.0, 3.0, 5.0]
    assert [message.data for message in active] == ["idle", "brief", "idle", "navi", "teleop"]


@pytest.mark.parametrize("text", ["", "subscribers: []", "subscribers: [{name: a}]", "a: [", "subscribers: 3"])
def test_a_configuration_that_is_none_is_named(stage, tmp_path: Path, capsys, text: str) -> None:
    (tmp_path / "mux.yaml").write_text(text)
    file = str(tmp_path / ("mux.yaml" if text else "none.yaml"))
    assert stage.start("nodelet/nodelet", _LOAD, name="mux", yaml_cfg_file=file).result(PATIENCE_S) == 1
    assert file in capsys.readouterr().err
