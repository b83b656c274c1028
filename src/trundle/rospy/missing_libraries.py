"""Advice for a program that ended because its Python lacks a module."""

import sys

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
_OF_THE_SYSTEM = {
    "gi": "apt install python3-gi",
    "tkinter": "apt install python3-tk",
    "RPi": "it is the Raspberry Pi's",
    "PyQt4": "it ended with Python 2; PyQt5 is its successor",
    "PySide": "it ended with Python 2; PySide6 is its successor",
}


def advice(error: Exception) -> str | None:
    """Return how to go on after the error that ended a program; None if nothing is known."""
    from .python2.advice import python2_advice

    if (line := python2_advice(error)) is not None:
        return line
    return missing_module_advice(error.name) if isinstance(error, ModuleNotFoundError) and error.name else None


def missing_module_advice(module: str) -> str:
    """Return what brings a module that is not found."""
    name = module.partition(".")[0]
    if name in _OF_THE_SYSTEM:
        return f"trundle: no module {name!r}: {_OF_THE_SYSTEM[name]}"
    from trundle.repositories import shipped_index

    if name not in _PYPI and shipped_index().find(name, "noetic") is not None:
        return f"trundle: {name!r} is a ROS package: trundle pack get {name}"
    return f"trundle: no module {name!r} in this Python; {sys.executable} -m pip install {_PYPI.get(name, name)}"
