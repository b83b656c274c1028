"""Registration of the ready environments with Gymnasium."""

from collections.abc import Callable

IDS = ("Trundle/ArmReach-v0", "Trundle/CartPole-v0", "Trundle/DriveToGoal-v0")
_MAKERS = "trundle.gym.ready"


def register_environments(register: Callable[..., None]) -> None:
    """Register each by its id.

    Args:
        register: Gymnasium's own.
    """
    for name in IDS:
        register(
            id=name,
            entry_point=f"{_MAKERS}:make_ready",
            vector_entry_point=f"{_MAKERS}:make_ready_vec",
            kwargs={"name": name},
        )
