from .catalog import (
    BUILTIN as BUILTIN,
    SENSOR_PLUGINS as SENSOR_PLUGINS,
    find_held_file as find_held_file,
    find_model_sensor_plugin as find_model_sensor_plugin,
    find_plugin as find_plugin,
    find_sensor_plugin as find_sensor_plugin,
    find_user_file as find_user_file,
    find_visual_plugin as find_visual_plugin,
    find_world_plugin as find_world_plugin,
    is_cosmetic as is_cosmetic,
    is_sensor_plugin as is_sensor_plugin,
    require_plugin as require_plugin,
)
from .compiled.library import plugin_library as plugin_library
from .documentation import (
    PluginDocumentation as PluginDocumentation,
    PluginParameter as PluginParameter,
    plugin_documentation as plugin_documentation,
)
from .gazebo_ros.plugin_names import PluginNames as PluginNames
from .plugin import Hooks as Hooks, Plugin as Plugin, VisualPlugin as VisualPlugin, WorldPlugin as WorldPlugin
