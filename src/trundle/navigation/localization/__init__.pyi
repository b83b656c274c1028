from .amcl import Amcl as Amcl
from .fake_localization import FakeLocalization as FakeLocalization
