"""kinematics.yaml of the plugins in use is understood."""

from typing import Any

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.planning.kinematics import KinematicsSettings, read_kinematics

_KDL = "kdl_kinematics_plugin/KDLKinematicsPlugin"
_TRAC = "trac_ik_kinematics_plugin/TRAC_IKKinematicsPlugin"


def _read(**values: Any) -> tuple[KinematicsSettings, list[str]]:
    report = Diagnostics()
    return read_kinematics({"arm": values}, {"arm": None}, report)["arm"], report.warnings


def test_settings_are_read() -> None:
    settings, warnings = _read(
        kinematics_solver=_KDL,
        kinematics_solver_search_resolution=0.005,
        kinematics_solver_timeout=0.005,
        kinematics_solver_attempts=3,
        position_only_ik=True,
    )

    assert warnings == []
    assert settings == KinematicsSettings(solver=_KDL, timeout=0.005, position_only=True)


@pytest.mark.parametrize(
    ("solver", "solve_type"),
    [
        (_KDL, "Speed"),
        (_TRAC, "Speed"),
        ("lma_kinematics_plugin/LMAKinematicsPlugin", "Speed"),
        ("cached_ik_kinematics_plugin/CachedKDLKinematicsPlugin", "Speed"),
        ("bio_ik/BioIKKinematicsPlugin", "Distance"),
        ("panda_panda_arm/IKFastKinematicsPlugin", "Distance"),
        ("ur_kinematics/UR5KinematicsPlugin", "Distance"),
        ("moveit_opw_kinematics_plugin/MoveItOPWKinematicsPlugin", "Distance"),
    ],
)
def test_plugins_by_name(solver: str, solve_type: str) -> None:
    settings, warnings = _read(kinematics_solver=solver)

    assert (settings.solve_type, warnings) == (solve_type, [])


def test_trac_iks_solve_type() -> None:
    assert _read(kinematics_solver=_TRAC, solve_type="Manip2", epsilon=0.001) == (
        KinematicsSettings(solver=_TRAC, solve_type="Manip2", epsilon=0.001),
        [],
    )


@pytest.mark.parametrize(
    ("values", "fault"),
    [
        ({"kinematics_solver": "my/Solver"}, "group 'arm': no kinematics_solver 'my/Solver'; Trundle's own solves it"),
        ({"kinematics_solver_timeout": 0}, "kinematics_solver_timeout is 0, not a time > 0 s; the default is used"),
        ({"kinematics_solver_timeout": True}, "kinematics_solver_timeout is True, not a time > 0 s"),
        ({"position_only_ik": "yes"}, "position_only_ik is 'yes', not true or false"),
        ({"solve_type": "Fast"}, "solve_type is 'Fast', not one of Speed, Distance, Manip1, Manip2"),
        ({"epsilon": float("nan")}, "epsilon is nan, not a number > 0"),
        ({"kinematics_solver_tip": 3}, "kinematics_solver_tip is 3, not a link"),
        ({"timeout": 1}, "group 'arm': no setting 'timeout'"),
    ],
)
def test_faulty_settings_are_named(values: dict[str, Any], fault: str) -> None:
    settings, warnings = _read(**values)

    assert len(warnings) == 1
    assert fault in warnings[0]
    assert settings == KinematicsSettings(solver=str(values.get("kinematics_solver", "")))


def test_unknown_groups_are_named() -> None:
    report = Diagnostics()

    assert read_kinematics({"arn": {}, "arm": 3}, {"arm": None}, report) == {}
    assert "no group 'arn'; there are: 'arm'" in report.warnings[0]
    assert "group 'arm': 3 is no list of settings" in report.warnings[1]
