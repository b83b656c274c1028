"""`trundle test`: runs each <test> node of launch files in a separate launch, as rostest does."""

import os
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from trundle.base.console import say
from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.base.supervisor import Job, JobError, StopTimeouts
from trundle.robots.launch import LaunchTest
from trundle.ros import GraphLoop, MasterProxy, MasterUnreachableError, master_uri_from_env

from .loaded_launch import LoadedLaunch
from .logs import ros_home
from .options import LaunchOptions
from .run_launch import read_files
from .session import LaunchSession
from .test_options import LaunchTestOptions
from .test_results import CaseResult, SuiteResult, read_result, write_junit


def run_tests(
    words: Sequence[str],
    options: LaunchOptions,
    test_options: LaunchTestOptions,
    *,
    environment: Mapping[str, str] | None = None,
) -> int:
    """Run every test; return rostest's exit code: 0: all passed, 1: one did not run, 2: a case failed.

    Args:
        words: the command line: PKG FILE or FILE…, and NAME:=VALUE.
        options: launch options.
        test_options: options of `trundle test`.
        environment: environment variables; None: os.environ.

    Raises:
        TrundleError: an invalid file or request.
    """
    if test_options.clear and not test_options.reuse_master:
        raise UsageError("--clear is only valid with --reuse-master: a test's own graph has no parameters yet")
    env = dict(os.environ if environment is None else environment)
    if test_options.reuse_master:
        env["ROS_MASTER_URI"] = _answering_master(env)
    else:
        env.pop("ROS_MASTER_URI", None)  # each test gets a new graph
    loaded = read_files(words, options, env)
    if loaded is None:
        return 0
    if not loaded.plan.tests:
        raise UsageError("no <test> in these launch files; trundle launch starts their nodes")
    with tempfile.TemporaryDirectory() as temporary:
        package = _package_of(loaded, test_options)
        folder = Path(temporary) if test_options.text else _results_folder(env, test_options, package)
        suites = [_run(loaded, options, test_options, test, folder) for test in loaded.plan.tests]
    for suite in suites:
        for case in suite.cases:
            problem = f"\n  {case.problem}" if case.problem else ""
            print(f"[{suite.name}/{case.name}][{case.verdict}]{problem}")
    junit = test_options.junit
    if junit is None and not test_options.text:
        junit = folder / f"rostest-{_name_of(loaded, test_options)}.xml"
    if junit is not None:
        write_junit(junit, suites)
    failures = sum(suite.failures for suite in suites)
    errors = sum(suite.errors for suite in suites)
    verdict = "SUCCESS" if failures + errors == 0 else "FAIL"
    tests = sum(len(suite.cases) for suite in suites)
    print(f"\nSUMMARY\n * RESULT: {verdict}\n * TESTS: {tests}\n * ERRORS: {errors}\n * FAILURES: {failures}")
    if not all(suite.did_run for suite in suites):
        return 1
    return 0 if verdict == "SUCCESS" else 2


def _run(
    loaded: LoadedLaunch, options: LaunchOptions, test_options: LaunchTestOptions, test: LaunchTest, folder: Path
) -> SuiteResult:
    """Run a test, with its retries, and return the last result; its program writes into `folder`."""
    name = f"{test.node.package}.{test.name}"
    for left in range(test.retries, -1, -1):
        started = time.monotonic()
        if test_options.clear:
            _clear_params(MasterProxy(loaded.env["ROS_MASTER_URI"]))
        with LaunchSession(loaded, replace(options, summary=False), ports=(0,), rosout=False) as session:
            session.start(loaded.plan.nodes)
            did_run, cases = _attempt(session, test, folder / f"rosunit-{test.name}.xml", text=test_options.text)
        seconds = time.monotonic() - started
        suite = SuiteResult(name=name, seconds=seconds, cases=tuple(cases), did_run=did_run)
        if left == 0 or suite.failures + suite.errors == 0:
            return suite
        loaded.show.line(f"test {test.name!r} did not pass; {left} more {'try' if left == 1 else 'tries'}")
    raise AssertionError("the last try returns")


@dataclass(frozen=True, slots=True)
class _ProgramExit:
    code: int | None
    """Exit code; None: timed out."""
    output: list[str]


def _attempt(
    session: LaunchSession, test: LaunchTest, result: Path, *, text: bool
) -> tuple[bool, Sequence[CaseResult]]:
    """Run a test's program; return (True if it ended in time and left results, its cases)."""

    def did_not_run(problem: str, *, is_error: bool = True) -> tuple[bool, Sequence[CaseResult]]:
        return False, [CaseResult(name=test.name, problem=problem, is_error=is_error)]

    result.unlink(missing_ok=True)
    arguments = (f"--gtest_output=xml:{result}", *(["--text"] if text else []))
    try:
        prepared = session.starter.prepare(test.node, f"test-{test.name}", show=_show, extra_arguments=arguments)
    except DescriptionError as error:
        return did_not_run(str(error))
    if prepared.job is None:
        return did_not_run(prepared.detail)
    try:
        ended = _wait_for_exit(session.graph.loop, prepared.job, test.time_limit_s)
    except JobError as error:
        return did_not_run(str(error))
    if ended.code is None:
        return did_not_run(f"it took more than its {test.time_limit_s:g} s", is_error=False)
    if result.is_file():
        return True, read_result(result, test.name)
    if prepared.kind == "process" and not text:
        output = "\n  ".join(["", *ended.output])
        problem = f"it wrote no results ({result}), and ended with exit code {ended.code}{output}"
        return did_not_run(problem)
    return True, [CaseResult(name=test.name, problem="" if ended.code == 0 else f"exit code {ended.code}")]


def _wait_for_exit(loop: GraphLoop, job: Job, limit_s: float) -> _ProgramExit:
    loop.run(job.start())
    try:
        code = loop.run(job.wait(), limit_s)
    except TimeoutError:
        code = None
    finally:  # also on Ctrl-C
        loop.run(job.stop(StopTimeouts()))
    return _ProgramExit(code, job.last_output())


def _answering_master(env: Mapping[str, str]) -> str:
    uri = env.get("ROS_MASTER_URI") or master_uri_from_env()
    try:
        MasterProxy(uri).call("getPid")
    except MasterUnreachableError:
        raise UsageError(f"--reuse-master: no ROS master answers at {uri}; start one: trundle core") from None
    return uri


def _clear_params(master: MasterProxy) -> None:
    """Delete the graph's parameters, except those of its master and of roslaunch."""
    for name in master.call("getParamNames"):
        if name not in _MASTER_PARAMS and not name.startswith("/roslaunch/"):
            master.call("deleteParam", name)


_MASTER_PARAMS = ("/run_id", "/rosversion", "/rosdistro")


def _results_folder(env: Mapping[str, str], test_options: LaunchTestOptions, package: str) -> Path:
    """Create rostest's results folder of a package."""
    base = test_options.results_folder or env.get("ROS_TEST_RESULTS_DIR") or ros_home(env) / "test_results"
    folder = Path(base).absolute() / package
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(
            f"no folder {folder} for results: {error.strerror}; set ROS_TEST_RESULTS_DIR or --results-base-dir"
        ) from None
    return folder


def _package_of(loaded: LoadedLaunch, test_options: LaunchTestOptions) -> str:
    """Package of the options, else of the folder that contains the file, else of the first test."""
    if test_options.package is not None:
        return test_options.package
    package_names = {folder.resolve(): name for name, folder in loaded.packages.ros_packages().items()}
    enclosing = (package_names[folder] for folder in loaded.start.resolve().parents if folder in package_names)
    return next(enclosing, loaded.plan.tests[0].node.package)


def _name_of(loaded: LoadedLaunch, test_options: LaunchTestOptions) -> str:
    """rostest's name of a file's results: its path in the package, with "_" for slashes and no suffix."""
    if test_options.results_name is not None:
        return Path(test_options.results_name).stem
    base = test_options.package_folder or loaded.packages.find_package(_package_of(loaded, test_options))
    file = loaded.start.resolve()
    path = file.relative_to(base.resolve()) if base and file.is_relative_to(base.resolve()) else Path(file.name)
    return path.with_suffix("").as_posix().replace("/", "_")


def _show(_name: str, line: str) -> None:
    say(line)
