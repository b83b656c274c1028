"""Ports of a launch's pages."""

from pathlib import Path

from trundle.base.diagnostics import Diagnostics
from trundle.base.http.page_address import PageAddress
from trundle.live.launch.pages import reserved_ports
from trundle.page.http.listening import listen
from trundle.robots.launch import read_launch_text
from trundle.robots.packages import Packages

VIDEO = 'pkg="web_video_server" type="web_video_server"'


def test_ports_of_video_servers_are_reserved(tmp_path: Path) -> None:
    plan = read_launch_text(
        f"""<launch><node name="a" {VIDEO}/>
        <node ns="b" name="c" {VIDEO}><param name="port" value="8082"/></node></launch>""",
        name="t.launch",
        packages=Packages({}, start=tmp_path),
        report=Diagnostics(),
    )

    assert reserved_ports(plan) == (8080, 8082)


def test_a_page_listens_at_no_reserved_port() -> None:
    reserved = tuple(range(8080, 8090))
    with listen(PageAddress(reserved_ports=reserved)) as listening:
        assert listening.getsockname()[1] not in reserved
