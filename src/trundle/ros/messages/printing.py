"""Messages as text, in rostopic's format: YAML, or rows for plotting."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from .message_library import Message, Messages

_NUMBERS = {"float32", "float64"} | {f"{u}int{n}" for u in ("", "u") for n in (8, 16, 32, 64)} | {"byte", "char"}
_BYTES = ("uint8[", "char[")


@dataclass(frozen=True, slots=True, kw_only=True)
class MessagePrinter:
    """Printer of one store's messages."""

    messages: Messages
    width: int | None = None
    """Digits of each number; None: as many as needed."""
    hide_strings: bool = False
    hide_arrays: bool = False
    offset_ns: int | None = None
    """If set, times are printed relative to it [ns]."""

    def text(self, value: Any, type_text: str, indent: str = "") -> str:
        """Format a value of a ROS type ('float64[36]', 'geometry_msgs/Pose', …); nested messages start a new line."""
        value, type_text = self._displayed(value, type_text)
        base, bracket, _ = type_text.partition("[")
        if bracket:
            return self._list(value, base, indent)
        if base in ("time", "duration"):
            return self._time(value, base, indent)
        if base == "bool":
            return str(bool(value))
        if base in _NUMBERS:
            return self._number(value)
        if base == "string":
            return _string(value)
        lines = [f"{indent}{line}" for line in self._members(value, base, indent)]
        return ("\n" if indent else "") + "\n".join(lines)

    def columns(self, value: Any, type_text: str, name: str = "field") -> Iterator[tuple[str, str]]:
        """Yield (name, text) of every number and string in a value, for plotting."""
        base, bracket, _ = type_text.partition("[")
        if bracket:
            for i, item in enumerate(_plain(value)):
                yield from self.columns(item, base, f"{name}{i}")
        elif base in ("time", "duration"):
            offset = self.offset_ns or 0 if base == "time" else 0
            yield name, str(value.sec * 10**9 + value.nanosec - offset)
        elif base == "bool":
            yield name, "1" if value else "0"
        elif base in _NUMBERS or base == "string":
            yield name, str(value)
        else:
            for field, kind in self.messages.fields(base).items():
                if kind.startswith(_BYTES):  # rostopic treats them as strings, which it does not plot
                    continue
                if not (self.hide_arrays and "[" in kind) and not (self.hide_strings and "string" in kind):
                    yield from self.columns(field_value(value, field), kind, f"{name}.{field}")

    def _members(self, message: Message, type_name: str, indent: str) -> Iterator[str]:
        for field, kind in self.messages.fields(type_name).items():
            yield f"{field}: {self.text(field_value(message, field), kind, '  ' + indent)}"

    def _displayed(self, value: Any, kind: str) -> tuple[Any, str]:
        """Value and type to print; a hidden value is replaced by a description."""
        if self.hide_arrays and "[" in kind:
            # rostopic strips only trailing brackets, so a fixed length loses its closing one.
            return f"<array type: {kind.rstrip('[]')}, length: {len(value)}>", "string"
        if self.hide_strings and kind == "string":
            return f"<string length: {len(value)}>", "string"
        if self.hide_strings and kind == "string[]":
            return f"<array type: string, length: {len(value)}>", "string"
        return value, kind

    def _list(self, values: Any, base: str, indent: str) -> str:
        items = _plain(values)
        if not items:
            return "[]"
        if base == "string":
            import yaml

            text = yaml.dump(items).rstrip("\n")
            return "\n" + "\n".join(indent + line for line in text.splitlines())
        if base == "bool":
            return str([bool(item) for item in items])
        if base in _NUMBERS:
            return str(items) if self.width is None else f"[{', '.join(map(self._number, items))}]"
        printer = self
        if self.hide_strings:  # rostopic shows strings in lists
            printer = MessagePrinter(messages=self.messages, width=self.width, offset_ns=self.offset_ns)
        return "\n" + "\n".join(f"{indent}- {printer.text(item, base, indent + '  ')}" for item in items)

    def _number(self, value: Any) -> str:
        if self.width is None:
            return str(value)
        if isinstance(value, float):
            text = f"{value:.{self.width}f}"
            return text[: max(text.find("."), self.width)]
        return f"{value:{self.width}d}"

    def _time(self, value: Any, base: str, indent: str) -> str:
        seconds, nanoseconds = value.sec, value.nanosec
        if self.offset_ns is not None and base == "time":
            seconds, nanoseconds = divmod(seconds * 10**9 + nanoseconds - self.offset_ns, 10**9)
        if self.width is None:
            return f"\n{indent}secs: {seconds}\n{indent}nsecs: {nanoseconds:9d}"
        return f"\n{indent}secs: {seconds:{self.width}d}\n{indent}nsecs: {nanoseconds:{self.width}d}"


def field_value(message: Message, field: str) -> object:
    """Value of a field by its ROS name; the attribute of a Python keyword has a trailing `_`."""
    if field in ("secs", "nsecs"):
        field = {"secs": "sec", "nsecs": "nanosec"}[field]
    return getattr(message, field) if hasattr(message, field) else getattr(message, f"{field}_")


def _plain(values: Any) -> list[Any]:
    return values.tolist() if hasattr(values, "tolist") else list(values)


def _string(value: str) -> str:
    if not value:
        return "''"
    import yaml

    return yaml.dump(value, default_style='"').rstrip("\n")
