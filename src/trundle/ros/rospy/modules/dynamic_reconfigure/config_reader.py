"""The module XConfig of a .cfg file, without a build."""

import traceback

from . import parameter_generator
from .encoding import extract_params


def config_namespace(package, file):
    """Names of the module that a build would generate.

    Args:
        package: package's name.
        file: path of the .cfg file, which is Python and is run.

    Raises:
        ImportError: the file fails, or generates nothing.
    """
    generator = _run(package, file)
    description = generator.group.to_dict()
    parameters = extract_params(description)
    namespace = {key: {each["name"]: each[key] for each in parameters} for key in ("min", "max", "level", "type")}
    namespace["defaults"] = {each["name"]: each["default"] for each in parameters}
    namespace["all_level"] = 0
    for each in parameters:
        namespace["all_level"] |= each["level"]
    constants = {f"{generator.name}_{each['name']}": each["value"] for each in generator.constants}
    return {
        "config_description": description,
        "extract_params": extract_params,
        "inf": float("inf"),
        **namespace,
        **constants,
    }


def _run(package, file):
    """Run a .cfg file; returns the ParameterGenerator that it calls `generate` of."""
    parameter_generator.collected.clear()
    try:
        code = compile(file.read_text(encoding="utf-8"), str(file), "exec")
        exec(code, {"__name__": "__main__", "__file__": str(file)})
    except SystemExit:
        pass  # files end in exit(gen.generate(…))
    except Exception as error:
        where = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(file)]
        line = error.lineno if isinstance(error, SyntaxError) else where[-1] if where else 0
        raise ImportError(f"{file}:{line}: error: {type(error).__name__}: {error}") from None
    if not parameter_generator.collected:
        raise ImportError(
            f"{file}: error: it calls no ParameterGenerator.generate, so {package}.cfg has no such module"
        )
    named = [each for each in parameter_generator.collected if each.name == file.stem]
    return (named or parameter_generator.collected)[-1]
