"""Reading of lessons: Markdown in which each heading of the second level begins a step.

A line of a fence with the language `check` is a check of the step, in YAML: `publishes: /cmd_vel`, or
`moved: {model: rp2w, distance: 0.5}`. A line of a fence with the language `look` is a part of the page to mark:
`topics`, or `model: rp2w`. Front matter may say what the lesson needs:

    ---
    start: trundle run rp2w.world --lesson rp2w
    needs: {model: rp2w}
    ---
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeAlias, get_args

import msgspec
import yaml

from trundle.assets import ASSETS
from trundle.base.diagnostics import DescriptionError, Source, UsageError, did_you_mean
from trundle.base.files import read_text
from trundle.base.yaml_loader import load_yaml, one_line

from .checks import Check
from .lesson import Lesson, LessonStep, PagePart, StatedCheck
from .markdown import SyntaxTreeNode, blocks_of, line_of, parse_markdown, plain_text

SUFFIX = ".md"
_FOLDER = ASSETS / "lessons"
_MAX_BYTES = 256_000
_FRONT = re.compile(r"\A---\n(.*?)\n---\n", re.DOTALL)
_FRONT_KEYS = ("start", "needs")
_KINDS: Mapping[str, type[Check]] = {str(kind.__struct_config__.tag): kind for kind in get_args(Check)}
_PARTS: tuple[str, ...] = get_args(PagePart)
_MODEL = "model:"
_Fault: TypeAlias = Callable[[str], DescriptionError]
"""Makes an error at a line."""


def lesson_names() -> tuple[str, ...]:
    """Return the names of the lessons that Trundle brings."""
    return tuple(sorted(file.stem for file in _FOLDER.glob(f"*{SUFFIX}")))


def read_lesson(name: str) -> Lesson:
    """Read a lesson by its name, or a file FILE.md.

    Raises:
        UsageError: there is no such lesson.
        DescriptionError: the file cannot be read, or is no lesson.
    """
    if name.endswith(SUFFIX):
        path = Path(name).expanduser()
    elif name in lesson_names():
        path = _FOLDER / f"{name}{SUFFIX}"
    else:
        names = lesson_names()
        raise UsageError(f"no lesson {name!r}{did_you_mean(name, names)}; lessons: {', '.join(names)}, or a file *.md")
    try:
        text = read_text(path, max_bytes=_MAX_BYTES)
    except OSError as error:
        raise DescriptionError(Source(name), f"cannot be read: {error.strerror}") from None
    return parse_lesson(text, file=name)


def parse_lesson(text: str, *, file: str) -> Lesson:
    """Return the lesson in a text.

    Args:
        text: Markdown.
        file: name in errors.

    Raises:
        DescriptionError: no title or steps, an invalid check, or brackets that take long to read.
    """
    front = _FRONT.match(text)
    start, needs = _read_front(front[1], file) if front else ("", ())
    body = text if front is None else "\n" * front[0].count("\n") + text[front.end() :]
    nodes = parse_markdown(body, file=file)
    headings = [index for index, node in enumerate(nodes) if node.type == "heading" and node.tag in ("h1", "h2")]
    if not headings or nodes[headings[0]].tag != "h1":
        raise DescriptionError(Source(file), "a lesson begins with its title: '# Drive a robot'")
    ends = [*headings[1:], len(nodes)]
    steps = [_read_step(nodes[first:end], file) for first, end in zip(headings, ends, strict=True)]
    title = steps[0].title
    return Lesson(title=title, start=start, needs=needs, steps=tuple(steps))


def _read_front(text: str, file: str) -> tuple[str, tuple[StatedCheck, ...]]:
    def fault(what: str) -> DescriptionError:
        return DescriptionError(Source(file, 1), what)

    front = _load(text, fault)
    if not isinstance(front, dict) or not set(front) <= set(_FRONT_KEYS):
        raise fault(f"front matter is a mapping with the keys {', '.join(_FRONT_KEYS)}")
    start, needs = front.get("start", ""), front.get("needs", [])
    if not isinstance(start, str):
        raise fault("'start' is a command")
    alternatives: list[Any] = needs if isinstance(needs, list) else [needs]
    return start, tuple(_read_check(each, fault) for each in alternatives)


def _read_step(nodes: list[SyntaxTreeNode], file: str) -> LessonStep:
    checks: list[StatedCheck] = []
    looks: list[str] = []
    text: list[SyntaxTreeNode] = []
    for node in nodes[1:]:
        language = node.info.strip() if node.type == "fence" else ""
        if language not in ("check", "look"):
            text.append(node)
            continue
        for line, content in enumerate(node.content.splitlines(), start=line_of(node) + 1):
            at = Source(file, line)
            if not content.strip():
                continue
            if language == "check":
                fault = _fault_at(at)
                checks.append(_read_check(_load(content, fault), fault))
            else:
                looks.append(_read_look(content.strip(), at))
    return LessonStep(
        title=plain_text(nodes[0]),
        blocks=blocks_of(text),
        checks=tuple(checks),
        parts=tuple(look for look in looks if not look.startswith(_MODEL)),  # pyright: ignore[reportArgumentType]
        models=tuple(look.removeprefix(_MODEL).strip() for look in looks if look.startswith(_MODEL)),
    )


def _fault_at(at: Source) -> _Fault:
    return lambda what: DescriptionError(at, what)


def _load(text: str, fault: _Fault) -> Any:
    try:
        return load_yaml(text)
    except yaml.YAMLError as error:
        raise fault(f"not YAML: {one_line(error)}") from None


def _read_check(value: Any, fault: _Fault) -> StatedCheck:
    """Read a mapping of one kind of check to its values, or to the only value."""
    if not isinstance(value, dict) or len(value) != 1:
        raise fault("a check is one key with its values, such as 'publishes: /cmd_vel'")
    ((kind, values),) = value.items()
    struct = _KINDS.get(str(kind))
    if struct is None:
        raise fault(f"unknown check {kind!r}{did_you_mean(str(kind), _KINDS)}; checks: {', '.join(_KINDS)}")
    fields = values if isinstance(values, dict) else {struct.__struct_fields__[0]: values}
    try:
        check = msgspec.convert(fields, struct)
    except msgspec.ValidationError as error:
        raise fault(f"check {kind!r}: {error}") from None
    return StatedCheck(sentence=check.sentence, check=check)


def _read_look(look: str, at: Source) -> str:
    if look not in _PARTS and not look.startswith(_MODEL):
        near = did_you_mean(look, _PARTS)
        raise DescriptionError(at, f"unknown part {look!r}{near}; parts: {', '.join(_PARTS)}, or 'model: NAME'")
    return look
