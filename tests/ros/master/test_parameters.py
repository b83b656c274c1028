"""The parameter tree, as in rosmaster."""

import pytest

from trundle.ros import ParameterError, ParameterTree, set_leaves
from trundle.ros.master.parameters import MAX_BYTES, MAX_DEPTH, updates
from trundle.ros.xmlrpc.xmlrpc_text import encode_response


def _tree(**values: object) -> ParameterTree:
    tree = ParameterTree()
    for name, value in values.items():
        tree.set(f"/{name}", value)
    return tree


def test_a_namespace_is_a_dictionary() -> None:
    tree = _tree()
    tree.set("/a/b/c", 1)
    assert tree.get("/a") == {"b": {"c": 1}}
    assert tree.get("/") == {"a": {"b": {"c": 1}}}
    assert tree.names() == ["/a/b/c"]


def test_setting_a_dictionary_replaces_the_namespace() -> None:
    tree = _tree(a={"x": 1, "y": 2})
    tree.set("/a", {"x": 3})
    assert tree.get("/a") == {"x": 3}


def test_setting_leaves_keeps_the_rest_of_a_namespace() -> None:
    tree = _tree(a={"x": 1, "y": 2})
    set_leaves("/a", {"x": 3, "z": {"q": 4}}, tree.set)
    assert tree.get("/a") == {"x": 3, "y": 2, "z": {"q": 4}}


def test_setting_a_name_below_a_value_makes_it_a_namespace() -> None:
    tree = _tree(a=1)
    tree.set("/a/b", 2)
    assert tree.get("/a") == {"b": 2}


@pytest.mark.parametrize("name", ["/nope", "/a/x/deeper", "/"])
def test_deleting_a_missing_name_is_a_key_error(name: str) -> None:
    with pytest.raises(KeyError):
        _tree(a={"x": 1}).delete(name)


def test_the_root_must_be_a_dictionary() -> None:
    with pytest.raises(TypeError, match="root"):
        _tree().set("/", 3)


def test_all_parameters_together_are_bounded() -> None:
    """Many values that are acceptable one by one must not fill the master's memory; deleting frees it."""
    tree = _tree(a="x" * (MAX_BYTES // 2))
    tree.set("/b", {"c": ["y" * (MAX_BYTES // 4)]})
    with pytest.raises(ParameterError, match=r"all parameters together would take \d+ bytes"):
        tree.set("/one/more", "z" * (MAX_BYTES // 4))
    assert tree.names() == ["/a", "/b/c"]

    tree.set("/a", "x" * (MAX_BYTES // 2))  # replacing a value by an equal one adds nothing
    tree.delete("/b")
    tree.set("/one/more", "z" * (MAX_BYTES // 4))
    tree.set("/one", {})
    tree.set("/a/below", 1)  # replaces the long text
    tree.set("/b", "y" * (MAX_BYTES // 8 * 7))
    with pytest.raises(ParameterError):
        tree.set("/a/below", "z" * (MAX_BYTES // 4))
    with pytest.raises(ParameterError):
        tree.set("/", {"c": "z" * MAX_BYTES})


def test_a_name_of_too_many_parts_is_refused() -> None:
    tree = _tree()
    with pytest.raises(ParameterError, match="nest deeper"):
        tree.set("/a" * 10_000, 1)
    assert tree.names() == []


def test_a_search_goes_upwards_and_matches_the_first_part() -> None:
    tree = _tree(robot_description={"arm": 1})
    tree.set("/pr2/robot_description/base", 1)
    assert tree.search("/pr2/foo", "robot_description") == "/pr2/robot_description"
    assert tree.search("/pr2/foo", "robot_description/arm") == "/pr2/robot_description/arm"
    assert tree.search("/other/foo", "robot_description/arm") == "/robot_description/arm"
    assert tree.search("/pr2/foo", "nope") is None


def test_subscribers_above_and_below_a_set_name_get_their_part() -> None:
    computed = updates(["/a/", "/a/b/", "/a/c/", "/x/"], "/a", {"b": 1})
    assert computed == [("/a/", "/a/", {"b": 1}), ("/a/b/", "/a/b/", 1), ("/a/c/", "/a/c/", {})]


def test_every_accepted_value_can_be_read_from_the_root() -> None:
    """Levels of names and of values add up."""
    tree = _tree()
    value: object = 1
    for _ in range(MAX_DEPTH - 60):
        value = {"v": value}
    tree.set("/n" * 60, value)
    encode_response([[1, "", tree.get("/")]])
    with pytest.raises(ParameterError, match="nest deeper"):
        tree.set("/n" * 61, value)
