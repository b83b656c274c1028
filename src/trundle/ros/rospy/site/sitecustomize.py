"""Appends Trundle's finder of ROS packages, in processes whose PYTHONPATH begins with this folder.

Then runs the `sitecustomize` that this one hides.
"""

import os
import sys
from importlib.machinery import PathFinder

_INTERRUPTED = 130
"""Exit code of programs that Ctrl-C ended."""


def _install():
    try:
        from trundle.ros.rospy.finder import install
        from trundle.ros.rospy.python2.loader import install as install_translation
    except ImportError:
        return False
    install()
    install_translation()
    return True


def _install_from_libraries():
    """Install the finder in another Python of the same version, which uses Trundle's libraries after its own."""
    tag, _, libraries = os.environ.get("TRUNDLE_LIBRARIES", "").partition(":")
    if tag == sys.implementation.cache_tag:
        from site import addsitedir

        addsitedir(libraries)
        _install()


def _run_hidden():
    here = os.path.dirname(os.path.abspath(__file__))
    hidden = PathFinder.find_spec("sitecustomize", [path for path in sys.path if os.path.abspath(path) != here])
    if hidden is not None and hidden.loader is not None:
        from importlib.util import module_from_spec

        hidden.loader.exec_module(module_from_spec(hidden))


try:
    if not _install():
        _install_from_libraries()
    _run_hidden()
except KeyboardInterrupt:  # Python would report Ctrl-C as a fatal error, with two tracebacks
    os._exit(_INTERRUPTED)
