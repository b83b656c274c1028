"""Targets of `make fuzz`: seeds are read, mutated inputs are read or refused; findings are recorded."""

import contextlib
import json
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest
from fuzz.campaign import Campaign
from fuzz.catalog import TARGETS, load_target
from fuzz.mutate import Pool, mutate
from hypothesis import given, settings, strategies as st

from trundle.base.diagnostics import TrundleError

SERVERS = [name for name, family in TARGETS.items() if family in ("graph", "navigation", "web")]
FILES = [name for name in TARGETS if name not in SERVERS]
FAULTY = """
import sys
from contextlib import contextmanager
import fuzz.catalog, fuzz.worker
from fuzz.target import Target

def execute(data):
    if b"raise" in data:
        raise KeyError("no such key")
    if b"print" in data:
        print("x.py:1: RuntimeWarning: overflow", file=sys.stderr)
    if b"start" in data:
        import subprocess
        subprocess.run(["true"])
    if b"exit" in data:
        sys.exit(3)

@contextmanager
def opened(folder):
    yield execute

fuzz.catalog.load_target = lambda _: Target(open=opened, seeds=lambda: [b""])
fuzz.worker.main()
"""


@pytest.fixture(autouse=True)
def _isolated_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "open").mkdir()


@pytest.mark.parametrize("name", FILES)
def test_readers_accept_their_seeds(tmp_path: Path, name: str) -> None:
    target = load_target(name)

    with target.open(tmp_path / "open") as execute:
        for seed in target.seeds():
            execute(seed)


@pytest.mark.parametrize("name", FILES)
def test_readers_accept_or_refuse_mutated_files(tmp_path: Path, name: str) -> None:
    target = load_target(name)
    pool = Pool(target.words, target.seeds())

    with target.open(tmp_path / "open") as execute:

        @settings(max_examples=30)
        @given(source=st.randoms(use_true_random=False))
        def feed(source: Random) -> None:
            with contextlib.suppress(TrundleError):
                execute(mutate(source.choice(pool.inputs), pool, source))

        feed()


@pytest.mark.slow
@pytest.mark.parametrize("name", SERVERS)
def test_servers_withstand_seeds_and_mutations(tmp_path: Path, name: str) -> None:
    with Campaign(tmp_path, None, {}) as campaign:
        campaign.run([name], 3.0, 1)

    assert campaign.found == {}
    assert json.loads((tmp_path / "summary.json").read_text())[name]["executions"] >= len(load_target(name).seeds())


@pytest.mark.slow
def test_the_summary_accumulates_over_runs(tmp_path: Path) -> None:
    for runs in (1, 2):
        with Campaign(tmp_path, None, {}) as campaign:
            campaign.run(["state-log", "map"], 4.0, 2)

        summary = json.loads((tmp_path / "summary.json").read_text())
        assert campaign.found == {}
        assert all(summary[name]["executions"] > runs for name in ("state-log", "map"))
        assert all(summary[name]["findings"] == [] for name in ("state-log", "map"))
        assert summary["map"]["hours"] > 0.0


@pytest.mark.parametrize(
    ("data", "summary"),
    [
        (b"raise", "faulty: KeyError: 'no such key'"),
        (b"print", "faulty: printed: x.py:1: RuntimeWarning: overflow"),
        (b"start", "faulty: ForbiddenError: subprocess.Popen "),
        (b"exit", "faulty: SystemExit: 3"),
        (b"all is well", None),
    ],
)
def test_a_fault_is_recorded_with_its_input(tmp_path: Path, data: bytes, summary: str | None) -> None:
    (tmp_path / "input").write_bytes(data)
    options = ["--findings", str(tmp_path / "findings"), "--corpus", str(tmp_path), "--input", str(tmp_path / "input")]
    (tmp_path / "open").rmdir()
    with (tmp_path / "printed").open("wb") as printed:
        command = [sys.executable, "-c", FAULTY, "faulty", str(tmp_path), *options]
        subprocess.run(command, stderr=printed, check=True, cwd=Path(__file__).parents[1])

    folders = sorted((tmp_path / "findings").glob("*")) if summary else []
    assert len(folders) == (summary is not None)
    for folder in folders:
        report = (folder / "report.txt").read_text()
        assert report.startswith(summary or "")
        assert f"-m fuzz faulty --input {folder}/input" in report
        assert (folder / "input").read_bytes() == data


def test_mutations_are_bounded_and_mostly_change_the_input() -> None:
    pool = Pool((b"word",), [b"<a><b c='1'>text</b></a>" * 3, bytes(range(60))])
    mutated = [mutate(pool.inputs[seed % 2], pool, Random(seed)) for seed in range(500)]

    assert sum(data in pool.inputs for data in mutated) < 50
    assert max(map(len, mutated)) < 100_000
    assert len(set(mutated)) > 350
