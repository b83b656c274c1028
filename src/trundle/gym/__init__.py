"""Gymnasium environments: reinforcement learning in the world of any description.

Importing it registers the built-in environments, `Trundle/CartPole-v0` and others, with Gymnasium.
"""

import lazy_loader

try:
    import gymnasium as _gymnasium
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "trundle.gym needs the package 'gymnasium': pip install 'trundle[gym]'", name="gymnasium"
    ) from error

from .registration import register_environments

register_environments(_gymnasium.register)

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
