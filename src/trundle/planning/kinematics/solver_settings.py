"""kinematics.yaml: which solver a group has, and its settings."""

from collections.abc import Callable, Mapping
from typing import Any, Literal, TypeAlias, cast, get_args

from msgspec import Struct

from trundle.base.diagnostics import Diagnostics, Source, no_such

SolveType: TypeAlias = Literal["Speed", "Distance", "Manip1", "Manip2"]
_AT = Source("kinematics.yaml")
_TYPES: tuple[str, ...] = get_args(SolveType)
_NEAREST = ("ikfast", "opw", "ur_kinematics", "bio_ik", "pick_ik", "pr2_arm_kinematics")
"""Plugins that compute all solutions, or weigh the motion, and return the one that is nearest to the seed."""
_KNOWN = ("kdl_kinematics_plugin", "trac_ik", "lma_kinematics_plugin", "cached_ik_kinematics_plugin", *_NEAREST)
_OTHERS = (
    "kinematics_solver_attempts",
    "kinematics_solver_search_resolution",
    "kinematics_solver_joint_limits",
    "kinematics_solver_ik_links",
    "goal_joint_tolerance",
    "goal_position_tolerance",
    "goal_orientation_tolerance",
    "max_solver_iterations",
    "orientation_vs_position",
    "joints",
    "urdf_param",
    "arm_prefix",
    "arm_name",
    "kinematics_solver_service_name",
)
"""Settings of other solvers, and of goals, without an effect on this one."""
_OTHER_PREFIXES = (
    "max_cache_size",
    "min_pose_distance",
    "min_joint_config_distance",
    "cached_ik_path",
    "bio_ik",
    "opw",
)


class KinematicsSettings(Struct, frozen=True, kw_only=True):
    """Settings of inverse kinematics."""

    solver: str = ""
    """Plugin named in kinematics.yaml."""
    timeout: float = 0.05
    """[s], converted into iterations; see `InverseKinematics`."""
    position_only: bool = False
    """True: the tip's rotation is free."""
    solve_type: SolveType = "Speed"
    """The first solution; of many, the nearest to the seed, the most manipulable, or the best conditioned one."""
    epsilon: float = 1e-5
    """Greatest error of a solution, of each component [m], [rad]."""
    tip: str = ""
    """Tip link; empty: the group's."""
    seed: int = 0
    """Seed of random restarts."""


def read_kinematics(
    values: Mapping[str, Any], groups: Mapping[str, object], report: Diagnostics
) -> dict[str, KinematicsSettings]:
    """Return the settings of groups.

    Args:
        values: kinematics.yaml, such as the parameter robot_description_kinematics.
        groups: the model's groups.
        report: collects findings.
    """
    read: dict[str, KinematicsSettings] = {}
    for name, section in values.items():
        if name not in groups:
            report.warn(_AT, f"{no_such('no group', name, groups)}; its settings are ignored", "missing-link")
        elif not isinstance(section, Mapping):
            report.warn(_AT, f"group {name!r}: {section!r} is no list of settings; it is ignored", "invalid-value")
        else:
            read[name] = _settings(name, cast(Mapping[str, Any], section), report)
    return read


def _settings(group: str, section: Mapping[str, Any], report: Diagnostics) -> KinematicsSettings:
    values = dict(section)
    read: dict[str, Any] = {}
    solver = str(values.pop("kinematics_solver", ""))
    folded = solver.lower()
    if solver and not any(known in folded for known in _KNOWN):
        fault = f"group {group!r}: no kinematics_solver {solver!r}"
        report.warn(_AT, f"{fault}; Trundle's own solves it, as it does for {', '.join(_KNOWN)}", "unknown-choice")
    read["solver"] = solver
    if any(name in folded for name in _NEAREST):
        read["solve_type"] = "Distance"
    for key, field, convert, expected in _FIELDS:
        if key not in values:
            continue
        value = convert(values.pop(key))
        if value is None:
            fault = f"group {group!r}: {key} is {section[key]!r}, not {expected}"
            report.warn(_AT, f"{fault}; the default is used", "invalid-value")
        else:
            read[field] = value
    for key in values:
        if key not in _OTHERS and not str(key).startswith(_OTHER_PREFIXES):
            known = (*(name for name, *_ in _FIELDS), *_OTHERS)
            fault = no_such("no setting", key, known)
            report.warn(_AT, f"group {group!r}: {fault}; it is ignored", "unsupported-attribute")
    return KinematicsSettings(**read)


def _positive(value: object) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value) if 0.0 < value < 1e6 else None


def _flag(value: object) -> bool | None:
    return value if isinstance(value, bool) else None


def _solve_type(value: object) -> str | None:
    return value if isinstance(value, str) and value in _TYPES else None


def _text(value: object) -> str | None:
    return value if isinstance(value, str) else None


_FIELDS: tuple[tuple[str, str, Callable[[object], object | None], str], ...] = (
    ("kinematics_solver_timeout", "timeout", _positive, "a time > 0 s"),
    ("position_only_ik", "position_only", _flag, "true or false"),
    ("solve_type", "solve_type", _solve_type, f"one of {', '.join(_TYPES)}"),
    ("epsilon", "epsilon", _positive, "a number > 0"),
    ("kinematics_solver_tip", "tip", _text, "a link"),
)
