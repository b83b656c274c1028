"""Data that states share, and one state's view of it."""

import copy

from .exceptions import InvalidUserCodeError
from .log import logerr

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping
    from typing import Any


class UserData:
    """Values by key; keys are attributes too."""

    def __init__(self) -> None:
        self._data: dict[str, Any] = {}

    def update(self, other_userdata: "UserData") -> None:
        """Copy all values of another UserData."""
        self._data.update(other_userdata._data)

    def extract(self, keys: "Iterable[str]", remapping: "Mapping[str, str]") -> "UserData":
        """New UserData with copies of some values; the remapping maps the new keys to the keys of this one."""
        new_names = {old: new for new, old in remapping.items()}
        if len(new_names) != len(remapping):
            logerr(f"SMACH userdata remapping is not one-to-one: {remapping}")
        extracted = UserData()
        for key in keys:
            extracted[new_names.get(key, key)] = copy.copy(self[key])
        return extracted

    def merge(self, ud: "Any", keys: "Iterable[str]", remapping: "Mapping[str, str]") -> None:
        """Copy some values of another UserData; the remapping maps its keys to the keys of this one."""
        for key in keys:
            self[remapping.get(key, key)] = copy.copy(ud[key])

    def keys(self) -> list[str]:
        """List of the keys."""
        return list(self._data)

    def __contains__(self, key: str) -> bool:
        return key in self._data

    def __getitem__(self, key: str) -> "Any":
        if key not in self._data:
            logerr(f"Userdata key '{key}' not available. Available keys are: {list(self._data)}")
            raise KeyError(key)
        return self._data[key]

    def __setitem__(self, key: str, item: object) -> None:
        self._data[key] = item

    def __getattr__(self, name: str) -> "Any":
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name: str, value: object) -> None:
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        else:
            self[name] = value


class Const:
    """An object whose attributes cannot be set."""

    def __init__(self, obj: object) -> None:
        object.__setattr__(self, "_obj", obj)

    def __getattr__(self, name: str) -> "Any":
        return get_const(getattr(self._obj, name))

    def __getitem__(self, name: "Any") -> "Any":
        return get_const(self._obj[name])

    def __call__(self, *args: "Any", **kwargs: "Any") -> "Any":
        return self._obj(*args, **kwargs)

    def __setattr__(self, name: str, value: object) -> None:
        logerr(f"Attempting to set '{name}' but this member is read-only.")
        raise TypeError(f"'{name}' is read-only here: declare the key as output too")

    def __delattr__(self, name: str) -> None:
        logerr(f"Attempting to delete '{name}' but this member is read-only.")
        raise TypeError(f"'{name}' is read-only here: declare the key as output too")


def get_const(obj: "Any") -> "Any":
    """Read-only view of an object with attributes; other values unchanged."""
    return Const(obj) if hasattr(obj, "__dict__") else obj


class Remapper:
    """One state's view of UserData: only its keys, under its names; keys that are not outputs are read-only."""

    def __init__(
        self,
        ud: "Any",
        input_keys: "Collection[str]" = (),
        output_keys: "Collection[str]" = (),
        remapping: "Mapping[str, str] | None" = None,
    ) -> None:
        self._ud = ud
        self._input = input_keys
        self._output = output_keys
        self._map = remapping or {}

    def update(self, other_userdata: "Any") -> None:
        """Copy all values of another."""
        self._ud.update(other_userdata)

    def keys(self) -> list[str]:
        """List of the keys."""
        return [self._remap(key) for key in self._ud.keys() if key in self._input]  # noqa: SIM118 (UserData is not iterable)

    def __contains__(self, key: str) -> bool:
        return key in self._input and self._remap(key) in self._ud

    def __getitem__(self, key: str) -> "Any":
        if key not in self._input:
            raise InvalidUserCodeError(
                f"Reading from SMACH userdata key '{key}' but the only keys that were declared as input to this state "
                f"were: {self._input}. This key needs to be declared as input to this state. "
            )
        value = self._ud[self._remap(key)]
        return value if key in self._output else get_const(value)

    def __setitem__(self, key: str, item: object) -> None:
        if key not in self._output:
            logerr(
                f"Writing to SMACH userdata key '{key}' but the only keys that were declared as output from this state "
                f"were: {self._output}."
            )
            return
        self._ud[self._remap(key)] = item

    def __getattr__(self, name: str) -> "Any":
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name: str, value: object) -> None:
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        else:
            self[name] = value

    def _remap(self, key: str) -> str:
        return self._map.get(key, key)
