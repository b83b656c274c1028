"""Files, parameters, worlds and models of a launch, read without starting it."""

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


def launch_inputs(read: LoadedLaunch) -> RunInputs:
    """Return what the nodes of a launch read as far as their command lines and parameters name it.

    Files that a program names in its own code are not among them.
    """
    files, worlds = list(read.plan.files), list(_described(read))
    for node in read.plan.nodes:
        found = find_node(node.package, node.type, read.packages.find_package, env=read.env, arguments=node.arguments)
        files += [found.path] if isinstance(found, Executable) else []
        packages = Packages({**read.env, **dict(node.env)}, start=read.start)
        for word in words_of(node):
            if os.path.isfile(word):
                files.append(Path(word))
            if node.package == "gazebo_ros":
                worlds += _loaded(word, packages)
    params = repr([(each.name, each.value) for each in read.params])
    return RunInputs(worlds=tuple(worlds), texts=(params,), files=tuple(files))


def words_of(node: LaunchNode) -> Iterator[str]:
    """Yield a node's arguments; models of the model path as URIs."""
    try:
        words = shlex.split(node.arguments)
    except ValueError:
        return  # the run says so
    for before, word in zip(["", *words], words, strict=False):
        yield f"model://{word}" if before == _DATABASE else os.path.expanduser(word.removeprefix("file://"))


def _loaded(word: str, packages: Packages) -> list[World]:
    """Return the world of a file or URI; none if it is neither."""
    if not (os.path.isfile(word) or word.startswith("model://") or packages.find_world(word) is not None):
        return []
    with suppress(TrundleError):  # the run says so
        return [load(word, Diagnostics(), packages=packages).world]
    return []


def _described(read: LoadedLaunch) -> Iterator[World]:
    """Yield the robots and models whose descriptions are parameters."""
    for param in read.params:
        if isinstance(param.value, str) and param.value.lstrip().startswith("<"):
            with suppress(TrundleError):
                text, report = param.value, Diagnostics()
                yield load_text(text, name=param.name, folder=Path.cwd(), packages=read.packages, report=report).world
