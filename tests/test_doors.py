"""Front doors that open on first use."""

import importlib
import pkgutil

import pytest

import trundle.model
from trundle.doors import opened_on_use


def _rooms() -> list[str]:
    """Every folder of modules that says what it lets through."""
    found = pkgutil.walk_packages(trundle.__path__, "trundle.")
    names = [module.name for module in found if module.ispkg]
    return [name for name in names if hasattr(importlib.import_module(name), "__all__")]


def test_a_name_is_looked_up_where_it_lives_and_kept(monkeypatch) -> None:
    monkeypatch.delattr(trundle.model, "Noise", raising=False)

    found = opened_on_use("trundle.model", {"Noise": "noise"})("Noise")

    assert found is trundle.model.noise.Noise
    assert vars(trundle.model)["Noise"] is found


def test_any_other_name_is_missing_as_from_any_module() -> None:
    with pytest.raises(AttributeError, match=r"module 'trundle\.model' has no attribute 'Nobody'"):
        opened_on_use("trundle.model", {})("Nobody")


@pytest.mark.parametrize("name", _rooms())
def test_doors_let_through_what_they_say(name) -> None:
    room = importlib.import_module(name)

    assert all(hasattr(room, name) for name in room.__all__)
    assert len(set(room.__all__)) == len(room.__all__)


@pytest.mark.parametrize("name", _rooms())
def test_no_name_that_is_looked_up_on_use_is_that_of_a_module(name) -> None:
    """The import of the module would stand in the name's place."""
    room = importlib.import_module(name)

    modules = {module.name for module in pkgutil.iter_modules(room.__path__)}
    assert not hasattr(room, "__getattr__") or not modules & set(room.__all__)
