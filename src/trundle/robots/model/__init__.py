"""World, Model, Link, Joint, …: frozen structs with SDF's meaning; all readers make them, and all consumers start from
them.

Names are imported on first use: a robot of boxes loads no cameras.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
