"""`trundle test`: the <test> nodes of launch files, each in a launch of its own, as rostest runs them."""

import asyncio
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from trundle.diagnostics import DescriptionError, UsageError
from trundle.launch import LaunchTest
from trundle.supervisor import Job, JobError, Patience

from .launch import read_files
from .launch_logs import ros_home
from .launch_options import LaunchOptions
from .launch_read import ReadLaunch
from .launch_results import CaseResult, SuiteResult, read_result, write_junit
from .launch_session import LaunchSession
from .showing import say


def run_tests(
    words: Sequence[str], options: LaunchOptions, *, junit: Path | None, environment: Mapping[str, str] | None = None
) -> int:
    """Run every test; return rostest's exit code: 0 when all passed, 1 when one did not run, 2 when a case failed.

    Args:
        words: of the command line: PKG FILE or FILE…, and NAME:=VALUE.
        options: how to launch.
        junit: takes the results of all of them; None: where rostest leaves them.
        environment: None: the process's own.

    Raises:
        TrundleError: the files, or the request, are at fault.
    """
    env = dict(os.environ if environment is None else environment)
    env.pop("ROS_MASTER_URI", None)  # a test is alone on its graph
    read = read_files(words, options, env)
    if read is None:
        return 0
    if not read.plan.tests:
        raise UsageError("there is no <test> in what was given; trundle launch starts its nodes")
    suites = [_run(read, options, test) for test in read.plan.tests]
    for suite in suites:
        for case in suite.cases:
            said = f"\n  {case.problem}" if case.problem else ""
            print(f"[{suite.name}/{case.name}][{case.verdict}]{said}")
    if junit is None:
        junit = _results_folder(env, _package_of(read)) / f"rostest-{_name_of(read)}.xml"
    write_junit(junit, suites)
    failures = sum(suite.failures for suite in suites)
    errors = sum(suite.errors for suite in suites)
    verdict = "SUCCESS" if failures + errors == 0 else "FAIL"
    tests = sum(len(suite.cases) for suite in suites)
    print(f"\nSUMMARY\n * RESULT: {verdict}\n * TESTS: {tests}\n * ERRORS: {errors}\n * FAILURES: {failures}")
    if not all(suite.did_run for suite in suites):
        return 1
    return 0 if verdict == "SUCCESS" else 2


def _run(read: ReadLaunch, options: LaunchOptions, test: LaunchTest) -> SuiteResult:
    """Try a test as often as it allows; the last result counts."""
    name = f"{test.node.package}.{test.name}"
    for left in range(test.retries, -1, -1):
        started = time.monotonic()
        with LaunchSession(read, replace(options, summary=False), any_port=True) as session:
            session.start(read.plan.nodes)
            did_run, cases = session.graph.loop.run(
                _attempt(session, test, _result_file(read.env, test)), timeout_s=None
            )
        seconds = time.monotonic() - started
        suite = SuiteResult(name=name, seconds=seconds, cases=tuple(cases), did_run=did_run)
        if left == 0 or suite.failures + suite.errors == 0:
            return suite
        read.show.line(f"test {test.name!r} did not pass; {left} more {'try' if left == 1 else 'tries'}")
    raise AssertionError("the last try returns")


@dataclass(frozen=True, slots=True)
class _Ended:
    code: int | None
    """None: the time was over."""
    output: list[str]


async def _attempt(session: LaunchSession, test: LaunchTest, result: Path) -> tuple[bool, Sequence[CaseResult]]:
    """Return whether the program ran to its end and left results, and those."""

    def did_not_run(problem: str, *, is_error: bool = True) -> tuple[bool, Sequence[CaseResult]]:
        return False, [CaseResult(name=test.name, problem=problem, is_error=is_error)]

    result.unlink(missing_ok=True)
    try:
        prepared = session.starter.prepare(
            test.node, f"test-{test.name}", show=_show, more=(f"--gtest_output=xml:{result}",)
        )
    except DescriptionError as error:
        return did_not_run(str(error))
    if prepared.job is None:
        return did_not_run(prepared.what)
    try:
        ended = await _to_the_end(prepared.job, test.time_limit_s)
    except JobError as error:
        return did_not_run(str(error))
    if ended.code is None:
        return did_not_run(f"it took more than its {test.time_limit_s:g} s", is_error=False)
    if result.is_file():
        return True, read_result(result, test.name)
    if prepared.kind == "process":
        said = "\n  ".join(["", *ended.output])
        problem = f"it wrote no results ({result}), and ended with exit code {ended.code}{said}"
        return did_not_run(problem)
    return True, [CaseResult(name=test.name, problem="" if ended.code == 0 else f"exit code {ended.code}")]


async def _to_the_end(job: Job, limit_s: float) -> _Ended:
    await job.start()
    try:
        code = await asyncio.wait_for(job.wait(), limit_s)
    except TimeoutError:
        await job.stop(Patience())
        return _Ended(None, job.last_output())
    return _Ended(code, job.last_output())


def _result_file(env: Mapping[str, str], test: LaunchTest) -> Path:
    return _results_folder(env, test.node.package) / f"rosunit-{test.name}.xml"


def _results_folder(env: Mapping[str, str], package: str) -> Path:
    """Where rostest has results of a package's tests, too."""
    folder = Path(env.get("ROS_TEST_RESULTS_DIR") or ros_home(env) / "test_results") / package
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"no folder {folder} for results: {error.strerror}; set ROS_TEST_RESULTS_DIR") from None
    return folder


def _package_of(read: ReadLaunch) -> str:
    """The package whose folder the file lies in, else that of the first test."""
    homes = {folder.resolve(): name for name, folder in read.packages.ros_packages().items()}
    here = (homes[folder] for folder in read.start.resolve().parents if folder in homes)
    return next(here, read.plan.tests[0].node.package)


def _name_of(read: ReadLaunch) -> str:
    """As rostest calls a file's results: its path in the package, without slashes and ending."""
    home = read.packages.find_package(_package_of(read))
    file = read.start.resolve()
    inside = file.relative_to(home.resolve()) if home and file.is_relative_to(home.resolve()) else Path(file.name)
    return inside.with_suffix("").as_posix().replace("/", "_")


def _show(_name: str, line: str) -> None:
    say(line)
