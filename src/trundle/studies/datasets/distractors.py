"""Distractors: boxes, cylinders, capsules and spheres of random sizes, the same for all pictures of a plan.

Each picture shows some of them, with random poses and looks.
"""

import math

import numpy as np

from trundle.base.diagnostics import Source
from trundle.robots.model import Box, Capsule, Collision, Cylinder, Inertial, Link, Model, Solid, Sphere, Visual

from .plan import DistractorPlan

_PER_SHOWN = 3
"""Ratio of the number of distractors to the number that a picture may show."""
_DENSITY = 400.0
"""[kg/m³]"""
_POOL = 1 << 32
"""Second part of the seed; other seeds have a picture's number, which is smaller."""


def distractor_models(plan: DistractorPlan, seed: int) -> list[Model]:
    """Return the distractors of a plan."""
    random = np.random.default_rng((seed, _POOL))
    models: list[Model] = []
    for number in range(round(plan.count.largest) * _PER_SHOWN):
        x, y, z = (plan.size.draw(random) for _ in range(3))
        shapes: tuple[tuple[Solid, float], ...] = (
            (Box((x, y, z)), x * y * z),
            (Cylinder(x / 2, z), math.pi * x * x * z / 4),
            (Capsule(x / 2, z), math.pi * x * x * (z / 4 + x / 6)),
            (Sphere(x / 2), math.pi * x**3 / 6),
        )
        shape, volume = shapes[number % len(shapes)]
        models.append(_model(f"distractor_{number}", shape, _DENSITY * volume, max(x, y, z), plan.at))
    return models


def _model(name: str, shape: Solid, mass: float, size: float, at: Source) -> Model:
    moment = 0.1 * mass * size * size  # sphere of diameter `size`: 2/5 m r²
    link = Link(
        name="link",
        at=at,
        inertial=Inertial(mass=mass, moments=(moment, moment, moment)),
        visuals=(Visual(name="visual", geometry=shape, at=at),),
        collisions=(Collision(name="collision", geometry=shape, at=at),),
    )
    return Model(name=name, at=at, links=(link,), canonical_link="link")
