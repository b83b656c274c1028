from .complementary import ImuComplementaryFilter as ImuComplementaryFilter
from .madgwick import ImuFilterMadgwick as ImuFilterMadgwick
