"""`trundle sweep report`: a self-contained HTML file."""

from collections import Counter
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.http.html_policy import policy_of_document
from trundle.studies.plan_files.lock import lock_folder

from .analysis import numbers, rank_correlation, worst_rows
from .plan import Plan
from .report_charts import breakable, correlation_bars, histogram, scatter
from .report_pictures import end_picture
from .report_style import STYLE
from .row_runner import RowRunner, runner_of
from .rows import Rows
from .run_sweep import open_results, results_folder

_WORST = 6
_REASONS = 8


def write_report(plan: Plan, *, output: Path | None = None) -> Path:
    """Write the report of a plan's results, `report.html` in their folder; return its path.

    Args:
        plan: plan of the sweep.
        output: folder of the results; None: next to the plan.

    Raises:
        UsageError: the plan has no results.
    """
    folder, rows = results_folder(plan, output), Rows(plan)
    if not folder.is_dir():
        raise UsageError(f"{folder}: no results; run `trundle sweep {plan.file}` first")
    with lock_folder(folder):
        table = open_results(plan, rows, folder, runner_of(plan)).read()
    if not table.num_rows:
        raise UsageError(f"{folder}: no run has finished yet; run `trundle sweep {plan.file}` to continue")
    path = folder / "report.html"
    write_atomically(path, _Report(plan, rows, table).html())
    return path


class _Report:
    def __init__(self, plan: Plan, rows: Rows, table: Any) -> None:
        self._plan = plan
        self._rows = rows
        self._table = table
        self._measures = {measure.name: numbers(table[measure.name]) for measure in plan.measures}
        self._is_ok: NDArray[np.bool_] = np.array(
            [status == "ok" for status in table["status"].to_pylist()], dtype=bool
        )

    def html(self) -> str:
        name = escape(Path(self._plan.file).name)
        parts = [self._summary(), self._distributions(), self._importance(), self._worst()]
        head = (
            f'<meta charset="utf-8">{policy_of_document()}<meta name="viewport" content="width=device-width">'
            f"<title>{name}</title>"
        )
        body = f"<head>{head}<style>{STYLE}</style></head><body>{''.join(parts)}</body>"
        return f'<!doctype html><html lang="en">{body}</html>'

    def _summary(self) -> str:
        counts = Counter(self._table["status"].to_pylist())
        cards = "".join(f'<li class="{status}"><b>{count}</b> {status}</li>' for status, count in counts.most_common())
        reasons = Counter(reason.partition(":")[0] if reason.startswith("not ") else reason
                          for reason in self._table["reason"].to_pylist() if reason)  # fmt: skip
        listed = "".join(
            f"<tr><td>{count}</td><td>{escape(reason)}</td></tr>" for reason, count in reasons.most_common(_REASONS)
        )
        done, total = self._table.num_rows, len(self._rows)
        of = f"{done} runs" if done == total else f"{done} of {total} runs so far"
        world = escape(Path(self._plan.world).name or self._plan.world)
        summary = f"{of} of {self._plan.duration_s:g} s of {world}, seed {self._plan.seed}"
        table = f"<table class='reasons'><tr><th>runs</th><th>reason</th></tr>{listed}</table>" if listed else ""
        return f'<h1>{escape(Path(self._plan.file).name)}</h1><p>{summary}</p><ul class="counts">{cards}</ul>{table}'

    def _distributions(self) -> str:
        charts = "".join(
            f"<figure><figcaption>{escape(name)}{_spread(values)}</figcaption>{histogram(values, self._is_ok)}</figure>"
            for name, values in self._measures.items()
            if values is not None
        )
        return f'<h2>Distributions</h2><div class="grid">{charts}</div>' if charts else ""

    def _importance(self) -> str:
        varied = [variation.name for variation in self._plan.vary]
        targets = {name: values for name, values in self._measures.items() if values is not None}
        if not self._is_ok.all() and self._is_ok.any():
            targets = {"ok": self._is_ok.astype(float), **targets}
        sections: list[str] = []
        for target, values in targets.items():
            correlations = [(name, rank_correlation(self._table[name], values)) for name in varied]
            strengths = [(abs(value), name) for name, value in correlations if value is not None]
            if not strengths:
                continue
            drawn = "" if target == "ok" else self._drawn_over(max(strengths)[1], target, values)
            bars = correlation_bars(correlations)
            sections.append(f"<figure><figcaption>{escape(target)}</figcaption>{bars}{drawn}</figure>")
        if not sections:
            return ""
        intro = (
            "Spearman rank correlation of each varied value with each measure. "
            "±1: the measure only ever rises or falls with the value; 0: no trend."
        )
        return f'<h2>What matters</h2><p>{intro}</p><div class="grid">{"".join(sections)}</div>'

    def _drawn_over(self, varied: str, target: str, values: NDArray[np.float64]) -> str:
        """Draw a measure over its most influential varied value, unless that is text."""
        over = numbers(self._table[varied])
        if over is None:
            return ""
        variation = next(candidate for candidate in self._plan.vary if candidate.name == varied)
        is_log = variation.distribution is not None and variation.distribution.kind == "log_uniform"
        caption = f"{breakable(target)} over {breakable(varied)}{' (logarithmic)' if is_log else ''}"
        return f"<p>{caption}</p>{scatter(over, values, self._is_ok, is_log=is_log)}"

    def _worst(self) -> str:
        runner = runner_of(self._plan)
        index = {row: i for i, row in enumerate(self._table["row"].to_pylist())}
        cards: list[str] = []
        for number in worst_rows(self._table, list(self._measures), _WORST):
            row, record = self._rows.row(number), self._table.slice(index[number], 1).to_pylist()[0]
            picture = None
            if isinstance(runner, RowRunner) and record["status"] in ("ok", "failed", "error"):
                picture = end_picture(self._plan, runner, row)
            image = f'<img src="{picture}" alt="row {number} at its end">' if picture else ""
            values = {name: record[name] for name in (*row.values, *self._measures)}
            cells = "".join(
                f"<tr><th>{breakable(name)}</th><td>{_text(value)}</td></tr>" for name, value in values.items()
            )
            reason = escape(record["reason"] or record["status"])
            again = f"<code>trundle sweep {escape(Path(self._plan.file).name)} --row {number}</code>"
            caption = f'<figcaption>row {number}: <span class="{record["status"]}">{reason}</span></figcaption>'
            cards.append(f"<figure>{caption}{image}<table>{cells}</table>{again}</figure>")
        intro = "Runs that are not ok first; among those, the ones farthest from the median of a measure."
        return f'<h2>Worst runs</h2><p>{intro}</p><div class="grid">{"".join(cards)}</div>'


def _spread(values: NDArray[np.float64]) -> str:
    finite = values[np.isfinite(values)]
    if not len(finite):
        return ""
    low, middle, high = np.percentile(finite, [5, 50, 95]).tolist()
    return f"<small>median {middle:.4g}, 90 % from {low:.4g} to {high:.4g}</small>"


def _text(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else "–" if value is None else escape(str(value))
