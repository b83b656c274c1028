"""Stand-ins are nodes that can be shut down from outside."""

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.ros import MasterProxy


@pytest.mark.parametrize(
    ("program", "arguments"),
    [("tf/static_transform_publisher", "0 0 0 0 0 0 a b 100"), ("topic_tools/relay", "/in /out")],
)
def test_a_stand_in_ends_when_its_node_is_killed(graph, program: str, arguments: str) -> None:
    exit_code = graph.start(program, arguments, name="victim")
    master = MasterProxy(graph.uri)

    def services() -> dict[str, list[str]]:
        _, _, provided = master.call("getSystemState")
        return dict(provided)

    graph.until(lambda: "/victim/get_loggers" in services())
    MasterProxy(master.call("lookupNode", "/victim")).call("shutdown", "user request")
    assert exit_code.result(PATIENCE_S) == 0
    assert "/victim/get_loggers" not in services()
