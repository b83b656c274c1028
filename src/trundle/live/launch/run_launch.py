"""`trundle launch`: sets a launch file's parameters and runs its nodes until they end or Ctrl-C."""

import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.console import Console
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.base.files import is_stream
from trundle.base.signals import StopFlag, blind_wait, stop_flag
from trundle.page.network_warning import warn_of_network
from trundle.robots.launch import ROS_VARIABLES, LaunchParam, LaunchPlan, read_arguments, read_launch, resolve_params
from trundle.robots.packages import Packages
from trundle.ros import MasterProxy, MasterUnreachableError, master_uri_from_env
from trundle.spatial import NS_PER_S

from . import printing
from .loaded_launch import LoadedLaunch
from .options import LaunchOptions
from .request import LaunchRequest, read_request

if TYPE_CHECKING:
    from trundle.ros import Clock

_CLOCK_TIMEOUT_S = 5.0


def launch(words: Sequence[str], options: LaunchOptions, environment: Mapping[str, str] | None = None) -> int:
    """Launch; return the exit code: 0 at the end of --duration, 1 if a required node or recording failed.

    Like roslaunch, it ends with its last node only if it joined a running master.

    Args:
        words: the command line: PKG FILE or FILE…, and NAME:=VALUE.
        options: launch options.
        environment: environment variables; None: os.environ.

    Raises:
        TrundleError: an invalid file or request.
    """
    loaded = read_files(words, options, dict(os.environ if environment is None else environment))
    if loaded is None:
        return 0
    show = loaded.show
    warn_of_network(options.host, show.line)
    if options.verbose:
        _print_summary(loaded.plan, loaded.params, show.line)
        for folder, reason in loaded.packages.skipped_folders().items():
            show.line(f"packages are not searched in {folder}: {reason}")
    with stop_flag() as stop:
        if options.wait_for_master and not _wait_for_master(loaded.env, stop, show.line):
            return 130

        def read_again() -> LoadedLaunch:
            if any(word == "-" or is_stream(word) for word in words):
                raise UsageError("the launch came through a pipe, which cannot be read again")
            reread = read_files(words, options, dict(os.environ if environment is None else environment))
            assert reread is not None
            return reread

        if options.pid_file is None:
            return _run(loaded, options, stop, read_again)
        pid_file = options.pid_file.expanduser()
        pid_file.parent.mkdir(parents=True, exist_ok=True)
        pid_file.write_text(str(os.getpid()))
        try:
            return _run(loaded, options, stop, read_again)
        finally:
            pid_file.unlink(missing_ok=True)


def read_files(words: Sequence[str], options: LaunchOptions, env: dict[str, str]) -> LoadedLaunch | None:
    """Read the files of the command line; None: --nodes or the like printed them, nothing to run.

    Raises:
        TrundleError: an invalid file or request; an error on a missing package names all missing ones.
    """
    if options.master_port is not None:
        env["ROS_MASTER_URI"] = f"http://localhost:{options.master_port}"
    if options.distro is not None:
        env["ROS_DISTRO"] = options.distro
    for name, value in ROS_VARIABLES.items():  # nodes read them, too
        env.setdefault(name, value)
    packages = Packages(env, start=Path.cwd())
    request = LaunchRequest() if options.core_only else read_request(words, packages)
    try:
        return _read(request, options, packages, env)
    except DescriptionError as error:
        if not error.missing_packages:
            raise
        from .missing_packages import with_all_missing

        raise with_all_missing(error, request, env) from None


def _read(
    request: LaunchRequest, options: LaunchOptions, packages: Packages, env: dict[str, str]
) -> LoadedLaunch | None:
    report = Diagnostics(strict=options.strict)
    show = Console(sys.stderr, report, quiet=options.quiet)
    start = request.files[0] if request.files else Path.cwd()
    packages = packages.around(start)
    for package, variables in packages.hook_variables().items():
        env.update(variables)
        show.note(f"set {', '.join(variables)} as the environment hooks of {package} do")
    if options.only == "arguments":
        for file in request.files:
            declared = read_arguments(file, packages=packages, report=report, arguments=request.arguments, env=env)
            print(printing.arguments(declared))
        return None
    plan = read_launch(
        request.files,
        packages=packages,
        report=report,
        arguments=request.arguments,
        texts=request.texts,
        env=env,
        namespace="/" + (request.namespace or env.get("ROS_NAMESPACE", "")).strip("/"),
    )
    packages.warn_of_finds(report, Source(str(start)))
    for path in packages.configured_files:
        show.note(f"wrote {path} from its template, as catkin_make does")
    show.findings()
    if options.only is not None and options.only != "params":
        print(_printed(options, plan, packages, env))
        return None

    def expand(file: Path, arguments: Mapping[str, str]) -> str:
        from trundle.robots.description import expand_xacro

        return expand_xacro(file, arguments, packages=packages, report=report)

    params = resolve_params(plan, report, expand_xacro=expand, env=env)
    show.findings()
    if options.only == "params":
        print(printing.parameters(params))
        return None
    nodes = tuple(node for node in plan.nodes if node.address is not None)
    if len(nodes) < len(plan.nodes) and not packages.is_lenient:
        node = next(node for node in plan.nodes if node.address is None)
        raise DescriptionError(node.at, f"node {node.name!r}: there is no machine {node.machine!r}", "unknown-machine")
    plan = replace(plan, nodes=nodes)  # --lenient may have left the machine out
    return LoadedLaunch(plan=plan, params=params, packages=packages, start=start, env=env, report=report, show=show)


def _run(loaded: LoadedLaunch, options: LaunchOptions, stop: StopFlag, read_again: Callable[[], LoadedLaunch]) -> int:
    from .session import LaunchSession

    with LaunchSession(loaded, options, read_again=read_again) as session:
        running, clock = session.start(loaded.plan.nodes, is_ending=stop.is_set), session.clock
        duration = None
        if options.duration_s is not None:
            duration = _LaunchDuration(
                clock,
                options.duration_s,
                in_step=session.is_lockstep,
                has_world_ended=lambda: running.has_world_ended(),
                say=loaded.show.line,
            )
        is_over = False
        clock_warning = _ClockWarning(clock, loaded.show.line)
        while not stop.wait(0.05) and not is_over and not (duration is not None and duration.is_over()):
            session.show.findings()
            clock_warning.check()
            if session.is_reload_due:
                running = session.reload(is_ending=stop.is_set)
                session.show.note("the launch is loaded again")
            is_over = session.is_over or running.required_died or (running.is_over and not session.has_master)
            is_over = is_over or session.recording_failed
        required_failed = running.required_failed
    if session.recording_failed:  # recording failed, or closing the bag did
        return 1
    if stop.is_set():
        return 130
    return 1 if required_failed else 0


def _printed(options: LaunchOptions, plan: LaunchPlan, packages: Packages, env: Mapping[str, str]) -> str:
    match options.only:
        case "nodes":
            return printing.node_names(plan)
        case "files":
            return printing.file_names(plan)
        case "find-node":
            return printing.node_file(plan, options.node)
        case "translation":
            return printing.translations(plan, packages, env)
        case _:
            return printing.node_command(plan, options.node, packages, env)


def _print_summary(plan: LaunchPlan, params: Sequence[LaunchParam], say: Callable[[str], None]) -> None:
    for file in plan.files:
        say(f"... loading XML file [{file}]")
    for param in params:
        say(f"Added parameter [{param.name}]")
    for node in plan.nodes:
        say(f"Added node of type [{node.package}/{node.type}] in namespace [{node.namespace}]")


def _wait_for_master(env: Mapping[str, str], stop: StopFlag, say: Callable[[str], None]) -> bool:
    """Wait until a master answers; return False if stopped first."""
    proxy = MasterProxy(env.get("ROS_MASTER_URI") or master_uri_from_env())
    is_reported = False
    while True:
        try:
            with blind_wait():
                proxy.call("getPid")
        except MasterUnreachableError:
            if not is_reported:
                say("roscore/master is not yet running, will wait for it to start")
            is_reported = True
        else:
            say("master has started, initiating launch")
            return True
        if stop.wait(0.1):
            return False


class _LaunchDuration:
    """Counts ROS time, and wall time once the world has ended."""

    def __init__(
        self,
        clock: "Clock",
        duration_s: float,
        *,
        in_step: bool,
        has_world_ended: Callable[[], bool],
        say: Callable[[str], None],
    ) -> None:
        """Start counting.

        Args:
            clock: ROS time of the nodes.
            duration_s: duration of the launch [s].
            in_step: True: time starts at zero, and the stepping thread detects the end.
            has_world_ended: True if the world that published /clock has ended.
            say: prints that the rest is counted in wall time.
        """
        self._clock = clock
        self._in_step = in_step
        self._has_world_ended = has_world_ended
        self._say: Callable[[str], None] | None = say
        self._end_ns = round(duration_s * NS_PER_S) + (0 if in_step else clock.now_ns())
        self._wall_ns = 0
        self._polled_ns = time.monotonic_ns()

    def is_over(self) -> bool:
        """Return True if the time has passed; to be polled."""
        now_ns = time.monotonic_ns()
        world_ended = self._has_world_ended()
        if world_ended:
            self._wall_ns += now_ns - self._polled_ns
            if self._say is not None:
                self._say(
                    "the simulation has ended, and ROS time with it; the rest of --duration is counted in wall time"
                )
                self._say = None
        self._polled_ns = now_ns
        return (world_ended or not self._in_step) and self._clock.now_ns() + self._wall_ns >= self._end_ns


class _ClockWarning:
    """Warns once if /use_sim_time is true but nothing publishes /clock, so that every node's time stands still."""

    def __init__(self, clock: "Clock", say: Callable[[str], None]) -> None:
        self._clock = clock
        self._say: Callable[[str], None] | None = say
        self._deadline_s = time.monotonic() + _CLOCK_TIMEOUT_S

    def check(self) -> None:
        """Warn if no time was published for 5 s; to be polled."""
        if self._say is None or self._clock.now_ns() > 0:
            self._say = None
        elif time.monotonic() > self._deadline_s:
            self._say("/use_sim_time is true, but nothing has published a time on /clock yet (a simulation, a bag?)")
            self._say = None
