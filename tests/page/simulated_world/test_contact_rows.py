"""Rows of contacts for the page."""

from pathlib import Path

import numpy as np
import pytest
from tests.page.simulated_world.worlds import loaded

from trundle.page.simulated_world import contact_rows
from trundle.page.simulated_world.body_numbers import BodyNumbers
from trundle.page.simulated_world.contact_rows import ContactRows

_SHAPE = '<collision name="c"><geometry><box><size>{0} {0} 0.2</size></box></geometry></collision>'
_WORLD = f"""<model name="floor"><static>1</static><link name="l">{_SHAPE.format(9)}</link></model>
<model name="crate"><pose>1 0 0.2 0 0 0</pose><link name="l">{_SHAPE.format(0.4)}
<inertial><mass>2</mass></inertial></link></model>"""


def _rows(folder: Path) -> ContactRows:
    """Return the contact rows of a resting crate of 2 kg."""
    sim, _ = loaded(folder, _WORLD)
    bodies = BodyNumbers()
    bodies.update(sim.engine.compiled.link_names)
    sim.run(0.5)
    return ContactRows(sim, bodies)


def test_the_forces_of_a_resting_crate_carry_its_weight(tmp_path: Path) -> None:
    rows = _rows(tmp_path).read()

    assert np.sort(rows[:, :2], axis=1).tolist() == [[0, 1]] * 4
    assert np.abs(rows[:, 2:4] - (1, 0)) == pytest.approx(np.full((4, 2), 0.2), abs=0.01)
    assert abs(rows[:, 7].sum()) == pytest.approx(2 * 9.8, rel=0.02)


def test_only_the_strongest_of_too_many_contacts_are_sent(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    contacts = _rows(tmp_path)
    forces = np.abs(contacts.read()[:, 7])
    monkeypatch.setattr(contact_rows, "MAX_CONTACTS", 2)

    assert sorted(np.abs(contacts.read()[:, 7])) == sorted(forces)[2:]
