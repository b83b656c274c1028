"""Contacts and distances of bodies of a planning scene."""

from typing import Literal, TypeAlias

from msgspec import Struct

from trundle.spatial import Vector3

BodyType: TypeAlias = Literal["robot_link", "robot_attached", "world_object"]


class Contact(Struct, frozen=True, kw_only=True):
    """Two bodies that overlap, as moveit_msgs/ContactInformation."""

    body_1: str
    type_1: BodyType
    body_2: str
    type_2: BodyType
    depth: float
    """[m], padding included."""
    position: Vector3
    """Model frame [m]."""
    normal: Vector3
    """Unit vector from body 1 to body 2, model frame."""


class NearestBodies(Struct, frozen=True, kw_only=True):
    """The two nearest bodies that may not touch."""

    distance: float
    """[m]; below zero: greatest depth; inf: nothing within reach."""
    body_1: str = ""
    body_2: str = ""
    point_1: Vector3 = (0.0, 0.0, 0.0)
    """Model frame [m]."""
    point_2: Vector3 = (0.0, 0.0, 0.0)
