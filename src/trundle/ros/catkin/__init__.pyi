from .build_report import CppTarget as CppTarget, PackageBuild as PackageBuild, report_package as report_package
from .devel_space import underlays as underlays, write_devel_space as write_devel_space
from .new_package import (
    NewPackage as NewPackage,
    create_package as create_package,
    package_warnings as package_warnings,
)
from .workspace import Workspace as Workspace, init_workspace as init_workspace, open_workspace as open_workspace
