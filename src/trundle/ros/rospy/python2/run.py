"""Runs a Python 2 script as `__main__`: `python …/run.py SCRIPT ARGUMENT…`.

Run by its path, as Python runs scripts: `sys.path` begins with the script's folder.
"""

import os
import sys
from types import CodeType, ModuleType, TracebackType

_INTERRUPTED = 130
"""Exit code of programs that Ctrl-C ended."""


def main() -> None:
    """Run the script of the command line."""
    del sys.argv[0]
    script = sys.argv[0]
    sys.path[0] = os.path.dirname(os.path.realpath(script))
    sys.excepthook = _show
    try:
        code, module = _load(script)
    except KeyboardInterrupt:  # no part of the script has run
        os._exit(_INTERRUPTED)
    sys.modules["__main__"] = module
    exec(code, module.__dict__)


def _load(script: str) -> tuple[CodeType, ModuleType]:
    """Return the script's translation, and the module in which it runs."""
    from trundle.ros.rospy.python2.cache import translated_code
    from trundle.ros.rospy.python2.loader import install
    from trundle.ros.rospy.python2.names import add_module_names, python2_builtins

    install()
    add_module_names()
    module = ModuleType("__main__")
    module.__dict__.update(__file__=script, __builtins__=python2_builtins())
    return translated_code(script), module


def _show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """Print a traceback from the script on, and how to install a missing module."""
    from trundle.ros.rospy.missing_libraries import library_advice

    while trace is not None and trace.tb_frame.f_code.co_filename == __file__:
        trace = trace.tb_next
    sys.__excepthook__(kind, error.with_traceback(trace), trace)
    if (line := library_advice(error)) is not None:
        sys.stderr.write(f"{line}\n")


if __name__ == "__main__":
    main()
