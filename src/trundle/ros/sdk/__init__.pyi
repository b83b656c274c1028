from .headers import Headers as Headers
from .kit import Kit as Kit, compiled_kit as compiled_kit, kit_sources as kit_sources
from .package_build import BuildResult as BuildResult, PackageBuilder as PackageBuilder
from .toolchain import Toolchain as Toolchain, find_toolchain as find_toolchain
