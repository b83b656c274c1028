"""Lessons: steps, checks and parts are read from Markdown; errors name the line and what there is instead."""

import re
from pathlib import Path
from typing import get_args

import pytest

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.page.lessons.checks import FileCheck, ModelCheck, MovedCheck, NodeCheck, PublishesCheck, RateCheck
from trundle.page.lessons.lesson import PagePart
from trundle.page.lessons.read import lesson_names, parse_lesson, read_lesson

LESSON = """---
start: trundle run model://cart --lesson cart.md
needs: [{model: cart}, {node: /base}]
---
<!-- slow -->
# Drive a cart

Hello.

## Drive

Hold the disc.

```check
moved: {model: cart, distance: 0.5}
publishes: /cmd_vel
```

```look
drive
model: cart
```

## Listen

```bash
trundle topic echo /scan
```

```check
rate: {topic: /scan, hz: 5}
```
"""


def _error(text: str) -> str:
    with pytest.raises(DescriptionError) as caught:
        parse_lesson(text, file="l.md")
    return str(caught.value)


def test_headings_begin_steps_with_their_checks() -> None:
    lesson = parse_lesson(LESSON, file="l.md")

    assert lesson.title == "Drive a cart"
    assert lesson.start == "trundle run model://cart --lesson cart.md"
    assert [need.check for need in lesson.needs] == [ModelCheck("cart"), NodeCheck("/base")]
    assert [step.title for step in lesson.steps] == ["Drive a cart", "Drive", "Listen"]
    first, drive, listen = lesson.steps
    assert first.checks == ()
    assert [each.check for each in drive.checks] == [MovedCheck("cart", 0.5), PublishesCheck("/cmd_vel")]
    assert drive.checks[0].sentence == "cart has moved 0.5 m"
    assert (drive.parts, drive.models) == (("drive",), ("cart",))
    assert len(drive.blocks) == 1
    assert [each.check for each in listen.checks] == [RateCheck("/scan", 5.0)]


def test_every_lesson_that_trundle_brings_can_be_read() -> None:
    assert lesson_names() == ("rp2w", "smartcar")
    for name in lesson_names():
        lesson = read_lesson(name)
        assert f"--lesson {name}" in lesson.start
        assert sum(bool(step.checks) for step in lesson.steps) >= 5


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("publish: /cmd_vel", "unknown check 'publish' (did you mean 'publishes'?); checks: file, model,"),
        ("moved: {model: cart}", "check 'moved': Object missing required field `distance`"),
        ("moved: {model: cart, distance: -1}", "check 'moved': Expected `float` > 0.0 - at `$.distance`"),
        ("moved: {model: cart, distance: 1, to: 2}", "check 'moved': Object contains unknown field `to`"),
        ("node: 5", "check 'node': Expected `str`, got `int` - at `$.node`"),
        ("{a: 1, b: 2}", "a check is one key with its values, such as 'publishes: /cmd_vel'"),
        ("node: [", "not YAML: line 1, column 8: expected the node content, but found '<stream end>'"),
        ("? {1: 2}: 3", "not YAML: "),
    ],
)
def test_an_invalid_check_is_an_error_with_its_line(line: str, error: str) -> None:
    text = f"# T\n\n## S\n\n```check\nnode: /base\n{line}\n```\n"

    assert _error(text).startswith(f"l.md:7: error: {error}")


def test_the_line_of_an_error_counts_the_front_matter() -> None:
    assert _error("---\nstart: x\n---\n# T\n```look\ndisc\n```\n").startswith("l.md:6: error: unknown part 'disc'")


@pytest.mark.parametrize("text", ["", "## Step\n", "text\n\n## Step\n"])
def test_a_lesson_begins_with_a_title(text: str) -> None:
    assert _error(text) == "l.md: error: a lesson begins with its title: '# Drive a robot'"


@pytest.mark.parametrize("front", ["start: [1]", "stat: x", "- 1", "needs: {modl: a}", "needs: 3", "a: &a [*a]"])
def test_invalid_front_matter_is_an_error(front: str) -> None:
    assert _error(f"---\n{front}\n---\n# T\n").startswith("l.md:1: error: ")


def test_a_lesson_that_is_not_there_is_an_error() -> None:
    with pytest.raises(UsageError, match=r"no lesson 'rp2'.*did you mean 'rp2w'.*rp2w, smartcar, or a file"):
        read_lesson("rp2")
    with pytest.raises(DescriptionError, match=r"gone\.md: error: cannot be read"):
        read_lesson("gone.md")


def test_every_panel_of_the_dock_can_be_marked() -> None:
    sources = (Path(__file__).parents[3] / "web/src/panels").glob("*.tsx")
    panels = {name for source in sources for name in re.findall(r'Panel = {\n  id: "(\w+)"', source.read_text())}

    assert len(panels) > 10
    assert panels <= set(get_args(PagePart))


def test_a_file_check_keeps_its_path() -> None:
    lesson = parse_lesson("# T\n```check\nfile: ~/a b/model.sdf\n```\n", file="l.md")
    assert [each.check for each in lesson.steps[0].checks] == [FileCheck("~/a b/model.sdf")]
