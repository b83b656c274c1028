"""`trundle view` with other nodes in the graph."""

import re


def test_a_view_does_not_replace_a_running_rviz(start, trundle, master, until, shared) -> None:
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


def test_the_error_of_view_without_a_master_names_trundle_core(trundle, env) -> None:
    done = trundle("view")

    assert done.returncode == 1
    assert re.search(r"no ROS master answers at http://127\.0\.0\.1:\d+; start one with 'trundle core'", done.stderr)
