"""Log files of a run: written in a thread, bounded in size."""

from pathlib import Path
from typing import Any

import pytest
from tests.graphs import until

from trundle.ros import Core, GraphLoop, LogFile, Messages, Node
from trundle.ros.core.logs import rosout_line


def test_lines_are_appended_to_an_existing_file(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    path.write_text("earlier\n")
    log = LogFile(path, max_bytes=1000, backups=1)
    log.write("one")
    log.write("two\nlines")
    log.close()
    assert path.read_text() == "earlier\none\ntwo\nlines\n"


def test_old_files_are_rotated_out(tmp_path: Path) -> None:
    log = LogFile(tmp_path / "a.log", max_bytes=9, backups=2)
    for number in range(5):
        log.write(f"line {number:04d}")  # one byte longer than a file may be
    log.write("last")
    log.close()
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == {
        "a.log": "last\n",
        "a.log.1": "line 0004\n",
        "a.log.2": "line 0003\n",
    }


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_lines_lost_on_a_full_disk_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    path.symlink_to("/dev/full")
    log = LogFile(path, max_bytes=1000, backups=1)
    log.write("one")
    log.write("two")
    until(lambda: log.lost == 2)
    path.unlink()
    log.write("three")
    log.close()
    assert path.read_text() == "2 lines dropped: the disk was full or too slow\nthree\n"


def test_rosout_lines_have_roscores_format(messages: Messages) -> None:
    fields = {
        "header": {"stamp": {"secs": 12, "nsecs": 5}},
        "level": 4,
        "name": "/talker",
        "msg": "two\nlines",
        "file": "talk.py",
        "function": "main",
        "line": 7,
        "topics": ["/rosout", "/chatter"],
    }
    message = messages.new("rosgraph_msgs/Log", fields)
    start = "12.000000005 WARN /talker [talk.py:7(main)] "
    assert rosout_line(message, with_topics=True) == f"{start}[topics: /rosout, /chatter] two\nlines"
    assert rosout_line(message, with_topics=False) == f"{start}two\nlines"


def test_a_core_logs_node_messages_and_registrations(tmp_path: Path, messages: Messages) -> None:
    with GraphLoop(messages=messages) as loop:
        core = Core(loop, port=0, log_folder=lambda _: tmp_path)
        loop.run(core.start())
        loop.run(core.wait_ready())
        node = _node(loop, core)
        loop.run(node.wait_registered())
        until(lambda: _log_info(node, "first") and "first" in _text(tmp_path / "rosout.log"))
        loop.run(node.params.set("/rosout/omit_topics", True))
        until(lambda: _log_info(node, "second") and "second" in _text(tmp_path / "rosout.log"))
        uri = node.uri
        loop.run(node.shutdown())
        loop.run(core.stop())
    rosout = (tmp_path / "rosout.log").read_text().splitlines()
    assert any(line.endswith("(_log_info)] [topics: /chatter, /rosout] first") for line in rosout)
    assert any(line.endswith("(_log_info)] second") for line in rosout)
    master = (tmp_path / "master.log").read_text()
    assert "[rosmaster.master][INFO]" in master
    assert f": +PUB [/chatter] /talker {uri}\n" in master
    assert f": -PUB [/chatter] /talker {uri}\n" in master
    assert f": +SERVICE [/talker/get_loggers] /talker {uri}\n" in master
    assert ": +PARAM [/rosout/omit_topics] by /talker\n" in master


def test_rosout_logging_can_be_disabled(tmp_path: Path, messages: Messages, monkeypatch: Any) -> None:
    monkeypatch.setenv("ROSOUT_DISABLE_FILE_LOGGING", "1")
    with GraphLoop(messages=messages) as loop:
        core = Core(loop, port=0, log_folder=lambda _: tmp_path)
        loop.run(core.start())
        loop.run(core.stop())
    assert [file.name for file in tmp_path.iterdir()] == ["master.log"]


def _node(loop: GraphLoop, core: Core) -> Node:
    node = Node("talker", loop=loop, master_uri=core.uri)
    node.advertise("/chatter", "std_msgs/String")
    return node


def _log_info(node: Node, text: str) -> bool:
    node.log.info(text)
    return True


def _text(file: Path) -> str:
    return file.read_text() if file.exists() else ""
