"""Bodies of a specification, built in batches: MuJoCo walks a whole specification whenever something is added to it."""

import warnings

import mujoco

from trundle.spatial import Pose

from .solver_settings import apply_settings, silence_log

_MANY = 250
"""Number of bodies at which a batch is full."""


class BodyBatches:
    """The first bodies of a world are in its specification, the others in separate ones until `attach`."""

    def __init__(self, spec: mujoco.MjSpec) -> None:
        self._spec = spec
        self._world = spec.worldbody
        self._frames: list[mujoco.MjsFrame] = []
        self._free = _MANY
        """Number of bodies that still fit into the last batch."""
        self.bodies = [self._world]
        """All bodies, the world's first."""

    def add_body(self, parent: mujoco.MjsBody | None, *, name: str, pose: Pose) -> mujoco.MjsBody:
        """Add a body below another, or below the world if there is no other."""
        if parent is None and self._free <= 0:
            self._start_batch()
        body = (parent or self._world).add_body(name=name, pos=pose.position, quat=pose.quaternion)
        if parent is None and self._frames:
            body.set_frame(self._frames[-1])
        self._free -= 1
        self.bodies.append(body)
        return body

    def _start_batch(self) -> None:
        batch = mujoco.MjSpec()
        apply_settings(batch)
        batch.default.name = (
            f"batch{len(self._frames)}"  # defaults are attached, too; two of one name would make invalid MJCF
        )
        self._world = batch.worldbody
        self._frames.append(self._world.add_frame())
        self._free = _MANY

    def attach(self) -> None:
        """Attach the batches to the world, in order."""
        silence_log()
        for frame in self._frames:
            self._spec.worldbody.attach_frame(frame, "", "")


def ignore_attach_warning() -> None:
    """Ignore, within `warnings.catch_warnings`, MuJoCo's warning about attached names; ours are unique."""
    warnings.filterwarnings("ignore", message="Attaching a spec with an empty prefix")
