"""A Python 2 program run by plain `python3` ends with the command that runs it."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.ros.rospy.environment import RUN_PYTHON2, with_finder


def _ended(program: Path, *words: str) -> str:
    command = [sys.executable, program, *words]
    done = subprocess.run(command, env=with_finder(os.environ), capture_output=True, text=True, check=False)
    assert done.returncode == 1
    return done.stderr.splitlines()[-1]


@pytest.mark.parametrize(
    "text", ["print 'hello'\n", "for i in xrange(3):\n    print(i)\n", "import Queue\n", "print({1: 2}.has_key(1))\n"]
)
def test_the_advice_for_a_python_2_program_is_trundle_exec(tmp_path: Path, text: str) -> None:
    package = tmp_path / "src/talker"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>talker</name></package>")
    program = package / "scripts/talk.py"
    program.write_text(text)

    advice = f"trundle: {program} is Python 2; this runs it, translated: trundle exec talker talk.py _rate:=3"
    assert _ended(program, "_rate:=3") == advice


def test_the_advised_command_runs_a_program_outside_of_packages(tmp_path: Path) -> None:
    program = tmp_path / "alone.py"
    program.write_text("print 'hello', 7 / 2\n")

    advice = f"trundle: {program} is Python 2; this runs it, translated: "
    command = _ended(program).removeprefix(advice)

    assert shlex.split(command) == [sys.executable, str(RUN_PYTHON2), str(program)]
    done = subprocess.run(shlex.split(command), capture_output=True, text=True, check=False)
    assert done.stdout == "hello 3\n"


@pytest.mark.parametrize("text", ["print('a'\n", "undefined_name\n", "None.attribute\n"])
def test_errors_of_python_3_programs_get_no_such_advice(tmp_path: Path, text: str) -> None:
    program = tmp_path / "wrong.py"
    program.write_text(text)
    assert "Python 2" not in _ended(program)
