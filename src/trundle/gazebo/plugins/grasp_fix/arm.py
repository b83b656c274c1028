"""One gripper: its palm, its fingers, and the object welded to it."""

from collections.abc import Sequence

from msgspec.structs import replace

from trundle.robots.model import Joint, JointType, Link, Model, Surface
from trundle.robots.parameters import TagParameters
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation

from .contact_average import ContactAverage


class Arm:
    """Gripper that holds one object at a time."""

    def __init__(
        self, sim: Simulation, model: ModelHandle, parameters: TagParameters, *, disable_collisions: bool
    ) -> None:
        """Read <arm>.

        Args:
            sim: the simulation.
            model: model of the gripper.
            parameters: <arm> with <arm_name>, <palm_link> and <gripper_link>.
            disable_collisions: True: a held object collides with nothing.

        Raises:
            UsageError: no such palm link.
        """
        self._sim, self._model, self._disable_collisions = sim, model, disable_collisions
        self.at = parameters.at
        self.name = parameters.text("arm_name", "")
        self.palm = model.link(parameters.text("palm_link"))
        self.fingers: dict[str, LinkHandle] = {}
        """Collision, `model::link::collision` → link of the finger."""
        for finger in parameters.texts("gripper_link"):
            link = next((link for link in model.links if link.name == finger), None)
            if link is None:
                links = ", ".join(repr(link.name) for link in model.links)
                parameters.warn(f"no link {finger!r}; links here: {links}; it is left out")
                continue
            names = (f"{model.name}::{link.name}::{collision.name}" for collision in link.link.collisions)
            self.fingers |= dict.fromkeys(names, link)
        self.held = ""
        """Held collision, `model::link::collision`; empty: none."""
        self.grip: list[ContactAverage] = []
        """Contacts of the fingers at the grasp."""
        self._surfaces: list[Surface] = []

    @property
    def _joint(self) -> str:
        return f"{self._model.name}::{self.name}::grasp"

    def attach(self, collision: str, link: LinkHandle, grip: list[ContactAverage]) -> None:
        """Weld an object's link to the palm in its current pose.

        Args:
            collision: object's collision, `model::link::collision`.
            link: link of the collision.
            grip: contacts of the fingers with the object.

        Raises:
            TrundleError: the links cannot be joined; nothing is changed.
        """
        child, parent = collision.rpartition("::")[0], f"{self._model.name}::{self.palm.name}"
        self._sim.attach(Joint(name=self._joint, type=JointType.FIXED, parent=parent, child=child, at=self.at))
        self.held, self.grip = collision, grip
        self._surfaces = [shape.surface for shape in link.link.collisions]
        if self._disable_collisions:
            self._set_surfaces(
                child, [replace(collision, collide_bitmask=0, category_bitmask=0) for collision in self._surfaces]
            )

    def detach(self) -> None:
        """Release the object."""
        self._sim.detach(self._joint)
        if self._disable_collisions:
            self._set_surfaces(self.held.rpartition("::")[0], self._surfaces)
        self.clear()

    def clear(self) -> None:
        """Clear the held object."""
        self.held, self.grip = "", []

    @property
    def is_joint_lost(self) -> bool:
        """True if another part removed the joint, as when a model is deleted."""
        return bool(self.held) and all(joint.name != self._joint for joint in self._sim.joints)

    def _set_surfaces(self, path: str, surfaces: Sequence[Surface]) -> None:
        """Set the surfaces of the collisions of `model::link`."""
        owner, _, name = path.partition("::")
        world = self._sim.world

        def with_surfaces(model: Model) -> Model:
            if model.name != owner:
                return model
            return replace(
                model,
                links=tuple(_with_surfaces(link, surfaces) if link.name == name else link for link in model.links),
            )

        self._sim.edit(replace(world, models=tuple(map(with_surfaces, world.models))))


def _with_surfaces(link: Link, surfaces: Sequence[Surface]) -> Link:
    pairs = zip(link.collisions, surfaces, strict=True)
    return replace(link, collisions=tuple(replace(collision, surface=surface) for collision, surface in pairs))
