"""cmd_vel_mux, the nodelet that multiplexes a TurtleBot 2's velocity commands."""

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


def test_the_active_input_has_the_highest_priority_until_it_times_out(graph, tmp_path: Path) -> None:
    (tmp_path / "mux.yaml").write_text(_SOURCES)
    graph.start("nodelet/nodelet", _LOAD, name="cmd_vel_mux", yaml_cfg_file=str(tmp_path / "mux.yaml"))
    messages = graph.listen("/base/velocity", _TWIST)
    active = graph.listen("/cmd_vel_mux/active", "std_msgs/String")
    navi, teleop, brief = (
        graph.advertise(f"/cmd_vel_mux/input/{name}", _TWIST) for name in ("navi", "teleop", "brief")
    )
    graph.until(lambda: graph.connected("/base/velocity") and active)
    for count, (source, speed) in enumerate(((brief, 1.0), (navi, 2.0), (teleop, 3.0))):
        source.publish({"linear": {"x": speed}})
        graph.until(lambda count=count: len(messages) == count + 1)
        if source is brief:
            graph.until(lambda: active[-1].data == "idle" and len(active) > 1)  # it was silent for its timeout
    navi.publish({"linear": {"x": 4.0}})
    teleop.publish({"linear": {"x": 5.0}})
    graph.until(lambda: len(messages) == 4)

    assert [message.linear.x for message in messages] == [1.0, 2.0, 3.0, 5.0]
    assert [message.data for message in active] == ["idle", "brief", "idle", "navi", "teleop"]


@pytest.mark.parametrize("text", ["", "subscribers: []", "subscribers: [{name: a}]", "a: [", "subscribers: 3"])
def test_an_invalid_configuration_is_reported(graph, tmp_path: Path, capsys, text: str) -> None:
    (tmp_path / "mux.yaml").write_text(text)
    file = str(tmp_path / ("mux.yaml" if text else "none.yaml"))
    assert graph.start("nodelet/nodelet", _LOAD, name="mux", yaml_cfg_file=file).result(PATIENCE_S) == 1
    assert file in capsys.readouterr().err
