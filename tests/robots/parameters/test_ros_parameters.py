"""Parameters of the ROS graph: what is wrong with one is an error that names it."""

import pytest

from trundle.robots.parameters import ParamError, RosParameters


def test_values_are_read_as_they_are_set() -> None:
    tree = {"a": 1, "b": "2.5", "c": True, "d": "text", "e": [1, 2.0, 3], "f": ["x"], "g": {"h": 7}, "i": [{"k": 1}]}
    parameters = RosParameters(tree, "/n/")

    assert parameters.number("a") == 1.0
    assert parameters.number("b") == 2.5
    assert parameters.flag("c", default=False) is True
    assert parameters.flag("a", default=False) is True
    assert parameters.text("d") == "text"
    assert parameters.vector("e") == (1.0, 2.0, 3.0)
    assert parameters.texts("f") == ["x"]
    assert parameters.section("g").integer("h") == 7
    assert [section.number("k") for section in parameters.sections("i")] == [1.0]
    assert parameters.number("z", 4.0) == 4.0
    assert parameters.names() == list(tree)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (True, "parameter /n/x: True is not a number"),
        ([1], "parameter /n/x: [1] is not a number"),
        (float("inf"), "parameter /n/x: inf is not a finite number"),
        (0, "parameter /n/x must be > 0, got 0"),
        (None, "parameter /n/x is not set"),
    ],
)
def test_an_invalid_number_is_an_error_whatever_the_default(value: object, message: str) -> None:
    parameters = RosParameters({} if value is None else {"x": value}, "/n")

    with pytest.raises(ParamError) as error:
        parameters.number("x", None if value is None else 5.0, above=0.0)
    assert str(error.value) == message


def test_an_invalid_list_is_an_error() -> None:
    parameters = RosParameters({"joints": ["a", 1], "points": [1, 2]}, "/n")

    with pytest.raises(ParamError, match=r"/n/joints: \['a', 1\] is not a list of texts"):
        parameters.texts("joints")
    with pytest.raises(ParamError, match=r"/n/points: \[1, 2\] is not 3 numbers"):
        parameters.numbers("points", 3)


def test_an_error_in_a_section_names_its_full_path() -> None:
    parameters = RosParameters({"topics": [{"name": "a"}]}, "/mux")

    with pytest.raises(ParamError, match=r"^parameter /mux/topics\[0\]/timeout is not set$"):
        parameters.sections("topics")[0].number("timeout")


def test_with_a_warning_an_invalid_value_becomes_its_default() -> None:
    warnings: list[str] = []
    parameters = RosParameters({"own": {"rate": "fast", "y_vels": [0.1]}}, "/node", warn=warnings.append)
    own = parameters.section("own")

    assert (own.number("rate", 2.0), own.text("y_vels", "0.1")) == (2.0, "0.1")
    assert warnings[0].startswith("parameter /node/own/rate")
    assert warnings[0].endswith("; 2.0 is used")
    with pytest.raises(ParamError, match="rate"):
        own.number("rate")


def test_renamed_parameters_keep_what_is_set_by_its_new_name() -> None:
    parameters = RosParameters({"max_rot_vel": 1.0, "acc_lim_th": 2.0, "acc_lim_theta": 3.0}, "/node")
    renamed = parameters.renamed({"max_rot_vel": "max_vel_theta", "acc_lim_th": "acc_lim_theta"})

    assert (renamed.number("max_vel_theta"), renamed.number("acc_lim_theta")) == (1.0, 3.0)
    assert renamed.with_defaults({"max_vel_theta": 9.0, "sim_time": 2.0}).number("max_vel_theta") == 1.0
    assert renamed.with_defaults({"sim_time": 2.0}).number("sim_time") == 2.0
