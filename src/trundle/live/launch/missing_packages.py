"""Finds the missing packages of a launch without running anything."""

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


class _RecordingPackages(Packages):
    """Finder that records the names of missing packages, and leaves out their files."""

    def __init__(
        self, environment: Mapping[str, str], *, start: Path, fallback: "_RecordingPackages | None" = None
    ) -> None:
        environment = {**environment, LENIENT: "1"}
        super().__init__(environment, start=start, fallback=fallback)
        self.missing: dict[str, None] = {} if fallback is None else fallback.missing

    def around(self, file: Path) -> "_RecordingPackages":
        return _RecordingPackages(self._environment, start=file, fallback=self)

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
    """Return the names of missing packages, from `$(find)`s, nodes, robots' files and meshes.

    Args:
        words: a launch's command line: PKG FILE or FILE…, and NAME:=VALUE.
        environment: environment variables that locate packages.

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
    """Extend an error on missing packages by all other missing packages of the launch."""
    with suppress(TrundleError):
        others = [
            other for other in _errors(request, environment) if other.missing_packages[0] not in error.missing_packages
        ]
        names = (*error.missing_packages, *(name for other in others for name in other.missing_packages))
        return DescriptionError(error.at, error.what, error.id, more=[*error.more, *others], missing_packages=names)
    return error


def _errors(request: LaunchRequest, environment: Mapping[str, str]) -> list[DescriptionError]:
    """Return an error for each missing package, at the first line that needs it."""
    start = _start(request)
    packages = _RecordingPackages(environment, start=start)
    report = Diagnostics()
    sources: dict[str, Source] = {}
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
            sources.setdefault(node.package, node.at)
        _find_packages_of_robots(plan, packages, report, environment, sources)
    for name in packages.missing:
        reported = (finding.at for finding in report.findings if f"no package {name!r}" in finding.what)
        sources[name] = next(reported, None) or sources.get(name) or Source(str(start))
    return [
        DescriptionError(
            sources[name], f"no package {name!r}{repository_hint(name)}", "missing-package", missing_packages=(name,)
        )
        for name in packages.missing
    ]


def _find_packages_of_robots(
    plan: LaunchPlan,
    packages: _RecordingPackages,
    report: Diagnostics,
    environment: Mapping[str, str],
    sources: dict[str, Source],
) -> None:
    """Expand the robots of a launch as far as possible without the missing packages."""

    def expand(file: Path, arguments: Mapping[str, str]) -> str:
        return expand_xacro(file, arguments, packages=packages, report=report)

    for param in plan.params:
        with suppress(TrundleError):
            alone = replace(plan, params=(param,))
            (resolved,) = resolve_params(alone, report, expand_xacro=expand, env=environment, run=_run_nothing)
            for name in _URI.findall(resolved.value) if isinstance(resolved.value, str) else ():
                packages.find_folder(name)
                sources.setdefault(name, param.at)


def _start(request: LaunchRequest) -> Path:
    return request.files[0] if request.files else Path.cwd()


def _run_nothing(_: Sequence[str], /, *, env: Mapping[str, str]) -> str:
    del env
    return ""
