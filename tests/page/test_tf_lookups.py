"""Lookups that the client's tests repeat: `python tests/page/test_tf_lookups.py` rewrites them."""

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
    """Return random transforms of a small tree, and the results of random lookups in our buffer."""
    chance = random.Random(17)
    buffer = TransformBuffer()
    transforms: list[dict[str, Any]] = []
    for child, parent in FRAMES.items():
        # Times exceed 53 bits, and the spans of frames overlap only partly.
        start = 1_700_000_000_000_000_001 + chance.randrange(2_000) * MS
        stamps = [0] if child in STATIC else [start + k * chance.randrange(290, 310) * MS for k in range(45)]
        for stamp in stamps:
            translation = tuple(round(chance.uniform(-2, 2), 3) for _ in range(3))
            rotation = tuple(round(chance.gauss(0, 1), 3) for _ in range(4))
            transforms.append(
                {"parent": f"/{parent}" if chance.random() < 0.1 else parent, "child": child, "stamp": str(stamp)}
                | {"translation": translation, "rotation": rotation, "static": child in STATIC}
            )
    chance.shuffle(transforms)
    for stamped in transforms:
        transform = Transform(
            parent=stamped["parent"],
            child=stamped["child"],
            stamp_ns=int(stamped["stamp"]),
            translation=stamped["translation"],
            rotation=stamped["rotation"],
        )
        buffer.set_transform(transform, static=stamped["static"])
    names = [*FRAMES, "map", "elsewhere", "nowhere"]
    queries: list[dict[str, Any]] = []
    while len(queries) < 150:
        target, source = chance.sample(names, 2)
        stamp = 0 if chance.random() < 0.4 else 1_700_000_000_000_000_001 + chance.randrange(18_000) * MS
        queries.append(
            {"target": target, "source": source, "stamp": str(stamp)} | answer(buffer, target, source, stamp)
        )
    return {"transforms": transforms, "lookups": queries}


def answer(buffer: TransformBuffer, target: str, source: str, stamp: int) -> dict[str, Any]:
    try:
        buffer.path(target, source)  # two trees: the client reports this at any time, tf2 only if both have the time
        transform = buffer.lookup_transform(target, source, stamp)
    except TransformError as error:
        return {"error": next(words for words in WORDS if words in str(error))}
    translation, rotation = (
        [round(value, 9) for value in part] for part in (transform.translation, transform.rotation)
    )
    return {"translation": translation, "rotation": rotation}


def test_the_saved_lookups_match_our_buffer() -> None:
    saved = json.loads(FILE.read_text())

    assert saved == json.loads(json.dumps(lookups()))
    answered = [lookup for lookup in saved["lookups"] if "error" not in lookup]
    assert 50 <= len(answered) <= 100
    assert {lookup["error"] for lookup in saved["lookups"] if "error" in lookup} == {*WORDS} - {"at time"}


if __name__ == "__main__":
    FILE.write_text(json.dumps(lookups()).replace("}, {", "},\n{") + "\n")
