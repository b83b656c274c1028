"""The law that keeps sliding contacts down, on Warp's device: equal to the C++ within a step."""

import copy
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from tests.sim.physics.step.test_gpu import DEVICE, needs_warp

import trundle
from trundle.sim.physics.compile.law_tables import find_table

CONTACT = int(mujoco.mjtConstraint.mjCNSTR_CONTACT_ELLIPTIC)


def _references(model: mujoco.MjModel, data: mujoco.MjData, *, laws: bool) -> tuple[np.ndarray, mujoco.MjData]:
    """Return the reference accelerations of the constraint rows of a state, with the laws or without."""
    model = copy.copy(model)
    find_table(model, "laws")[0, 1] = float(laws)
    data = copy.copy(data)
    mujoco.mj_forward(model, data)
    return data.efc_aref.copy(), data


def _on_device(model: mujoco.MjModel, before: mujoco.MjData, at: mujoco.MjData, *, sparse: bool) -> np.ndarray:
    """Return the change of the reference accelerations by Warp's kernels."""
    import warp as wp
    from mujoco_warp import Contact

    from trundle.sim.physics.step.warp.sliding import Sliding

    vec5 = Contact.__dataclass_fields__["friction"].type.dtype
    contact, rows, nv = at.contact, at.nefc, model.nv
    jacobian = at.efc_J.reshape(rows, nv)
    addresses = contact.efc_address[:, None] + np.arange(6)

    def one(values: np.ndarray, dtype: object = float) -> object:
        return wp.array(np.asarray(values)[None], dtype=dtype)

    with wp.ScopedDevice(DEVICE):
        columns = np.tile(np.arange(nv), rows)
        efc = SimpleNamespace(
            type=one(at.efc_type, int), id=one(at.efc_id, int), vel=one(at.efc_vel), aref=one(np.zeros(rows)),
            J=one(jacobian.reshape(1, -1) if sparse else jacobian), J_colind=one(columns[None], int),
            J_rownnz=one(np.full(rows, nv), int), J_rowadr=one(nv * np.arange(rows), int),
        )  # fmt: skip
        contacts = SimpleNamespace(
            geom=wp.array(contact.geom, dtype=wp.vec2i), dim=wp.array(contact.dim, dtype=int),
            efc_address=wp.array(addresses, dtype=int), friction=wp.array(contact.friction, dtype=vec5),
            solimp=wp.array(contact.solimp, dtype=vec5), solref=wp.array(contact.solref, dtype=wp.vec2),
            solreffriction=wp.array(contact.solreffriction, dtype=wp.vec2),
        )  # fmt: skip
        data = SimpleNamespace(
            nworld=1, njmax=rows, nefc=wp.array([rows], dtype=int), efc=efc, contact=contacts, ctrl=one(before.ctrl),
            qpos=one(before.qpos), qvel=one(before.qvel), qacc_warmstart=one(before.qacc_warmstart),
        )  # fmt: skip
        device_model = SimpleNamespace(
            tendon_frictionloss=one(model.tendon_frictionloss), is_sparse=sparse,
            body_subtreemass=one(model.body_subtreemass), dof_invweight0=one(model.dof_invweight0),
        )  # fmt: skip
        sliding = Sliding(model, device_model, data, one(find_table(model, "motors")[:, 1]))
        sliding.last_targets.assign(before.userdata[None, : model.nu])
        sliding.launch()
        assert sliding.last_targets.numpy()[0] == pytest.approx(at.userdata[: model.nu], abs=1e-5)
        return efc.aref.numpy()[0]


@needs_warp
@pytest.mark.parametrize("sparse", [False, True])
def test_sliding_contacts_are_held_down_as_on_the_cpu(sparse: bool) -> None:
    """The RP2W starts, brakes and turns by random speeds of its wheels."""
    sim = trundle.load("model://rp2w")
    model = sim.engine.compiled.model
    random = np.random.default_rng(0)
    largest = 0.0
    sim.step(500)
    for _ in range(4):
        for side in ("left", "right"):
            sim["rp2w"].joint(f"chassis_{side}_wheel").command_velocity(random.uniform(-4.0, 4.0), max_effort=2.0)
        for _ in range(5):
            before = sim.engine.save().data
            with_laws, after = _references(model, before, laws=True)
            free, _ = _references(model, before, laws=False)
            change = (with_laws - free)[after.efc_type == CONTACT]
            on_gpu = _on_device(model, before, after, sparse=sparse)[after.efc_type == CONTACT]

            assert on_gpu == pytest.approx(change, rel=2e-3, abs=1e-2)
            largest = max(largest, -change.min(initial=0.0))
            sim.step()
        sim.step(100)

    assert largest > 10.0
