from .fake_localization import FakeLocalization as FakeLocalization
