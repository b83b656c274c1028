"""Python 2 programs: output of the translation, detection, and a node on a graph."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from tests.graphs import PATIENCE_S, running_graph

from trundle.ros.rospy.environment import RUN_PYTHON2, with_finder
from trundle.ros.rospy.python2.detect import is_python2
from trundle.ros.rospy.python2.translate import show_changes, translate

_LANGUAGE = """\
# -*- coding: utf-8 -*-
import sys, Queue, cPickle, StringIO
from types import StringType
reload(sys)
sys.setdefaultencoding('utf8')
class Half:
    def __init__(self, x): self.x = x
    def __div__(self, k): return Half(self.x / k)
    def __nonzero__(self): return False
def first((a, b), c):
    return a + b + c
d = {'a': 1, 'b': 2}
k = d.keys(); k.sort()
print k, d.has_key('a'), 7 / 2, 7 / 2.0, -7 / 2
print >>sys.stderr, "aside",
print "x = %d" % 3,
print u'y'
for n, v in d.iteritems():
    print n, v
try:
    raise ValueError, "bad"
except ValueError, e:
    print 'caught', e
try:
    raise "text"
except "text":
    print 'a string'
exec "q = 5" in globals()
print q, `q`, 0777, 10L, xrange(3)[1], unicode("ü", "utf-8"), first((1, 2), 3)
import numpy
a = numpy.array([5, 7]); b = a; a /= 2
print b, numpy.array([5, 7]) / 2, numpy.array([5., 7]) / 2, (Half(7) / 2).x, bool(Half(7))
x = [9]; x[0] /= 2; y = 9; y /= 2
print x, y, isinstance('a', basestring), range(3) + [1], map(None, [1, 2], [3, 4]), round(2.5)
l = [3, 1]; l.sort(lambda p, q: cmp(p, q)); m = numpy.array([3, 1]); m.sort(0)
print l, m, sorted([1, 3], cmp=lambda p, q: cmp(q, p)), isinstance('a', StringType), sys.maxint > 5
if 1 <> 2: print raw_input(), input() + 1, reduce(max, [1, 4]), cPickle.loads(cPickle.dumps([1]))
Queue.Queue().put(None)
"""
_PRINTED = """\
['a', 'b'] True 3 3.5 -4
x = 3 y
a 1
b 2
caught bad
a string
5 5 511 10 1 ü 6
[2 3] [2 3] [2.5 3.5] 3 False
[4] 4 True [0, 1, 2, 1] [(1, 3), (2, 4)] 3.0
[1, 3] [1 3] [3, 1] True True
typed 5 4 [1]
"""


@pytest.fixture(autouse=True)
def _separate_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def _run(script: Path, *, typed: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, RUN_PYTHON2, script],
        input=typed,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


def test_a_program_prints_the_same_as_with_python_2_and_its_file_is_unchanged(tmp_path: Path) -> None:
    script = tmp_path / "old.py"
    script.write_text(_LANGUAGE)
    for _ in range(2):  # translated, then from the cache
        done = _run(script, typed="typed\n4\n")
        assert (done.returncode, done.stdout) == (0, _PRINTED), done.stderr
        assert done.stderr.startswith(f"{script} is Python 2: translated; --show-translation prints the changes\n")
    assert script.read_text() == _LANGUAGE
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cache", "old.py"]


def test_a_traceback_shows_the_users_file_and_lines(tmp_path: Path) -> None:
    """Also where the translation adds a line, as for a tuple parameter."""
    script = tmp_path / "old.py"
    script.write_text("print 'a'\ndef f((a, b)):\n    c = a\n    return c.missing\n\nf((1, 2))\n")
    done = _run(script)
    assert done.stderr.splitlines()[1:] == [
        "Traceback (most recent call last):",
        f'  File "{script}", line 6, in <module>',
        "    f((1, 2))",
        f'  File "{script}", line 4, in f',
        "    return c.missing",
        "AttributeError: 'int' object has no attribute 'missing'",
    ]


def test_the_advice_for_a_missing_module_of_a_translated_program_names_its_source(tmp_path: Path) -> None:
    script = tmp_path / "old.py"
    script.write_text("print 'a'\nfrom PyQt4 import QtGui\n")

    done = subprocess.run(
        [sys.executable, RUN_PYTHON2, script], env=with_finder(os.environ), capture_output=True, text=True, check=False
    )

    assert done.stderr.splitlines()[-4:] == [
        f'  File "{script}", line 2, in <module>',
        "    from PyQt4 import QtGui",
        "ModuleNotFoundError: No module named 'PyQt4'",
        "trundle: no module 'PyQt4': it ended with Python 2; PyQt5 is its successor",
    ]


@pytest.mark.skipif(os.name != "posix", reason="Ctrl-C is a signal there")
def test_a_program_that_is_interrupted_while_it_is_translated_prints_nothing(tmp_path: Path) -> None:
    """Ctrl-C in a launch interrupts programs that are still being translated."""
    (tmp_path / "fissix.py").write_text("import os, time\nos.write(1, b'parsing')\ntime.sleep(100.0)\n")
    (tmp_path / "old.py").write_text("print 'a'\n")
    with subprocess.Popen(
        [sys.executable, RUN_PYTHON2, tmp_path / "old.py"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.read(7) == b"parsing"
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 130
        assert process.stderr.read() == b""


def test_division_is_unchanged_where_true_division_is_imported() -> None:
    assert translate("from __future__ import division\nprint 7 / 2\n", "a.py") == (
        "from __future__ import division\nprint(7 / 2)\n"
    )
    assert show_changes("print a / b\n", "a.py").splitlines()[-2:] == ["-print a / b", "+print(python2_divide(a, b))"]


@pytest.mark.parametrize(
    ("source", "is_old"),
    [
        ("print 'a'\n", True),
        ("for i in xrange(3): pass\n", True),
        ("import Tkinter\n", True),
        ("d = {}\nd.has_key(1)\n", True),
        ("#!/usr/bin/env python2.7\nprint('a')\n", True),
        ("import time\nstart = time.clock()\n", True),
        ("import time\ntry:\n    now = time.clock()\nexcept AttributeError:\n    now = time.perf_counter()\n", False),
        ("print('a', 7 / 2)\n", False),
        ("try:\n    import Queue\nexcept ImportError:\n    import queue\n", False),
        ("try:\n    import urllib.parse as urlparse\nexcept ImportError:\n    import urlparse\n", False),
        ("try:\n    input = raw_input\nexcept NameError:\n    pass\n", False),
        ("import sys\nread = raw_input if sys.version_info[0] < 3 else input\n", False),
        ("file = open('a')\nfile.read()\n", False),
        ("def cmp(a, b): return 0\ncmp(1, 2)\n", False),
    ],
)
def test_programs_for_python_2_only_are_detected(source: str, is_old: bool) -> None:
    assert is_python2(source) == is_old


def test_imports_are_relative_only_within_packages(tmp_path: Path) -> None:
    """A script's folder may also have an `__init__.py`, as folders of tests do."""
    folder = tmp_path / "scripts"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "first.py").write_text("from second import WORD\nprint 'top', WORD\n")
    (folder / "second.py").write_text("WORD = 'second'\n")
    (folder / "run.py").write_text("import first\nimport inside.third\nprint 'end'\n")
    package = folder / "inside"
    package.mkdir()
    (package / "__init__.py").write_text("print 'init'\nfrom fourth import WORD\n")
    (package / "third.py").write_text("from fourth import WORD\nprint 'package', WORD\n")
    (package / "fourth.py").write_text("WORD = 'fourth'\n")

    done = subprocess.run([sys.executable, RUN_PYTHON2, folder / "run.py"], capture_output=True, text=True, check=False)

    assert done.stdout.splitlines() == ["top second", "init", "package fourth", "end"], done.stderr


def test_a_node_and_the_modules_of_its_package_run_on_a_graph(tmp_path: Path) -> None:
    """`trundle exec` of a script for python2.7, which is not needed."""
    package = tmp_path / "src" / "old_robot"
    (package / "src" / "old_robot").mkdir(parents=True)
    (package / "scripts").mkdir()
    (package / "package.xml").write_text("<package><name>old_robot</name></package>")
    (package / "src" / "old_robot" / "__init__.py").write_text("")
    (package / "src" / "old_robot" / "words.py").write_text(
        "def say(n):\n    print 'from the package', n / 2\n    return n\n"
    )
    (package / "scripts" / "near.py").write_text("WORD = '%s' % `5`\nprint 'near'\n")
    node = package / "scripts" / "talk.py"
    node.write_text(
        "#!/usr/bin/env python2.7\nimport rospy\nfrom std_msgs.msg import String\nfrom old_robot.words import say\n"
        "from near import WORD\nrospy.init_node('talk')\n"
        "pub = rospy.Publisher('said', String, latch=True, queue_size=1)\n"
        "pub.publish('%s %d' % (WORD, say(7)))\nprint rospy.get_name()\nrospy.spin()\n"
    )
    node.chmod(0o755)
    launch = package / "all.launch"
    launch.write_text(
        "<launch>"
        "<node name='one' pkg='old_robot' type='talk.py'/><node name='two' pkg='old_robot' type='talk.py'/>"
        "<node name='rosout' pkg='rosout' type='rosout'/>"
        "</launch>"
    )
    command = [sys.executable, "-m", "trundle", "exec", "old_robot", "talk.py"]
    with running_graph() as graph:
        env = {**os.environ, "ROS_MASTER_URI": graph.core.uri, "ROS_PACKAGE_PATH": str(tmp_path / "src")}
        env["PYTHONUNBUFFERED"] = "1"
        with subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            assert program.stdout is not None
            lines = [program.stdout.readline() for _ in range(3)]
            program.terminate()
            _, errors = program.communicate(timeout=PATIENCE_S)
        shown, of_launch = (
            subprocess.run([*command[:3], *words], env=env, capture_output=True, text=True, check=True).stdout
            for words in (
                ["exec", "--show-translation", *command[4:]],
                ["launch", "--show-translation", str(launch)],
            )
        )
    assert lines == ["near\n", "from the package 3\n", "/talk\n"], errors
    assert errors.count("is Python 2: translated") == 1
    assert "+print(rospy.get_name())" in shown
    assert of_launch == shown
    assert not list(package.rglob("near*.pyc")) + list(package.rglob("words*.pyc"))
