"""Warp compiles annotated functions at run time; to the type checker all of it is Any."""

from typing import Any

def __getattr__(name: str) -> Any: ...
