"""Which renderer draws: the one that was asked for, never another."""

from collections.abc import Callable
from typing import Literal, TypeAlias

from trundle.physics import EglRenderer
from trundle.render import NativeRenderer, Renderer, Scene

RendererName: TypeAlias = Literal["cpu", "egl"]
RENDERERS: dict[RendererName, Callable[[Scene], Renderer]] = {"cpu": NativeRenderer, "egl": EglRenderer}
