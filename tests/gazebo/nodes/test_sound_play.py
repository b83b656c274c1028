"""sound_play with programs of the test's in place of the machine's."""

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
    """Folder of programs that write what they play to `heard`."""
    for name, line in (
        ("espeak", 'cat >> "$0.heard"; echo " $*" >> "$0.heard"'),
        ("paplay", 'echo "$*" >> "$0.heard"'),
    ):
        program = tmp_path / name
        program.write_text(f"#!/bin/sh\n{line}\n")
        program.chmod(0o755)
    return tmp_path


def host(folder: Path) -> NodeHost:
    return replace(NodeHost(), env={"PATH": f"{folder}:/usr/bin:/bin"})


def request(sound: int, command: int = ONCE, arg: str = "", volume: float = 0.5) -> dict[str, Any]:
    return {"sound": sound, "command": command, "arg": arg, "volume": volume}


def heard(program: Path) -> str:
    file = program.with_name(f"{program.name}.heard")
    return file.read_text() if file.exists() else ""


def test_a_text_is_spoken_and_a_file_played_at_its_volume(stage, sounds: Path) -> None:
    stage.start("sound_play/soundplay_node.py", host=host(sounds))
    topic = stage.speak("/robotsound", REQUEST)
    topic.publish(request(SAY, arg="-x hello; rm"))
    stage.until(lambda: heard(sounds / "espeak") == "-x hello; rm --stdin -a 50\n")

    song = sounds / "-song.wav"
    song.write_bytes(b"RIFF")
    topic.publish(request(FILE, arg=str(song), volume=1.0))
    stage.until(lambda: heard(sounds / "paplay") == f"--volume=65536 {song}\n")


def test_a_sound_repeats_until_it_is_stopped(stage, sounds: Path) -> None:
    stage.start("sound_play/soundplay_node.py", host=host(sounds))
    topic = stage.speak("/robotsound", REQUEST)
    topic.publish(request(SAY, START, "again"))
    stage.until(lambda: heard(sounds / "espeak").count("again") > 2)
    topic.publish(request(ALL, STOP))

    topic.publish(request(SAY, arg="last"))
    stage.until(lambda: heard(sounds / "espeak").endswith("last --stdin -a 50\n"))


def test_a_goal_of_the_action_ends_with_its_sound(stage, sounds: Path) -> None:
    stage.start("sound_play/soundplay_node.py", host=host(sounds))
    goals = stage.speak("/sound_play/goal", "sound_play/SoundRequestActionGoal")
    results = stage.listen("/sound_play/result", "sound_play/SoundRequestActionResult")
    stage.until(lambda: stage.linked("/sound_play/result"))
    goals.publish({"goal_id": {"id": "one"}, "goal": {"sound_request": request(SAY, arg="done")}})

    stage.until(lambda: results)
    assert results[0].status.status == 3
    assert heard(sounds / "espeak").startswith("done")


def test_a_machine_without_sound_prints_the_text(stage, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    said = ""
    stage.start("sound_play/soundplay_node.py", host=replace(NodeHost(), env={"PATH": str(tmp_path)}))
    topic = stage.speak("/robotsound", REQUEST)
    topic.publish(request(SAY, arg="hello"))

    def is_said() -> bool:
        nonlocal said
        said += "".join(capfd.readouterr())
        return "says: hello (without a sound: none of espeak-ng, espeak, say is installed)" in said

    stage.until(is_said)
