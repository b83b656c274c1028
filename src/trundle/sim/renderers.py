"""Renderers by name."""

import os
from collections.abc import Callable
from typing import Literal, TypeAlias

from trundle.sim.physics import EglRenderer
from trundle.sim.render import NativeRenderer, Renderer, Scene

RendererName: TypeAlias = Literal["cpu", "egl"]
_MAX_THREADS = 8


def _native(scene: Scene) -> Renderer:
    return NativeRenderer(scene, threads=min(os.cpu_count() or 1, _MAX_THREADS))


RENDERERS: dict[RendererName, Callable[[Scene], Renderer]] = {"cpu": _native, "egl": EglRenderer}
