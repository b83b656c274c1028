from .library import foreign_library as foreign_library, has_mark as has_mark, plugin_library as plugin_library
from .plugin import (
    compiled_model_plugin as compiled_model_plugin,
    compiled_visual_plugin as compiled_visual_plugin,
    compiled_world_plugin as compiled_world_plugin,
)
from .plugin_world import CompiledPlugins as CompiledPlugins, start_ros as start_ros
from .sensor_plugin import attach_compiled_plugin as attach_compiled_plugin
