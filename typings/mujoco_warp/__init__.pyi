"""MuJoCo on Warp belongs to the extra `gpu`; to the type checker all of it is Any."""

from typing import Any

def __getattr__(name: str) -> Any: ...
