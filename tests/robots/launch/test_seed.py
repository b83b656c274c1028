"""The published smartcar's launch file, item by item as the real roslaunch reads it."""

import json
import os
from pathlib import Path

import pytest
import yaml

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import LaunchPlan, ParamCommand, read_launch, resolve_params


class OneFolder:
    """Package finder that looks in one folder, by the package's name."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def find_folder(self, name: str, /) -> Path | None:
        path = self._folder / name
        return path if path.is_dir() else None

    is_lenient = False

    def absent_package(self, _file: Path, /) -> str | None:
        return None

    def not_found_message(self, name: str, /) -> str:
        return f"no package {name!r}"


def read_seed(shared: Path) -> tuple[LaunchPlan, Diagnostics]:
    report = Diagnostics()
    file = shared / "seeds/smartcar_description/launch/smartcar_display.rviz.launch"
    return read_launch(file, packages=OneFolder(shared / "seeds"), report=report), report


def test_the_smartcars_nodes_are_those_of_the_real_roslaunch(shared: Path) -> None:
    plan, report = read_seed(shared)
    assert report.findings == []
    assert [(n.full_name, n.package, n.type, n.output) for n in plan.nodes] == [
        ("/arbotix", "arbotix_python", "arbotix_driver", "screen"),
        ("/joint_state_publisher", "joint_state_publisher", "joint_state_publisher", "log"),
        ("/robot_state_publisher", "robot_state_publisher", "state_publisher", "log"),
        ("/odom_left_wheel_broadcaster", "tf", "static_transform_publisher", "log"),
        ("/odom_right_wheel_broadcaster", "tf", "static_transform_publisher", "log"),
        ("/rviz", "rviz", "rviz", "log"),
    ]
    assert plan.nodes[3].arguments == "0 0 0 0 0 0 /base_link /left_front_link 100"
    assert plan.nodes[5].arguments == f"-d {shared}/seeds/smartcar_description/urdf.rviz"


def flat(tree: object, name: str = "") -> dict[str, object]:
    if not isinstance(tree, dict):
        return {name: tree}
    return {k: v for key, value in tree.items() for k, v in flat(value, f"{name}/{key}").items()}


def test_the_smartcars_parameters_are_those_of_the_real_roslaunch(shared: Path) -> None:
    plan, report = read_seed(shared)
    requested: list[Path] = []

    def expand(file: Path, arguments: object, /) -> str:
        requested.append(file)
        return "<robot/>"

    got = {p.name: p.value for p in resolve_params(plan, report, expand_xacro=expand, env={})}
    dump = yaml.safe_load((shared / "peers/ros_reference/rosparam_dump.txt").read_text())
    for added in ("rosdistro", "rosversion", "roslaunch", "run_id"):  # by roslaunch itself
        del dump[added]
    want = flat(dump)
    assert set(got) == set(want)
    assert got.pop("/robot_description") == "<robot/>"
    del want["/robot_description"]
    assert {k: (type(v), v) for k, v in got.items()} == {k: (type(v), v) for k, v in want.items()}
    assert requested == [shared / "seeds/smartcar_description/urdf/smartcar.urdf.xacro"]


# Files that the real tool refuses as malformed XML, and values that a parameter server cannot hold.
_READ_HERE = {"xml_leading_blank_line.launch"}
_REFUSED_HERE = {"xml_xxe.launch"}


def test_hostile_and_broken_files_are_accepted_or_refused_as_by_roslaunch(shared: Path) -> None:
    folder = shared / "corpus/invalid/launch"
    accepted: dict[str, bool] = {}
    for line in (shared / "corpus/refs/invalid.md").read_text().partition("## launch")[2].splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) > 3 and cells[1].endswith(".launch"):
            accepted[cells[1]] = cells[2] == "ok"
    assert len(accepted) > 40
    for name, expected in accepted.items():
        try:
            read_launch(folder / name, packages=OneFolder(folder), report=Diagnostics(), env=os.environ)
            got = True
        except DescriptionError:
            got = False
        assert got == (name in _READ_HERE or (expected and name not in _REFUSED_HERE)), name


@pytest.mark.slow
def test_the_corpus_has_the_nodes_and_parameter_names_of_the_real_loader(shared: Path) -> None:
    """Only files all of whose packages are in the corpus are compared."""
    import gzip
    import re

    corpus = shared / "corpus"
    rows = json.loads((corpus / "manifest.json").read_text())["launch"]
    folders: dict[str, set[Path]] = {}
    for file in (corpus / "repos").rglob("package.xml"):
        match = re.search(r"<name>\s*([^<\s]+)\s*</name>", file.read_text(errors="replace"))
        folders.setdefault(match[1] if match else file.parent.name, set()).add(file.parent)

    class Corpus:
        """Packages of the corpus with a unique name."""

        def find_folder(self, name: str, /) -> Path | None:
            packages = folders.get(name, set())
            return next(iter(packages)) if len(packages) == 1 else None

        is_lenient = False

        def absent_package(self, _file: Path, /) -> str | None:
            return None

        def not_found_message(self, name: str, /) -> str:
            return f"no package {name!r}"

    compared = 0
    refused: dict[str, str] = {}
    for row in rows:
        if not row["accept"]:
            continue
        answer = json.loads(gzip.decompress((corpus / row["ref"]).read_bytes()))
        arguments = dict(word.split(":=", 1) for word in row["argv"] if not word.endswith(":="))
        env = {"HOME": "/root", "USER": "u", **row["env"]}
        try:
            plan = read_launch(
                corpus / row["file"], packages=Corpus(), report=Diagnostics(), arguments=arguments, env=env
            )
        except DescriptionError as error:
            refused[row["file"]] = str(error)
            continue
        want = [(n["name"], n["namespace"].rstrip("/") or "/", n["pkg"], n["type"]) for n in answer["nodes"]]
        got = [(n.name, n.namespace, n.package, n.type) for n in plan.nodes]
        if re.search(r"_\d{5,}", f"{want}{list(answer['params'])}"):  # anonymous names
            continue
        assert got == want, row["file"]
        names = {p.name: p.value for p in plan.params}
        assert set(names) == set(answer["params"]), row["file"]
        for name, value in answer["params"].items():
            if not isinstance(value, dict | list | str) and not isinstance(names[name], ParamCommand):
                assert names[name] == pytest.approx(value, nan_ok=True), f"{row['file']} {name}"
        compared += 1
    assert compared > 300
    assert [text for text in refused.values() if "no package" not in text] == []
