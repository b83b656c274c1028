"""Context menus of interactive markers."""

from visualization_msgs.msg import InteractiveMarkerFeedback, MenuEntry

import rospy


class EntryContext:
    """One entry of a menu."""

    def __init__(self, title="", command_type=0, command="", feedback_cb=None):
        self.title = title
        self.command = command
        self.command_type = command_type
        self.sub_entries = []
        self.visible = True
        self.check_state = MenuHandler.NO_CHECKBOX
        self.feedback_cb = feedback_cb


class MenuHandler:
    """A menu, which several markers may share."""

    NO_CHECKBOX = 0
    CHECKED = 1
    UNCHECKED = 2

    def __init__(self):
        self.top_level_handles_ = []
        self.entry_contexts_ = {}
        self.current_handle_ = 1
        self.managed_markers_ = set()

    def insert(self, title, parent=None, command_type=MenuEntry.FEEDBACK, command="", callback=None):
        """Add an entry and return its handle; None if there is no such parent.

        Args:
            title: its text.
            parent: handle of the entry it is below.
            command_type: what rviz does on a click; by default it sends feedback.
            command: for rosrun and roslaunch.
            callback: called with the InteractiveMarkerFeedback of a click.
        """
        if parent is not None and parent not in self.entry_contexts_:
            rospy.logerr(f"menu entry '{title}': no parent with the handle {parent}")
            return None
        handle = self.doInsert(title, command_type, command, callback)
        siblings = self.top_level_handles_ if parent is None else self.entry_contexts_[parent].sub_entries
        siblings.append(handle)
        return handle

    def setVisible(self, handle, visible):
        """Show or hide an entry; False if there is no such."""
        return self._set(handle, "visible", visible)

    def setCheckState(self, handle, check_state):
        """Set an entry's box: NO_CHECKBOX, CHECKED or UNCHECKED; False if there is no such entry."""
        return self._set(handle, "check_state", check_state)

    def getCheckState(self, handle):
        """State of an entry's box; None if there is no such entry."""
        return self.entry_contexts_[handle].check_state if handle in self.entry_contexts_ else None

    def getTitle(self, handle):
        """Text of an entry; None if there is no such."""
        return self.entry_contexts_[handle].title if handle in self.entry_contexts_ else None

    def apply(self, server, marker_name):
        """Give a marker this menu; False if there is no such marker."""
        marker = server.get(marker_name)
        if not marker:
            self.managed_markers_.discard(marker_name)
            return False
        marker.menu_entries = []
        self.pushMenuEntries(self.top_level_handles_, marker.menu_entries, 0)
        server.insert(marker, self.processFeedback, InteractiveMarkerFeedback.MENU_SELECT)
        self.managed_markers_.add(marker_name)
        return True

    def reApply(self, server):
        """Give all its markers the menu as it is now; False if one is gone."""
        return not [name for name in list(self.managed_markers_) if not self.apply(server, name)]

    def processFeedback(self, feedback):
        """Take a click."""
        entry = self.entry_contexts_.get(feedback.menu_entry_id)
        if entry is not None and entry.feedback_cb:
            entry.feedback_cb(feedback)

    def pushMenuEntries(self, handles_in, entries_out, parent_handle):
        """Append the MenuEntry messages of visible entries and those below them; always True."""
        for handle in handles_in:
            entry = self.entry_contexts_[handle]
            if entry.visible:
                entries_out.append(self.makeEntry(entry, handle, parent_handle))
                self.pushMenuEntries(entry.sub_entries, entries_out, handle)
        return True

    def makeEntry(self, context, handle, parent_handle):
        """MenuEntry message of an entry."""
        box = {self.CHECKED: "[x] ", self.UNCHECKED: "[ ] "}.get(context.check_state, "")
        return MenuEntry(
            id=handle,
            parent_id=parent_handle,
            title=box + context.title,
            command=context.command,
            command_type=context.command_type,
        )

    def doInsert(self, title, command_type, command, feedback_cb):
        """Make an entry that is in no menu yet; returns its handle."""
        handle = self.current_handle_
        self.current_handle_ += 1
        self.entry_contexts_[handle] = EntryContext(title, command_type, command, feedback_cb)
        return handle

    def _set(self, handle, attribute, value):
        if handle not in self.entry_contexts_:
            return False
        setattr(self.entry_contexts_[handle], attribute, value)
        return True
