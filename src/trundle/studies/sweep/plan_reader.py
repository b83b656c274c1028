"""Reader of plans."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal, TypeVar

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.expressions import Interpreter
from trundle.studies.plan_files.plan_source import description_path, read_source
from trundle.studies.plan_files.variation_reader import read_variation
from trundle.studies.plan_files.yaml_node import YamlNode, read_yaml

from .plan import Design, Event, Formula, Measure, Over, Plan
from .unused import check_used

_KEYS = (
    "world", "launch", "duration", "every", "time_limit", "memory_limit", "seed", "seeds", "repeat", "samples",
    "design", "plugins", "bag", "vary", "set", "events", "stop", "measure", "pass",
)  # fmt: skip
_DESIGNS: dict[str, Design] = {"random": "random", "latin_hypercube": "latin_hypercube", "sobol": "sobol"}
_OVER: dict[str, Over] = {each: each for each in ("end", "start", "min", "max", "mean", "time")}
_COMMANDS = ("position", "velocity", "effort")
PICTURES = frozenset(
    {
        "sensor_msgs/CompressedImage",
        "sensor_msgs/Image",
        "sensor_msgs/PointCloud",
        "sensor_msgs/PointCloud2",
        "stereo_msgs/DisparityImage",
        "theora_image_transport/Packet",
    }
)
"""Message types of pictures and point clouds."""
RESERVED = ("row", "status", "reason", "seed", "time", "t", "models", "topics")
"""Columns of every table, and names of every expression."""


def load_plan(plan: "str | os.PathLike[str] | Mapping[str, object]") -> Plan:
    """Read a plan's file, or a dictionary.

    Raises:
        UsageError: the file cannot be read.
        DescriptionError: it is not a plan; with its line.
    """
    source = read_source(plan)
    return read_plan(source.text, file=source.file, folder=source.folder)


def read_plan(text: str, *, file: str, folder: Path) -> Plan:
    """Read a plan.

    Args:
        text: YAML.
        file: its name in messages.
        folder: base of relative paths.

    Raises:
        DescriptionError: it is not a plan; with its line.
    """
    root = read_yaml(text, file)
    found = root.check_keys("a plan", *_KEYS)
    if ("world" in found) == ("launch" in found):
        root.fail("a plan needs either `world: …` or `launch: …`")
    if "duration" not in found:
        root.fail("a plan needs `duration: …`")
    world = found.get("world") or found["launch"]
    vary = tuple(
        read_variation(name, node, root.value["vary"].keys[name])
        for name, node in (found["vary"].mapping("vary") if "vary" in found else {}).items()
    )
    for each in vary:
        _check_name(each.name, each.at, path_allowed=True)
        other = next((other for other in vary if other.name == each.beside), None)
        if each.beside is not None and (other is None or other is each or len(other.values) != len(each.values)):
            what = f"{each.name!r} goes with {each.beside!r}, which must be another list of {len(each.values)} values"
            raise DescriptionError(each.at, what)
        if other is not None and other.beside is not None:
            raise DescriptionError(each.at, f"{each.name!r} goes with {other.name!r}: name {other.beside!r} instead")
    if "seeds" in found and "repeat" in found:
        raise DescriptionError(root.keys["repeat"], "`seeds` has a run for each seed; leave `repeat` out")
    seeds = tuple(node.whole("a seed", at_least=0) for node in found["seeds"].items()) if "seeds" in found else ()
    random = [each for each in vary if each.distribution is not None]
    if "samples" in found and not random:
        raise DescriptionError(
            root.keys["samples"], "`samples` needs a distribution in `vary`, such as uniform: [0, 1]"
        )
    measures = tuple(_measures(found["measure"], folder)) if "measure" in found else ()
    for measure in measures:
        if any(each.name == measure.name for each in vary):
            raise DescriptionError(measure.at, f"{measure.name!r} varies already; name the measure otherwise")
    bag_s, bag_without = _bag(found["bag"]) if "bag" in found else (None, frozenset[str]())
    plan = Plan(
        file=file,
        folder=folder,
        text=text,
        world=description_path(world, folder, "world"),
        world_at=world.at,
        is_launch="launch" in found,
        duration_s=found["duration"].number("duration", above=0),
        every_s=found["every"].number("every", above=0) if "every" in found else 0.1,
        time_limit_s=found["time_limit"].number("time_limit", above=0) if "time_limit" in found else None,
        bag_s=bag_s,
        bag_without=bag_without,
        memory_limit_bytes=_bytes(found["memory_limit"]) if "memory_limit" in found else None,
        seed=found["seed"].whole("seed", at_least=0) if "seed" in found else 0,
        seeds=seeds,
        repetitions=len(seeds) or (found["repeat"].whole("repeat", at_least=1) if "repeat" in found else 1),
        samples=found["samples"].whole("samples", at_least=1) if "samples" in found else 1,
        design=_choice(found["design"], "design", _DESIGNS) if "design" in found else "random",
        plugins="plugins" in found and found["plugins"].flag("plugins"),
        vary=vary,
        assignments={
            name: _formula(node, f"set {name}")
            for name, node in (found["set"].mapping("set") if "set" in found else {}).items()
        },
        events=tuple(_event(node) for node in found["events"].items()) if "events" in found else (),
        stop=_formulas(found, "stop"),
        measures=measures,
        criteria=_formulas(found, "pass"),
        keys=root.keys,
    )
    check_used(plan)
    return plan


def _bag(node: YamlNode) -> tuple[float, frozenset[str]]:
    """Read a bag's seconds, and the types that it leaves out."""
    if not isinstance(node.value, dict):
        return node.number("bag", above=0), PICTURES
    found = node.check_keys("bag", "last", "pictures")
    if "last" not in found:
        node.fail("a bag needs `last: …`, its seconds")
    has_pictures = "pictures" in found and found["pictures"].flag("pictures")
    return found["last"].number("last", above=0), frozenset() if has_pictures else PICTURES


def _bytes(node: YamlNode) -> int:
    """Read a limit in megabytes."""
    return round(node.number("memory_limit", above=0) * 1e6)


def _check_name(name: str, at: Source, *, path_allowed: bool = False) -> None:
    if path_allowed and "/" in name:
        return
    if not name.isidentifier():
        what = "a path with /, or a name of letters, digits and _" if path_allowed else "letters, digits and _"
        raise DescriptionError(at, f"{name!r} is no name; give {what}")
    if name in RESERVED:
        raise DescriptionError(at, f"{name!r} is a column or name of every sweep; give another name")


_T = TypeVar("_T")


def _choice(node: YamlNode, what: str, choices: dict[str, _T]) -> _T:
    name = node.text(what)
    if name not in choices:
        node.fail(f"{what} must be one of {', '.join(choices)}, not {name!r}")
    return choices[name]


def _formula(node: YamlNode, what: str) -> Formula:
    text = node.text(what)
    try:
        Interpreter().check(text)
    except Exception as error:
        node.fail(f"{what}: {text!r} is no expression: {error}")
    return Formula(text=text, at=node.at)


def _formulas(found: dict[str, YamlNode], name: str) -> tuple[Formula, ...]:
    return tuple(_formula(node, name) for node in found[name].items()) if name in found else ()


def _measures(node: YamlNode, folder: Path) -> Iterator[Measure]:
    for name, each in node.mapping("measure").items():
        at = node.keys[name]
        _check_name(name, at)
        if not isinstance(each.value, dict):
            yield Measure(name=name, at=at, expression=_formula(each, f"measure {name}").text)
            continue
        found = each.check_keys(f"measure {name}", *_OVER, "function")
        if len(found) != 1:
            each.fail(f"measure {name} needs one of {', '.join(_OVER)} or function")
        ((over, value),) = found.items()
        if over == "function":
            yield Measure(name=name, at=at, function=_function(value, folder))
        else:
            yield Measure(name=name, at=at, expression=_formula(value, f"measure {name}").text, over=_OVER[over])


def _function(node: YamlNode, folder: Path) -> tuple[Path, str]:
    file, _, name = node.text("function").rpartition(":")
    if not file or not name.isidentifier():
        node.fail(f"function must be FILE.py:FUNCTION, not {node.value!r}")
    if not os.path.isfile(folder / file):
        node.fail(f"function: there is no file {folder / file}")
    return folder / file, name


def _event(node: YamlNode) -> Event:
    known = ("at", "push", "force", "torque", "for", "joint", *_COMMANDS)
    found = node.check_keys("an event", *known)
    kinds = [kind for kind in ("push", "joint") if kind in found]
    if len(kinds) != 1 or "at" not in found:
        node.fail("an event needs `at: SECONDS` and either `push: MODEL/LINK` or `joint: MODEL/JOINT`")
    target = found[kinds[0]]
    model, slash, part = target.text(kinds[0]).partition("/")
    if not slash:
        target.fail(f"{kinds[0]} must be MODEL/{'LINK' if kinds[0] == 'push' else 'JOINT'}, not {model!r}")
    wanted = ("at", "push", "force", "torque", "for") if kinds[0] == "push" else ("at", "joint", "for", *_COMMANDS)
    for name in found:
        if name not in wanted:
            raise DescriptionError(node.keys[name], f"a {kinds[0]} has no {name!r}; it has: {', '.join(wanted)}")
    duration = _formula(found["for"], "for") if "for" in found else None
    time = _formula(found["at"], "at")
    if kinds[0] == "joint":
        commands = [name for name in _COMMANDS if name in found]
        if len(commands) != 1 or (duration is not None and commands != ["effort"]):
            node.fail(f"a joint needs one of {', '.join(_COMMANDS)}; only an effort has `for`")
        kind: str = commands[0]
        numbers = (_formula(found[kind], kind),)
        return Event(
            at=node.at, time_s=time, target=(model, part), kind=_KINDS[kind], numbers=numbers, duration_s=duration
        )
    if "force" not in found and "torque" not in found:
        node.fail("a push needs `force: [x, y, z]` or `torque: [x, y, z]`")
    zero = Formula(text="0", at=node.at)
    numbers = (*_vector(found.get("force"), "force", zero), *_vector(found.get("torque"), "torque", zero))
    return Event(at=node.at, time_s=time, target=(model, part), kind="push", numbers=numbers, duration_s=duration)


_KINDS: dict[str, Literal["position", "velocity", "effort"]] = {
    "position": "position", "velocity": "velocity", "effort": "effort",
}  # fmt: skip


def _vector(node: YamlNode | None, what: str, zero: Formula) -> tuple[Formula, ...]:
    if node is None:
        return (zero, zero, zero)
    parts = tuple(_formula(part, what) for part in node.items())
    return parts if len(parts) == 3 else node.fail(f"{what} must be [x, y, z]")
