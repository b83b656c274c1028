"""Constants of message types: values and md5 sums as in genmsg 0.6."""

import math

import pytest

from trundle.ros import MessageError, Messages


@pytest.mark.parametrize(
    ("line", "value", "md5"),
    [
        ('string A="x"\nint32 b\n', '"x"', "970aa51ab26f2b387e665440185d99ad"),
        ("string A='x y' # no\nint32 b\n", "'x y' # no", "4ca2e8ac60fdc33ca98e18f3fd52d752"),
        ("string A=\nint32 b\n", "", "4268d9430987762c7a2ba93a875d1467"),
        ('string A="a" "b"\nint8 b', '"a" "b"', "cb383abc87eff5e5bcff53bed1ec20a6"),
    ],
)
def test_a_string_constant_is_the_rest_of_its_line(line: str, value: str, md5: str) -> None:
    messages = Messages()
    messages.add("p/T", line)
    assert vars(type(messages.new("p/T")))["A"] == value
    assert messages.md5("p/T") == md5


def test_number_and_bool_constants() -> None:
    messages = Messages()
    messages.add("p/T", "uint32 M=4294967295\nfloat32 G=5.\nfloat64 H=inf\nfloat64 N=nan\nbool T=True # yes\nint8 b")
    attributes = vars(type(messages.new("p/T")))
    assert [attributes[name] for name in "MGHT"] == [4294967295, 5.0, math.inf, True]
    assert math.isnan(attributes["N"])


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("uint8 A=256", "256 is not in the range of uint8, 0 to 255"),
        ("byte A=200", "200 is not in the range of byte, -128 to 127"),
        ("int8 A=1.0", "'1.0' is not a constant of type int8"),
        ("bool A=yes", "'yes' is not a constant of type bool"),
        ("time A=3", "'3' is not a constant of type time"),
        ("uint8 A=" + "9" * 5000, "is not a constant of type uint8"),
    ],
)
def test_an_invalid_constant_is_reported(line: str, sentence: str) -> None:
    with pytest.raises(MessageError, match=sentence):
        Messages().add("p/T", f"{line}\nint8 b")
