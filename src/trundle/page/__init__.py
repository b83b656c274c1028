"""Browser page: a server process for the Foxglove protocol, and the interface of the process that owns it.

page = PageServer.start(Session(title="rp2w", kind="simulation"))
page.set_world(manifest, files)
while True:
    page.put_poses(time_ns, poses)
    for request in page.requests(): …
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
