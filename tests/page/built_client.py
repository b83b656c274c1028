"""The mark of tests that open the built client."""

import pytest

from trundle.page.http.client_files import CLIENT

needs_client = pytest.mark.skipif(not (CLIENT / "index.html").is_file(), reason="the page's client is not built: make")
