"""Stand-ins as nodes that others may shut down."""

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.ros import MasterProxy


@pytest.mark.parametrize(
    ("what", "arguments"),
    [("tf/static_transform_publisher", "0 0 0 0 0 0 a b 100"), ("topic_tools/relay", "/in /out")],
)
def test_a_stand_in_ends_when_its_node_is_killed(stage, what: str, arguments: str) -> None:
    ended = stage.start(what, arguments, name="victim")
    master = MasterProxy(stage.uri)

    def services() -> dict[str, list[str]]:
        _, _, provided = master.call("getSystemState")
        return dict(provided)

    stage.until(lambda: "/victim/get_loggers" in services())
    MasterProxy(master.call("lookupNode", "/victim")).call("shutdown", "user request")
    assert ended.result(PATIENCE_S) == 0
    assert "/victim/get_loggers" not in services()
