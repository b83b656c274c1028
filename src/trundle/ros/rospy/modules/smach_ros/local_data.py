"""Userdata in introspection messages: base64 of a pickle."""

import base64
import io
import pickle


class _PlainUnpickler(pickle.Unpickler):
    """Reads numbers, text, lists and dictionaries only: a pickle of a class would run its sender's code."""

    def find_class(self, module, name):
        raise pickle.UnpicklingError(f"userdata of the type {module}.{name} is not taken from the network")


def encode(data):
    """Text of a dictionary; values that cannot be pickled are left out."""
    kept = {}
    for key, value in data.items():
        try:
            pickle.dumps(value, 2)
        except Exception:  # whatever a class of the user raises
            continue
        kept[key] = value
    return base64.b64encode(pickle.dumps(kept, 2)).decode()


def decode(text):
    """Dictionary of such a text.

    Raises:
        ValueError: it is damaged, or has values that are not plain data.
    """
    try:
        data = _PlainUnpickler(io.BytesIO(base64.b64decode(text, validate=True))).load()
    except Exception as error:  # hostile bytes raise anything
        raise ValueError(f"userdata cannot be read: {error}") from None
    if not isinstance(data, dict):
        raise ValueError("userdata is not a dictionary")
    return data
