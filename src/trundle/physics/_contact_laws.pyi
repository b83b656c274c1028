from collections.abc import Sequence

VERSION: int
"""Of the MuJoCo whose headers this was compiled with, as `mujoco.mj_version()` has it."""

def names() -> list[str]:
    """What `bind` takes the addresses of."""

def bind(addresses: Sequence[int]) -> None: ...
def install() -> None:
    """Have MuJoCo call the laws in every step, behind whoever it calls now."""

def report_efforts(model: int, data: int) -> None:
    """Write what motors exert to qfrc_actuator, after a step. Both by their addresses."""
