"""Starts every Python node of cloned repositories without an installed ROS, and reports which register.

    python -m bench.rospy_nodes FOLDER… [--list FILE]

A node is a script that calls `rospy.init_node`, outside of tests and Python packages. It starts in an environment with
no ROS except Trundle, on its own master with a simulated clock that does not advance. It passes if its name is
registered, or if it exits without a traceback (a tool that prints its usage). `rospy_nodes.txt` is the table of 39
repositories.
"""

import argparse
import os
import pty
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from trundle.ros import Core, GraphLoop, MasterProxy, RosError
from trundle.ros.rospy.environment import RUN_PYTHON2, with_finder
from trundle.ros.rospy.python2.cache import is_python2_file

_NODE = re.compile(rb"^[^#\n]*rospy\.init_node\(|^[^#\n]*\binit_node\(", re.MULTILINE)
_PYTHON = re.compile(rb"#!.*python")
_SKIPPED = {"test", "tests", "build", "node_modules"}
_START_S, _POLL_S = 40.0, 0.1
_MAX_LENGTH = 200
_MISSING = re.compile(r"(?:ModuleNotFoundError|ImportError): (?:No module named|cannot import name) '?([\w.]+)")


def find_nodes(folder: Path) -> Iterator[Path]:
    """Yield scripts that call `rospy.init_node`."""
    for root, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if name not in _SKIPPED and not name.startswith("."))
        if "__init__.py" in files:
            continue
        for name in sorted(files):
            path = Path(root, name)
            if path.is_symlink() or path.stat().st_size > 1_000_000 or path.suffix not in (".py", ""):
                continue
            data = path.read_bytes()
            if _NODE.search(data) and (path.suffix == ".py" or _PYTHON.match(data)):
                yield path


def start_node(path: Path, *, is_python2: bool) -> str:
    """Start a node; return 'registered', 'ends', or the last line of its traceback."""
    with GraphLoop() as loop, tempfile.TemporaryDirectory() as home:
        core = Core(loop, port=0)
        loop.run(core.start(), 60)
        loop.run(core.wait_ready(), 60)
        env = {name: value for name, value in os.environ.items() if not name.startswith("ROS")}
        env |= {"ROS_MASTER_URI": core.uri, "ROS_HOME": home, "MPLBACKEND": "Agg", "QT_QPA_PLATFORM": "offscreen"}
        translated = [RUN_PYTHON2] if is_python2 else []
        terminal, keyboard = pty.openpty()  # nodes that read keys need a terminal
        with tempfile.TemporaryFile() as output:
            process = subprocess.Popen(
                [sys.executable, "-W", "ignore", *translated, path],
                env=with_finder(env), cwd=path.parent, stdin=keyboard, stdout=output, stderr=output,
            )  # fmt: skip
            try:
                return _wait_for_result(process, core.uri, output)
            finally:
                process.kill()
                process.wait()
                os.close(terminal)
                os.close(keyboard)
                loop.run(core.stop(), 60)


def _wait_for_result(process: "subprocess.Popen[bytes]", uri: str, output: object) -> str:
    end = time.monotonic() + _START_S
    while process.poll() is None and time.monotonic() < end:
        if _is_registered(uri):
            return "registered"
        time.sleep(_POLL_S)
    if _is_registered(uri):
        return "registered"
    output.seek(0)  # pyright: ignore[reportAttributeAccessIssue]
    text = output.read().decode(errors="replace")  # pyright: ignore[reportAttributeAccessIssue]
    if process.poll() is None:
        return "runs, but does not register"
    if "Traceback" not in text and "SyntaxError" not in text and "Error:" not in text:
        return "ends"
    last = [line for line in text.strip().splitlines() if line.strip()][-1]
    prefix = "within our modules: " if re.search(r'File "[^"]*/trundle/rospy/', text.rpartition("Traceback")[2]) else ""
    return f"{prefix}{last}"[:_MAX_LENGTH]


def _is_registered(uri: str) -> bool:
    try:
        publishers, subscribers, services = MasterProxy(uri).call("getSystemState")
    except RosError:
        return False
    return any(node != "/rosout" for kind in (publishers, subscribers, services) for _, nodes in kind for node in nodes)


def main() -> int:
    """Start the nodes of the folders on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--list", type=Path, help="file for the table of nodes and results")
    args = parser.parse_args()
    nodes = [(folder, path) for folder in args.folders for path in find_nodes(folder.resolve())]
    are_python2 = [is_python2_file(path) for _, path in nodes]  # here: parsing in threads fails in Python 3.11
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        started = [
            pool.submit(start_node, path, is_python2=is_python2)
            for (_, path), is_python2 in zip(nodes, are_python2, strict=True)
        ]
        results = [future.result() for future in started]
    rows = [
        f"{path.relative_to(folder.resolve().parent)}\t{result}"
        for (folder, path), result in zip(nodes, results, strict=True)
    ]
    print("\n".join(rows))
    if args.list:
        args.list.write_text("\n".join(rows) + "\n")
    good = sum(result in ("registered", "ends") for result in results)
    missing = Counter(match[1] for result in results if (match := _MISSING.search(result)))
    print(f"{good} of {len(nodes)} nodes start; missing modules: {dict(missing.most_common())}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
