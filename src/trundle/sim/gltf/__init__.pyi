from .document import Document as Document
from .nodes import add_scene as add_scene, animated_glb as animated_glb, glb_from_scene as glb_from_scene
from .packing import content_name as content_name
