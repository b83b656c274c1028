"""Context menus of interactive markers."""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from visualization_msgs.msg import InteractiveMarkerFeedback, MenuEntry

import rospy

if TYPE_CHECKING:
    from .interactive_marker_server import InteractiveMarkerServer


class EntryContext:
    """Entry of a menu."""

    def __init__(
        self,
        title: str = "",
        command_type: int = 0,
        command: str = "",
        feedback_cb: Callable[[Any], object] | None = None,
    ) -> None:
        self.title = title
        self.command = command
        self.command_type = command_type
        self.sub_entries: list[int] = []
        self.visible = True
        self.check_state = MenuHandler.NO_CHECKBOX
        self.feedback_cb = feedback_cb


class MenuHandler:
    """Menu that several markers may share."""

    NO_CHECKBOX = 0
    CHECKED = 1
    UNCHECKED = 2

    def __init__(self) -> None:
        self.top_level_handles_: list[int] = []
        self.entry_contexts_: dict[int, EntryContext] = {}
        self.current_handle_ = 1
        self.managed_markers_: set[str] = set()

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = MenuEntry.FEEDBACK,
        command: str = "",
        callback: Callable[[Any], object] | None = None,
    ) -> int | None:
        """Add an entry and return its handle; None if there is no such parent.

        Args:
            title: entry's text.
            parent: parent entry's handle; None: top level.
            command_type: rviz's action on a click; default: feedback.
            command: arguments for rosrun and roslaunch.
            callback: called with the InteractiveMarkerFeedback of a click.
        """
        if parent is not None and parent not in self.entry_contexts_:
            rospy.logerr(f"menu entry '{title}': no parent with the handle {parent}")
            return None
        handle = self.doInsert(title, command_type, command, callback)
        siblings = self.top_level_handles_ if parent is None else self.entry_contexts_[parent].sub_entries
        siblings.append(handle)
        return handle

    def setVisible(self, handle: int, visible: bool) -> bool:
        """Show or hide an entry; False if there is no such entry."""
        return self._set(handle, "visible", visible)

    def setCheckState(self, handle: int, check_state: int) -> bool:
        """Set an entry's check box: NO_CHECKBOX, CHECKED or UNCHECKED; False if there is no such entry."""
        return self._set(handle, "check_state", check_state)

    def getCheckState(self, handle: int) -> int | None:
        """State of an entry's check box; None if there is no such entry."""
        return self.entry_contexts_[handle].check_state if handle in self.entry_contexts_ else None

    def getTitle(self, handle: int) -> str | None:
        """Text of an entry; None if there is no such entry."""
        return self.entry_contexts_[handle].title if handle in self.entry_contexts_ else None

    def apply(self, server: "InteractiveMarkerServer", marker_name: str) -> bool:
        """Set a marker's menu to this one; False if there is no such marker."""
        marker = server.get(marker_name)
        if not marker:
            self.managed_markers_.discard(marker_name)
            return False
        marker.menu_entries = []
        self.pushMenuEntries(self.top_level_handles_, marker.menu_entries, 0)
        server.insert(marker, self.processFeedback, InteractiveMarkerFeedback.MENU_SELECT)
        self.managed_markers_.add(marker_name)
        return True

    def reApply(self, server: "InteractiveMarkerServer") -> bool:
        """Update the menu of all its markers; False if a marker no longer exists."""
        return not [name for name in list(self.managed_markers_) if not self.apply(server, name)]

    def processFeedback(self, feedback: Any) -> None:
        """Handle a click."""
        entry = self.entry_contexts_.get(feedback.menu_entry_id)
        if entry is not None and entry.feedback_cb:
            entry.feedback_cb(feedback)

    def pushMenuEntries(self, handles_in: Iterable[int], entries_out: list[Any], parent_handle: int) -> bool:
        """Append the MenuEntry messages of visible entries and their descendants; always True."""
        for handle in handles_in:
            entry = self.entry_contexts_[handle]
            if entry.visible:
                entries_out.append(self.makeEntry(entry, handle, parent_handle))
                self.pushMenuEntries(entry.sub_entries, entries_out, handle)
        return True

    def makeEntry(self, context: EntryContext, handle: int, parent_handle: int) -> Any:
        """MenuEntry message of an entry."""
        check_box = {self.CHECKED: "[x] ", self.UNCHECKED: "[ ] "}.get(context.check_state, "")
        return MenuEntry(
            id=handle,
            parent_id=parent_handle,
            title=check_box + context.title,
            command=context.command,
            command_type=context.command_type,
        )

    def doInsert(self, title: str, command_type: int, command: str, feedback_cb: Callable[[Any], object] | None) -> int:
        """Create an entry outside of any menu; returns its handle."""
        handle = self.current_handle_
        self.current_handle_ += 1
        self.entry_contexts_[handle] = EntryContext(title, command_type, command, feedback_cb)
        return handle

    def _set(self, handle: int, attribute: str, value: object) -> bool:
        if handle not in self.entry_contexts_:
            return False
        setattr(self.entry_contexts_[handle], attribute, value)
        return True
