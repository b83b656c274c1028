"""Finds the packages that a launch needs and that are not here; nothing is run."""

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, TrundleError
from trundle.robots.description import expand_xacro
from trundle.robots.launch import LaunchPlan, read_launch, resolve_params
from trundle.robots.packages import LENIENT, Packages
from trundle.robots.repositories import repository_hint

from .request import LaunchRequest, read_request

_URI = re.compile(r"package://([\w-]+)/")


class _NotingPackages(Packages):
    """Packages that note the names of missing ones; what needs those is left out."""

    def __init__(self, environment: Mapping[str, str], *, start: Path, known: "_NotingPackages | None" = None) -> None:
        self._own = {**environment, LENIENT: "1"}
        super().__init__(self._own, start=start, known=known)
        self.missing: dict[str, None] = {} if known is None else known.missing

    def around(self, file: Path) -> "_NotingPackages":
        return _NotingPackages(self._own, start=file, known=self)

    def find_folder(self, name: str) -> Path | None:
        folder = super().find_folder(name)
        if folder is None:
            self.missing.setdefault(name)
        return folder

    def absent_package(self, file: Path) -> str | None:
        name = super().absent_package(file)
        if name is not None:
            self.missing.setdefault(name)
        return name


def missing_packages(words: Sequence[str], environment: Mapping[str, str]) -> list[str]:
    """Return the names of missing packages: of `$(find)`s, nodes, robots' files and meshes.

    Args:
        words: command line of a launch: PKG FILE or FILE…, and NAME:=VALUE.
        environment: where packages are searched.

    Raises:
        TrundleError: the launch cannot be read, for another reason.
    """
    packages = Packages(environment, start=Path.cwd())
    try:
        request = read_request(words, packages)
    except TrundleError as error:
        if not error.missing_packages:
            raise
        return list(error.missing_packages)
    for variables in packages.around(_start(request)).hook_variables().values():
        environment = {**environment, **variables}
    return [name for error in _errors(request, environment) for name in error.missing_packages]


def with_all_missing(
    error: DescriptionError, request: LaunchRequest, environment: Mapping[str, str]
) -> DescriptionError:
    """Return an error on missing packages with all others that the launch needs, too."""
    with suppress(TrundleError):
        others = [
            each for each in _errors(request, environment) if each.missing_packages[0] not in error.missing_packages
        ]
        names = (*error.missing_packages, *(name for each in others for name in each.missing_packages))
        return DescriptionError(error.at, error.what, more=[*error.more, *others], missing_packages=names)
    return error


def _errors(request: LaunchRequest, environment: Mapping[str, str]) -> list[DescriptionError]:
    """Return an error for each missing package, with the first place that needs it."""
    start = _start(request)
    packages = _NotingPackages(environment, start=start)
    report = Diagnostics()
    places: dict[str, Source] = {}
    try:
        plan = read_launch(
            request.files,
            packages=packages,
            report=report,
            arguments=request.arguments,
            texts=request.texts,
            env=environment,
        )
    except TrundleError:
        if not packages.missing:
            raise
    else:
        for node in plan.nodes:
            packages.find_folder(node.package)
            places.setdefault(node.package, node.at)
        _note_those_of_robots(plan, packages, report, environment, places)
    for name in packages.missing:
        found = (each.at for each in report.findings if f"no package {name!r}" in each.what)
        places[name] = next(found, None) or places.get(name) or Source(str(start))
    return [
        DescriptionError(places[name], f"no package {name!r}{repository_hint(name)}", missing_packages=(name,))
        for name in packages.missing
    ]


def _note_those_of_robots(
    plan: LaunchPlan,
    packages: _NotingPackages,
    report: Diagnostics,
    environment: Mapping[str, str],
    places: dict[str, Source],
) -> None:
    """Expand the robots of a launch as far as they can be without what is missing."""

    def expand(file: Path, arguments: Mapping[str, str]) -> str:
        return expand_xacro(file, arguments, packages=packages, report=report)

    for param in plan.params:
        with suppress(TrundleError):
            alone = replace(plan, params=(param,))
            (resolved,) = resolve_params(alone, report, expand_xacro=expand, env=environment, run=_run_nothing)
            for name in _URI.findall(resolved.value) if isinstance(resolved.value, str) else ():
                packages.find_folder(name)
                places.setdefault(name, param.at)


def _start(request: LaunchRequest) -> Path:
    return request.files[0] if request.files else Path.cwd()


def _run_nothing(_: Sequence[str], /, *, env: Mapping[str, str]) -> str:
    del env
    return ""
