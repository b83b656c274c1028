import pytest


@pytest.fixture(autouse=True)
def _no_reconfigure(monkeypatch: pytest.MonkeyPatch) -> None:
    for planner in ("teb_planner", "eband_planner"):
        monkeypatch.setattr(f"trundle.navigation.planners.elastic_bands.{planner}.reconfigure", lambda *_: None)
