"""Qt under ROS's names, with PyQt5 or PySide6 from PyPI."""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from trundle.ros.rospy.environment import with_finder

HIDE = "import sys; sys.modules[{!r}] = None\n"
PROGRAM = """\
from python_qt_binding import QT_BINDING, loadUi
from python_qt_binding.QtCore import QTimer, Signal, Slot
from python_qt_binding.QtGui import QFont, QLabel
from python_qt_binding.QtWidgets import QAction, QApplication, QSlider, QWidget

class Window(QWidget):
    moved = Signal(int)

    def __init__(self):
        super(Window, self).__init__()
        loadUi("window.ui", self)
        self.slider.valueChanged.connect(self.moved)
        self.moved.connect(self.show_value)

    @Slot(int)
    def show_value(self, value):
        self.label.setText("at %d" % value)

app = QApplication(sys.argv)
window = Window()
QTimer.singleShot(0, lambda: window.slider.setValue(7))
QTimer.singleShot(50, app.quit)
app.exec_()
print(QT_BINDING, window.label.text(), isinstance(window.slider, QSlider))
"""
UI = """\
<ui version="4.0"><class>Form</class><widget class="QWidget" name="Form"><layout class="QVBoxLayout" name="rows">
<item><widget class="QSlider" name="slider"/></item><item><widget class="QLabel" name="label"/></item>
</layout></widget></ui>
"""


def _run(folder: Path, code: str) -> "subprocess.CompletedProcess[str]":
    (folder / "window.ui").write_text(UI)
    env = with_finder({**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    return subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code], cwd=folder, env=env, capture_output=True, text=True, timeout=120
    )


@pytest.mark.slow
@pytest.mark.parametrize(("package", "name"), [("PyQt5", "pyqt"), ("PySide6", "pyside")])
def test_a_window_is_loaded_and_receives_signals_with_either_binding(tmp_path: Path, package: str, name: str) -> None:
    if find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    other = "PySide6" if package == "PyQt5" else "PyQt5"

    done = _run(tmp_path, HIDE.format(other) + PROGRAM)

    assert done.stdout == f"{name} at 7 True\n", done.stderr


def test_the_error_without_qt_names_the_packages_to_install(tmp_path: Path) -> None:
    hide = HIDE.format("PyQt5") + HIDE.format("PySide6")

    done = _run(tmp_path, hide + "import python_qt_binding")

    assert done.stderr.endswith("ImportError: python_qt_binding needs Qt for Python: pip install PyQt5 (or PySide6)\n")
