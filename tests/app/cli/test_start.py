"""Start of `trundle`: Ctrl-C before Python handles it, the path of its script, the terminal's encoding."""

import os
import shutil
import signal
import subprocess
import sys
import sysconfig
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(
    sys.platform not in ("linux", "darwin"), reason="elsewhere the installer's own program starts Python"
)


def _installed() -> Path:
    return Path(sysconfig.get_path("scripts")) / "trundle"


def _run(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=100)


@pytest.fixture
def beside(tmp_path: Path) -> Path:
    """The program, in a folder without its script."""
    return Path(shutil.copy(_installed(), tmp_path / "trundle"))


def test_ctrl_c_before_python_has_begun_ends_it_without_a_word(beside: Path) -> None:
    script = beside.with_name("_trundle")
    script.write_text(f'#!/bin/sh\nkill -INT $$\nexec "{sys.executable}" -m trundle "$@"\n')
    script.chmod(0o755)

    done = _run(beside, "--version")

    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_ctrl_c_is_let_through_afterwards() -> None:
    held = "import signal; print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))"
    started = f"import sys; sys.argv[1:] = ['--version']; from trundle.__main__ import main; main(); {held}"
    with_it_held = f"import signal, os, sys; signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]); {started}"

    assert _run(sys.executable, "-c", with_it_held).stdout.splitlines()[-1] == "False"


@pytest.mark.parametrize(
    "dropping",
    [
        "self.reference = weakref.ref(Thing(), lambda _: interrupt())",
        "Finalized()",
        "threading.Thread.start = lambda thread: (start(thread), time.sleep(0.1)); Finalized()",
    ],
    ids=["callback of a weak reference", "finalizer", "busy machine"],
)
def test_ctrl_c_where_python_drops_exceptions_still_ends_it(dropping: str) -> None:
    waits = """
        import os, signal, sys, threading, time, types, weakref, trundle.app.cli, trundle.__main__
        start = threading.Thread.start
        interrupt = lambda: os.kill(os.getpid(), signal.SIGINT)
        Thing = type("Thing", (), {})
        Finalized = type("Finalized", (), {"__del__": lambda self: interrupt()})
        self = types.SimpleNamespace()
        def command():
            try:
                DROPPING
                print("goes on", flush=True)
                time.sleep(50)
            except KeyboardInterrupt:
                print("interrupted", flush=True)
            return 0
        trundle.app.cli.main = command
        sys.exit(trundle.__main__.main())
    """

    done = _run(sys.executable, "-c", textwrap.dedent(waits).replace("DROPPING", dropping))

    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith("interrupted\n")


def test_ctrl_c_while_python_ends_is_no_traceback() -> None:
    lingers = """
        import sys, threading, time, trundle.app.cli, trundle.__main__
        def command():
            threading.Thread(target=time.sleep, args=(100,)).start()
            return 0
        trundle.app.cli.main = command
        code = trundle.__main__.main()
        print("done", flush=True)
        sys.exit(code)
    """
    words = [sys.executable, "-c", textwrap.dedent(lingers)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        assert running.stdout.readline() == "done\n"
        running.send_signal(signal.SIGINT)
        _, said = running.communicate(timeout=50)
    assert (running.returncode, said) == (-signal.SIGINT, "")


def test_a_command_in_a_scripts_background_is_ended_by_sigint_as_are_its_children() -> None:
    """A shell without job control starts `trundle … &` with SIGINT ignored."""
    waits = """
        import subprocess, sys, time, trundle.app.cli, trundle.__main__
        def command():
            try:
                child = subprocess.Popen(["/bin/sh", "-c", "kill -INT $$"], start_new_session=True)
                print(child.wait(), flush=True)
                time.sleep(20)
            except KeyboardInterrupt:
                return 130
        trundle.app.cli.main = command
        sys.exit(trundle.__main__.main())
    """
    words = ["sh", "-c", 'trap "" INT; exec "$@"', "sh", sys.executable, "-c", textwrap.dedent(waits)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        assert running.stdout.readline() == f"{-signal.SIGINT}\n"
        running.send_signal(signal.SIGINT)
        assert running.wait(50) == 130


def test_help_and_runs_are_the_same_without_docstrings_and_asserts(tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text('<robot name="r"><link name="base"/></robot>')
    for words in (["xacro", "--help"], ["check", "--tree", str(file)]):
        plain, optimized = (_run(sys.executable, *option, "-m", "trundle", *words) for option in ((), ("-OO",)))
        assert (optimized.returncode, optimized.stdout, optimized.stderr) == (0, plain.stdout, plain.stderr)


def test_a_link_to_it_and_arguments_of_any_kind(tmp_path: Path) -> None:
    link = tmp_path / "a b" / "robot"
    link.parent.mkdir()
    link.symlink_to(_installed())

    assert _run(link, "--version").stdout == _run(_installed(), "--version").stdout != ""
    assert "no such file" in _run(link, "check", "a 'b' \"c\" ü").stdout


@pytest.mark.parametrize(("command", "shown"), [("check --tree", "\\xdcber"), ("xacro", '<link name="&#220;ber"/>')])
@pytest.mark.parametrize("terminal", [{"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "POSIX", "PYTHONCOERCECLOCALE": "0"}])
def test_letters_that_a_terminal_lacks_are_written_by_number(
    tmp_path: Path, terminal: dict[str, str], command: str, shown: str
) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text('<?xml version="1.0"?><robot name="r"><link name="Über"/></robot>', encoding="utf-8")
    words = [sys.executable, "-m", "trundle", *command.split(), str(file)]
    env = {**os.environ, "PYTHONUTF8": "0", **terminal}

    done = subprocess.run(words, env=env, capture_output=True, text=True, check=False)

    assert done.returncode == 0, done.stderr
    assert shown in done.stdout


def test_files_are_utf_8_whatever_the_terminal_is(tmp_path: Path) -> None:
    """In the C locale, Python writes ASCII unless told otherwise."""
    env = {**os.environ, "PYTHONUTF8": "0", "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0"}
    words = [sys.executable, "-m", "trundle", "--as", "catkin_create_pkg", "cart", "-D", "für Rüben", "--author", "Zoë"]

    done = subprocess.run(words, env=env, cwd=tmp_path, capture_output=True, text=True, check=False)

    assert done.returncode == 0, done.stderr
    assert "für Rüben" in (tmp_path / "cart/package.xml").read_text(encoding="utf-8")


def test_without_its_script_it_says_which_is_missing_and_what_to_do(beside: Path) -> None:
    done = _run(beside, "--version")

    assert done.returncode == 1
    assert done.stderr == f"{beside.with_name('_trundle')}: No such file or directory; install Trundle again\n"


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_a_name_that_the_terminal_cannot_show_is_written_with_backslashes(tmp_path: Path, encoding: str) -> None:
    """Archives of the years before UTF-8 have names in Latin-1."""
    env = {**os.environ, "PYTHONIOENCODING": f"{encoding}:strict"}
    words = [os.fsencode(sys.executable), b"-m", b"trundle", b"check", b"r\xf6bot.urdf"]
    done = subprocess.run(words, env=env, cwd=tmp_path, capture_output=True, check=False)

    assert done.returncode == 1
    assert done.stdout.splitlines()[-1] == b"r\\udcf6bot.urdf: refused; 1 error"
    assert b"Traceback" not in done.stderr
