"""Finds the packages that a launch file needs and that are not here; nothing is run."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.robots.description import expand_xacro
from trundle.robots.launch import read_launch, resolve_params
from trundle.robots.packages import Packages

from .launch.request import read_request

_URI = re.compile(r"package://([\w-]+)/")


def missing_packages(words: Sequence[str], environment: Mapping[str, str]) -> list[str]:
    """Return the names of missing packages: of `$(find)`s, nodes, robots' files and meshes.

    Args:
        words: command line of a launch: PKG FILE or FILE…, and NAME:=VALUE.
        environment: where packages are searched.

    Raises:
        TrundleError: the launch cannot be read, for another reason.
    """
    packages = Packages(environment, start=Path.cwd())
    report = Diagnostics()
    try:
        request = read_request(words, packages)
        packages = packages.around(request.files[0]) if request.files else packages
        plan = read_launch(
            request.files,
            packages=packages,
            report=report,
            arguments=request.arguments,
            texts=request.texts,
            env=environment,
        )

        def expand(file: Path, arguments: Mapping[str, str]) -> str:
            return expand_xacro(file, arguments, packages=packages, report=report)

        params = resolve_params(plan, report, expand_xacro=expand, env=environment, run=_run_nothing)
    except TrundleError as error:
        if not error.missing_packages:
            raise
        return list(error.missing_packages)
    nodes = [node.package for node in plan.nodes]
    meshes = [name for param in params if isinstance(param.value, str) for name in _URI.findall(param.value)]
    return [name for name in dict.fromkeys((*nodes, *meshes)) if packages.find_folder(name) is None]


def _run_nothing(_: Sequence[str], /, *, env: Mapping[str, str]) -> str:
    del env
    return ""
