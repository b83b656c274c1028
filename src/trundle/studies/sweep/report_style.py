"""Style sheet of a sweep's report."""

STYLE = """
:root { color-scheme: light dark; --ground: #fff; --ink: #1c2126; --soft: #5b6670; --line: #d5dade; --ok: #3b7dbd;
  --bad: #d1492e; --card: #f6f7f8 }
@media (prefers-color-scheme: dark) { :root { --ground: #16191c; --ink: #e4e8eb; --soft: #9aa5ae; --line: #363d43;
  --ok: #5fa3e0; --bad: #f0755b; --card: #1e2226 } }
* { box-sizing: border-box }
body { margin: 0 auto; max-width: 1240px; padding: 24px 16px 64px; background: var(--ground); color: var(--ink);
  font: 15px/1.5 system-ui, sans-serif; overflow-wrap: break-word }
h1 { font-size: 24px; margin: 0 } h2 { font-size: 18px; margin: 40px 0 4px }
p { margin: 4px 0 16px; color: var(--soft) }
.counts { display: flex; flex-wrap: wrap; gap: 8px; padding: 0; list-style: none }
.counts li { padding: 6px 14px; border-radius: 6px; background: var(--card); border-left: 4px solid var(--bad) }
.counts li.ok { border-color: var(--ok) }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); gap: 16px;
  align-items: start }
figure { margin: 0; padding: 12px; background: var(--card); border-radius: 8px; min-width: 0 }
figcaption { font-weight: 600; margin-bottom: 8px }
figcaption small { display: block; font-weight: 400; color: var(--soft) }
figcaption span { font-weight: 400; color: var(--bad) } figcaption span.ok { color: var(--soft) }
svg, img { display: block; width: 100%; height: auto } img { border-radius: 4px; margin-bottom: 8px }
svg .ok { fill: var(--ok) } svg .bad { fill: var(--bad) } svg circle { opacity: 0.6 }
svg line { stroke: var(--soft) } svg .level { stroke: var(--line) }
figure p { margin: 12px 0 4px; font-size: 13px } svg text { font-size: 11px; fill: var(--soft) }
table { border-collapse: collapse; width: 100%; font-size: 13px }
td, th { text-align: left; font-weight: 400; padding: 2px 8px 2px 0; vertical-align: top;
  border-bottom: 1px solid var(--line) }
td { font-variant-numeric: tabular-nums } figure td:last-child { text-align: right; white-space: nowrap }
.reasons th:first-child { width: 60px }
.correlations { margin-bottom: 8px } .correlations td:nth-child(2) { width: 45% }
.bar { position: relative; display: block; height: 12px; margin-top: 4px;
  background: linear-gradient(var(--line), var(--line)) center / 1px 100% no-repeat }
.bar i { position: absolute; top: 0; bottom: 0; background: var(--ok) }
code { display: block; margin-top: 8px; font-size: 12px; color: var(--soft) }
"""
