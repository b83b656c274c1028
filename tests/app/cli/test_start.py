"""Start of `trundle`: Ctrl-C before Python handles it, paths, and the terminal's encoding."""

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
def program(tmp_path: Path) -> Path:
    """The program in a folder without its script."""
    return Path(shutil.copy(_installed(), tmp_path / "trundle"))


def test_ctrl_c_before_python_starts_exits_silently(program: Path) -> None:
    script = program.with_name("_trundle")
    script.write_text(f'#!/bin/sh\nkill -INT $$\nexec "{sys.executable}" -m trundle "$@"\n')
    script.chmod(0o755)

    process = _run(program, "--version")

    assert (process.returncode, process.stdout, process.stderr) == (-signal.SIGINT, "", "")


def test_sigint_is_unblocked_after_the_start() -> None:
    print_mask = "import signal; print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))"
    started = f"import sys; sys.argv[1:] = ['--version']; from trundle.__main__ import main; main(); {print_mask}"
    blocked = f"import signal, os, sys; signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]); {started}"

    assert _run(sys.executable, "-c", blocked).stdout.splitlines()[-1] == "False"


@pytest.mark.parametrize(
    "dropping",
    [
        "self.reference = weakref.ref(Thing(), lambda _: interrupt())",
        "Finalized()",
        "threading.Thread.start = lambda thread: (start(thread), time.sleep(0.1)); Finalized()",
    ],
    ids=["callback of a weak reference", "finalizer", "busy machine"],
)
def test_ctrl_c_where_python_drops_exceptions_still_interrupts(dropping: str) -> None:
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

    process = _run(sys.executable, "-c", textwrap.dedent(waits).replace("DROPPING", dropping))

    assert (process.returncode, process.stderr) == (0, "")
    assert process.stdout.endswith("interrupted\n")


def test_ctrl_c_during_pythons_exit_prints_no_traceback() -> None:
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
        _, errors = running.communicate(timeout=50)
    assert (running.returncode, errors) == (-signal.SIGINT, "")


def test_sigint_ends_a_background_command_of_a_script_and_its_children() -> None:
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


def test_output_is_the_same_without_docstrings_and_asserts(tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text('<robot name="r"><link name="base"/></robot>')
    for words in (["xacro", "--help"], ["check", "--tree", str(file)]):
        plain, optimized = (_run(sys.executable, *option, "-m", "trundle", *words) for option in ((), ("-OO",)))
        assert (optimized.returncode, optimized.stdout, optimized.stderr) == (0, plain.stdout, plain.stderr)


def test_the_program_runs_through_a_link_with_any_arguments(tmp_path: Path) -> None:
    link = tmp_path / "a b" / "robot"
    link.parent.mkdir()
    link.symlink_to(_installed())

    assert _run(link, "--version").stdout == _run(_installed(), "--version").stdout != ""
    assert "no such file" in _run(link, "check", "a 'b' \"c\" ü").stdout


@pytest.mark.parametrize(("command", "shown"), [("check --tree", "\\xdcber"), ("xacro", '<link name="&#220;ber"/>')])
@pytest.mark.parametrize("terminal", [{"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "POSIX", "PYTHONCOERCECLOCALE": "0"}])
def test_letters_that_a_terminal_lacks_are_escaped(
    tmp_path: Path, terminal: dict[str, str], command: str, shown: str
) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text('<?xml version="1.0"?><robot name="r"><link name="Über"/></robot>', encoding="utf-8")
    words = [sys.executable, "-m", "trundle", *command.split(), str(file)]
    env = {**os.environ, "PYTHONUTF8": "0", **terminal}

    process = subprocess.run(words, env=env, capture_output=True, text=True, check=False)

    assert process.returncode == 0, process.stderr
    assert shown in process.stdout


def test_files_are_utf_8_in_every_locale(tmp_path: Path) -> None:
    """In the C locale, Python writes ASCII by default."""
    env = {**os.environ, "PYTHONUTF8": "0", "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0"}
    words = [sys.executable, "-m", "trundle", "--as", "catkin_create_pkg", "cart", "-D", "für Rüben", "--author", "Zoë"]

    process = subprocess.run(words, env=env, cwd=tmp_path, capture_output=True, text=True, check=False)

    assert process.returncode == 0, process.stderr
    assert "für Rüben" in (tmp_path / "cart/package.xml").read_text(encoding="utf-8")


def test_a_missing_script_is_reported_with_its_path(program: Path) -> None:
    process = _run(program, "--version")

    assert process.returncode == 1
    assert process.stderr == f"{program.with_name('_trundle')}: No such file or directory; install Trundle again\n"


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_a_file_name_that_is_not_utf_8_is_escaped(tmp_path: Path, encoding: str) -> None:
    """Old archives have names in Latin-1."""
    env = {**os.environ, "PYTHONIOENCODING": f"{encoding}:strict"}
    words = [os.fsencode(sys.executable), b"-m", b"trundle", b"check", b"r\xf6bot.urdf"]
    process = subprocess.run(words, env=env, cwd=tmp_path, capture_output=True, check=False)

    assert process.returncode == 1
    assert process.stdout.splitlines()[-1] == b"r\\udcf6bot.urdf: refused; 1 error"
    assert b"Traceback" not in process.stderr
