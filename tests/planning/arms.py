"""Small arms of tests/data/arms as robot models."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import Diagnostics
from trundle.planning.robot_model import RobotModel, robot_model

FOLDER = Path(__file__).parents[1] / "data" / "arms"
ARMS = ("six_axis", "seven_axis", "scara", "four_axis")


@cache
def arm(name: str) -> RobotModel:
    """Return an arm, which has no finding."""
    return changed_arm(name)


def changed_arm(
    name: str, *replaced: tuple[str, str], srdf: str = "", limits: Mapping[str, Any] | None = None
) -> RobotModel:
    """Return an arm as of `read_arm`, which must have no finding."""
    model, report = read_arm(name, *replaced, srdf=srdf, limits=limits)
    assert report.findings == []
    return model


def read_arm(
    name: str, *replaced: tuple[str, str], srdf: str = "", limits: Mapping[str, Any] | None = None
) -> tuple[RobotModel, Diagnostics]:
    """Return an arm with texts of its files replaced and elements added to its SRDF, and what was found."""
    report = Diagnostics()
    texts = [(FOLDER / f"{name}.{kind}").read_text() for kind in ("urdf", "srdf")]
    for old, new in replaced:
        assert any(old in text for text in texts)
        texts = [text.replace(old, new) for text in texts]
    return robot_model(texts[0], texts[1].replace("</robot>", f"{srdf}</robot>"), limits, report), report
