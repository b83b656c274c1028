"""ROS' packages are importable by PYTHONPATH and by trundle-rospy's .pth; installed packages win."""

import os
import signal
import subprocess
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path

import pytest

from trundle.ros.rospy.environment import LIBRARIES, SITE, with_finder
from trundle.ros.rospy.setup_file import read_setup

_PTH = Path(__file__).parents[3] / "packaging/trundle-rospy/trundle_rospy.pth"


def _output(code: str, env: Mapping[str, str], *, python: str | Path = sys.executable, cwd: Path | None = None) -> str:
    environment = {name: value for name, value in os.environ.items() if not name.startswith("ROS")} | dict(env)
    done = subprocess.run(
        [python, "-W", "ignore", "-c", code], env=environment, cwd=cwd, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_a_child_process_imports_rospy_and_messages() -> None:
    code = "import rospy, std_msgs.msg; print(rospy.__name__, std_msgs.msg.String('a'))"
    assert _output(code, with_finder({})) == 'rospy data: "a"'


def test_the_pythonpath_of_the_user_stays_in_effect(tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text("import builtins; builtins.mark = 5\n")
    (tmp_path / "rospy.py").write_text("mine = True\n")
    env = with_finder({"PYTHONPATH": str(tmp_path)}, [tmp_path])
    assert env["PYTHONPATH"] == f"{SITE}{os.pathsep}{tmp_path}"
    assert env["ROS_PACKAGE_PATH"] == str(tmp_path)
    assert with_finder({"ROS_PACKAGE_PATH": "/a"}, [tmp_path])["ROS_PACKAGE_PATH"] == "/a"
    assert _output("import rospy; print(mark, rospy.mine)", env) == "5 True"


def test_another_python_of_the_same_version_keeps_its_libraries(tmp_path: Path) -> None:
    """A script whose first line names its virtual environment; ROS' packages come from this Python's libraries."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tmp_path / "venv"], check=True)
    site = next((tmp_path / "venv").glob("**/site-packages"))
    python = next(path for path in (tmp_path / "venv").glob("*/python*") if path.stem == "python")
    (site / "gripper.py").write_text("own = True\n")
    code = "import gripper, std_msgs.msg; print(gripper.own, std_msgs.msg.String('a'))"

    assert _output(code, with_finder({}), python=python) == 'True data: "a"'

    other = {**with_finder({}), LIBRARIES: f"cpython-27:{sysconfig.get_path('purelib')}"}
    with pytest.raises(AssertionError, match="No module named 'std_msgs'"):
        _output(code, other, python=python)


@pytest.mark.parametrize(
    ("module", "advice"),
    [
        ("cv2.aruco", f"no module 'cv2' in this Python; {sys.executable} -m pip install opencv-python"),
        ("no_such_library", f"{sys.executable} -m pip install no_such_library"),
        ("PyQt4", "it ended with Python 2; PyQt5 is its successor"),
        ("summit_xl_pad", "'summit_xl_pad' is a ROS package: trundle pack get summit_xl_pad"),
    ],
)
def test_the_advice_for_a_missing_module_names_its_source(module: str, advice: str) -> None:
    code = f"import sys; sys.modules.update(cv2=None) if {module!r}[:3] == 'cv2' else None; import {module}"
    words = [sys.executable, "-c", code]
    done = subprocess.run(words, env=with_finder(os.environ), capture_output=True, text=True, check=False)

    assert done.returncode == 1
    assert "ModuleNotFoundError: " in done.stderr
    assert done.stderr.splitlines()[-1].endswith(advice)


def test_the_advice_for_a_missing_compiled_module_of_an_installed_package_is_to_build_it(tmp_path: Path) -> None:
    """trac_ik_python wraps C++; fetching it again would not help."""
    (tmp_path / "trac_ik_python").mkdir()
    (tmp_path / "trac_ik_python/__init__.py").write_text("")
    program = tmp_path / "solve.py"
    program.write_text("from trac_ik_python.trac_ik_wrap import TRAC_IK\n")

    words = [sys.executable, program]
    done = subprocess.run(words, env=with_finder(os.environ), capture_output=True, text=True, check=False)

    text = "trundle: the ROS package 'trac_ik_python' is here without 'trac_ik_python.trac_ik_wrap'; is that C++"
    assert done.stderr.splitlines()[-1] == f"{text}, which is not built?"


def test_the_advice_for_messages_of_an_unknown_package_names_the_workspace(tmp_path: Path) -> None:
    program = tmp_path / "sensor.py"
    program.write_text("from no_such_mouse.msg import Light\n")

    words = [sys.executable, program]
    done = subprocess.run(words, env=with_finder(os.environ), capture_output=True, text=True, check=False)

    text = "trundle: 'no_such_mouse' is a ROS package that is not here"
    assert done.stderr.splitlines()[-1] == f"{text}: put it into the workspace's src, or on ROS_PACKAGE_PATH"


def test_the_pth_of_trundle_rospy_makes_packages_importable(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tmp_path / "venv"], check=True)
    site = next((tmp_path / "venv").glob("**/site-packages"))
    python = next(path for path in (tmp_path / "venv").glob("*/python*") if path.stem == "python")
    (site / "a.pth").write_text(f"import site; site.addsitedir({sysconfig.get_path('platlib')!r})\n")
    (site / _PTH.name).write_text(_PTH.read_text())
    assert _output("import rospy; print(rospy.__name__)", {}, python=python) == "rospy"


def _package(folder: Path, name: str) -> Path:
    (folder / name).mkdir(parents=True)
    (folder / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    return folder / name


def test_messages_and_modules_of_the_workspace_need_no_build(tmp_path: Path) -> None:
    """As in the tutorials: the package's own messages, services and actions, and modules below src."""
    package = _package(tmp_path / "src", "beginner")
    for name, text in {
        "msg/Person.msg": "Header header\nstring name\nuint8 OLD=100\nOther[] others\n",
        "msg/Other.msg": "geometry_msgs/Point where\n",
        "srv/Greet.srv": "Person who\n---\nbool is_polite\n",
        "action/Walk.action": "int32 steps\n---\nfloat32 far\n---\nint32 done\n",
        "src/beginner/__init__.py": "",
        "src/beginner/greeting.py": "from beginner.msg import Person\n",
        "setup.py": "setup(**generate_distutils_setup(packages=['extra', 'beginner'], package_dir={'': 'src'}))\n",
        "src/extra/__init__.py": "value = 7\n",
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    code = """
import beginner.greeting, extra
from beginner.msg import *
from beginner.srv import Greet, GreetResponse
print(beginner.greeting.Person is Person, Person.OLD, Person(others=[Other()]).others[0].where.x, extra.value)
print(Greet._request_class.__slots__, GreetResponse(True).is_polite, WalkGoal(3).steps, WalkAction().action_goal)
import roslib; roslib.load_manifest("beginner")
try:
    from beginner.msg import Nobody
except ImportError as error:
    print(error)
"""
    printed = _output(code, with_finder({}), cwd=package).splitlines()
    assert printed[0] == "True 100 0.0 7"
    assert printed[1].startswith("['who'] True 3 header:")
    assert printed[-1].startswith("cannot import name 'Nobody' from 'beginner.msg'")
    elsewhere = _output(
        "import extra; print(extra.value)", with_finder({"ROS_PACKAGE_PATH": str(tmp_path)}), cwd=tmp_path
    )
    assert elsewhere == "7"


def test_the_error_of_an_invalid_definition_names_type_and_line(tmp_path: Path) -> None:
    package = _package(tmp_path, "broken")
    (package / "msg").mkdir()
    (package / "msg/Bad.msg").write_text("int32 a\nwhat is this\n")
    code = "import broken.msg\ntry: broken.msg.Bad\nexcept ImportError as error: print(error)"
    error = _output(code, with_finder({}), cwd=package)
    assert error.startswith("broken/Bad cannot be imported: the definition of broken/Bad cannot be read: line 2")


@pytest.mark.parametrize(
    ("text", "modules"),
    [
        (
            "d = generate_distutils_setup()\nd['packages'] = ['a']\nd['package_dir'] = {'': 'src'}\nsetup(**d)\n",
            {"a": "src/a"},
        ),
        ("setup(packages=['a.b'], package_dir={'a': 'lib/x'})", {"a": "lib/x"}),
        ("setup(py_modules=['one'], package_dir={'': 'src'})", {"one": "src/one.py"}),
        ("setup(packages=find_packages())", {}),
        ("setup(packages=", {}),
        ("setup(packages={'a': 1}, package_dir=['src'])", {}),
    ],
)
def test_setup_files_are_parsed_not_run(tmp_path: Path, text: str, modules: dict[str, str]) -> None:
    for folder in ("src/a", "lib/x"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "src/one.py").touch()
    (tmp_path / "setup.py").write_text(text)
    assert dict(read_setup(tmp_path / "setup.py")) == {name: tmp_path / path for name, path in modules.items()}


def test_packages_are_not_searched_for_jython_modules(tmp_path: Path) -> None:
    package = _package(tmp_path, "org")
    for name in ("__init__.py", "python/__init__.py", "python/core.py"):
        (package / "src/org" / name).parent.mkdir(parents=True, exist_ok=True)
        (package / "src/org" / name).write_text("PyStringMap = dict\n")
    code = "import copy, pickle, sys; print('org' in sys.modules)"
    assert _output(code, with_finder({"ROS_PACKAGE_PATH": str(tmp_path)})) == "False"


@pytest.mark.skipif(os.name != "posix", reason="Ctrl-C is a signal there")
def test_a_program_that_is_interrupted_while_python_starts_prints_nothing(tmp_path: Path) -> None:
    """Ctrl-C in a launch interrupts nodes that are still starting, which Python reports as a fatal error."""
    (tmp_path / "sitecustomize.py").write_text("import os, time; os.write(1, b'starting'); time.sleep(100.0)\n")
    env = with_finder({**os.environ, "PYTHONPATH": str(tmp_path)})
    with subprocess.Popen(
        [sys.executable, "-c", ""], env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.read(8) == b"starting"
        process.send_signal(signal.SIGINT)
        assert process.wait(60.0) == 130
        assert process.stderr.read() == b""
