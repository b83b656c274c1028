"""Module XConfig of a .cfg file, without a build."""

import traceback
from pathlib import Path
from typing import Any

from . import parameter_generator
from .encoding import extract_params


def config_namespace(package: str, file: Path) -> dict[str, Any]:
    """Namespace of the module that a build would generate.

    Args:
        package: package's name.
        file: .cfg file, a Python program, which is run.

    Raises:
        ImportError: the file fails, or generates nothing.
    """
    generators = _run(package, file)
    generator = ([one for one in generators if one.name == file.stem] or generators)[-1]
    description = generator.group.to_dict()
    parameters = extract_params(description)
    namespace: dict[str, Any] = {
        field: {parameter["name"]: parameter[field] for parameter in parameters}
        for field in ("min", "max", "level", "type")
    }
    namespace["defaults"] = {parameter["name"]: parameter["default"] for parameter in parameters}
    namespace["all_level"] = 0
    for parameter in parameters:
        namespace["all_level"] |= parameter["level"]
    constants = {f"{generator.name}_{constant['name']}": constant["value"] for constant in generator.constants}
    return {
        "config_description": description,
        "extract_params": extract_params,
        "inf": float("inf"),
        **namespace,
        **constants,
    }


def described(package: str, file: Path) -> list[dict[str, Any]]:
    """All configurations that a .cfg file generates: pkgname that it gives, name, group, constants.

    Raises:
        ImportError: the file fails, or generates nothing.
    """
    return [
        {
            "pkgname": generator.pkgname,
            "name": generator.name,
            "group": generator.group.to_dict(),
            "constants": generator.constants,
        }
        for generator in _run(package, file)
    ]


def _run(package: str, file: Path) -> list[parameter_generator.ParameterGenerator]:
    """Run a .cfg file; returns the ParameterGenerators whose `generate` it calls."""
    parameter_generator.collected.clear()
    try:
        code = compile(file.read_text(encoding="utf-8"), str(file), "exec")
        exec(code, {"__name__": "__main__", "__file__": str(file)})
    except SystemExit:
        pass  # files end in exit(gen.generate(…))
    except Exception as error:
        lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(file)]
        line = error.lineno if isinstance(error, SyntaxError) else lines[-1] if lines else 0
        raise ImportError(f"{file}:{line}: error: {type(error).__name__}: {error}") from None
    if not parameter_generator.collected:
        raise ImportError(f"{file}: error: no call of ParameterGenerator.generate, so {package}.cfg has no such module")
    return list(parameter_generator.collected)
