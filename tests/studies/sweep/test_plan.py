"""Plans: what is read, and the sentence for each mistake."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError
from trundle.studies.sweep.plan_reader import read_plan
from trundle.studies.sweep.rows import Rows

PLAN = """\
world: model://rp2w
duration: 2
seed: 3
set: {models/rp2w/links/chassis/inertial/mass: mass + 0 * push}
vary:
  mass: {uniform: [1, 2]}
  push: {range: [10, 30, 10]}
  name: {values: [a, b, c], with: push}
"""


def _read(text: str):
    return read_plan(text, file="plan.yaml", folder=Path(__file__).parent)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("world: [", "plan.yaml:1: error: not YAML: line 1, column 9: expected"),
        ("", "plan.yaml:1: error: an empty file"),
        ("duration: 1", "plan.yaml:1: error: a plan needs either `world: …` or `launch: …`"),
        (f"world: {'a' * 5000}\nduration: 0", "plan.yaml:2: error: duration must be above 0, not 0"),
        ("world: a\nduration: soon", "plan.yaml:2: error: duration must be a number, not 'soon'"),
        ("world: a\nduration: 0", "plan.yaml:2: error: duration must be above 0, not 0"),
        ("world: a\nduration: 1\nduration: 2", "plan.yaml:3: error: 'duration' is here twice; keep one"),
        (PLAN + "repeat: 1.5", "plan.yaml:9: error: repeat must be a whole number of at least 1, not 1.5"),
        (PLAN + "seeds: [1]\nrepeat: 2", "plan.yaml:10: error: `seeds` has a run for each seed"),
        (PLAN + "  t: [1]", "plan.yaml:9: error: 't' is a column or name of every sweep; give another name"),
        (PLAN + "  a b: [1]", "plan.yaml:9: error: 'a b' is no name; give a path with /"),
        (PLAN + "  a: []", "plan.yaml:9: error: an empty list; give at least one value"),
        (PLAN + "  a: {normal: [0, 0]}", "plan.yaml:9: error: normal: the deviation must be above 0, not 0"),
        (PLAN + "  a: {log_uniform: [0, 1]}", "plan.yaml:9: error: log_uniform: needs 0 < low < high, not [0, 1]"),
        (PLAN + "  a: {range: [0, 1, -1]}", "plan.yaml:9: error: range: steps of -1 do not lead from 0 to 1"),
        (PLAN + "  a: {values: [1], with: push}", "plan.yaml:9: error: 'a' goes with 'push', which must be"),
        (PLAN + "measure: {x: '1 +'}", "plan.yaml:9: error: measure x: '1 +' is no expression: invalid syntax"),
        (PLAN + "measure:\n  x: {median: '1'}", "plan.yaml:10: error: measure x has no 'median'; it has: end"),
        (PLAN + "measure:\n  x: {function: a.py:f}", "plan.yaml:10: error: function: there is no file "),
        (PLAN + "measure:\n  mass: '1'", "plan.yaml:10: error: 'mass' varies already; name the measure otherwise"),
        (PLAN + "events: [{at: 1}]", "plan.yaml:9: error: an event needs `at: SECONDS` and either `push: MODEL/LINK`"),
        (PLAN + "events: [{at: 1, push: a/b, force: [1, 2]}]", "plan.yaml:9: error: force must be [x, y, z]"),
        (PLAN + "events: [{at: 1, push: a/b, speed: 1}]", "plan.yaml:9: error: an event has no 'speed'; it has: at"),
        (PLAN + "worlds: 1", "plan.yaml:9: error: a plan has no 'worlds'; it has: world, launch, duration"),
        (PLAN + "  frction: [1]", "plan.yaml:9: error: vary: nothing uses 'frction'; name it in `set`, `events`, "),
        (PLAN + "  timestep: [1]", "plan.yaml:9: error: vary: nothing uses 'timestep'; the nearest name is 'time_"),
        (PLAN + "  speeed: [1]\nstop: [abs(speed) > 1]", "plan.yaml:9: error: vary: nothing uses 'speeed'; the n"),
        (PLAN + "  a: {values: [1, 2, 3], with: push}", "plan.yaml:9: error: vary: nothing uses 'a'; name it in"),
        (PLAN + "  models/rp2w/links/chassis/inertial/mass: [1]", "plan.yaml:9: error: vary: `set` gives 'models/"),
        ("world: a\nduration: 1\nsamples: 9", "plan.yaml:3: error: `samples` needs a distribution in `vary`"),
    ],
)  # fmt: skip
def test_a_mistake_is_named_with_its_line(text: str, message: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        _read(text)
    assert str(caught.value).startswith(message)


def test_rows_combine_grids_and_samples_and_repetitions() -> None:
    rows = Rows(_read(PLAN + "samples: 4\nrepeat: 2"))

    assert len(rows) == 3 * 4 * 2
    assert [(rows.row(n).values["push"], rows.row(n).values["name"]) for n in (0, 7, 8, 16)] == [
        (10, "a"), (10, "a"), (20, "b"), (30, "c"),
    ]  # fmt: skip
    assert rows.row(4).values == rows.row(5).values
    assert rows.row(4).seed != rows.row(5).seed


@pytest.mark.parametrize("design", ["random", "latin_hypercube", "sobol"])
def test_a_row_is_determined_by_its_number(design: str) -> None:
    text = PLAN + f"samples: 50\ndesign: {design}"
    first, second = Rows(_read(text)), Rows(_read(text))

    assert [second.row(n) for n in reversed(range(150))] == list(first)[::-1]
    assert Rows(_read(text.replace("seed: 3", "seed: 4"))).row(7) != first.row(7)


def test_a_latin_hypercube_has_one_sample_in_each_slice() -> None:
    rows = Rows(_read(PLAN + "samples: 50\ndesign: latin_hypercube"))
    masses = sorted(float(str(rows.row(n).values["mass"])) for n in range(50))
    assert [int((mass - 1) * 50) for mass in masses] == list(range(50))


def test_distributions_have_their_moments() -> None:
    vary = "vary: {n: {normal: [5, 2]}, l: {log_uniform: [1e-2, 1e2]}}\nset: {gravity/z: n * l}"
    text = f"world: a\nduration: 1\nsamples: 4096\ndesign: sobol\n{vary}"
    rows = list(Rows(_read(text)))
    numbers = [float(str(row.values["n"])) for row in rows]
    mean = sum(numbers) / len(numbers)
    assert mean == pytest.approx(5, abs=0.02)
    assert sum((x - mean) ** 2 for x in numbers) / len(numbers) == pytest.approx(4, rel=0.02)
    assert sum(float(str(row.values["l"])) < 1 for row in rows) == pytest.approx(2048, abs=4)


def test_seeds_are_those_of_the_plan() -> None:
    rows = Rows(_read(PLAN + "seeds: [7, 9]"))
    assert [row.seed for row in rows] == [7, 9] * 3
