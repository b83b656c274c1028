"""Document that a browser without a token gets in place of the page; it asks for the link."""

from trundle.base.http.html_policy import inline_hash

_STYLE = """
:root { color-scheme: light dark }
body { font: 16px/1.5 system-ui, sans-serif; margin: 0; padding: 12vh 24px 24px; color: #1b1f23; background: #f6f7f8 }
main { max-width: 34em; margin: 0 auto }
h1 { font-size: 22px; line-height: 1.3; margin: 0 0 12px }
p { margin: 0 0 12px }
a { color: inherit }
code { font: 14px/1.5 ui-monospace, monospace; overflow-wrap: anywhere; padding: 1px 5px; border-radius: 4px;
  background: #e6e9ec }
@media (prefers-color-scheme: dark) {
  body { color: #e4e7ea; background: #16191c }
  code { background: #2a2f35 }
}
"""
LINK_REQUEST = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Trundle</title>
<style>{_STYLE}</style>
</head>
<body>
<main>
<h1>This page opens with its link</h1>
<p>It can drive the robot and change the world, so it asks for the link that Trundle printed when it started:
<code>see it at http://…/?token=…</code></p>
<p>To print the link again, run this on the machine where Trundle runs, as the user who started it:</p>
<p><code>trundle page link</code></p>
<p>Was it open in this browser already? <a href="/">Open it again</a></p>
</main>
</body>
</html>
"""
POLICY = (
    f"default-src 'none'; style-src {inline_hash(_STYLE)}; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
)
"""Content security policy of the document."""
