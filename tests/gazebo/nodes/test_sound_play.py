"""sound_play with fake players and speech synthesizers."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from trundle.gazebo.nodes import NodeHost

REQUEST = "sound_play/SoundRequest"
SAY, FILE, ALL = -3, -2, -1
ONCE, START, STOP = 1, 2, 0


@pytest.fixture
def sounds(tmp_path: Path) -> Path:
    """Folder of programs that append what they play to a `.log` file."""
    for name, line in (
        ("espeak", 'cat >> "$0.log"; echo " $*" >> "$0.log"'),
        ("paplay", 'echo "$*" >> "$0.log"'),
    ):
        program = tmp_path / name
        program.write_text(f"#!/bin/sh\n{line}\n")
        program.chmod(0o755)
    return tmp_path


def host(folder: Path) -> NodeHost:
    return replace(NodeHost(), env={"PATH": f"{folder}:/usr/bin:/bin"})


def request(sound: int, command: int = ONCE, arg: str = "", volume: float = 0.5) -> dict[str, Any]:
    return {"sound": sound, "command": command, "arg": arg, "volume": volume}


def played(program: Path) -> str:
    file = program.with_name(f"{program.name}.log")
    return file.read_text() if file.exists() else ""


def test_a_text_is_spoken_and_a_file_played_at_its_volume(graph, sounds: Path) -> None:
    graph.start("sound_play/soundplay_node.py", host=host(sounds))
    topic = graph.advertise("/robotsound", REQUEST)
    topic.publish(request(SAY, arg="-x hello; rm"))
    graph.until(lambda: played(sounds / "espeak") == "-x hello; rm --stdin -a 50\n")

    song = sounds / "-song.wav"
    song.write_bytes(b"RIFF")
    topic.publish(request(FILE, arg=str(song), volume=1.0))
    graph.until(lambda: played(sounds / "paplay") == f"--volume=65536 {song}\n")


def test_a_sound_repeats_until_it_is_stopped(graph, sounds: Path) -> None:
    graph.start("sound_play/soundplay_node.py", host=host(sounds))
    topic = graph.advertise("/robotsound", REQUEST)
    topic.publish(request(SAY, START, "again"))
    graph.until(lambda: played(sounds / "espeak").count("again") > 2)
    topic.publish(request(ALL, STOP))

    topic.publish(request(SAY, arg="last"))
    graph.until(lambda: played(sounds / "espeak").endswith("last --stdin -a 50\n"))


def test_an_action_goal_succeeds_after_its_sound(graph, sounds: Path) -> None:
    graph.start("sound_play/soundplay_node.py", host=host(sounds))
    goals = graph.advertise("/sound_play/goal", "sound_play/SoundRequestActionGoal")
    results = graph.listen("/sound_play/result", "sound_play/SoundRequestActionResult")
    graph.until(lambda: graph.linked("/sound_play/result"))
    goals.publish({"goal_id": {"id": "one"}, "goal": {"sound_request": request(SAY, arg="done")}})

    graph.until(lambda: results)
    assert results[0].status.status == 3
    assert played(sounds / "espeak").startswith("done")


def test_a_machine_without_sound_prints_the_text(graph, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    output = ""
    graph.start("sound_play/soundplay_node.py", host=replace(NodeHost(), env={"PATH": str(tmp_path)}))
    topic = graph.advertise("/robotsound", REQUEST)
    topic.publish(request(SAY, arg="hello"))

    def is_printed() -> bool:
        nonlocal output
        output += "".join(capfd.readouterr())
        return "says: hello (silently: none of espeak-ng, espeak, say is installed)" in output

    graph.until(is_printed)
