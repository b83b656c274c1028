from .frames import FrameError as FrameError, Frames as Frames
from .mirror import SceneMirror as SceneMirror
from .octomap import OctomapError as OctomapError, read_octomap as read_octomap
from .scene_changes import SceneChanges as SceneChanges, SceneError as SceneError
from .scene_contents import CarriedObject as CarriedObject, SceneContents as SceneContents, SceneObject as SceneObject
from .scene_messages import diff_fields as diff_fields, scene_fields as scene_fields
from .shapes import mesh_of as mesh_of, pose_fields as pose_fields, pose_of as pose_of, primitive_of as primitive_of
from .state_messages import (
    is_empty_state as is_empty_state,
    positions_of as positions_of,
    state_fields as state_fields,
)
from .trajectory_messages import trajectory_fields as trajectory_fields
