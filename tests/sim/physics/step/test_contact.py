"""Contacts as arrays and one by one, against what a body weighs."""

from pathlib import Path

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load_text
from trundle.robots.packages import Packages
from trundle.sim.physics import Contacts
from trundle.sim.simulation import Simulation

_BOX = "<geometry><box><size>0.4 0.2 0.1</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="w">
<model name="floor"><static>true</static><link name="f"><collision name="c"><geometry><plane/></geometry></collision>
</link></model>
<model name="crate"><pose>1 2 0.05 0 0 0</pose><link name="body"><inertial><mass>2</mass>
<inertia><ixx>0.01</ixx><iyy>0.03</iyy><izz>0.03</izz></inertia></inertial>
<collision name="hull">{_BOX}</collision></link></model>
<model name="marble"><pose>5 0 0.1 0 0 0</pose><link name="b"><collision name="c">
<geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>
</world></sdf>"""


@pytest.fixture
def sim() -> Simulation:
    report = Diagnostics()
    loaded = load_text(WORLD.encode(), name="w.sdf", folder=Path(), packages=Packages({}, start=Path()), report=report)
    return Simulation(loaded.world, report)


def on(contacts: Contacts, body: str) -> np.ndarray:
    """(N,) +1 where the body is the second of the two, −1 where it is the first, 0 elsewhere."""
    return np.array([(other == body) - float(one == body) for one, other in contacts.bodies])


def test_contact_forces_carry_the_weight_above_them(sim: Simulation) -> None:
    sim.run(1.0)
    contacts = sim.contacts()
    crate = on(contacts, "crate::body")

    assert (len(contacts), contacts.positions.shape, contacts.torques.shape) == (5, (5, 3), (5, 3))
    assert crate @ contacts.forces == pytest.approx([0.0, 0.0, 2 * 9.8], abs=1e-3)
    assert crate[:, None] * contacts.normals == pytest.approx(abs(crate[:, None]) * [0.0, 0.0, 1.0], abs=1e-9)
    corners = contacts.positions[crate != 0]
    assert sorted(corners[:, :2].round(6).tolist()) == [[0.8, 1.9], [0.8, 2.1], [1.2, 1.9], [1.2, 2.1]]
    assert on(contacts, "marble::b") @ contacts.forces == pytest.approx([0.0, 0.0, 9.8], abs=1e-3)


def test_contacts_by_index_equal_the_arrays(sim: Simulation) -> None:
    sim.run(0.1)
    contacts = sim.contacts()

    assert [contact.collisions for contact in contacts] == list(contacts.collisions)
    assert [contact.force.force for contact in contacts] == [tuple(force) for force in contacts.forces.tolist()]
    assert contacts[-1] == list(contacts)[-1] == contacts[4]
    assert contacts[1:3].positions.tolist() == contacts.positions[1:3].tolist()
    with pytest.raises(IndexError):
        contacts[5]


def test_contacts_of_named_collisions_only(sim: Simulation) -> None:
    """Also of sleeping bodies, whose contacts are computed separately."""
    for seconds in (0.1, 3.0):
        sim.run(seconds)
        contacts = sim.contacts(frozenset({"marble::b::c"}))
        assert [set(pair) for pair in contacts.collisions] == [{"floor::f::c", "marble::b::c"}]
        assert len(sim.contacts()) == 5
    assert repr(contacts).startswith("<1 contacts: ")


def test_where_nothing_touches_the_arrays_are_empty(sim: Simulation) -> None:
    sim.delete("floor")
    sim.step()

    contacts = sim.contacts()
    assert (len(contacts), contacts.forces.shape, contacts.bodies, repr(contacts)) == (0, (0, 3), (), "<0 contacts>")
