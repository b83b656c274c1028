"""Appends Trundle's finder of ROS packages, in processes whose PYTHONPATH begins with this folder.

Then runs the `sitecustomize` that this one hides.
"""

import os
import sys
from importlib.machinery import PathFinder

try:
    from trundle.rospy.finder import install
    from trundle.rospy.python2.loader import install as install_translation
except ImportError:  # another Python, without Trundle
    pass
else:
    install()
    install_translation()

_here = os.path.dirname(os.path.abspath(__file__))
_hidden = PathFinder.find_spec("sitecustomize", [path for path in sys.path if os.path.abspath(path) != _here])
if _hidden is not None and _hidden.loader is not None:
    from importlib.util import module_from_spec

    _hidden.loader.exec_module(module_from_spec(_hidden))
