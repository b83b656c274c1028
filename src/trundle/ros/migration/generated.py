"""Generated rules copy fields of the same name and type; a rule to complete reports the other fields."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .classes import BUILTIN, MessageClass, RuleMessage, base_type
from .rule import MessageUpdateRule, Rule, Rules, short_name

CanMigrate = Callable[[str, str], bool]
"""Returns True if rules lead from one type name to the other."""
_INDENT = "    "


@dataclass(frozen=True, slots=True)
class _Field:
    """Source of a field of the new message."""

    name: str
    kind: str
    problem: str = ""
    """Reason why it keeps its default."""
    pair: tuple[str, str] | None = None
    """Old and new type of a nested message."""


class GeneratedRule(Rule):
    """Copies the fields that both types share; valid if there are no others."""

    def __init__(self, migrator: Rules, old: MessageClass, new: MessageClass, may_become: CanMigrate) -> None:
        super().__init__(migrator, f"the rule from {old.kind} to {new.kind}")
        self.old_type, self.new_type = old.kind, new.kind
        self.old_class, self.new_class = old, new
        self.old_types, self.new_types = old.nested_classes(), new.nested_classes()
        self._fields = [_plan_field(name, old, new, may_become) for name in new.kinds]
        self._problems = [
            *(f"constant {name} has changed" for name in _changed_constants(old, new)),
            *(f"{name} ({kind}) is gone" for name, kind in old.kinds.items() if name not in new.kinds),
        ]
        self.valid = not self._problems and not any(field.problem for field in self._fields)
        self.migrated_types = tuple(dict.fromkeys(field.pair for field in self._fields if field.pair))

    def update(self, old_msg: RuleMessage, new_msg: RuleMessage) -> None:
        """Copy the shared fields."""
        for field in self._fields:
            if field.problem:
                continue
            value = getattr(old_msg, field.name)
            if field.pair is None:
                setattr(new_msg, field.name, value)
            elif "[" in field.kind:
                items: list[Any] = []
                self.migrate_array(value, items, base_type(field.kind))
                setattr(new_msg, field.name, items)
            else:
                self.migrate(value, getattr(new_msg, field.name))

    def text(self) -> str:
        """Python source of the rule, for a rule file."""
        assert self.new_class is not None
        lines: list[str] = []
        for field in self._fields:
            name, kind = field.name, field.kind
            if field.problem:
                lines += [f"# {field.problem}", f"new_msg.{name} = {_default(kind, name)}"]
            elif field.pair is None:
                lines.append(f"new_msg.{name} = old_msg.{name}")
            elif "[" in kind:
                lines.append(f"self.migrate_array(old_msg.{name}, new_msg.{name}, '{base_type(kind)}')")
            else:
                lines.append(f"self.migrate(old_msg.{name}, new_msg.{name})")
        lines += [f"# {problem}" for problem in self._problems]
        return _text(self, self.new_type, self.new_class.definition, lines)


class PlaceholderRule(Rule):
    """Placeholder of a rule to an unknown type."""

    def __init__(self, migrator: Rules, old: MessageClass) -> None:
        super().__init__(migrator, f"the rule from {old.kind}")
        self.old_type, self.old_class, self.new_class = old.kind, old, None
        self.old_types, self.new_types = {}, {}


def _plan_field(name: str, old: MessageClass, new: MessageClass, may_become: CanMigrate) -> _Field:
    before, after = old.kinds.get(name), new.kinds[name]
    if before is None:
        return _Field(name, after, f"{name} ({after}) is new")
    old_base, new_base = base_type(before), base_type(after)
    is_same_shape = before[len(old_base) :] == after[len(new_base) :]
    is_message = old_base not in BUILTIN and new_base not in BUILTIN
    if is_same_shape and is_message and may_become(old_base, new_base):
        return _Field(name, after, pair=(short_name(old_base, old.kind), short_name(new_base, new.kind)))
    if is_same_shape and not is_message and old_base == new_base:
        return _Field(name, after)
    return _Field(name, after, f"{name} was {before} and is {after}")


def _changed_constants(old: MessageClass, new: MessageClass) -> list[str]:
    """Constants that were removed or changed."""
    after = new.constants()
    return [name for name, constant in old.constants().items() if after.get(name) != constant]


def _default(kind: str, name: str) -> str:
    """Python expression of a field's default."""
    base, bracket, count = kind.partition("[")
    length = count.rstrip("]")
    if bracket and base in ("uint8", "char"):
        return f"bytes({length})" if length else "b''"
    if base in ("time", "duration") and length:
        return f"new_msg.{name}"
    if bracket:
        return f"[{_default(base, name)} for _ in range({length})]" if length else "[]"
    if base in ("time", "duration"):
        return f"type(new_msg.{name})()"
    if base in BUILTIN:
        return {"string": "''", "bool": "False", "float32": "0.0", "float64": "0.0"}.get(base, "0")
    return f"self.get_new_class('{base}')()"


def _text(rule: Rule, new_type: str, new_text: str, update: list[str]) -> str:
    kind, md5sum = rule.old_class.key
    pairs = "".join(f"\n{_INDENT * 2}('{old}', '{new}')," for old, new in rule.migrated_types)
    body = [*update, *([] if any(not line.startswith("#") for line in update) else ["pass"])]
    return "\n".join(
        [
            f"class update_{kind.replace('/', '_')}_{md5sum}({MessageUpdateRule.__name__}):",
            f'{_INDENT}old_type = "{kind}"',
            f'{_INDENT}old_full_text = """\n{_quoted(rule.old_class.definition)}\n"""\n',
            f'{_INDENT}new_type = "{new_type}"',
            f'{_INDENT}new_full_text = """\n{_quoted(new_text)}\n"""\n',
            f"{_INDENT}order = 0",
            f"{_INDENT}migrated_types = [{pairs}{f'{chr(10)}{_INDENT}' if pairs else ''}]\n",
            f"{_INDENT}valid = {rule.valid}\n",
            f"{_INDENT}def update(self, old_msg, new_msg):",
            *(f"{_INDENT * 2}{line}" for line in body),
            "\n",
        ]
    )


def _quoted(text: str) -> str:
    return text.strip().replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
