"""Data that states share, and what one state may see of it."""

import copy

from .exceptions import InvalidUserCodeError
from .log import logerr


class UserData:
    """Values by key; keys are attributes too."""

    def __init__(self):
        self._data = {}

    def update(self, other_userdata):
        """Take all values of another."""
        self._data.update(other_userdata._data)

    def extract(self, keys, remapping):
        """New UserData with copies of some values; the remapping is new key → key here."""
        new_names = {old: new for new, old in remapping.items()}
        if len(new_names) != len(remapping):
            logerr(f"SMACH userdata remapping is not one-to-one: {remapping}")
        extracted = UserData()
        for key in keys:
            extracted[new_names.get(key, key)] = copy.copy(self[key])
        return extracted

    def merge(self, ud, keys, remapping):
        """Take copies of some values of another; the remapping is key there → key here."""
        for key in keys:
            self[remapping.get(key, key)] = copy.copy(ud[key])

    def keys(self):
        """List of the keys."""
        return list(self._data)

    def __contains__(self, key):
        return key in self._data

    def __getitem__(self, key):
        if key not in self._data:
            logerr(f"Userdata key '{key}' not available. Available keys are: {list(self._data)}")
            raise KeyError(key)
        return self._data[key]

    def __setitem__(self, key, item):
        self._data[key] = item

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name, value):
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        else:
            self[name] = value


class Const:
    """An object whose attributes cannot be set."""

    def __init__(self, obj):
        object.__setattr__(self, "_obj", obj)

    def __getattr__(self, name):
        return get_const(getattr(self._obj, name))

    def __getitem__(self, name):
        return get_const(self._obj[name])

    def __call__(self, *args, **kwargs):
        return self._obj(*args, **kwargs)

    def __setattr__(self, name, value):
        logerr(f"Attempting to set '{name}' but this member is read-only.")
        raise TypeError(f"'{name}' is read-only here: declare the key as output too")

    def __delattr__(self, name):
        logerr(f"Attempting to delete '{name}' but this member is read-only.")
        raise TypeError(f"'{name}' is read-only here: declare the key as output too")


def get_const(obj):
    """Read-only view of an object with attributes; other values as they are."""
    return Const(obj) if hasattr(obj, "__dict__") else obj


class Remapper:
    """UserData as one state sees it: its own keys by its own names; what is no output is read-only."""

    def __init__(self, ud, input_keys=(), output_keys=(), remapping=None):
        self._ud = ud
        self._input = input_keys
        self._output = output_keys
        self._map = remapping or {}

    def update(self, other_userdata):
        """Take all values of another."""
        self._ud.update(other_userdata)

    def keys(self):
        """List of the keys."""
        return [self._remap(key) for key in self._ud.keys() if key in self._input]  # noqa: SIM118 (UserData is not iterable)

    def __contains__(self, key):
        return key in self._input and self._remap(key) in self._ud

    def __getitem__(self, key):
        if key not in self._input:
            raise InvalidUserCodeError(
                f"Reading from SMACH userdata key '{key}' but the only keys that were declared as input to this state "
                f"were: {self._input}. This key needs to be declared as input to this state. "
            )
        value = self._ud[self._remap(key)]
        return value if key in self._output else get_const(value)

    def __setitem__(self, key, item):
        if key not in self._output:
            logerr(
                f"Writing to SMACH userdata key '{key}' but the only keys that were declared as output from this state "
                f"were: {self._output}."
            )
            return
        self._ud[self._remap(key)] = item

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name, value):
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        else:
            self[name] = value

    def _remap(self, key):
        return self._map.get(key, key)
