"""`trundle compare`: differences of two bags, by topics, numbers and frames."""

from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Source, UsageError, printable
from trundle.page.bag.comparison import BagComparison
from trundle.ros import BagReader, RecordedNumbers, median_rates, open_bag, read_numbers

from .run_differences import RunDifferences, TopicCounts, file_names

_TOLERANCE = 0.01
"""Difference [m, rad] from which on poses count as apart, unless the user gives one."""


def compare_bags(run: Path, reference: Path, tolerance: float | None = None) -> RunDifferences:
    """Compare two bags at the same times since their starts.

    Raises:
        BagError: a file is damaged.
        DescriptionError: a bag is empty.
        UsageError: the bags have no topic in common.
    """
    with open_bag(run) as bag, open_bag(reference) as other:
        one, two = _read(bag), _read(other)
        rates = median_rates(bag), median_rates(other)
    common = [topic for topic in one.topics if topic in two.topics]
    if not common:
        raise UsageError(f"{run} and {reference} have no topic in common: {_listed(one)} and {_listed(two)}")
    duration = min(one.duration, two.duration)
    comparison = BagComparison(two, start=one.start)
    comparison.add_run(one)
    names = file_names(run.name, reference.name, (str(run), str(reference)))
    alone = [
        tuple(topic for topic in some.topics if topic not in others.topics) for some, others in ((one, two), (two, one))
    ]
    rows = tuple(comparison.differences(one.start + duration, since_start=True))
    return RunDifferences(
        duration=duration,
        rows=rows,
        unit="",
        only=tuple((name, some) for name, some in zip(names, alone, strict=True) if some),
        topics=tuple(
            TopicCounts(
                topic=topic,
                type=one.topics[topic].type,
                counts=(one.topics[topic].count, two.topics[topic].count),
                rates=(rates[0].get(topic), rates[1].get(topic)),
            )
            for topic in common
        ),
        notes=(
            *_faults(names, one, two),
            f"{comparison.equal} other numbers change and are equal",
            *_apart(comparison, _TOLERANCE if tolerance is None else tolerance),
        ),
    )


def _read(bag: BagReader) -> RecordedNumbers:
    if not any(bag.counts):
        raise DescriptionError(Source(str(bag.path)), "nothing was recorded")
    return read_numbers(bag)


def _listed(recorded: RecordedNumbers) -> str:
    return ", ".join(recorded.topics) or "no topics"


def _faults(names: tuple[str, str], one: RecordedNumbers, two: RecordedNumbers) -> list[str]:
    """Return sentences on topics that cannot be compared."""
    faults = [
        f"{topic} of {name} is not compared: {found.fault}"
        for name, recorded in zip(names, (one, two), strict=True)
        for topic, found in recorded.topics.items()
        if found.fault is not None
    ]
    types = [(topic, found.type, two.topics[topic].type) for topic, found in one.topics.items() if topic in two.topics]
    faults += [
        f"{topic} is a {here} in {names[0]}, a {there} in {names[1]}" for topic, here, there in types if here != there
    ]
    return [printable(fault) for fault in faults]


def _apart(comparison: BagComparison, tolerance: float) -> list[str]:
    """Return a sentence on where poses are apart first; none without poses."""
    found = comparison.first_apart(tolerance)
    if found is None:
        return []
    time, name = found
    return [
        printable(
            f"poses are apart by more than {tolerance:g} m or rad from {time - comparison.start:.2f} s on: {name}"
        )
    ]
