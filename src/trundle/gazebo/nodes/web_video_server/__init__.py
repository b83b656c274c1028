"""web_video_server: image topics as MJPEG streams and snapshots for web pages."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
