"""Arms: a model of a URDF, an SRDF or limits that are not to be trusted, its kinematics, and a package made of it."""

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

import numpy as np
import yaml

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.base.xmlnode import parse_xml
from trundle.base.yaml_loader import load_yaml
from trundle.planning.kinematics import InverseKinematics, Kinematics, read_kinematics
from trundle.planning.robot_model import RobotModel, read_srdf, robot_model, write_srdf
from trundle.planning.setup_assistant import DescriptionSource, moveit_config
from trundle.robots.robot import read_robot

from .seeds import seed
from .target import Execute, Open, Target

_MOST_LINKS = 200
"""Links of a model whose kinematics are computed."""


def _use(model: RobotModel, settings: dict[str, Any] | None = None) -> None:
    """Ask all that planners ask of a model."""
    state = model.default_positions()
    assert state.shape == (len(model.variables),)
    assert np.isfinite(state).all()
    kinematics = Kinematics(model)
    if len(model.links) > _MOST_LINKS:
        return
    poses = kinematics.link_poses(state)
    for group in model.groups.values():
        try:
            solver = InverseKinematics(kinematics, group.name, settings=(settings or {}).get(group.name))
            found = solver.search(poses[model.links.index(solver.tip)], state, timeout=5e-4, consistency=None)
        except TrundleError:
            continue
        assert found.positions.shape == state.shape
        kinematics.manipulability(group.name, state, solver.tip)


def _model_of(kind: str) -> Open:
    @contextmanager
    def opened(_: Path) -> Generator[Execute]:
        urdf, srdf = seed("arm.urdf").decode(), seed("arm.srdf").decode()

        def execute(data: bytes) -> None:
            text = data.decode(errors="replace")
            report = Diagnostics()
            if kind == "urdf":
                _use(robot_model(text, srdf, None, report))
            elif kind == "srdf":
                _use(robot_model(urdf, text, None, report))
                written = write_srdf(read_srdf(text, Diagnostics()))
                read_srdf(written, Diagnostics())
            else:
                try:
                    values = load_yaml(text)
                except yaml.YAMLError:
                    return
                limits = cast("dict[str, Any]", values) if isinstance(values, dict) else {}
                model = robot_model(urdf, srdf, limits, report)
                _use(model, cast("dict[str, Any]", read_kinematics(limits, model.groups, report)))
            assert all("\n" not in finding.what for finding in report.findings), "a finding is one line"

        yield execute

    return opened


@contextmanager
def _open_package(_: Path) -> Generator[Execute]:
    """Make a package of a URDF."""

    def execute(data: bytes) -> None:
        text = data.decode(errors="replace")
        report = Diagnostics()
        robot = read_robot(parse_xml(text, name="arm.urdf", report=report), report)
        if len(robot.links) <= _MOST_LINKS // 10:
            source = DescriptionSource(robot=robot, text=text)
            for path in moveit_config(source, "p", report=report, trials=2):
                assert ".." not in path.split("/")

    yield execute


_WORDS = (
    b"<virtual_joint name='v' type='floating' parent_frame='o' child_link='base'/>", b"planar", b"prismatic",
    b"continuous", b"<mimic joint='elbow' multiplier='2'/>", b"<group name='a'><group name='a'/></group>",
    b"<chain base_link='base' tip_link='tool'/>", b"<disable_default_collisions link='tool'/>", b"1e308", b"-1",
    b"has_position_limits: true", b"kinematics_solver_timeout: 1e300",
)  # fmt: skip


def _seeds(*names: str) -> Any:
    return lambda: [seed(name) for name in names]


_YAML = _seeds("arm_limits.yaml", "arm_kinematics.yaml")
TARGETS = {
    "arm-urdf": Target(open=_model_of("urdf"), seeds=_seeds("arm.urdf"), words=_WORDS),
    "srdf": Target(open=_model_of("srdf"), seeds=_seeds("arm.srdf"), words=_WORDS, corpus=("repos/*/**/*.srdf",)),
    "joint-limits": Target(open=_model_of("limits"), seeds=_YAML, words=_WORDS),
    "moveit-config": Target(open=_open_package, seeds=_seeds("arm.urdf"), words=_WORDS),
}
