"""Placed models."""

from dataclasses import dataclass

from .plan import ObjectPlan, Paint, Placement


@dataclass(frozen=True, slots=True, kw_only=True)
class Instance:
    """Model that a picture may show."""

    number: int
    """Number in segmentations, from 1 on, the same in every picture."""
    model: str
    """Name in the world."""
    placement: Placement
    paint: Paint
    plan: ObjectPlan | None
    """None: a distractor."""
