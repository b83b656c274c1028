"""Every rule of the launch language, by files of a few tags each, compared with roslaunch.

Each line of `language.txt` is a file without its <launch>, in which <n/> stands for a node n; words before the colon
go on the command line. `eval:` and `wrong:` are expressions; `name/other.launch:` is a file beside the one named so.
"""

import json
import os
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.live.launch.request import read_request
from trundle.robots.launch import LaunchNode, read_launch, resolve_params
from trundle.robots.packages import Packages

REAL_PYTHON = "/usr/bin/python3"
_LINES = Path(__file__).with_name("language.txt").read_text().splitlines()
_EVAL = """<arg name="a" default="q"/><arg name="b" default="4"/><arg name="c" default="false"/>
<arg name="d" default="1.50"/><param name="x" value="$(eval {})"/>"""
_ANONYMOUS = re.compile(r"_[A-Za-z0-9.-]*_\d+_\d+")
# Prints Debian's roslaunch's result of each file, one JSON list of lines each; null: refused.
_REAL = """
import json, signal, sys
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from roslaunch import config
config.load_roscore = lambda *_, **__: None
def read(words):
    sys.argv = ["roslaunch", *words]
    said = StringIO()
    try:
        with redirect_stdout(StringIO()), redirect_stderr(said):
            c = config.load_config_default(words[:1], None, verbose=False, assign_machines=False)
    except Exception:
        return None
    nodes = [[n.name, n.namespace, n.package, n.type, n.args, [list(r) for r in n.remap_args],
              [list(e) for e in n.env_args], n.output or "log", n.respawn, n.respawn_delay, n.required,
              "node" if n.cwd == "node" else "ROS_HOME", n.launch_prefix or "", n.machine_name or ""] for n in c.nodes]
    tests = [[t.name, t.namespace, t.package, t.type, t.args, t.test_name, t.time_limit, t.retry] for t in c.tests]
    params = {k: repr(getattr(p.value, "data", p.value)) for k, p in c.params.items()}
    return [nodes, tests, params, sorted(c.clear_params), bool(c.config_errors or said.getvalue())]
print(json.dumps([read(words) for words in json.load(sys.stdin)]))
"""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("ws") / "p"
    folder.mkdir()
    (folder / "package.xml").write_text("<package><name>p</name><version>1.0.0</version></package>")
    (folder / "talk").write_text("#!/bin/sh\n")
    (folder / "talk").chmod(0o755)
    return folder


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    """Line → words of the command line, with the file written."""
    folder = tmp_path_factory.mktemp("files")
    files_by_case: dict[str, list[str]] = {}
    for number, line in enumerate(_LINES):
        head, _, text = line.partition(": ")
        name, *words = head.split()
        text = text.replace(r"\n", "\n").replace(r"\t", "\t")
        body = _EVAL.format(text) if name in ("eval", "wrong") else text
        body = re.sub(r"<(\w)/>", r'<node pkg="p" type="talk" name="\1"/>', body)
        main, _, sibling = name.partition("/")
        path = folder / (main if main not in ("eval", "wrong") else f"{number}")
        path.mkdir(exist_ok=True)
        whole = body if "<launch" in body or sibling == "t.launch" else f"<launch>{body}</launch>"
        (path / (sibling or "main.launch")).write_text(whole)
        if not sibling:
            files_by_case[line] = [str(path / "main.launch"), *words]
    return files_by_case


def _env(package: Path) -> dict[str, str]:
    environment = {key: value for key, value in os.environ.items() if not key.startswith("ROS_") and key != "NOPE"}
    return {
        **environment,
        "ROS_PACKAGE_PATH": str(package.parent),
        "FOO": "foo",
        "ROS_MASTER_URI": "http://127.0.0.1:1",
    }


def _read(words: list[str], env: dict[str, str]) -> list[Any] | None:
    report = Diagnostics()
    packages = Packages(env, start=Path(words[0]))
    request = read_request(words, packages)
    try:
        plan = read_launch(request.files, packages=packages, report=report, arguments=request.arguments, env=env)
        params = resolve_params(plan, report, expand_xacro=lambda _file, _arguments: "", env=env)
    except DescriptionError:  # a sentence with file and line
        return None

    def path(node: LaunchNode) -> list[Any]:
        return [node.name, node.namespace.rstrip("/") + "/", node.package, node.type, node.arguments]

    nodes = [
        [
            *(*path(n), [list(r) for r in n.remappings], [list(e) for e in n.env], n.output, n.respawn),
            *(n.respawn_delay_s, n.required, n.cwd, n.launch_prefix, n.machine),
        ]
        for n in plan.nodes
    ]
    tests = [[*path(t.node), t.name, t.time_limit_s, t.retries] for t in plan.tests]
    values = {param.name: repr(param.value) for param in params}
    return [nodes, tests, values, sorted(f"{name.rstrip('/')}/" for name in plan.clear_params), bool(report.warnings)]


@pytest.mark.real_ros
def test_each_file_is_read_as_by_roslaunch(files: dict[str, list[str]], package: Path) -> None:
    if not Path("/usr/bin/roslaunch").exists():
        pytest.skip("Debian's roslaunch is not installed (make system)")
    env = _env(package)
    input_json = json.dumps(list(files.values()))
    done = subprocess.run(
        [REAL_PYTHON, "-c", _REAL], input=input_json, env=env, capture_output=True, text=True, check=True, timeout=100
    )

    def plain(read: object) -> str:
        return _ANONYMOUS.sub("_ANON", json.dumps(read))

    differences = [
        f"{line}\n  ours: {plain(actual)}\n  theirs: {plain(expected)}"
        for (line, words), expected in zip(files.items(), json.loads(done.stdout), strict=True)
        if plain(actual := _read(words, env)) != plain(expected)
    ]
    assert "\n".join(differences) == ""


def test_faults_are_refused_with_file_and_line(files: dict[str, list[str]], package: Path) -> None:
    """Faults are refused without a reference roslaunch, too; the DescriptionError names file and line."""
    refused = [line for line, words in files.items() if _read(words, _env(package)) is None]

    assert len(refused) > 80
    assert all(line in refused for line in files if line.startswith("wrong: "))
    assert not any(line in refused for line in files if line.startswith("eval: "))


@pytest.mark.parametrize(
    "expression",
    [
        "'%99999d' % 1",
        "'%*d' % (99999, 1)",
        "'{:99999}'.format(1)",
        "'{:{}}'.format(1, 99999)",
        "'{0.real}'.format(1)",
        "'{0[0]}'.format('a')",
        "'%s' * 1000 % 1",
        "('%s' * 9999) % ('a' * 9999)",
        "factorial(10**6)",
        "1 << 10**9",
        "str([[0] * 99999] * 999)",
        "[[0] * 99999] * 999",
        "list(map(list, ['a' * 99999] * 999))",
        "prod([10**9999] * 999)",
        "round(1, -10**9)",
        "'a'.zfill(10**9)",
        "('a' * 9999).join(['b'] * 9999)",
    ],
)
def test_an_expression_cannot_grow_without_bound(tmp_path: Path, package: Path, expression: str) -> None:
    file = tmp_path / "main.launch"
    file.write_text(f"<launch>{_EVAL.format(expression)}</launch>")
    assert _read([str(file)], _env(package)) is None
