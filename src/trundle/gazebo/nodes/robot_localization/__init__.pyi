from .ekf import EkfLocalization as EkfLocalization, UkfLocalization as UkfLocalization
