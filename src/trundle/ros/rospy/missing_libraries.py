"""Advice for a program that ended because its Python lacks a module."""

import re
import sys
import traceback

_PYPI = {
    "bs4": "beautifulsoup4",
    "cv2": "opencv-python",
    "Crypto": "pycryptodome",
    "dateutil": "python-dateutil",
    "google": "protobuf",
    "OpenGL": "PyOpenGL",
    "PIL": "pillow",
    "serial": "pyserial",
    "skimage": "scikit-image",
    "sklearn": "scikit-learn",
    "smbus": "smbus2",
    "socketio": "python-socketio",
    "speech_recognition": "SpeechRecognition",
    "usb": "pyusb",
    "websocket": "websocket-client",
    "wx": "wxPython",
    "yaml": "pyyaml",
    "zmq": "pyzmq",
}
"""Module → PyPI's name, where they differ."""
_SYSTEM_MODULES = {
    "gi": "apt install python3-gi",
    "tkinter": "apt install python3-tk",
    "RPi": "it is the Raspberry Pi's",
    "PyQt4": "it ended with Python 2; PyQt5 is its successor",
    "PySide": "it ended with Python 2; PySide6 is its successor",
}


def advice(error: Exception) -> str | None:
    """Return advice for the error that ended a program, or None."""
    from .python2.advice import python2_advice

    return python2_advice(error) or library_advice(error)


def library_advice(error: BaseException) -> str | None:
    """Return how to install the module that a program lacks; None for another error."""
    if not isinstance(error, ModuleNotFoundError) or not error.name:
        return None
    return missing_module_advice(error.name, has_messages=_is_imported_for_messages(error.name, error))


def _is_imported_for_messages(module: str, error: ModuleNotFoundError) -> bool:
    """True if the failing line imports the module's messages, services or options, as of a ROS package."""
    lines = (frame.line or "" for frame in traceback.extract_tb(error.__traceback__))
    import_pattern = re.compile(rf"\b{re.escape(module)}\.(?:msg|srv|cfg)\b")
    return any(import_pattern.search(line) for line in lines)


def missing_module_advice(module: str, *, has_messages: bool = False) -> str:
    """Return how to install a module that is not found; `has_messages`: it belongs to a ROS package."""
    name = module.partition(".")[0]
    if name in _SYSTEM_MODULES:
        return f"trundle: no module {name!r}: {_SYSTEM_MODULES[name]}"
    from trundle.robots.repositories import shipped_index

    if name not in _PYPI and shipped_index().find(name, "noetic") is not None:
        if sys.modules.get(name) is not None:
            return f"trundle: the ROS package {name!r} is here without {module!r}; is that C++, which is not built?"
        return f"trundle: {name!r} is a ROS package: trundle pack get {name}"
    if has_messages:
        what = f"trundle: {name!r} is a ROS package that is not here"
        return f"{what}: put it into the workspace's src, or on ROS_PACKAGE_PATH"
    return f"trundle: no module {name!r} in this Python; {sys.executable} -m pip install {_PYPI.get(name, name)}"
