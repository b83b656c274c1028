"""Appends Trundle's finder of ROS packages, in processes whose PYTHONPATH begins with this folder.

Then runs the `sitecustomize` that this one hides.
"""

import os
import sys
from importlib.machinery import PathFinder


def _install():
    try:
        from trundle.rospy.finder import install
        from trundle.rospy.python2.loader import install as install_translation
    except ImportError:
        return False
    install()
    install_translation()
    return True


if not _install():  # another Python, without Trundle: one of the same version can use its libraries after its own
    _tag, _, _libraries = os.environ.get("TRUNDLE_LIBRARIES", "").partition(":")
    if _tag == sys.implementation.cache_tag:
        from site import addsitedir

        addsitedir(_libraries)
        _install()

_here = os.path.dirname(os.path.abspath(__file__))
_hidden = PathFinder.find_spec("sitecustomize", [path for path in sys.path if os.path.abspath(path) != _here])
if _hidden is not None and _hidden.loader is not None:
    from importlib.util import module_from_spec

    _hidden.loader.exec_module(module_from_spec(_hidden))
