"""Python libraries by rosdep key, as in package.xml."""

import re

_KEY = re.compile(r"python[23]?-(.+?)(-pip)?")
_RENAMED = {
    "bs4": "beautifulsoup4",
    "crypto": "pycryptodome",
    "cv": "opencv-python",
    "dateutil": "python-dateutil",
    "gnupg": "python-gnupg",
    "igraph": "python-igraph",
    "imaging": "pillow",
    "opencv": "opencv-python",
    "pil": "pillow",
    "qt4-bindings": "PyQt5",
    "qt5-bindings": "PyQt5",
    "serial": "pyserial",
    "skimage": "scikit-image",
    "sklearn": "scikit-learn",
    "socketio": "python-socketio",
    "speechrecognition": "SpeechRecognition",
    "tk": "",
    "usb": "pyusb",
    "websocket": "websocket-client",
    "xlib": "python-xlib",
    "yaml": "pyyaml",
    "zmq": "pyzmq",
}
"""Debian's name → PyPI's; '': PyPI does not have it."""


def python_library(key: str) -> str | None:
    """Return PyPI's name of a rosdep key such as python3-opencv; None for other keys."""
    match = _KEY.fullmatch(key)
    if match is None:
        return None
    return _RENAMED.get(match[1].lower(), match[1]) or None
