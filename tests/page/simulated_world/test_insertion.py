"""Inserting models, shapes and lights into a running world, by requests of the page."""

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from tests.page.simulated_world.fake_server import sent

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.gazebo.plugins import find_user_file
from trundle.page import DeleteLight, InsertAction, InsertLight, InsertModel, ListModels, RestoreLight
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world.code_consent import CodeConsent
from trundle.page.simulated_world.insertion import Insertion
from trundle.page.simulated_world.model_edits import ModelEdits
from trundle.robots.description import load_text
from trundle.robots.model import Model
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot
from trundle.sim.simulation import Simulation

CRATE = '<sdf version="1.6"><model name="crate"><link name="body"/>{}</model></sdf>'
CONFIG = "<model><name>A crate</name><sdf version='1.6'>model.sdf</sdf><description>Of  wood.</description></model>"


def answered(insertion: Insertion, action: InsertAction) -> dict[str, Any]:
    """Execute a request, and return the answer as a client gets it."""
    answer = insertion.handle(action)
    assert isinstance(answer, action.answer), "the answer has a type of the request's class"
    return sent(answer)


class Contents(BareWorld):
    """Adds models to a simulation without sensors and plugins."""

    def __init__(self, simulation: Simulation, packages: Packages, environment: Mapping[str, str]) -> None:
        super().__init__(simulation)
        self.packages, self.environment = packages, environment

    def spawn(self, model: Model, robot: Robot | None = None) -> None:
        assert robot is None
        self.simulation.spawn(model)

    def robot(self, model: str) -> None:
        assert any(present.name == model for present in self.simulation.models)


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    return {"GAZEBO_MODEL_PATH": str(tmp_path / "models"), "HOME": str(tmp_path)}


@pytest.fixture
def simulation(tmp_path: Path, environment: dict[str, str]) -> Simulation:
    packages, report = Packages(environment, start=tmp_path), Diagnostics()
    text = '<sdf version="1.6"><world name="yard"/></sdf>'
    return Simulation(load_text(text, name="yard", folder=tmp_path, packages=packages, report=report).world, report)


@pytest.fixture
def packages(tmp_path: Path, environment: dict[str, str]) -> Packages:
    return Packages(environment, start=tmp_path)


@pytest.fixture
def insertion(simulation: Simulation, packages: Packages, environment: dict[str, str]) -> Insertion:
    contents = Contents(simulation, packages, environment)
    return Insertion(contents, CodeConsent(environment))


@pytest.fixture
def edits(simulation: Simulation, tmp_path: Path, environment: dict[str, str]) -> ModelEdits:
    contents = Contents(simulation, Packages(environment, start=tmp_path), environment)
    return ModelEdits(contents)


def _put_crate(tmp_path: Path, plugin: str = "") -> None:
    folder = tmp_path / "models/crate"
    folder.mkdir(parents=True)
    (folder / "model.config").write_text(CONFIG)
    (folder / "model.sdf").write_text(CRATE.format(plugin))


def test_models_of_the_model_path_are_listed(insertion: Insertion, tmp_path: Path) -> None:
    _put_crate(tmp_path)

    models = answered(insertion, ListModels())["models"]

    assert {"name": "crate", "title": "A crate", "description": "Of wood.", "uploaded": False} in models


def test_an_uploaded_model_comes_first_and_is_inserted(
    insertion: Insertion, packages: Packages, simulation: Simulation, tmp_path: Path
) -> None:
    """Its SDF may refer to its own files, like that of every model, and no others."""
    _put_crate(tmp_path)
    (tmp_path / "models").rename(tmp_path / "uploads")
    insertion.handle(ListModels())
    packages.add_models(tmp_path / "uploads")

    first = answered(insertion, ListModels())["models"][0]
    insertion.handle(InsertModel(model="crate", position=(0.0, 0.0, 0.0)))

    assert (first["name"], first["uploaded"]) == ("crate", True)
    assert [model.name for model in simulation.models] == ["crate"]
    secret = tmp_path / "secret.stl"
    secret.write_text("solid")
    mesh = f'<visual name="v"><geometry><mesh><uri>file://{secret}</uri></mesh></geometry></visual>'
    text = CRATE.replace('<link name="body"/>', f'<link name="body">{mesh}</link>')
    (tmp_path / "uploads/crate/model.sdf").write_text(text.format(""))
    insertion.handle(InsertModel(model="crate", position=(0.0, 0.0, 0.0)))
    assert any("reads only below its own folders" in str(finding) for finding in simulation.report.findings)


def test_a_model_is_inserted_at_a_point_under_an_unused_name(
    insertion: Insertion, simulation: Simulation, tmp_path: Path
) -> None:
    _put_crate(tmp_path)

    names = [answered(insertion, InsertModel(model="crate", position=(x, 2.0, 0.5)))["name"] for x in (1.0, 3.0)]

    assert names == ["crate", "crate_0"]
    assert [simulation[name].pose.position for name in names] == [(1.0, 2.0, 0.5), (3.0, 2.0, 0.5)]


@pytest.mark.parametrize("shape", ["box", "sphere", "cylinder"])
def test_a_simple_shape_is_inserted_on_the_floor(insertion: Insertion, simulation: Simulation, shape: str) -> None:
    name = answered(insertion, InsertModel(model=shape, position=(1.0, 0.0, 0.0), is_shape=True))["name"]

    assert simulation[name].pose.position == (1.0, 0.0, 0.5)
    assert simulation[name].link("link").link.inertial.mass == 1.0


CODED = '<plugin name="p" filename="code.py"><speed>{}</speed></plugin>'


def _insert(insertion: Insertion, consent: str | None = None, model: str = "crate") -> dict[str, Any]:
    return answered(insertion, InsertModel(model=model, position=(0.0, 0.0, 0.0), consent=consent))


def test_a_model_with_code_needs_consent(insertion: Insertion, simulation: Simulation, tmp_path: Path) -> None:
    _put_crate(tmp_path, CODED.format(1))
    code = tmp_path / "models/crate/code.py"
    code.write_text("")

    question = _insert(insertion)
    before = [model.name for model in simulation.models]

    assert (question["code"], before) == ([str(code)], [])
    assert _insert(insertion, question["consent"]) == {"name": "crate"}


def test_consent_is_valid_once_and_for_the_listed_code(
    insertion: Insertion, simulation: Simulation, tmp_path: Path
) -> None:
    """Invented and used tokens, and those for other code, parameters or models, do not run it."""
    _put_crate(tmp_path, CODED.format(1))
    folder = tmp_path / "models/crate"
    (folder / "code.py").write_text("first = 1")
    shutil.copytree(folder, folder.with_name("other"))
    used, for_code, for_speed, for_crate = (str(_insert(insertion)["consent"]) for _ in range(4))

    assert _insert(insertion, used) == {"name": "crate"}
    (folder / "code.py").write_text("second = 2")
    refused = [_insert(insertion, word) for word in (used, for_code, "true", "")]
    (folder / "code.py").write_text("first = 1")
    (folder / "model.sdf").write_text(CRATE.format(CODED.format(2)))
    refused += [_insert(insertion, for_speed), _insert(insertion, for_crate, model="other")]

    assert all(answer["code"] for answer in refused)
    assert [model.name for model in simulation.models] == ["crate"]


def test_uploaded_code_is_not_loaded_before_consent(
    insertion: Insertion, packages: Packages, environment: dict[str, str], tmp_path: Path
) -> None:
    """Neither copying a model nor a spawn service loads it."""
    _put_crate(tmp_path, CODED.format(1))
    (tmp_path / "models").rename(tmp_path / "uploads")
    held = tmp_path / "uploads/crate/code.py.held"
    held.write_text("first = 1")
    packages.add_models(tmp_path / "uploads")
    (tag,) = insertion._read("crate")[0].plugins

    question = _insert(insertion)
    assert question["code"] == [str(held.with_suffix(""))]
    assert find_user_file(tag, environment) is None
    held.write_text("second = 2")
    assert _insert(insertion, question["consent"])["code"]
    assert find_user_file(tag, environment) is None
    assert _insert(insertion, _insert(insertion)["consent"]) == {"name": "crate"}
    code = find_user_file(tag, environment)
    assert code is not None
    assert code.read_text() == "second = 2"


def test_lights_are_inserted_deleted_and_restored(
    insertion: Insertion, edits: ModelEdits, simulation: Simulation
) -> None:
    def heights() -> dict[str, tuple[float, float, float]]:
        return {light.name: light.world_from_light.position for light in simulation.world.lights}

    name = answered(insertion, InsertLight(type="spot", position=(1.0, 2.0, 0.0)))["name"]
    before = heights()
    edits.handle(DeleteLight(light=name))
    after = heights()
    edits.handle(RestoreLight(light=name))

    assert before[name] == (1.0, 2.0, 2.0)
    assert name not in after
    assert heights() == before


def test_unknown_names_are_refused(insertion: Insertion, edits: ModelEdits) -> None:
    with pytest.raises(UsageError, match="no model 'nothing' on the model path"):
        insertion.handle(InsertModel(model="nothing", position=(0.0, 0.0, 0.0)))
    with pytest.raises(UsageError, match="no shape 'cone'; there are: box, sphere, cylinder"):
        insertion.handle(InsertModel(model="cone", position=(0.0, 0.0, 0.0), is_shape=True))
    with pytest.raises(UsageError, match="the world has no light 'moon'"):
        edits.handle(DeleteLight(light="moon"))
    with pytest.raises(UsageError, match="the page has deleted no light 'moon'"):
        edits.handle(RestoreLight(light="moon"))
