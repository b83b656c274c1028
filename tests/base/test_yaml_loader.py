"""YAML as plain data: limits, and one type of error."""

from pathlib import Path

import pytest
import yaml

from trundle.base.diagnostics import UsageError
from trundle.base.yaml_loader import BoundedLoader, load_yaml, one_line
from trundle.gazebo.nodes.map_server.occupancy_grid import read_map


def billions(first: str, again: str) -> str:
    """Return lines of aliases, each of which expands to ten times the one before."""
    lines = [f"a0: &a0 {first}"]
    return "\n".join([*lines, *(f"a{n}: &a{n} {again.format(', '.join([f'*a{n - 1}'] * 10))}" for n in range(1, 12))])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (billions("[x, x]", "[{0}]"), "its aliases stand for more than 500000 values"),
        (billions("{x: 1}", "{{<<: [{0}]}}"), "its aliases stand for more than 500000 values"),
        (billions("{x: 1}", "{{k: [{0}]}}"), "its aliases stand for more than 500000 values"),
        ("a: &a [*a]", "line 1: a value contains itself"),
        ("a: &a {b: *a}", "line 1: a value contains itself"),
        ("[" * 10_000 + "]" * 10_000, "nested too deeply"),
        ("".join(f"{' ' * depth}a:\n" for depth in range(900)), "nested too deeply"),
        ("!!python/object/apply:os.system [id]", "could not determine a constructor for the tag"),
        ("a: " + "9" * 5000, "Exceeds the limit"),
        ("2001-13-45", "month must be in 1..12"),
        ("!!bool maybe", "line 1: 'maybe' is not a value of its type"),
        ("!!timestamp x", "NoneType"),
        ("{[1]: 2}", "line 1, column 2: found unhashable key"),
        ("[1", "line 1, column 3"),
        ('a:\n  "\\ud800"', "line 2: a text with half of a surrogate pair"),
        ("\x00", "special characters are not allowed"),
        ("x" * (16 * 1024 * 1024 + 1), "characters of YAML; the most read is 16777216"),
    ],
)
def test_invalid_yaml_is_reported_in_one_line(text: str, words: str) -> None:
    with pytest.raises(yaml.YAMLError) as error:
        load_yaml(text)
    assert words in one_line(error.value)


def test_too_many_values_are_refused_before_construction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.base.yaml_loader._MAX_NODES", 100)
    with pytest.raises(yaml.YAMLError, match="more than 100 values"):
        load_yaml("[" + "0, " * 200 + "0]")


def test_keys_that_are_not_text_are_limited() -> None:
    """100,000 multiples of 2**61 - 1, whose hashes collide, would take minutes."""
    keys = "\n".join(f"{number * (2**61 - 1)}: 1" for number in range(2001))
    with pytest.raises(yaml.YAMLError, match="line 1: more than 2000 keys of a mapping that are not text"):
        load_yaml(keys)
    assert len(load_yaml("\n".join(f"k{number}: 1" for number in range(2001)))) == 2001  # pyright: ignore[reportArgumentType]


def test_plain_data_and_aliases_are_loaded() -> None:
    assert load_yaml("a: &a [1, 2.5, x, null, true]\nb: *a\nc: {<<: {d: 1}}") == {
        "a": [1, 2.5, "x", None, True],
        "b": [1, 2.5, "x", None, True],
        "c": {"d": 1},
    }
    assert load_yaml("") is None
    assert list(yaml.load_all("1\n---\n2", BoundedLoader)) == [1, 2]


def test_other_readers_of_yaml_are_bounded(tmp_path: Path) -> None:
    bomb = tmp_path / "bomb.yaml"
    bomb.write_text(billions("[x, x]", "[{0}]"))
    with pytest.raises(UsageError, match="its aliases stand for more than"):
        read_map(bomb)
