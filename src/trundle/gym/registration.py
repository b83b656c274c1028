"""Registration of the built-in environments with Gymnasium."""

from collections.abc import Callable

IDS = ("Trundle/ArmReach-v0", "Trundle/CartPole-v0", "Trundle/DriveToGoal-v0")
_ENTRY_POINTS = "trundle.gym.ready"


def register_environments(register: Callable[..., None]) -> None:
    """Register all built-in environments.

    Args:
        register: `gymnasium.register`.
    """
    for name in IDS:
        register(
            id=name,
            entry_point=f"{_ENTRY_POINTS}:make_ready",
            vector_entry_point=f"{_ENTRY_POINTS}:make_ready_vec",
            kwargs={"name": name},
        )
