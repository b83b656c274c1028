"""Qt's Python binding under ROS' names: PyQt5 if installed, else PySide6.

`python_qt_binding.QtWidgets` and the others are the binding's modules. With both bindings, QtCore has `Signal`, `Slot`
and `Property`, and QtGui has the widgets, for programs of Qt 4.
"""

import sys
from importlib import import_module
from importlib.util import find_spec

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

__all__ = ["QT_BINDING", "QT_BINDING_MODULES", "QT_BINDING_VERSION", "loadUi"]

_BINDINGS = {"PyQt5": "pyqt", "PySide6": "pyside"}
_REQUIRED = ("QtCore", "QtGui", "QtWidgets")
_OPTIONAL = ("QtHelp", "QtMultimedia", "QtNetwork", "QtOpenGL", "QtPrintSupport", "QtSql", "QtSvg", "QtTest", "QtXml")

_package = next((name for name in _BINDINGS if find_spec(name)), None)
if _package is None:
    raise ImportError("python_qt_binding needs Qt for Python: pip install PyQt5 (or PySide6)")

QT_BINDING = _BINDINGS[_package]
QT_BINDING_MODULES: "dict[str, Any]" = {name: import_module(f"{_package}.{name}") for name in _REQUIRED}
for _name in _OPTIONAL:
    try:
        QT_BINDING_MODULES[_name] = import_module(f"{_package}.{_name}")
    except ImportError:  # not in this build of Qt, or a library of the system is missing
        continue

_core, _gui, _widgets = (QT_BINDING_MODULES[name] for name in _REQUIRED)
if QT_BINDING == "pyqt":
    _core.Signal, _core.Slot, _core.Property = _core.pyqtSignal, _core.pyqtSlot, _core.pyqtProperty
QT_BINDING_VERSION = _core.PYQT_VERSION_STR if QT_BINDING == "pyqt" else _core.__version__
for _from, _to in ((_widgets, _gui), (_gui, _widgets)):  # Qt 6 moved QAction and QShortcut to QtGui
    for _name in (name for name in dir(_from) if name.startswith("Q") and not hasattr(_to, name)):
        setattr(_to, _name, getattr(_from, _name))

for _name, _module in QT_BINDING_MODULES.items():
    sys.modules[f"{__name__}.{_name}"] = globals()[_name] = _module


def loadUi(uifile: "Any", baseinstance: "Any" = None, custom_widgets: "Mapping[str, type] | None" = None) -> "Any":
    """Load a file of Qt Designer.

    Args:
        uifile: path of the file.
        baseinstance: widget to use as the file's top-level one; None: a new one.
        custom_widgets: class name in the file → class, if the file does not name the class's module.

    Returns:
        The top-level widget, with the others as attributes.
    """
    if QT_BINDING == "pyqt":
        return import_module("PyQt5.uic").loadUi(uifile, baseinstance)
    from .pyside_ui import UiLoader

    return UiLoader(baseinstance, custom_widgets or {}).load(uifile)
