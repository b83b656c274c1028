"""Commands of <param command> run without a shell; xacro runs inside the process."""

import os
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import read_launch_text, resolve_params


class NoPackages:
    def find_folder(self, _name: str, /) -> Path | None:
        return None

    is_lenient = False

    def absent_package(self, _file: Path, /) -> str | None:
        return None

    def not_found_message(self, name: str, /) -> str:
        return f"no package {name!r}"


def resolve(command: str, *, kind: str = "auto") -> object:
    text = f'<launch><param name="a" type="{kind}" command="{command}"/></launch>'
    report = Diagnostics()
    plan = read_launch_text(text, name="t.launch", packages=NoPackages(), report=report)

    def expand(file: Path, arguments: Mapping[str, str], /) -> str:
        return f"{file} {dict(arguments)}"

    (param,) = resolve_params(plan, report, expand_xacro=expand, env=os.environ)
    return param.value


PYTHON = sys.executable


@pytest.mark.parametrize(
    "program",
    [
        "$(find xacro)/xacro.py",
        "$(find xacro)/xacro --inorder",
        "/opt/ros/indigo/share/xacro/xacro.py",
        "xacro",
        "rosrun xacro xacro.py",
    ],
)
def test_xacro_is_expanded_in_process_under_any_path(program: str) -> None:
    assert resolve(f"{program} '/a b/c.xacro' gui:=true") == "/a b/c.xacro {'gui': 'true'}"


@pytest.mark.skipif(os.name != "posix", reason="such scripts are for sh")
@pytest.mark.parametrize("named", ["$(find xacro)/xacro", "/opt/ros/kinetic/share/xacro/xacro.py", "xacro"])
def test_a_script_that_runs_xacro_finds_one(named: str, tmp_path: Path) -> None:
    """Jackal, Dingo, Ridgeback and Warthog have env_run, which sets variables, then runs a command."""
    script, robot = tmp_path / "env_run", tmp_path / "a b.xacro"
    script.write_text('#!/bin/sh\nexport SIZE=4\nexec "$@"\n')
    script.chmod(0o755)
    robot.write_text('<robot name="r" size="$(env SIZE)" more="$(arg m)"/>')

    text = resolve(f"{script} {named} '{robot}' --inorder m:=7", kind="str")

    assert '<robot more="7" name="r" size="4"/>' in str(text)


def test_another_command_is_run_and_its_output_typed() -> None:
    assert resolve(f"{PYTHON} -c 'print(1 + 1, end=str())'") == 2
    assert resolve(f"{PYTHON} -c 'print(1 + 1, end=str())'", kind="str") == "2"


def test_no_shell_is_involved() -> None:
    assert resolve(f"{PYTHON} -c 'import sys; print(sys.argv[1:])' $HOME ; x") == "['$HOME', ';', 'x']\n"


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("/no/such/command x", "no such command '/no/such/command'"),
        (f"{PYTHON} -c 'import sys; sys.exit(\"bad link\")'", "returned 1: bad link"),
        (f"{PYTHON} -c 'while True: print(str(7) * 9999)'", "wrote more than 64 MiB"),
        (f"{PYTHON} 'unclosed", "cannot be split into words"),
        ("xacro", "xacro wants one file, got 0"),
    ],
)
def test_a_command_that_fails_ends_the_launch_with_a_sentence(command: str, message: str) -> None:
    with pytest.raises(DescriptionError, match=r"t\.launch:1: error: param '/a': ") as error:
        resolve(command.replace('"', "&quot;"))
    assert message in str(error.value)


@pytest.mark.skipif(os.name != "posix", reason="sessions are POSIX's")
def test_a_slow_command_is_waited_for_and_named(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("trundle.base.waiting.PERIOD_S", 0.0)

    assert resolve(f"{PYTHON} -c 'import time; time.sleep(1)'") == ""

    assert f"waiting for command {PYTHON!r} since 1 s" in capfd.readouterr().err


@pytest.mark.skipif(os.name != "posix", reason="sessions are POSIX's")
def test_ctrl_c_ends_a_command_that_hangs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """It has a session of its own, and does not hear the terminal."""
    number = tmp_path / "pid"
    program = tmp_path / "hang.py"
    program.write_text(f"import os, time\nopen({str(number)!r}, 'w').write(str(os.getpid()))\ntime.sleep(600)\n")

    def press(_: object) -> None:
        if number.is_file() and number.read_text():
            raise KeyboardInterrupt

    monkeypatch.setattr("trundle.robots.launch.run_command.WaitNotice.poll", press)
    with pytest.raises(KeyboardInterrupt):
        resolve(f"{PYTHON} {program}")

    with pytest.raises(ProcessLookupError):
        os.kill(int(number.read_text()), 0)


def test_a_null_parameter_is_named() -> None:
    report = Diagnostics()
    text = "<launch><rosparam>{a: ~, b: 1}</rosparam></launch>"
    plan = read_launch_text(text, name="t.launch", packages=NoPackages(), report=report)

    def expand(file: Path, arguments: Mapping[str, str], /) -> str:
        raise AssertionError("no xacro here")

    params = resolve_params(plan, report, expand_xacro=expand, env={})
    assert [(p.name, p.value) for p in params] == [("/a", None), ("/b", 1)]
    assert "'/a' is null" in report.warnings[0]


def test_stderr_of_a_command_is_passed_on(capfd: pytest.CaptureFixture[str]) -> None:
    assert resolve(f"{PYTHON} -c 'import sys; print(3, file=sys.stderr); print(4)'") == 4
    assert capfd.readouterr().err == "3\n"
