from .ekf import EkfLocalization as EkfLocalization, UkfLocalization as UkfLocalization
from .navsat_transform import NavsatTransform as NavsatTransform
