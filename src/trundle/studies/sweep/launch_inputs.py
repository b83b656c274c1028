"""Input files, parameters, worlds and models of a launch, read without starting it."""

import os
import shlex
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.gazebo.nodes import Executable, find_node
from trundle.live.launch.loaded_launch import LoadedLaunch
from trundle.robots.description import load, load_text
from trundle.robots.launch import LaunchNode
from trundle.robots.model import World
from trundle.robots.packages import Packages

from .plan_digest import RunInputs

_DATABASE = "-database"


def launch_inputs(launch: LoadedLaunch) -> RunInputs:
    """Return the inputs of a launch that its nodes' command lines and parameters name.

    Files named in a program's own code are not included.
    """
    files, worlds = list(launch.plan.files), list(_described(launch))
    for node in launch.plan.nodes:
        executable = find_node(
            node.package, node.type, launch.packages.find_package, env=launch.env, arguments=node.arguments
        )
        files += [executable.path] if isinstance(executable, Executable) else []
        packages = Packages({**launch.env, **dict(node.env)}, start=launch.start)
        for word in words_of(node):
            if os.path.isfile(word):
                files.append(Path(word))
            if node.package == "gazebo_ros":
                worlds += _loaded(word, packages)
    params = repr([(param.name, param.value) for param in launch.params])
    return RunInputs(worlds=tuple(worlds), texts=(params,), files=tuple(files))


def words_of(node: LaunchNode) -> Iterator[str]:
    """Yield a node's arguments; models on the model path as URIs."""
    try:
        words = shlex.split(node.arguments)
    except ValueError:
        return  # the run reports the error
    for before, word in zip(["", *words], words, strict=False):
        yield f"model://{word}" if before == _DATABASE else os.path.expanduser(word.removeprefix("file://"))


def _loaded(word: str, packages: Packages) -> list[World]:
    """Return the world of a file or URI; empty for another word."""
    if not (os.path.isfile(word) or word.startswith("model://") or packages.find_world(word) is not None):
        return []
    with suppress(TrundleError):  # the run reports the error
        return [load(word, Diagnostics(), packages=packages).world]
    return []


def _described(launch: LoadedLaunch) -> Iterator[World]:
    """Yield the worlds of robots and models described by parameters."""
    for param in launch.params:
        if isinstance(param.value, str) and param.value.lstrip().startswith("<"):
            with suppress(TrundleError):
                text, report = param.value, Diagnostics()
                yield load_text(text, name=param.name, folder=Path.cwd(), packages=launch.packages, report=report).world
