"""Detects Python 2 source, which does not compile as Python 3 or uses names that only Python 2 has."""

import ast
import re
import warnings

_SHEBANG = re.compile(r"#!.*\bpython2(\.\d+)?\s*$", re.MULTILINE)
_HINTS = re.compile(
    r"\b(?:raw_input|xrange|unicode|unichr|basestring|long|execfile|cmp|has_key|iter(?:items|keys|values)|__metaclass__"
    r"|setdefaultencoding|maxint|Tkinter|tkMessageBox|tkFileDialog|Queue|cPickle|StringIO|cStringIO|ConfigParser"
    r"|urllib2|urlparse|httplib|thread|commands|__builtin__|SocketServer|BaseHTTPServer|reduce|reload|file"
    r"|time\.clock)\b"
)
_BOTH = re.compile(r"\bversion_info\b|\bPY[23]\b|\bsix\b|\bfuture\.|\bbuiltins\b|\bperf_counter\b|\bprocess_time\b")
"""Names in programs for both versions."""
_NAMES = frozenset(
    {"raw_input", "xrange", "unicode", "unichr", "basestring", "long", "execfile", "cmp", "reduce", "reload", "file"}
)
_ATTRIBUTES = frozenset({"has_key", "iteritems", "iterkeys", "itervalues", "setdefaultencoding", "maxint"})
_MODULES = frozenset(
    {"Tkinter", "tkMessageBox", "tkFileDialog", "tkSimpleDialog", "ttk", "Queue", "cPickle", "StringIO", "cStringIO"}
    | {"ConfigParser", "urllib2", "urlparse", "httplib", "thread", "commands", "__builtin__", "SocketServer"}
    | {"BaseHTTPServer"}
)


def is_python2(source: str) -> bool:
    """True if source is Python 2 and not Python 3."""
    if _SHEBANG.match(source):
        return True
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # compiling warns of invalid escapes in strings
            tree = ast.parse(source)
    except (SyntaxError, ValueError):
        return True
    return bool(_HINTS.search(source)) and not _BOTH.search(source) and _uses_python2(tree)


def _uses_python2(tree: ast.Module) -> bool:
    if any(isinstance(node, ast.Try) and _is_fallback(node) for node in ast.walk(tree)):
        return False
    bound = {alias.asname or alias.name for node in _imports(tree) for alias in node.names}
    names: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=aliases) if any(alias.name in _MODULES for alias in aliases):
                return True
            case ast.ImportFrom(module=str(module), level=0) if module in _MODULES:
                return True
            case ast.Call(func=ast.Attribute(value=ast.Name(id="time"), attr="clock")):  # removed in Python 3.8
                return True
            case ast.Attribute(attr=name) if name in _ATTRIBUTES:
                names.add(name)
            case ast.Name(id=name, ctx=ast.Load()) if name in _NAMES:
                names.add(name)
            case ast.Name(id=name) | ast.arg(arg=name):
                bound.add(name)
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                bound.add(name)
            case _:
                pass
    unbound = names - bound
    return bool(unbound if "*" not in bound else unbound & (_ATTRIBUTES | {"raw_input", "xrange"}))


def _imports(tree: ast.Module) -> list[ast.Import | ast.ImportFrom]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]


def _is_fallback(node: ast.Try) -> bool:
    """True if the program catches a missing module or name, as programs for both versions do."""
    kinds = [handler.type for handler in node.handlers if handler.type is not None]
    caught = {name.id for kind in kinds for name in ast.walk(kind) if isinstance(name, ast.Name)}
    statements = [*node.body, *(statement for handler in node.handlers for statement in handler.body)]
    imports = [statement for statement in statements if isinstance(statement, ast.Import | ast.ImportFrom)]
    return "NameError" in caught or bool(
        caught & {"ImportError", "ModuleNotFoundError"} and any(map(_names_python2, imports))
    )


def _names_python2(node: ast.Import | ast.ImportFrom) -> bool:
    if isinstance(node, ast.ImportFrom):
        return node.module in _MODULES
    return any(alias.name in _MODULES for alias in node.names)
