"""Scene of a simulation's page."""

import trundle
from trundle.bringup.page_scene import build_page_scene


def test_the_page_looks_at_the_robot_not_at_the_ball_before_it() -> None:
    sim = trundle.load("rp2w_at_home.world")
    bodies = [f"{model.name}::{link.name}" for model in sim.world.models for link in model.links]
    assert any(body.startswith("ball::") for body in bodies[: bodies.index("rp2w::chassis")])

    scene = build_page_scene(sim, [], drive=False).scene

    assert scene.follow_body is not None
    assert scene.scene.bodies[scene.follow_body] == "rp2w::chassis"


def test_without_joints_the_page_looks_at_the_first_model_that_moves() -> None:
    sim = trundle.load("model://ball")

    scene = build_page_scene(sim, [], drive=False).scene

    assert scene.follow_body is not None
    assert scene.scene.bodies[scene.follow_body].startswith("ball::")
