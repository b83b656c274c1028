"""Grasp counter: welds an object that stays between fingers, and releases it."""

import math
from collections import Counter
from collections.abc import Callable
from typing import Self

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation

from ..plugin import Plugin
from .arm import Arm
from .contact_average import ContactAverage, forces_oppose, group_by_pair

_DEFAULT_TOPIC = "__default_topic__"


class GraspFix(Plugin):
    """Welds an object to a palm after fingers have pressed it from opposite sides for a while.

    Parameters, with the original's defaults: any number of <arm> with <arm_name>, <palm_link> and <gripper_link> (any
    number); <update_rate> 5 [Hz, of simulated time; wall time in the original]; <forces_angle_tolerance> 120 [deg]
    (at least 90): forces further apart oppose; <max_grip_count> 10; <grip_count_threshold> (half of that): welds after
    more updates than this; <release_tolerance> 0.005 [m]: distance that a finger may move from the held object;
    <disable_collisions_on_attach> false: the held object collides with nothing.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, log: Callable[[str], object], tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._sim, self._log = sim, log
        self._angle_rad = math.radians(parameters.number("forces_angle_tolerance", 120.0))
        if self._angle_rad < math.pi / 2:
            parameters.warn(
                "<forces_angle_tolerance> is less than 90 degrees: nothing is ever held, as in the original"
            )
        self._update_period_ns = round(1e9 / parameters.integer("update_rate", 5, minimum=1))
        self._max_count = parameters.integer("max_grip_count", 10)
        self._threshold = parameters.integer("grip_count_threshold", self._max_count // 2)
        self._release_tolerance = parameters.number("release_tolerance", 0.005)
        disable_collisions = parameters.flag("disable_collisions_on_attach", default=False)
        if parameters.text("contact_topic", _DEFAULT_TOPIC).strip() != _DEFAULT_TOPIC:
            parameters.warn("<contact_topic> is ignored, as in the original")
        self._arms: dict[str, Arm] = {}
        for child in parameters.sections("arm"):
            self._add(child, model, disable_collisions)
        if not self._arms:
            raise UsageError("it needs an <arm> with fingers that have collisions")
        self._fingers = {name: (arm, link) for arm in self._arms.values() for name, link in arm.fingers.items()}
        self._finger_names = frozenset(self._fingers)
        parameters.report_unread()
        self._clear()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(sim, model, str if node is None else node.log.info, tag)

    def before_step(self, sim: Simulation) -> None:
        """Add the contacts of the last step; at the update rate, grasp or release."""
        self._record_contacts()
        if sim.time_ns < self._next_ns:
            return
        self._next_ns = sim.time_ns + self._update_period_ns
        touching, self._touching = self._touching, {}
        for arm in self._arms.values():
            if arm.is_joint_lost:
                arm.clear()
        held = {
            name
            for name, contacts in touching.items()
            if forces_oppose([contact.mean_force for contact in contacts.values()], self._angle_rad)
        }
        for name in sorted(held):
            self._count[name] = min(self._count[name] + 1, self._max_count)
            if self._count[name] > self._threshold:
                self._attach(name, list(touching[name].values()))
        for name in sorted(self._count.keys() - held):
            self._count[name] = max(self._count[name] - 1, 0)
            if self._count[name] <= self._threshold:
                self._detach_if_slipped(name)

    def reset(self) -> None:
        """Release every object."""
        for arm in self._arms.values():
            if arm.held and not arm.is_joint_lost:
                arm.detach()
        self._clear()

    def _clear(self) -> None:
        self._next_ns = self._sim.time_ns + self._update_period_ns
        self._touching: dict[str, dict[str, ContactAverage]] = {}
        """Object's collision → finger's collision → contact."""
        self._count: Counter[str] = Counter()
        """Object's collision → number of updates with a grip minus updates without."""

    def _add(self, parameters: TagParameters, model: ModelHandle, disable_collisions: bool) -> None:
        try:
            arm = Arm(self._sim, model, parameters, disable_collisions=disable_collisions)
        except UsageError as error:
            parameters.warn(f"<arm>: {error}; it is left out")
            return
        finally:
            parameters.report_unread()
        if arm.name in self._arms or not arm.fingers:
            reason = "another arm has this name" if arm.name in self._arms else "no finger has a collision"
            parameters.warn(f"arm {arm.name!r}: {reason}; it is left out")
            return
        self._arms[arm.name] = arm

    def _record_contacts(self) -> None:
        contacts = self._sim.contacts(self._finger_names)
        if not contacts:
            return
        for (name, finger), (forces, points) in group_by_pair(contacts, self._fingers).items():
            arm, link = self._fingers[finger]
            owner = self._sim[name.partition("::")[0]]
            if owner.model.static:
                continue
            averages = self._touching.setdefault(name, {})
            if finger not in averages:
                averages[finger] = ContactAverage(arm.name, link, _link_of(owner, name))
            averages[finger].add(forces, points)

    def _attach(self, name: str, contacts: list[ContactAverage]) -> None:
        """Attach an object to the arm with most fingers on it, unless an arm that touches it holds an object."""
        fingers = Counter(contact.arm for contact in contacts)
        if any(self._arms[arm].held for arm in fingers):
            return
        arm = self._arms[max(fingers, key=lambda arm: fingers[arm])]
        try:
            arm.attach(name, contacts[0].object_link, [contact for contact in contacts if contact.arm == arm.name])
        except TrundleError as error:
            self._sim.report.warn_error(
                error, arm.at, f"{name} is not held", "plugin-failed", subject=f"arm {arm.name!r}"
            )
            return
        self._log(f"grasp_fix: {arm.name} holds {name}")

    def _detach_if_slipped(self, name: str) -> None:
        arm = next((arm for arm in self._arms.values() if arm.held == name), None)
        if arm is not None and any(contact.slip_distance() > self._release_tolerance for contact in arm.grip):
            arm.detach()
            self._count[name] = 0
            self._log(f"grasp_fix: {arm.name} releases {name}")


def _link_of(model: ModelHandle, collision: str) -> LinkHandle:
    """Link of the collision `model::link::collision`."""
    return model.link(collision.removeprefix(f"{model.name}::").rpartition("::")[0])
