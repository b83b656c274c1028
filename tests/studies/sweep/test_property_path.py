"""Properties of a world by path."""

import pytest

import trundle
from trundle.base.diagnostics import UsageError
from trundle.robots.model import World
from trundle.studies.plan_files.variation import Value
from trundle.studies.sweep.property_path import with_property


@pytest.fixture(scope="module")
def world() -> World:
    return trundle.load("model://rp2w").world


def test_a_number_is_replaced_and_the_rest_is_shared(world: World) -> None:
    edited = with_property(world, "models/rp2w/links/chassis/inertial/mass", 4)

    assert edited.models[0].link("chassis").inertial.mass == 4.0
    assert edited.models[1] is world.models[1]
    assert with_property(edited, "models/rp2w/links/chassis/inertial/mass", 3.0) == world


def test_a_star_matches_everything_that_has_the_rest_of_the_path(world: World) -> None:
    edited = with_property(world, "models/rp2w/joints/*/axis/damping", 0.5)
    assert {joint.axis.damping for joint in edited.models[0].joints if joint.axis} == {0.5}

    edited = with_property(world, "models/*/links/*/collisions/*/friction", 0.3)
    surfaces = [c.surface for model in edited.models for link in model.links for c in link.collisions]
    assert {(surface.mu, surface.mu2) for surface in surfaces} == {(0.3, 0.3)}


def test_short_names_and_components(world: World) -> None:
    edited = world
    for path, value in (
        ("gravity/z", -1.62),
        ("time_step", 0.002),
        ("models/rp2w/pose/yaw", 0.5),
        ("lights/sun/diffuse/r", 0.1),
    ):
        edited = with_property(edited, path, value)

    assert (edited.physics.gravity[2], edited.physics.max_step_size_s) == (-1.62, 0.002)
    assert edited.models[0].world_from_model.rpy[2] == pytest.approx(0.5)
    assert edited.lights[0].diffuse[0] == 0.1


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (
            "models/rp/links",
            1,
            "models/rp/links: models has no 'rp'; the nearest is 'rp2w'; it has: rp2w, ground_plane, *",
        ),
        (
            "models/rp2w/links/chassis/inertial/mas",
            1,
            "models/rp2w/links/chassis/inertial has no 'mas'; the nearest is 'mass'; it has: ",
        ),
        ("models/rp2w/links/chassis/inertial", 1, "models/rp2w/links/chassis/inertial is no single value; go on with"),
        ("models/rp2w/static", 1, "models/rp2w/static must be true or false, not 1"),
        ("gravity", (0, 1), "gravity must be [x, y, z], not (0, 1)"),
        (
            "models/rp2w/links/*/inertial/mass",
            "heavy",
            "models/rp2w/links/*/inertial/mass must be a number, not 'heavy'",
        ),
    ],
)
def test_a_wrong_path_lists_what_is_there(world: World, path: str, value: Value, message: str) -> None:
    with pytest.raises(UsageError) as caught:
        with_property(world, path, value)
    assert message in str(caught.value)
