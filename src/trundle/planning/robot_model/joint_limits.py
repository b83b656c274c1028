"""joint_limits.yaml: limits that win over the URDF's."""

import math
from collections.abc import Mapping
from typing import Any, cast

from trundle.base.diagnostics import Diagnostics, Source, no_such
from trundle.base.xmlnode import MAX_NUMBER

_AT = Source("joint_limits")
_FLAGS = ("has_position_limits", "has_velocity_limits", "has_acceleration_limits", "has_jerk_limits")
_FLAGS_OF_OTHERS = ("angle_wraparound", "has_deceleration_limits", "has_effort_limits", "has_soft_limits")
_NUMBERS = ("min_position", "max_position", "max_velocity", "max_acceleration")
_NUMBERS_OF_OTHERS = (
    "max_jerk",
    "min_velocity",
    "max_deceleration",
    "max_effort",
    "k_position",
    "k_velocity",
    "soft_lower_limit",
    "soft_upper_limit",
)
"""Keys of ros_control's and Pilz' limits, of which MoveIt's model has no use."""


def read_joint_limits(
    limits: Mapping[str, Any] | None, variables: Mapping[str, object], report: Diagnostics
) -> dict[str, dict[str, float]]:
    """Return limits per variable: `min_position`, `max_position`, `max_velocity` and `max_acceleration`, as far as set.

    Args:
        limits: the file, or its section `joint_limits`.
        variables: the model's variables.
        report: collects findings.
    """
    if limits is None:
        return {}
    section: object = limits.get("joint_limits", limits)
    if not isinstance(section, Mapping):
        report.warn(_AT, f"joint_limits is {section!r}, not a list of joints; it is ignored", "invalid-value")
        return {}
    read: dict[str, dict[str, float]] = {}
    for key, values in cast(Mapping[object, object], section).items():
        name = str(key)
        if name.startswith("default_"):  # default_velocity_scaling_factor: move_group's
            continue
        if name not in variables:
            report.warn(_AT, f"{no_such('no joint', name, variables)}; its limits are ignored", "missing-link")
        elif not isinstance(values, Mapping):
            fault = f"the limits of joint {name!r} are {values!r}, not has_velocity_limits, max_velocity …"
            report.warn(_AT, f"{fault}; they are ignored", "invalid-value")
        else:
            read[name] = _limits(name, cast(Mapping[str, object], values), report)
    return read


def _limits(name: str, values: Mapping[str, object], report: Diagnostics) -> dict[str, float]:
    known = (*_FLAGS, *_FLAGS_OF_OTHERS, *_NUMBERS, *_NUMBERS_OF_OTHERS)
    for key in values:
        if key not in known:
            report.warn(
                _AT, f"joint {name!r}: {no_such('no limit', key, known)}; it is ignored", "unsupported-attribute"
            )
    read: dict[str, float] = {}
    for flag, keys in (
        ("has_position_limits", ("min_position", "max_position")),
        ("has_velocity_limits", ("max_velocity",)),
        ("has_acceleration_limits", ("max_acceleration",)),
    ):
        if values.get(flag) not in (True, 1):
            continue
        for key in keys:
            value = values.get(key)
            if value is None:
                fault = f"joint {name!r}: {flag}, but no {key}"
                report.warn(_AT, f"{fault}; the URDF's limit is used", "incomplete-element")
            elif isinstance(value, bool) or not isinstance(value, int | float) or not _is_limit(float(value)):
                fault = f"joint {name!r}: {key} is {value!r}, not a number within ±{MAX_NUMBER:g}"
                report.warn(_AT, f"{fault}; the URDF's limit is used", "invalid-value")
            elif key.startswith("max_") and key != "max_position" and value < 0:
                fault = f"joint {name!r}: {key} is {value:g}, less than 0"
                report.warn(_AT, f"{fault}; the URDF's limit is used", "out-of-range")
            else:
                read[key] = float(value)
    lower, upper = read.get("min_position", -math.inf), read.get("max_position", math.inf)
    if lower > upper:
        fault = f"joint {name!r}: min_position {lower:g} is above max_position {upper:g}"
        report.warn(_AT, f"{fault}; the URDF's limits are used", "swapped-limits")
        del read["min_position"], read["max_position"]
    return read


def _is_limit(value: float) -> bool:
    return math.isfinite(value) and abs(value) <= MAX_NUMBER
