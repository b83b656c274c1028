"""Recording that the page is compared with: a state log with the world, by the owner; a bag with the topics, here."""

import asyncio
import os
from collections.abc import Mapping
from pathlib import Path

from trundle.base.diagnostics import TrundleError
from trundle.ros import is_bag

from .bag.reference import BagReference
from .clients.hub import Hub
from .owner import Owner
from .requests.request import ClientAction, Compare, SetReferenceOffset, StopComparing
from .wire import BagReferenceFile
from .world.channels import StreamChannel

_CONDITION = "reference"


class ComparedRecording:
    """At most one recording at a time; used on the loop only."""

    def __init__(
        self,
        hub: Hub,
        owner: Owner,
        differences: StreamChannel,
        *,
        has_world: bool,
        has_topics: bool,
        bag_start_s: float | None,
    ) -> None:
        """Create it without a recording.

        Args:
            hub: channels of the topics.
            owner: compares state logs.
            differences: channel of the differences.
            has_world: whether the page shows a world.
            has_topics: whether the page has topics.
            bag_start_s: start of the bag that the page plays [s]; None: it plays none.
        """
        self._hub = hub
        self._owner = owner
        self._bag = BagReference(hub, differences)
        hub.polled.append(self._bag)
        self._has_world = has_world
        self._has_topics = has_topics
        self._bag_start_s = bag_start_s

    @property
    def files(self) -> Mapping[str, bytes]:
        """Files that draw the bag's robot, by URL."""
        return self._bag.files if self._bag.is_open else {}

    async def open_first(self, bag: BagReferenceFile) -> None:
        """Compare with the bag that the owner named at the start; the page says how that goes."""
        self._hub.set_condition(_CONDITION, f"{bag.title} is being read")
        reason = await self._open_bag(bag.file, bag.title)
        self._hub.set_condition(_CONDITION, None if reason is None else f"{bag.title} is not compared: {reason}")

    async def open(self, action: Compare) -> str | None:
        """Compare with a state log or a bag; return the reason if it cannot be compared."""
        file = Path(os.fsdecode(action.file))
        try:
            found_bag = await asyncio.to_thread(is_bag, file)
        except TrundleError as error:
            return str(error)
        if not found_bag:
            return await self._open_log(action)
        if not self._has_topics:
            return f"{action.title} is a bag, and this page has no topics to compare with it"
        reason = await self._open_bag(file, action.title)
        if reason is None and self._has_world:
            await self._owner.compare(StopComparing())
        return reason

    async def _open_log(self, action: Compare) -> str | None:
        if not self._has_world:
            return f"{action.title}: topics can only be compared with a bag"
        reason = await self._owner.compare(action)
        if reason is None:
            self._bag.close()
        return reason

    async def _open_bag(self, file: Path, title: str) -> str | None:
        try:
            await self._bag.open(file, title, start=self._bag_start_s)
        except (TrundleError, OSError) as error:
            return str(error)
        return None

    def handle(self, action: ClientAction) -> bool:
        """Shift or close the bag as a client asks; return False if that is not what it asks, or there is none."""
        if not self._bag.is_open:
            return False
        match action:
            case SetReferenceOffset(offset):
                self._bag.set_offset(offset)
            case StopComparing():
                self._bag.close()
            case _:
                return False
        return True
