"""Nodes whose launch-prefix requests a terminal have one on the page, where a user drives by keys."""

import json
import re
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.page_client import ProtocolClient
from tests.system.browser import running_page

from trundle.base.supervisor import HAS_PSEUDO_TERMINALS

pytestmark = [
    pytest.mark.slow,
    needs_client,
    pytest.mark.skipif(not HAS_PSEUDO_TERMINALS, reason="Windows has no pseudo-terminals"),
]

MANIFEST = """<package><name>keys</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>x</license></package>"""
LAUNCH = """<launch>
  <node pkg="turtlesim" type="turtlesim_node" name="sim"/>
  <node pkg="keys" type="drive.py" name="drive" launch-prefix="xterm -e"/>
  <node pkg="turtlesim" type="turtle_teleop_key" name="turtle" launch-prefix="gnome-terminal --"/>
  <node pkg="keys" type="size.py" name="size" launch-prefix="konsole -e"/>
  <node pkg="keys" type="evil.py" name="evil" launch-prefix="rxvt -e nice"/>
  <node pkg="keys" type="endless.sh" name="endless" launch-prefix="xterm -hold -e"/>
</launch>"""
DRIVE = """#!/usr/bin/env python3
import sys, termios, tty
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("drive")
commands = rospy.Publisher("/robot/cmd_vel", Twist, queue_size=1)
print("i: forward, k: stop, q: quit")
before = termios.tcgetattr(sys.stdin)
try:
    tty.setraw(sys.stdin.fileno())
    while not rospy.is_shutdown():
        key = sys.stdin.read(1)
        if key == "q":
            break
        twist = Twist()
        twist.linear.x = {"i": 0.5}.get(key, 0.0)
        commands.publish(twist)
        print(f"pressed {key}", end="\\r\\n", flush=True)
finally:
    termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)
"""
SIZE = """#!/usr/bin/env python3
import os, signal
def show(*_):
    print("size %d x %d" % tuple(os.get_terminal_size()), flush=True)
signal.signal(signal.SIGWINCH, show)
show()
while True:
    signal.pause()
"""
EVIL = r"""#!/usr/bin/env python3
import select, sys, tty
tty.setraw(0)
sys.stdout.write("\033]0;<img src=x onerror=window.ran=1>\007\033]52;c;ZXZpbA==\007")
sys.stdout.write("<img src=x onerror=window.ran=1>\r\n\033]8;;javascript:window.ran=1\007a link\033]8;;\007\r\n")
sys.stdout.write("\033[c\033[6n\033[?25$p\033P$qm\033\\\033]10;?\007\033[18t\r\n")
sys.stdout.flush()
received = sys.stdin.read(1)
print("first key: %r" % received, end="\r\n", flush=True)
sys.stdin.read(1)
"""
ENDLESS = "#!/bin/sh\nexec yes 'and so on'\n"
ROWS = ".terminalhost .xterm-rows"


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def url(graph: Graph, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    home: Path = tmp_path_factory.mktemp("home")
    folder = home / "keys"
    folder.mkdir()
    programs = {"drive.py": DRIVE, "size.py": SIZE, "evil.py": EVIL, "endless.sh": ENDLESS}
    for name, text in {"package.xml": MANIFEST, "keys.launch": LAUNCH, **programs}.items():
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    environment = {
        "HOME": str(home),
        "ROS_MASTER_URI": graph.core.uri,
        "ROS_PACKAGE_PATH": str(folder),
        "DISPLAY": "",
        "WAYLAND_DISPLAY": "",
    }
    with running_page("launch", "keys.launch", "--view-port", "0", environment=environment, folder=folder) as url:
        yield url


class Typist(PanelUser):
    """User of the Terminal panel."""

    def __init__(self, browser: Any, url: str) -> None:
        super().__init__(browser, url)
        self.open("Terminal")

    def choose(self, node: str) -> None:
        """Show a node's terminal, which then has the focus."""
        self.page.get_by_role("tab", name=node).click()
        self.page.locator(".terminalhost .xterm").wait_for()

    def reads(self, text: str) -> None:
        """Wait until the terminal shows a text."""
        self.until(lambda: text in self.shown, what=f"for {text!r}")

    @property
    def shown(self) -> str:
        return str(self.page.locator(ROWS).inner_text()).replace("\xa0", " ")


@pytest.fixture
def user(chromium: Any, url: str) -> Iterator[Typist]:
    user = Typist(chromium, url)
    yield user
    user.close()


def test_keys_drive_a_robot_through_a_packages_program(graph: Graph, user: Typist) -> None:
    listener = graph.node("listener")
    received: list[float] = []
    listener.subscribe("/robot/cmd_vel", "geometry_msgs/Twist", lambda twist: received.append(twist.linear.x))
    user.choose("/drive")
    user.reads("i: forward")

    def drives() -> bool:
        user.page.keyboard.press("i")
        return 0.5 in received

    user.until(drives, what="for a command")
    user.page.keyboard.press("k")
    user.until(lambda: received[-1] == 0.0, what="for the stop")
    user.reads("pressed k")


def test_arrows_drive_the_turtle_through_a_stand_in(graph: Graph, user: Typist) -> None:
    watcher = graph.node("watcher")
    turned: list[float] = []
    watcher.subscribe("/turtle1/pose", "turtlesim/Pose", lambda pose: turned.append(pose.theta))
    user.choose("/turtle")
    user.reads("Use arrow keys to move the turtle.")
    user.page.keyboard.press("ArrowLeft")

    user.until(lambda: turned and turned[-1] > 0.5, what="for the turtle to turn")


def test_later_users_see_earlier_output(chromium: Any, url: str, user: Typist) -> None:
    user.choose("/size")
    user.reads("size ")
    later = Typist(chromium, url)
    later.choose("/turtle")
    later.reads("Use arrow keys to move the turtle.")
    later.close()


def test_the_program_has_the_size_of_the_panel(user: Typist) -> None:
    user.choose("/size")
    user.until(lambda: _fills_the_panel(user), what="for the panel's size")
    wide, _ = _last_size(user.shown)
    user.page.set_viewport_size({"width": 900, "height": 700})
    user.until(lambda: _last_size(user.shown)[0] < wide and _fills_the_panel(user), what="for the new size")


def _last_size(shown: str) -> tuple[int, int]:
    """Return the columns and rows that the program printed last."""
    lines = [line for line in shown.splitlines() if re.fullmatch(r"size \d+ x \d+", line.strip())]
    _, columns, _, rows = lines[-1].split() if lines else ("", "1", "", "1")
    return int(columns), int(rows)


def _fills_the_panel(user: Typist) -> bool:
    """Tell if neither another column nor another row would fit."""
    width, height, shown_width, shown_height = user.page.evaluate("""() => {
        const host = document.querySelector(".terminalhost"), screen = document.querySelector(".xterm-screen");
        return [host.clientWidth, host.clientHeight, screen.clientWidth, screen.clientHeight];
    }""")
    columns, rows = _last_size(user.shown)
    more_width, more_height = shown_width / columns + 40, shown_height / rows + 12  # including margins and a scroll bar
    return width - more_width < shown_width <= width and height - more_height < shown_height <= height


def test_view_only_users_see_output_and_cannot_type(graph: Graph, chromium: Any, url: str, user: Typist) -> None:
    link = _view_link(url)
    listener = graph.node("listener_of_viewer")
    received: list[float] = []
    listener.subscribe("/robot/cmd_vel", "geometry_msgs/Twist", lambda twist: received.append(twist.linear.x))
    viewer = Typist(chromium, link)
    viewer.choose("/drive")
    output = ("i: forward", "pressed")  # the first is out of sight after a few keys
    viewer.until(lambda: any(text in viewer.shown for text in output), what="for the program's output")
    viewer.page.get_by_text("This link is view-only.").wait_for()
    viewer.page.locator(".terminalhost").click()
    viewer.page.keyboard.type("iii")
    with ProtocolClient(link) as client:
        client.send("trundle/terminal", number=0, text="i")
        client.until(lambda: [status["message"] for status in client.statuses] == ["this link is view-only"])
    user.choose("/drive")
    user.page.keyboard.press("k")
    user.until(lambda: received, what="for the owner's command")
    viewer.close()

    assert 0.5 not in received


def _view_link(url: str) -> str:
    address, _, token = url.partition("?")
    with urllib.request.urlopen(f"{address}session.json?{token}") as answer:
        return f"{address}?token={json.load(answer)['view_token']}"


def test_a_hostile_program_cannot_type_or_change_the_page(user: Typist) -> None:
    user.choose("/evil")
    user.reads("a link")
    user.page.get_by_text("a link").click(force=True)
    user.page.keyboard.press("x")
    user.reads("first key: 'x'")

    assert user.page.evaluate("window.ran === undefined")
    assert user.page.locator("img[src=x]").count() == 0
    assert "img" not in user.page.title()
    assert len(user.page.context.pages) == 1


def test_endless_output_leaves_the_page_usable(graph: Graph, user: Typist) -> None:
    user.choose("/endless")
    user.reads("and so on")
    user.choose("/drive")
    user.page.keyboard.press("k")
    user.reads("pressed k")


def test_a_terminal_shows_the_end_of_its_node(user: Typist) -> None:
    user.choose("/drive")
    user.page.keyboard.press("q")
    user.reads("/drive has finished cleanly")
    user.page.get_by_role("tab", name="/drive (ended)").wait_for()
    user.choose("/endless")
    user.page.keyboard.press("Control+c")
    user.reads("/endless has died [signal 2]")
