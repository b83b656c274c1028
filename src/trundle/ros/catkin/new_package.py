"""New packages, as catkin_create_pkg creates them."""

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError

_CONVENTION = re.compile(r"[a-z][a-z0-9_-]*")
_MESSAGES = frozenset({"message_generation", "message_runtime"})


@dataclass(frozen=True, slots=True, kw_only=True)
class NewPackage:
    """Contents of a package.xml and a CMakeLists.txt."""

    name: str
    dependencies: tuple[str, ...] = ()
    """Other catkin packages."""
    system_dependencies: tuple[str, ...] = ()
    boost_components: tuple[str, ...] = ()
    version: str = "0.0.0"
    description: str = ""
    """Empty: `The NAME package`."""
    licences: tuple[str, ...] = ()
    authors: tuple[str, ...] = ()
    maintainers: tuple[str, ...] = ()
    is_metapackage: bool = False


def create_package(parent: Path, package: NewPackage) -> Iterator[str]:
    """Write a package's files and yield a line for each, in catkin_create_pkg's words.

    Raises:
        UsageError: a file exists or cannot be written; nothing is overwritten.
    """
    folder = parent / package.name
    texts = {"package.xml": package_xml(package), "CMakeLists.txt": cmake_lists(package)}
    for name in texts:
        if os.path.lexists(folder / name):
            raise UsageError(f"File exists: {folder / name}")
    folders: list[str] = []
    if not package.is_metapackage and "roscpp" in package.dependencies:
        folders.append(f"include/{package.name}")
    if not package.is_metapackage and not {"roscpp", "rospy"}.isdisjoint(package.dependencies):
        folders.append("src")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            write_atomically(folder / name, text, replace=False)
            yield f"Created file {package.name}/{name}"
        for name in folders:
            (folder / name).mkdir(parents=True, exist_ok=True)
            yield f"Created folder {package.name}/{name}"
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    yield f"Successfully created files in {folder}. Please adjust the values in package.xml."


def package_warnings(package: NewPackage) -> Iterator[str]:
    """Yield catkin's warnings about a package, which it creates nevertheless."""
    if _CONVENTION.fullmatch(package.name) is None:
        yield (
            f'Package name "{package.name}" does not follow the naming conventions. It should start with a lower case '
            "letter and only contain lower case letters, digits, underscores, and dashes."
        )
    if len(_MESSAGES.intersection(package.dependencies)) == 1:
        yield "Packages with messages or services should depend on both message_generation and message_runtime"


def package_xml(package: NewPackage) -> str:
    """Return the manifest, in format 2."""
    user = os.environ.get("USER") or os.environ.get("USERNAME") or "user"
    maintainers = package.maintainers or (user,)
    lines = [
        '<?xml version="1.0"?>',
        '<package format="2">',
        f"  <name>{escape(package.name)}</name>",
        f"  <version>{escape(package.version)}</version>",
        f"  <description>{escape(package.description or f'The {package.name} package')}</description>",
        "",
        "  <!-- whom to write to; more lines may follow -->",
        *(
            f"  <maintainer email={quoteattr(f'{_mailbox(person)}@todo.todo')}>{escape(person)}</maintainer>"
            for person in maintainers
        ),
        "",
        "  <!-- such as BSD, MIT or Apache-2.0 -->",
        *(f"  <license>{escape(licence)}</license>" for licence in package.licences or ("TODO",)),
        *(f"  <author>{escape(author)}</author>" for author in package.authors),
        "",
        "  <!-- to compile: build_depend; to run: exec_depend; both: depend -->",
        "  <buildtool_depend>catkin</buildtool_depend>",
        *(f"  <{tag}>{escape(name)}</{tag}>" for tag, name in _dependencies(package)),
        "",
        "  <export>",
        *(["    <metapackage/>"] if package.is_metapackage else []),
        "  </export>",
        "</package>",
        "",
    ]
    return "\n".join(lines)


def _mailbox(person: str) -> str:
    return re.sub(r"\W+", "_", person.strip()) or "user"


def _dependencies(package: NewPackage) -> Iterator[tuple[str, str]]:
    """Yield dependency tags with their packages; generated messages are needed to build, their runtime to run."""
    system = {*package.system_dependencies, *(["boost"] if package.boost_components else [])}
    names = sorted({*package.dependencies, *system})
    for tag in ("build_depend", "build_export_depend", "exec_depend"):
        message_package = {"build_depend": "message_generation", "exec_depend": "message_runtime"}.get(tag)
        yield from ((tag, name) for name in names if name == message_package or name not in _MESSAGES)


def cmake_lists(package: NewPackage) -> str:
    """Return the build file, with the commands of catkin_create_pkg's, and the usual next ones as comments."""
    if package.is_metapackage:
        commands = f"project({package.name})\nfind_package(catkin REQUIRED)\ncatkin_metapackage()\n"
        return f"cmake_minimum_required(VERSION 3.0.2)\n{commands}"
    components = sorted(package.dependencies)
    find = "find_package(catkin REQUIRED"
    boost = " ".join(package.boost_components)
    system = [name for name in package.system_dependencies if name.lower() != "boost" or not boost]
    includes = [
        *(["include"] if "roscpp" in package.dependencies else []),
        *(["${catkin_INCLUDE_DIRS}"] if components else []),
        *(["${Boost_INCLUDE_DIRS}"] if boost else []),
    ]
    lines = [
        "cmake_minimum_required(VERSION 3.0.2)",
        f"project({package.name})",
        "",
        *([f"{find} COMPONENTS", *(f"  {name}" for name in components), ")"] if components else [f"{find})"]),
        *([f"find_package(Boost REQUIRED COMPONENTS {boost})"] if boost else []),
        *(f"find_package({name} REQUIRED)" for name in system),
        "",
        "# Messages and services: list their files, and what they use.",
        "# add_message_files(FILES Message.msg)",
        "# add_service_files(FILES Service.srv)",
        "# generate_messages(DEPENDENCIES std_msgs)",
        "",
        "# Packages that use this one get what is listed here.",
        "catkin_package(",
        "#  INCLUDE_DIRS include",
        f"#  LIBRARIES {package.name}",
        f"#  CATKIN_DEPENDS {' '.join(components)}".rstrip(),
        ")",
        "",
        "include_directories(",
        *(f"  {include}" for include in includes),
        ")",
        "",
        "# A node in C++",
        f"# add_executable(${{PROJECT_NAME}}_node src/{package.name}_node.cpp)",
        "# target_link_libraries(${PROJECT_NAME}_node ${catkin_LIBRARIES})",
        "",
        "# Nodes in Python",
        "# catkin_install_python(PROGRAMS scripts/node.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})",
        "",
    ]
    return "\n".join(lines)
