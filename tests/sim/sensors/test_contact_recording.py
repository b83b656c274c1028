"""Contact sensors record every step without Python at every step, and exactly what a hook at every step would see."""

from collections.abc import Callable
from pathlib import Path
from threading import Thread

import pytest

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load_text
from trundle.robots.packages import Packages
from trundle.sim.physics import Contact, Engine
from trundle.sim.sensors import ContactReading, ContactRecord, ContactSensor, mount_sensors
from trundle.sim.simulation import Simulation, Snapshot
from trundle.sim.timeline import Timeline
from trundle.spatial import NS_PER_S, Wrench

FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry></collision></link></model>"""
INERTIAL = "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
BOX = """<model name="b{i}"><pose>{x} {y} {z} {roll} 0 0</pose><link name="l">{inertial}<collision name="c"><geometry>
<box><size>0.2 0.2 0.2</size></box></geometry></collision>{sensor}</link></model>"""
SENSOR = """<sensor name="s" type="contact"><update_rate>30</update_rate></sensor>"""
PILE = "".join(
    BOX.format(
        i=i,
        x=0.03 * i,
        y=0.05 * (i % 2),
        z=0.15 + 0.21 * i,
        roll=0.1 * i,
        inertial=INERTIAL,
        sensor=SENSOR if i < 2 else "",
    )
    for i in range(3)
)
ALONE = BOX.format(i="", x=5, y=0, z=0.1, roll=0, inertial=INERTIAL, sensor="").replace('"b"', '"alone"')
"""Sleeps before the pile does."""


@pytest.fixture
def load(tmp_path: Path) -> Callable[[], Simulation]:
    file = tmp_path / "pile.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{FLOOR}{PILE}{ALONE}</world></sdf>')
    return lambda: trundle.load(str(file))


class _ContactSensors:
    """Contact sensors of a simulation, and all their readings."""

    def __init__(self, sim: Simulation) -> None:
        self.readings: list[tuple[str, ContactReading]] = []
        self.mounted = [sensor for sensor in mount_sensors(sim) if isinstance(sensor, ContactSensor)]
        for sensor in self.mounted:
            sensor.listen(lambda reading, name=sensor.model.name: self.readings.append((name, reading)))
            sensor.start(sim)

    def records(self, model: str) -> list[ContactRecord]:
        return [record for name, reading in self.readings if name == model for record in reading.contacts]


class _EveryStep:
    """Hook that reads the contacts of some collisions after every step."""

    def __init__(self, sim: Simulation, collision: str) -> None:
        self.contacts: list[tuple[int, Contact]] = []
        self._among = frozenset({collision})
        self._sim = sim
        sim.add_hook(self)

    def after_step(self, snapshot: Snapshot) -> None:
        self.contacts += [(snapshot.time_ns, contact) for contact in self._sim.contacts(self._among)]


def _from_side(contacts: list[tuple[int, Contact]], collision: str, until_ns: int) -> list[ContactRecord]:
    """Contacts up to a time, as reported by the sensor of one side."""
    records: list[ContactRecord] = []
    for time_ns, contact in contacts:
        first, second = contact.collisions
        sign, other = (1.0, first) if second == collision else (-1.0, second)
        normal, force, torque = (
            (sign * x, sign * y, sign * z) for x, y, z in (contact.normal, contact.force.force, contact.force.torque)
        )
        if time_ns <= until_ns:
            records.append(
                ContactRecord(
                    time_ns=time_ns,
                    collision=collision,
                    other=other,
                    position=contact.position,
                    normal=normal,
                    depth=contact.depth,
                    wrench=Wrench(force, torque),
                )
            )
    return records


def test_recorded_contacts_equal_contacts_read_at_every_step(load: Callable[[], Simulation]) -> None:
    """While a pile falls, rests, sleeps, and is woken."""
    recorded, looked = load(), load()
    sensors = _ContactSensors(recorded)
    hooks = {f"b{i}": _EveryStep(looked, f"b{i}::l::c") for i in range(2)}
    for sim in (recorded, looked):
        sim.run(2.1)
        assert sim.engine.asleep >= 3
        sim["b2"].apply_wrench(Wrench(force=(3.0, 1.0, 4.0)), duration_s=0.2)
        sim.run(0.6)

    for name, hook in hooks.items():
        last_ns = max(reading.time_ns for readings, reading in sensors.readings if readings == name)
        expected = _from_side(hook.contacts, f"{name}::l::c", last_ns)
        assert len(expected) > 4_000
        assert repr(sensors.records(name)) == repr(expected), "floats are written in full"
    assert recorded.snapshot().poses.tobytes() == looked.snapshot().poses.tobytes()


def test_recording_needs_no_python_per_step(load: Callable[[], Simulation], monkeypatch: pytest.MonkeyPatch) -> None:
    """The engine is asked for a stride from reading to reading, 30 a second; with no listener for all 1000 steps."""
    strides: list[int] = []
    step = Engine.step

    def count(engine: Engine, number: int, *rest: object) -> int:
        strides.append(number)
        return step(engine, number, *rest)  # pyright: ignore[reportArgumentType]

    monkeypatch.setattr(Engine, "step", count)
    silent, sim = load(), load()
    for sensor in mount_sensors(silent):
        sensor.start(silent)
    silent.run(1.0)
    assert strides == [1000]
    _ContactSensors(sim)
    sim.run(1.0)
    assert 30 <= len(strides[1:]) <= 32
    assert sum(strides[1:]) == 1000


def test_two_simulations_on_two_threads_record_as_one_alone(load: Callable[[], Simulation]) -> None:
    sims = [load() for _ in range(3)]
    sensors = [_ContactSensors(sim) for sim in sims]
    sims[2].run(1.0)
    threads = [Thread(target=sim.run, args=(1.0,)) for sim in sims[:2]]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert sensors[2].readings
    assert repr(sensors[0].readings) == repr(sensors[1].readings) == repr(sensors[2].readings)


def test_a_timeline_seeks_into_the_middle_of_a_recording_period(load: Callable[[], Simulation]) -> None:
    """Contacts recorded before the saved state are reported again."""
    sim = load()
    sensors = _ContactSensors(sim)
    sim.run(0.35)
    timeline = Timeline(sim, roots=sensors.mounted)
    timeline.advance(NS_PER_S)
    first = repr([readings for readings in sensors.readings if readings[1].time_ns > 350_000_000])

    timeline.seek(350_000_000)
    timeline.advance(NS_PER_S)

    assert repr([readings for readings in sensors.readings if readings[1].time_ns > 350_000_000]) == first


def test_contacts_after_a_restore_repeat_from_the_next_period_on(load: Callable[[], Simulation]) -> None:
    sim = load()
    sensors = _ContactSensors(sim)
    sim.run(3.0)
    saved = sim.save()
    sim.run(0.5)
    first = [readings for readings in sensors.readings if readings[1].time_ns > 3_040_000_000]
    sensors.readings.clear()

    sim.restore(saved)
    sim.run(0.5)

    assert repr([readings for readings in sensors.readings if readings[1].time_ns > 3_040_000_000]) == repr(first)


def test_contacts_before_a_deletion_are_reported(load: Callable[[], Simulation]) -> None:
    sim, unchanged = load(), load()
    sensors, others = _ContactSensors(sim), _ContactSensors(unchanged)
    sim.run(0.31)
    sim.delete("alone")
    for simulation in (sim, unchanged):
        simulation.advance(410_000_000)

    def before(readings: _ContactSensors) -> str:
        return repr([record for record in readings.records("b1") if record.time_ns <= 310_000_000])

    assert sensors.records("b1")[-1].time_ns > 310_000_000
    assert before(sensors) == before(others)


def test_an_error_within_a_recorded_step_is_raised(tmp_path: Path) -> None:
    """A callback of the user's that fails within a recorded step ends the run, not the process."""
    import mujoco

    world = f'<sdf version="1.6"><world name="w">{FLOOR}{PILE}</world></sdf>'
    report = Diagnostics()
    loaded = load_text(world.encode(), name="w", folder=tmp_path, packages=Packages({}, start=tmp_path), report=report)
    sim = Simulation(loaded.world, report)
    _ContactSensors(sim)

    def fail(_: mujoco.MjModel, __: mujoco.MjData) -> None:
        raise ValueError("no")

    mujoco.set_mjcb_control(fail)
    try:
        with pytest.raises(RuntimeError, match="exception"):
            sim.step(3)
    finally:
        mujoco.set_mjcb_control(None)
    sim.step(3)
