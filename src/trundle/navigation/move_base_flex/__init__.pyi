from .legacy_relay import LegacyRelay as LegacyRelay
from .node import MbfCostmapNav as MbfCostmapNav
