from .ekf import EkfLocalization as EkfLocalization
