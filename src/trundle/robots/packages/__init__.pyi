from .cmake import (
    CMakeProgram as CMakeProgram,
    cmake_libraries as cmake_libraries,
    cmake_message_folders as cmake_message_folders,
    cmake_programs as cmake_programs,
)
from .compiled_program import compiled_fault as compiled_fault
from .configured_files import write_configured_files as write_configured_files
from .container import package_in_container as package_in_container, source_in_container as source_in_container
from .crawl import MANIFESTS as MANIFESTS
from .dependencies import build_dependencies as build_dependencies, run_dependencies as run_dependencies
from .gazebo_paths import is_stand_in as is_stand_in
from .model_config import model_file as model_file, refuse_template as refuse_template
from .package_finder import (
    ALLOW_OUTSIDE as ALLOW_OUTSIDE,
    HELD_SUFFIX as HELD_SUFFIX,
    LENIENT as LENIENT,
    Packages as Packages,
)
from .ros2 import refuse_ros2 as refuse_ros2, refuse_ros2_language as refuse_ros2_language
from .ros_packages import fetched_folder as fetched_folder
from .rule_exports import exported_rules as exported_rules
from .shipped import PLANS as PLANS, ShippedFile as ShippedFile, shipped_files as shipped_files
from .stock import STOCK as STOCK, STOCK_WITH_FILES as STOCK_WITH_FILES
from .workspace import build_prefixes as build_prefixes, program_folders as program_folders
