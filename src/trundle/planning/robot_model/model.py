"""Robot model: joints, links, groups and the state vector."""

from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError, no_such
from trundle.robots.robot import Robot

from .groups import EndEffector, JointModelGroup
from .joint_models import JointModel
from .srdf import DisabledPair

Positions = NDArray[np.float64]


class RobotModel:
    """Robot with its groups.

    A state is a float64 array (len(variables),) in the order of `variables` [rad, m].
    """

    def __init__(
        self,
        *,
        urdf: Robot,
        joints: Iterable[JointModel],
        model_frame: str,
        groups: Mapping[str, JointModelGroup],
        end_effectors: Mapping[str, EndEffector],
        disabled: Iterable[DisabledPair] = (),
        disabled_pairs: frozenset[frozenset[str]] = frozenset(),
        unchecked_links: frozenset[str] = frozenset(),
    ) -> None:
        """Take the parts of a model; `robot_model` makes them of files."""
        self.urdf = urdf
        """URDF's tree, with shapes and meshes."""
        self.name = urdf.name
        self.root_link = urdf.root
        self.model_frame = model_frame
        """Frame of poses: the root link, or the parent frame of a virtual joint that moves."""
        self.joints = tuple(joints)
        """Parents first, in MoveIt's order: depth first, children by name; the first one holds the root link."""
        self.links = tuple(joint.child_link for joint in self.joints)
        """Child link of each joint, in the same order."""
        self.groups = dict(groups)
        self.end_effectors = dict(end_effectors)
        self.disabled = tuple(disabled)
        """<disable_collisions>, with reasons."""
        self.disabled_pairs = disabled_pairs
        """Links that are not checked against each other."""
        self.unchecked_links = unchecked_links
        """Links that are checked only against those of <enable_collisions>, and against no object."""
        self.variables = tuple(name for joint in self.joints for name in joint.variables)
        """Names of the elements of a state, mimic joints' too."""
        self._index = {name: index for index, name in enumerate(self.variables)}
        self._joints = {joint.name: joint for joint in self.joints}
        self._parents = {joint.child_link: joint for joint in self.joints}

    def variable_index(self, name: str) -> int:
        """Return a variable's index in a state.

        Raises:
            UsageError: no such variable.
        """
        index = self._index.get(name)
        if index is None:
            raise UsageError(no_such("no variable", name, self.variables))
        return index

    def joint(self, name: str) -> JointModel:
        """Return a joint.

        Raises:
            UsageError: no such joint.
        """
        joint = self._joints.get(name)
        if joint is None:
            raise UsageError(no_such("no joint", name, self._joints))
        return joint

    def has_joint(self, name: str) -> bool:
        """Return True if there is a joint of this name."""
        return name in self._joints

    def parent_joint(self, link: str) -> JointModel:
        """Return the joint that holds a link.

        Raises:
            UsageError: no such link.
        """
        joint = self._parents.get(link)
        if joint is None:
            raise UsageError(no_such("no link", link, self.links))
        return joint

    def has_link(self, name: str) -> bool:
        """Return True if there is a link of this name."""
        return name in self._parents

    def group(self, name: str) -> JointModelGroup:
        """Return a group.

        Raises:
            UsageError: no such group.
        """
        group = self.groups.get(name)
        if group is None:
            raise UsageError(no_such("no group", name, self.groups))
        return group

    def indices(self, variables: Iterable[str]) -> NDArray[np.intp]:
        """Return indices of variables in a state.

        Raises:
            UsageError: no such variable.
        """
        return np.array([self.variable_index(name) for name in variables], dtype=np.intp)

    @cached_property
    def lower(self) -> Positions:
        """Lower limits per variable [rad] or [m]; see `JointModel.lower`."""
        return _frozen([value for joint in self.joints for value in joint.lower])

    @cached_property
    def upper(self) -> Positions:
        """Upper limits per variable [rad] or [m]."""
        return _frozen([value for joint in self.joints for value in joint.upper])

    @cached_property
    def is_bounded(self) -> NDArray[np.bool_]:
        """Per variable: False if it turns without end, or has no limit."""
        return np.array([flag for joint in self.joints for flag in joint.is_bounded], dtype=np.bool_)

    @cached_property
    def max_velocity(self) -> Positions:
        """Per variable [rad/s] or [m/s]; inf: unknown."""
        return _frozen([np.inf if v is None else v for joint in self.joints for v in joint.max_velocity])

    @cached_property
    def max_acceleration(self) -> Positions:
        """Per variable [rad/s²] or [m/s²]; inf: unknown."""
        return _frozen([np.inf if v is None else v for joint in self.joints for v in joint.max_acceleration])

    @cached_property
    def _mimics(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Positions, Positions]:
        followers = [joint for joint in self.joints if joint.mimic is not None]
        mimics = [joint.mimic for joint in followers if joint.mimic is not None]
        return (
            self.indices(joint.name for joint in followers),
            self.indices(mimic.joint for mimic in mimics),
            _frozen([mimic.multiplier for mimic in mimics]),
            _frozen([mimic.offset for mimic in mimics]),
        )

    def with_mimics(self, positions: Positions) -> Positions:
        """Return a copy of states (…, variables) in which mimic joints follow their leaders."""
        followers, leaders, multipliers, offsets = self._mimics
        state = np.array(positions, dtype=np.float64)
        if len(followers):
            state[..., followers] = state[..., leaders] * multipliers + offsets
        return state

    def default_positions(self) -> Positions:
        """Return the state of zeros, or the middle of the limits where zero is outside them."""
        with np.errstate(invalid="ignore"):
            state = np.where((self.lower <= 0.0) & (self.upper >= 0.0), 0.0, (self.lower + self.upper) / 2.0)
        for joint in self.joints:
            if joint.type == "floating":
                state[self._index[joint.variables[-1]]] = 1.0
        return self.with_mimics(state)

    def state_of(self, positions: Mapping[str, float], *, base: Positions | None = None) -> Positions:
        """Return a state with named variables set; others are as in `base`, or at their defaults.

        Raises:
            UsageError: no such variable.
        """
        state = np.array(self.default_positions() if base is None else base, dtype=np.float64)
        for name, value in positions.items():
            state[self.variable_index(name)] = value
        return self.with_mimics(state)

    def is_within_bounds(self, positions: Positions, *, margin: float = 0.0) -> bool:
        """Return True if each bounded variable is within its limits, widened by a margin [rad, m]."""
        inside = (positions >= self.lower - margin) & (positions <= self.upper + margin)
        return bool(np.all(inside | ~self.is_bounded))


def _frozen(values: list[float]) -> Positions:
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array
