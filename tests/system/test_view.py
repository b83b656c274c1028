"""`trundle view` beside other nodes of the graph."""

import contextlib
import re
import socket


def test_a_view_joins_without_pushing_another_rviz_out(start, trundle, master, until, shared) -> None:
    launch = ("launch", "smartcar_description", "smartcar_display.rviz.launch", "--headless")
    start(*launch, ROS_PACKAGE_PATH=str(shared / "seeds"))
    until("the launch", lambda: "/rviz" in trundle("node", "list").stdout.split())

    view = start("view", "--port", "0")

    def names() -> list[str]:
        return [name for name in trundle("node", "list").stdout.split() if name.startswith("/rviz")]

    until("the view", lambda: len(names()) == 2)
    assert "/rviz" in names()
    assert view.interrupt() == 130
    until("the view to be gone", lambda: names() == ["/rviz"])


def test_without_a_master_a_view_says_what_to_do(trundle, env) -> None:
    done = trundle("view")

    assert done.returncode == 1
    assert re.search(r"no ROS master answers at http://127\.0\.0\.1:\d+; start one with 'trundle core'", done.stderr)


def test_gazebos_page_is_at_the_port_after_that_of_rviz(trundle, tmp_path) -> None:
    """One port for both had left one of them out."""
    (tmp_path / "both.launch").write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
        '<node pkg="rviz" type="rviz" name="see"/></launch>'
    )
    port = _two_free_ports()
    done = trundle("launch", "both.launch", "--duration", "5", "--view-port", str(port))

    table = done.stdout[done.stdout.index("WHAT RUNS") :]
    assert {f"http://127.0.0.1:{port}", f"http://127.0.0.1:{port + 1}"} <= set(table.split())
    assert "cannot serve" not in done.stderr


def _two_free_ports() -> int:
    """First of two adjacent free ports."""
    while True:
        with socket.socket() as one, socket.socket() as other, contextlib.suppress(OSError):
            one.bind(("127.0.0.1", 0))
            other.bind(("127.0.0.1", one.getsockname()[1] + 1))
            return int(one.getsockname()[1])
