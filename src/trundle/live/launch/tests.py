"""`trundle test`: the <test> nodes of launch files, each in a launch of its own, as rostest runs them."""

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
    how: LaunchTestOptions,
    *,
    environment: Mapping[str, str] | None = None,
) -> int:
    """Run every test; return rostest's exit code: 0: all passed, 1: one did not run, 2: a case failed.

    Args:
        words: command line: PKG FILE or FILE…, and NAME:=VALUE.
        options: of the launch.
        how: options of the tests.
        environment: None: os.environ.

    Raises:
        TrundleError: an invalid file or request.
    """
    if how.clear and not how.reuse_master:
        raise UsageError("--clear is only valid with --reuse-master: a test's own graph has no parameters yet")
    env = dict(os.environ if environment is None else environment)
    if how.reuse_master:
        env["ROS_MASTER_URI"] = _answering_master(env)
    else:
        env.pop("ROS_MASTER_URI", None)  # a test is alone on its graph
    read = read_files(words, options, env)
    if read is None:
        return 0
    if not read.plan.tests:
        raise UsageError("there is no <test> in what was given; trundle launch starts its nodes")
    with tempfile.TemporaryDirectory() as passing:
        folder = Path(passing) if how.text else _results_folder(env, how, _package_of(read, how))
        suites = [_run(read, options, how, test, folder) for test in read.plan.tests]
    for suite in suites:
        for case in suite.cases:
            said = f"\n  {case.problem}" if case.problem else ""
            print(f"[{suite.name}/{case.name}][{case.verdict}]{said}")
    junit = how.junit
    if junit is None and not how.text:
        junit = folder / f"rostest-{_name_of(read, how)}.xml"
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
    read: LoadedLaunch, options: LaunchOptions, how: LaunchTestOptions, test: LaunchTest, folder: Path
) -> SuiteResult:
    """Run a test, and retry it as often as it allows; the last result counts. Its program writes into `folder`."""
    name = f"{test.node.package}.{test.name}"
    for left in range(test.retries, -1, -1):
        started = time.monotonic()
        if how.clear:
            _clear_params(MasterProxy(read.env["ROS_MASTER_URI"]))
        with LaunchSession(read, replace(options, summary=False), ports=(0,), rosout=False) as session:
            session.start(read.plan.nodes)
            did_run, cases = _attempt(session, test, folder / f"rosunit-{test.name}.xml", text=how.text)
        seconds = time.monotonic() - started
        suite = SuiteResult(name=name, seconds=seconds, cases=tuple(cases), did_run=did_run)
        if left == 0 or suite.failures + suite.errors == 0:
            return suite
        read.show.line(f"test {test.name!r} did not pass; {left} more {'try' if left == 1 else 'tries'}")
    raise AssertionError("the last try returns")


@dataclass(frozen=True, slots=True)
class _Ended:
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
    more = (f"--gtest_output=xml:{result}", *(["--text"] if text else []))
    try:
        prepared = session.starter.prepare(test.node, f"test-{test.name}", show=_show, more=more)
    except DescriptionError as error:
        return did_not_run(str(error))
    if prepared.job is None:
        return did_not_run(prepared.what)
    try:
        ended = _wait_for_exit(session.graph.loop, prepared.job, test.time_limit_s)
    except JobError as error:
        return did_not_run(str(error))
    if ended.code is None:
        return did_not_run(f"it took more than its {test.time_limit_s:g} s", is_error=False)
    if result.is_file():
        return True, read_result(result, test.name)
    if prepared.kind == "process" and not text:
        said = "\n  ".join(["", *ended.output])
        problem = f"it wrote no results ({result}), and ended with exit code {ended.code}{said}"
        return did_not_run(problem)
    return True, [CaseResult(name=test.name, problem="" if ended.code == 0 else f"exit code {ended.code}")]


def _wait_for_exit(loop: GraphLoop, job: Job, limit_s: float) -> _Ended:
    loop.run(job.start())
    try:
        code = loop.run(job.wait(), limit_s)
    except TimeoutError:
        code = None
    finally:  # also on Ctrl-C
        loop.run(job.stop(StopTimeouts()))
    return _Ended(code, job.last_output())


def _answering_master(env: Mapping[str, str]) -> str:
    uri = env.get("ROS_MASTER_URI") or master_uri_from_env()
    try:
        MasterProxy(uri).call("getPid")
    except MasterUnreachableError:
        raise UsageError(f"--reuse-master: no ROS master answers at {uri}; start one: trundle core") from None
    return uri


def _clear_params(master: MasterProxy) -> None:
    """Delete the graph's parameters, except those of its master and of other launches."""
    for name in master.call("getParamNames"):
        if name not in _KEPT and not name.startswith("/roslaunch/"):
            master.call("deleteParam", name)


_KEPT = ("/run_id", "/rosversion", "/rosdistro")


def _results_folder(env: Mapping[str, str], how: LaunchTestOptions, package: str) -> Path:
    """Make rostest's results folder of a package."""
    base = how.results_folder or env.get("ROS_TEST_RESULTS_DIR") or ros_home(env) / "test_results"
    folder = Path(base).absolute() / package
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(
            f"no folder {folder} for results: {error.strerror}; set ROS_TEST_RESULTS_DIR or --results-base-dir"
        ) from None
    return folder


def _package_of(read: LoadedLaunch, how: LaunchTestOptions) -> str:
    """Package given, else the one whose folder holds the file, else that of the first test."""
    if how.package is not None:
        return how.package
    homes = {folder.resolve(): name for name, folder in read.packages.ros_packages().items()}
    here = (homes[folder] for folder in read.start.resolve().parents if folder in homes)
    return next(here, read.plan.tests[0].node.package)


def _name_of(read: LoadedLaunch, how: LaunchTestOptions) -> str:
    """rostest's name of a file's results: its path in the package, with "_" for slashes and no suffix."""
    if how.results_name is not None:
        return Path(how.results_name).stem
    home = how.package_folder or read.packages.find_package(_package_of(read, how))
    file = read.start.resolve()
    inside = file.relative_to(home.resolve()) if home and file.is_relative_to(home.resolve()) else Path(file.name)
    return inside.with_suffix("").as_posix().replace("/", "_")


def _show(_name: str, line: str) -> None:
    say(line)
