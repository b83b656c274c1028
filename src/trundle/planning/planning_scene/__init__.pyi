from .allowed_collisions import AllowedCollisionMatrix as AllowedCollisionMatrix
from .contacts import BodyType as BodyType, Contact as Contact, NearestBodies as NearestBodies
from .objects import (
    AttachedObject as AttachedObject,
    CollisionObject as CollisionObject,
    PlacedShape as PlacedShape,
    ShapeGeometry as ShapeGeometry,
    Voxels as Voxels,
)
from .pieces import MAX_TRIANGLES as MAX_TRIANGLES, pieces_of as pieces_of, pose_row as pose_row
from .scene import (
    MAX_OBJECTS as MAX_OBJECTS,
    MAX_VOXELS as MAX_VOXELS,
    OCTOMAP as OCTOMAP,
    PlanningScene as PlanningScene,
)
