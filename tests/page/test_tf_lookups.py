"""Lookups that the client's tests repeat: `python tests/page/test_tf_lookups.py` writes them anew."""

import json
import random
from pathlib import Path
from typing import Any

from trundle.ros import Transform, TransformBuffer, TransformError

FILE = Path(__file__).parents[2] / "web/test/frames/tf_lookups.json"
MS = 1_000_000
FRAMES = {"odom": "map", "base": "odom", "laser": "base", "mast": "base", "camera": "mast", "loose": "elsewhere"}
STATIC = {"laser", "mast"}
WORDS = ("future", "past", "at time", "not part of the same tree", "does not exist")


def lookups() -> dict[str, Any]:
    """Random transforms of a small tree, and what our buffer answers to random questions."""
    chance = random.Random(17)
    buffer = TransformBuffer()
    given: list[dict[str, Any]] = []
    for child, parent in FRAMES.items():
        # Times are late, so that a number of 53 bits does not hold them, and overlap in part only.
        start = 1_700_000_000_000_000_001 + chance.randrange(2_000) * MS
        stamps = [0] if child in STATIC else [start + k * chance.randrange(290, 310) * MS for k in range(45)]
        for stamp in stamps:
            translation = tuple(round(chance.uniform(-2, 2), 3) for _ in range(3))
            rotation = tuple(round(chance.gauss(0, 1), 3) for _ in range(4))
            given.append(
                {"parent": f"/{parent}" if chance.random() < 0.1 else parent, "child": child, "stamp": str(stamp)}
                | {"translation": translation, "rotation": rotation, "static": child in STATIC}
            )
    chance.shuffle(given)
    for one in given:
        transform = Transform(
            parent=one["parent"],
            child=one["child"],
            stamp_ns=int(one["stamp"]),
            translation=one["translation"],
            rotation=one["rotation"],
        )
        buffer.set_transform(transform, static=one["static"])
    names = [*FRAMES, "map", "elsewhere", "nowhere"]
    asked: list[dict[str, Any]] = []
    while len(asked) < 150:
        target, source = chance.sample(names, 2)
        stamp = 0 if chance.random() < 0.4 else 1_700_000_000_000_000_001 + chance.randrange(18_000) * MS
        asked.append({"target": target, "source": source, "stamp": str(stamp)} | answer(buffer, target, source, stamp))
    return {"transforms": given, "lookups": asked}


def answer(buffer: TransformBuffer, target: str, source: str, stamp: int) -> dict[str, Any]:
    try:
        buffer.path(target, source)  # two trees: the client says so at any time, tf2 where the time is in both
        found = buffer.lookup_transform(target, source, stamp)
    except TransformError as error:
        return {"error": next(words for words in WORDS if words in str(error))}
    translation, rotation = ([round(value, 9) for value in part] for part in (found.translation, found.rotation))
    return {"translation": translation, "rotation": rotation}


def test_the_client_s_lookups_are_those_of_our_buffer() -> None:
    kept = json.loads(FILE.read_text())

    assert kept == json.loads(json.dumps(lookups()))
    answered = [one for one in kept["lookups"] if "error" not in one]
    assert 50 <= len(answered) <= 100
    assert {one["error"] for one in kept["lookups"] if "error" in one} == {*WORDS} - {"at time"}


if __name__ == "__main__":
    FILE.write_text(json.dumps(lookups()).replace("}, {", "},\n{") + "\n")
