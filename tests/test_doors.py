"""Front doors that open on first use."""

import pytest

import trundle.description.sdf
import trundle.model
import trundle.ros
from trundle.doors import opened_on_use


def test_a_name_is_looked_up_where_it_lives_and_kept(monkeypatch) -> None:
    monkeypatch.delattr(trundle.model, "Noise", raising=False)

    found = opened_on_use("trundle.model", {"Noise": "noise"})("Noise")

    assert found is trundle.model.noise.Noise
    assert vars(trundle.model)["Noise"] is found


def test_any_other_name_is_missing_as_from_any_module() -> None:
    with pytest.raises(AttributeError, match=r"module 'trundle\.model' has no attribute 'Nobody'"):
        opened_on_use("trundle.model", {})("Nobody")


@pytest.mark.parametrize("room", [trundle.description.sdf, trundle.model, trundle.ros])
def test_doors_let_through_what_they_say(room) -> None:
    assert all(hasattr(room, name) for name in room.__all__)
    assert len(set(room.__all__)) == len(room.__all__)
