"""Reader of sweep plans."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal, TypeVar

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.expressions import Interpreter
from trundle.studies.plan_files.plan_source import description_path, read_source
from trundle.studies.plan_files.variation import Variation
from trundle.studies.plan_files.variation_reader import read_variation
from trundle.studies.plan_files.yaml_node import YamlNode, read_yaml

from .plan import Design, Event, Formula, Measure, Over, Plan
from .unused import check_used

_KEYS = (
    "world", "launch", "duration", "every", "time_limit", "memory_limit", "seed", "seeds", "repeat", "samples",
    "design", "plugins", "bag", "vary", "set", "events", "stop", "measure", "pass",
)  # fmt: skip
_DESIGNS: dict[str, Design] = {"random": "random", "latin_hypercube": "latin_hypercube", "sobol": "sobol"}
_OVER: dict[str, Over] = {name: name for name in ("end", "start", "min", "max", "mean", "time")}
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
"""Columns of every table, and names in every expression."""


def load_plan(plan: "str | os.PathLike[str] | Mapping[str, object]") -> Plan:
    """Read a plan from a file or a dictionary.

    Raises:
        UsageError: the file cannot be read.
        DescriptionError: the plan is invalid.
    """
    source = read_source(plan)
    return read_plan(source.text, file=source.file, folder=source.folder)


def read_plan(text: str, *, file: str, folder: Path) -> Plan:
    """Read a plan.

    Args:
        text: YAML text.
        file: file name in messages.
        folder: base of relative paths.

    Raises:
        DescriptionError: the plan is invalid.
    """
    root = read_yaml(text, file)
    fields = root.check_keys("a plan", *_KEYS)
    if ("world" in fields) == ("launch" in fields):
        root.fail("a plan needs either `world: …` or `launch: …`")
    if "duration" not in fields:
        root.fail("a plan needs `duration: …`")
    world = fields.get("world") or fields["launch"]
    vary = tuple(
        read_variation(name, node, root.value["vary"].keys[name])
        for name, node in (fields["vary"].mapping("vary") if "vary" in fields else {}).items()
    )
    for variation in vary:
        _check_name(variation.name, variation.at, path_allowed=True)
        _check_pair(variation, vary)
    if "seeds" in fields and "repeat" in fields:
        raise DescriptionError(root.keys["repeat"], "`seeds` has a run for each seed; leave `repeat` out")
    seeds = tuple(node.whole("a seed", minimum=0) for node in fields["seeds"].items()) if "seeds" in fields else ()
    random = [variation for variation in vary if variation.distribution is not None]
    if "samples" in fields and not random:
        raise DescriptionError(
            root.keys["samples"], "`samples` needs a distribution in `vary`, such as uniform: [0, 1]"
        )
    measures = tuple(_measures(fields["measure"], folder)) if "measure" in fields else ()
    for measure in measures:
        if any(variation.name == measure.name for variation in vary):
            raise DescriptionError(measure.at, f"{measure.name!r} varies already; name the measure otherwise")
    bag_s, bag_without = _bag(fields["bag"]) if "bag" in fields else (None, frozenset[str]())
    plan = Plan(
        file=file,
        folder=folder,
        text=text,
        world=description_path(world, folder, "world"),
        world_at=world.at,
        is_launch="launch" in fields,
        duration_s=fields["duration"].number("duration", above=0),
        every_s=fields["every"].number("every", above=0) if "every" in fields else 0.1,
        time_limit_s=fields["time_limit"].number("time_limit", above=0) if "time_limit" in fields else None,
        bag_s=bag_s,
        bag_without=bag_without,
        memory_limit_bytes=_bytes(fields["memory_limit"]) if "memory_limit" in fields else None,
        seed=fields["seed"].whole("seed", minimum=0) if "seed" in fields else 0,
        seeds=seeds,
        repetitions=len(seeds) or (fields["repeat"].whole("repeat", minimum=1) if "repeat" in fields else 1),
        samples=fields["samples"].whole("samples", minimum=1) if "samples" in fields else 1,
        design=_choice(fields["design"], "design", _DESIGNS) if "design" in fields else "random",
        plugins="plugins" in fields and fields["plugins"].flag("plugins"),
        vary=vary,
        assignments={
            name: _formula(node, f"set {name}")
            for name, node in (fields["set"].mapping("set") if "set" in fields else {}).items()
        },
        events=tuple(_event(node) for node in fields["events"].items()) if "events" in fields else (),
        stop=_formulas(fields, "stop"),
        measures=measures,
        criteria=_formulas(fields, "pass"),
        keys=root.keys,
    )
    check_used(plan)
    return plan


def _check_pair(variation: Variation, vary: tuple[Variation, ...]) -> None:
    name, partner = variation.name, variation.paired_with
    other = next((other for other in vary if other.name == partner), None)
    count = len(variation.values)
    if partner is not None and (other is None or other is variation or len(other.values) != count):
        message = f"{name!r} goes with {partner!r}, which must be another list of {count} values"
        raise DescriptionError(variation.at, message)
    if other is not None and other.paired_with is not None:
        raise DescriptionError(variation.at, f"{name!r} goes with {partner!r}: name {other.paired_with!r} instead")


def _bag(node: YamlNode) -> tuple[float, frozenset[str]]:
    """Read a bag's duration [s] and its excluded message types."""
    if not isinstance(node.value, dict):
        return node.number("bag", above=0), PICTURES
    fields = node.check_keys("bag", "last", "pictures")
    if "last" not in fields:
        node.fail("a bag needs `last: …`, its seconds")
    has_pictures = "pictures" in fields and fields["pictures"].flag("pictures")
    return fields["last"].number("last", above=0), frozenset() if has_pictures else PICTURES


def _bytes(node: YamlNode) -> int:
    """Read a limit in megabytes."""
    return round(node.number("memory_limit", above=0) * 1e6)


def _check_name(name: str, at: Source, *, path_allowed: bool = False) -> None:
    if path_allowed and "/" in name:
        return
    if not name.isidentifier():
        allowed = "a path with /, or a name of letters, digits and _" if path_allowed else "letters, digits and _"
        raise DescriptionError(at, f"{name!r} is no name; give {allowed}")
    if name in RESERVED:
        raise DescriptionError(at, f"{name!r} is a column or name of every sweep; give another name")


_T = TypeVar("_T")


def _choice(node: YamlNode, label: str, choices: dict[str, _T]) -> _T:
    name = node.text(label)
    if name not in choices:
        node.fail(f"{label} must be one of {', '.join(choices)}, not {name!r}")
    return choices[name]


def _formula(node: YamlNode, label: str) -> Formula:
    text = node.text(label)
    try:
        Interpreter().check(text)
    except Exception as error:
        node.fail(f"{label}: {text!r} is no expression: {error}")
    return Formula(text=text, at=node.at)


def _formulas(fields: dict[str, YamlNode], name: str) -> tuple[Formula, ...]:
    return tuple(_formula(node, name) for node in fields[name].items()) if name in fields else ()


def _measures(node: YamlNode, folder: Path) -> Iterator[Measure]:
    for name, each in node.mapping("measure").items():
        at = node.keys[name]
        _check_name(name, at)
        if not isinstance(each.value, dict):
            yield Measure(name=name, at=at, expression=_formula(each, f"measure {name}").text)
            continue
        fields = each.check_keys(f"measure {name}", *_OVER, "function")
        if len(fields) != 1:
            each.fail(f"measure {name} needs one of {', '.join(_OVER)} or function")
        ((over, value),) = fields.items()
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
    allowed = ("at", "push", "force", "torque", "for", "joint", *_COMMANDS)
    fields = node.check_keys("an event", *allowed)
    kinds = [kind for kind in ("push", "joint") if kind in fields]
    if len(kinds) != 1 or "at" not in fields:
        node.fail("an event needs `at: SECONDS` and either `push: MODEL/LINK` or `joint: MODEL/JOINT`")
    target = fields[kinds[0]]
    model, slash, part = target.text(kinds[0]).partition("/")
    if not slash:
        target.fail(f"{kinds[0]} must be MODEL/{'LINK' if kinds[0] == 'push' else 'JOINT'}, not {model!r}")
    expected = ("at", "push", "force", "torque", "for") if kinds[0] == "push" else ("at", "joint", "for", *_COMMANDS)
    for name in fields:
        if name not in expected:
            raise DescriptionError(node.keys[name], f"a {kinds[0]} has no {name!r}; it has: {', '.join(expected)}")
    duration = _formula(fields["for"], "for") if "for" in fields else None
    time = _formula(fields["at"], "at")
    if kinds[0] == "joint":
        commands = [name for name in _COMMANDS if name in fields]
        if len(commands) != 1 or (duration is not None and commands != ["effort"]):
            node.fail(f"a joint needs one of {', '.join(_COMMANDS)}; only an effort has `for`")
        kind: str = commands[0]
        numbers = (_formula(fields[kind], kind),)
        return Event(
            at=node.at, time_s=time, target=(model, part), kind=_KINDS[kind], numbers=numbers, duration_s=duration
        )
    if "force" not in fields and "torque" not in fields:
        node.fail("a push needs `force: [x, y, z]` or `torque: [x, y, z]`")
    zero = Formula(text="0", at=node.at)
    numbers = (*_vector(fields.get("force"), "force", zero), *_vector(fields.get("torque"), "torque", zero))
    return Event(at=node.at, time_s=time, target=(model, part), kind="push", numbers=numbers, duration_s=duration)


_KINDS: dict[str, Literal["position", "velocity", "effort"]] = {
    "position": "position", "velocity": "velocity", "effort": "effort",
}  # fmt: skip


def _vector(node: YamlNode | None, label: str, zero: Formula) -> tuple[Formula, ...]:
    if node is None:
        return (zero, zero, zero)
    parts = tuple(_formula(part, label) for part in node.items())
    return parts if len(parts) == 3 else node.fail(f"{label} must be [x, y, z]")
