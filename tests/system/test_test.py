"""`trundle test` runs the tests of launch files like rostest."""

import signal
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from tests.graphs import running_graph

from trundle.ros import MasterProxy

_MANIFEST = """<package><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>x</license></package>"""
# Like a gtest or rosunit program, it writes its results to the given file.
_CHECK = """#!/usr/bin/env python3
import os, sys, pathlib
out = next(w.partition("xml:")[2] for w in sys.argv if w.startswith("--gtest_output="))
verdict = sys.argv[1]
cases = '<testcase name="sees" classname="C" time="0.5"/>'
if verdict == "fail":
    cases += '<testcase name="hears" classname="C" time="0.1"><failure message="no &lt;sound&gt;"/></testcase>'
if verdict == "flaky":
    mark = pathlib.Path(sys.argv[2])
    cases += "" if mark.exists() else '<testcase name="hears" classname="C"><error>first try</error></testcase>'
    mark.touch()
if verdict == "says":
    print("the graph is at", os.environ["ROS_MASTER_URI"])
if verdict == "nodes":
    from xmlrpc.client import ServerProxy
    print("nodes:", ServerProxy(os.environ["ROS_MASTER_URI"]).getSystemState("/t")[2])
if verdict == "waits":
    import signal, time
    signal.signal(signal.SIGINT, lambda *_: sys.exit(pathlib.Path(sys.argv[2]).write_text("interrupted")))
    pathlib.Path(sys.argv[2]).touch()
    time.sleep(100)
if "--text" in sys.argv:
    print("no file from me"); sys.exit(verdict == "fail")
if verdict == "silent":
    print("I crash before I write"); sys.exit(3)
if verdict == "slow":
    os.execvp("sleep", ["sleep", "100"])
pathlib.Path(out).write_text(f'<testsuite name="s">{cases}</testsuite>')
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "ws" / "p"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(_MANIFEST)
    (folder / "check").write_text(_CHECK)
    (folder / "check").chmod(0o755)
    return folder


def write_tests(package: Path, *tests: str) -> None:
    (package / "a.test").write_text(f"<launch><param name='x' value='1'/>{''.join(tests)}</launch>")


def launch_test(name: str, verdict: str, attributes: str = "") -> str:
    return f'<test pkg="p" type="check" test-name="{name}" args="{verdict}" {attributes}/>'


def test_results_are_printed_and_written_as_junit_xml(trundle, package: Path, tmp_path: Path) -> None:
    write_tests(package, launch_test("good", "pass"), launch_test("bad", "fail"))
    junit = tmp_path / "out" / "results.xml"
    done = trundle("test", "p", "a.test", "--junit", str(junit), ROS_PACKAGE_PATH=str(package.parent))

    assert done.returncode == 2
    assert "[p.good/sees][passed]" in done.stdout
    assert "[p.bad/hears][failed]\n  no <sound>" in done.stdout
    assert done.stdout.endswith("SUMMARY\n * RESULT: FAIL\n * TESTS: 3\n * ERRORS: 0\n * FAILURES: 1\n")
    suites = ET.parse(junit).getroot().findall("testsuite")
    assert [(s.get("name"), s.get("tests"), s.get("failures")) for s in suites] == [
        ("p.good", "1", "0"),
        ("p.bad", "2", "1"),
    ]
    failure = suites[1].find("testcase/failure")
    assert failure is not None
    assert failure.get("message") == "no <sound>"


def test_a_flaky_test_is_retried(trundle, package: Path, tmp_path: Path) -> None:
    write_tests(package, launch_test("flaky", f"flaky {tmp_path / 'mark'}", 'retry="1"'))
    done = trundle("test", "p", "a.test", ROS_PACKAGE_PATH=str(package.parent))

    assert done.returncode == 0
    assert "1 more try" in done.stderr
    assert "RESULT: SUCCESS" in done.stdout
    results = tmp_path / ".ros/test_results/p/rostest-a.xml"
    assert [s.get("name") for s in ET.parse(results).getroot()] == ["p.flaky"]


@pytest.mark.parametrize(
    ("test", "message"),
    [
        (launch_test("t", "silent"), "[p.t/t][error]\n  it wrote no results"),
        (launch_test("t", "slow", 'time-limit="1"'), "[p.t/t][failed]\n  it took more than its 1 s"),
        ('<test pkg="p" type="gone" test-name="t"/>', "[p.t/t][error]\n  no executable 'gone'"),
    ],
)
def test_a_test_without_results_fails(trundle, package: Path, test: str, message: str) -> None:
    write_tests(package, test)
    done = trundle("test", "p", "a.test", ROS_PACKAGE_PATH=str(package.parent))

    assert done.returncode == 1
    assert message in done.stdout
    assert "Traceback" not in done.stdout + done.stderr


def test_a_file_without_tests_is_an_error(trundle, package: Path) -> None:
    write_tests(package)
    done = trundle("test", "p", "a.test", ROS_PACKAGE_PATH=str(package.parent))
    assert done.returncode == 1
    assert "no <test>" in done.stderr


@pytest.mark.parametrize(("verdict", "code"), [("pass", 0), ("fail", 2)])
def test_text_leaves_no_files_and_the_exit_code_decides(
    trundle, package: Path, tmp_path: Path, verdict: str, code: int
) -> None:
    write_tests(package, launch_test("t", verdict))
    done = trundle("test", "p", "a.test", "--text", ROS_PACKAGE_PATH=str(package.parent))

    assert done.returncode == code
    assert "no file from me" in done.stdout + done.stderr
    assert list(tmp_path.rglob("ros*-*.xml")) == []


def test_the_results_folder_and_file_name_can_be_set(trundle, package: Path, tmp_path: Path) -> None:
    write_tests(package, launch_test("good", "pass"))
    path = str(package.parent)
    named = ("--package", "q", "--results-base-dir", "out", "--results-filename", "all.v2.xml")
    assert trundle("test", "p", "a.test", *named, ROS_PACKAGE_PATH=path).returncode == 0
    assert trundle("test", "ws/p/a.test", "--pkgdir", path, "--results-base-dir", "out").returncode == 0

    files = {str(file.relative_to(tmp_path / "out")) for file in (tmp_path / "out").rglob("*.xml")}
    assert files == {"q/rosunit-good.xml", "q/rostest-all.v2.xml", "p/rosunit-good.xml", "p/rostest-p_a.xml"}
    assert not (tmp_path / ".ros/test_results").exists()

    refused = trundle("test", "ws/p/a.test", "--results-filename", "b/all.xml")
    assert refused.returncode == 2
    assert "'b/all.xml' is not a file name; --results-base-dir takes the folder" in refused.stderr


def test_a_running_graph_is_reused_and_cleared(trundle, package: Path) -> None:
    write_tests(package, launch_test("says", "says"))
    with running_graph() as graph:
        master = MasterProxy(graph.core.uri)
        names = ("/old/deep", "/roslaunch/uris/host_a__1")
        for name in names:
            master.call("setParam", name, "v")
        variables = {"ROS_PACKAGE_PATH": str(package.parent), "ROS_MASTER_URI": graph.core.uri}
        initial = set(master.call("getParamNames"))

        alone = trundle("test", "p", "a.test", "-t", **variables)
        output = alone.stdout + alone.stderr
        assert "the graph is at" in output
        assert f"the graph is at {graph.core.uri}" not in output
        assert ":11311" not in output  # the port of a user's next roscore
        assert set(master.call("getParamNames")) == initial

        reused = trundle("test", "p", "a.test", "-t", "-r", **variables)
        assert reused.returncode == 0
        assert f"the graph is at {graph.core.uri}" in reused.stdout + reused.stderr
        assert set(master.call("getParamNames")) == initial | {"/x"}

        cleared = trundle("test", "p", "a.test", "--reuse-master", "--clear", **variables)
        assert cleared.returncode == 0
        assert set(master.call("getParamNames")) == (initial | {"/x"}) - {"/old/deep"}


@pytest.mark.parametrize(
    ("options", "message"),
    [(["--clear"], "--clear is only valid with --reuse-master"), (["-r"], "--reuse-master: no ROS master answers at")],
)
def test_invalid_reuse_options_are_errors(trundle, package: Path, options: list[str], message: str) -> None:
    write_tests(package, launch_test("good", "pass"))
    done = trundle("test", "p", "a.test", *options, ROS_PACKAGE_PATH=str(package.parent))
    assert done.returncode == 1
    assert message in done.stderr
    assert "Traceback" not in done.stderr


def test_the_master_of_a_test_has_no_rosout(trundle, package: Path) -> None:
    """As with rostest: a test itself may have the name /rosout."""
    write_tests(package, launch_test("rosout", "nodes"))
    done = trundle("test", "p", "a.test", "-t", ROS_PACKAGE_PATH=str(package.parent))
    assert done.returncode == 0
    assert "nodes: [[], [], []]" in done.stdout + done.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_test_in_a_shells_background_stops_on_signals(
    start, until, package: Path, tmp_path: Path, number: int
) -> None:
    """A shell starts background jobs with SIGINT ignored, and children inherit that."""
    mark = tmp_path / "mark"
    write_tests(package, launch_test("waits", f"waits {mark}"))
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        running = start("test", "p", "a.test", ROS_PACKAGE_PATH=str(package.parent))
    finally:
        signal.signal(signal.SIGINT, before)
    until("the test to run", mark.exists)

    running.process.send_signal(number)

    assert running.process.wait(60.0) == 130
    assert mark.read_text() == "interrupted"
    assert "Traceback" not in running.output()
