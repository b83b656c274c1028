"""Runs a Python 2 script as `__main__`: `python …/run.py SCRIPT ARGUMENT…`.

Run by its path, as Python runs scripts: `sys.path` begins with the script's folder.
"""

import os
import sys
from types import ModuleType, TracebackType


def main() -> None:
    """Run the script that the arguments name."""
    del sys.argv[0]
    script = sys.argv[0]
    sys.path[0] = os.path.dirname(os.path.realpath(script))
    from trundle.rospy.python2.cache import translated_code
    from trundle.rospy.python2.loader import install
    from trundle.rospy.python2.names import add_module_names, python2_builtins

    install()
    add_module_names()
    module = ModuleType("__main__")
    module.__dict__.update(__file__=script, __builtins__=python2_builtins())
    sys.excepthook = _show
    code = translated_code(script)
    sys.modules["__main__"] = module
    exec(code, module.__dict__)


def _show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """Print a traceback that begins in the script."""
    while trace is not None and trace.tb_frame.f_code.co_filename == __file__:
        trace = trace.tb_next
    sys.__excepthook__(kind, error.with_traceback(trace), trace)


if __name__ == "__main__":
    main()
