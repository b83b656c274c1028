"""Kinds of field types."""

SIMPLE_TYPES = (
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64", "byte", "char",
    "bool",
)  # fmt: skip
SIMPLE_TYPES_DICT = {
    "int8": "b", "uint8": "B", "bool": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "int64": "q",
    "uint64": "Q", "float32": "f", "float64": "d", "byte": "b", "char": "B",
}  # fmt: skip
"""Type → its letter in `struct`."""


def is_simple(type_: str) -> bool:
    """True for numbers and bool."""
    return type_ in SIMPLE_TYPES_DICT
