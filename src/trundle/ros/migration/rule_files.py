"""Rule files: Python programs that define update rules, named by the user or exported by packages."""

import traceback
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TypeGuard, cast

from trundle.base.files import read_file

from ..errors import RosError
from .rule import MessageUpdateRule, MigrationError, Rule, Rules


class _RuleError(MigrationError):
    """An error whose text already names file and line."""


class RuleFile:
    """A loaded rule file."""

    def __init__(self, path: Path) -> None:
        """Execute the file.

        Raises:
            MigrationError: the file is unreadable or fails; the text names the line.
        """
        self._path = path
        names: dict[str, object] = {MessageUpdateRule.__name__: MessageUpdateRule, "__file__": str(path)}
        with _load_errors(path, str(path)):
            exec(compile(read_file(path), str(path), "exec"), names)
        self._classes = [value for value in names.values() if _is_rule(value)]

    def rules(self, migrator: Rules) -> Iterator[MessageUpdateRule]:
        """Instantiate each rule.

        Raises:
            MigrationError: a rule is marked invalid, or its definitions are.
        """
        for rule_class in self._classes:
            location = _location(rule_class, self._path)
            if fault := _fault(rule_class):
                raise MigrationError(f"{location}: {fault}")
            with _load_errors(self._path, location):
                rule = rule_class(migrator, location)
            yield rule


@contextmanager
def rule_errors(rule: Rule) -> Generator[None]:
    """Convert exceptions of a rule to a MigrationError with file and line."""
    code = getattr(rule.update, "__code__", None) if isinstance(rule, MessageUpdateRule) else None
    with _load_errors(Path(code.co_filename) if code else None, rule.location):
        yield


@contextmanager
def _load_errors(path: Path | None, location: str) -> Generator[None]:
    try:
        yield
    except _RuleError:
        raise
    except SyntaxError as error:
        raise _RuleError(f"{path}:{error.lineno or 1}: {error.msg}") from None
    except OSError as error:
        raise _RuleError(f"{location}: {error.strerror or error}") from None
    except (Exception, SystemExit) as error:  # third-party code may raise anything
        lines = [f"{frame.filename}:{frame.lineno}" for frame in traceback.extract_tb(error.__traceback__)]
        rule_lines = [line for line in lines if path is not None and line.startswith(f"{path}:")]
        text = str(error) if isinstance(error, RosError) else f"{type(error).__name__}: {error}"
        raise _RuleError(f"{rule_lines[-1] if rule_lines else location}: {' '.join(text.split())}") from None


def _is_rule(value: object) -> TypeGuard[type[MessageUpdateRule]]:
    return isinstance(value, type) and issubclass(value, MessageUpdateRule) and value is not MessageUpdateRule


def _fault(rule: type[MessageUpdateRule]) -> str:
    """Return the reason why a rule's attributes are invalid; '' if they are valid."""
    for name in ("old_type", "new_type"):
        kind: object = getattr(rule, name)
        if not (isinstance(kind, str) and kind.count("/") == 1):
            return f"{name} is a type such as std_msgs/String, got {kind!r}"
    for pair in cast("Sequence[object]", rule.migrated_types):
        if not (isinstance(pair, tuple) and [type(name) for name in cast("tuple[object]", pair)] == [str, str]):
            return f"migrated_types is a list of pairs of types, got {pair!r} in it"
    if not isinstance(cast(object, rule.order), int | float):
        return f"order is a number, got {rule.order!r}"
    if not rule.valid:
        return "valid is False; complete its update, then set it to True"
    return "" if rule.update is not MessageUpdateRule.update else "it has no update"


def _location(rule: type[MessageUpdateRule], path: Path) -> str:
    """File, line and name of a rule's `update`."""
    code = getattr(rule.update, "__code__", None)
    line = f":{code.co_firstlineno}" if code is not None and code.co_filename == str(path) else ""
    return f"{path}{line}: {rule.__name__}"
