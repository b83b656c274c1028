from .config_files import write_config_headers as write_config_headers
from .headers import Headers as Headers
from .kit import (
    GAZEBO_CMAKE as GAZEBO_CMAKE,
    Kit as Kit,
    compiled_kit as compiled_kit,
    kit_sources as kit_sources,
    link_programs as link_programs,
)
from .package_build import BuildResult as BuildResult, PackageBuilder as PackageBuilder
from .toolchain import Toolchain as Toolchain, find_toolchain as find_toolchain
