from .library import foreign_library as foreign_library, plugin_library as plugin_library
from .plugin import compiled_model_plugin as compiled_model_plugin, compiled_world_plugin as compiled_world_plugin
