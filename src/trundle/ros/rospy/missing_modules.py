"""Modules of ROS that Trundle does not have: importing one raises an error with a way out."""

from importlib.machinery import ModuleSpec
from types import ModuleType

_GENERATED = (
    "writes Python files from definitions, which Trundle does not need: PACKAGE.msg and PACKAGE.srv import without "
    "generated files, and genpy.dynamic.generate_dynamic generates classes from a definition's text. To write files, "
    "install genpy and genmsg (Debian: python3-genpy), which are used where they are installed"
)
_OLD = (
    "was replaced by genmsg before 2013. Use genmsg.load_srv_by_type and genmsg.gentools, or the classes' own _md5sum "
    "and _full_text; ROS' own is used where it is installed (Debian: python3-roslib)"
)
_RUNNER = (
    "belongs to the programs rosunit and rostest. Use rosunit.unitrun in tests, and `trundle test` to run them; ROS' "
    "own is used where it is installed (Debian: python3-rosunit)"
)
MISSING = {
    **dict.fromkeys(("genpy.generator", "genpy.generate_initpy", "genpy.genpy_main"), _GENERATED),
    **dict.fromkeys(("genmsg.command_line", "genmsg.deps", "genmsg.template_tools"), _GENERATED),
    **dict.fromkeys(("roslib.gentools", "roslib.manifest", "roslib.manifestlib", "roslib.resources"), _OLD),
    **dict.fromkeys(("roslib.rospack", "roslib.srvs", "roslib.stack_manifest", "roslib.stacks"), _OLD),
    **dict.fromkeys(("rosunit.junitxml", "rosunit.pmon", "rosunit.rosunit_main"), _RUNNER),
}
"""Module → its purpose, and the way out."""


class _Refusal:
    """Loader that raises an error with the way out."""

    def __init__(self, text: str) -> None:
        self._text = text

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave the module to Python."""

    def exec_module(self, module: ModuleType) -> None:
        """Raise the error.

        Raises:
            ImportError: always.
        """
        raise ImportError(f"{module.__name__} {self._text}", name=module.__name__)


def find_missing(name: str) -> ModuleSpec | None:
    """Find a module that Trundle does not have; None for any other."""
    return ModuleSpec(name, _Refusal(MISSING[name])) if name in MISSING else None  # pyright: ignore[reportArgumentType]
