#include "interactive_markers/menu_handler.h"

#include <algorithm>

namespace interactive_markers {

MenuHandler::EntryHandle MenuHandler::add(EntryHandle parent, const std::string& title, uint8_t command_type,
                                          const std::string& command, const FeedbackCallback& callback) {
  if (parent != 0 && !entries_.count(parent)) {
    ROS_ERROR("Parent menu entry %u not found.", parent);
    return 0;
  }
  const EntryHandle handle = static_cast<EntryHandle>(entries_.size()) + 1;
  entries_[handle] = Entry{parent, title, command, command_type, callback, true, NO_CHECKBOX};
  return handle;
}

bool MenuHandler::setVisible(EntryHandle handle, bool visible) {
  const auto found = entries_.find(handle);
  if (found == entries_.end()) return false;
  found->second.is_visible = visible;
  return true;
}

bool MenuHandler::setCheckState(EntryHandle handle, CheckState check_state) {
  const auto found = entries_.find(handle);
  if (found == entries_.end()) return false;
  found->second.check = check_state;
  return true;
}

bool MenuHandler::getCheckState(EntryHandle handle, CheckState& check_state) const {
  const auto found = entries_.find(handle);
  check_state = found == entries_.end() ? NO_CHECKBOX : found->second.check;
  return found != entries_.end();
}

bool MenuHandler::getTitle(EntryHandle handle, std::string& title) const {
  const auto found = entries_.find(handle);
  if (found == entries_.end()) return false;
  title = found->second.title;
  return true;
}

bool MenuHandler::isShown(EntryHandle handle) const {
  for (; handle != 0; handle = entries_.at(handle).parent)
    if (!entries_.at(handle).is_visible) return false;
  return true;
}

bool MenuHandler::apply(InteractiveMarkerServer& server, const std::string& marker_name) {
  visualization_msgs::InteractiveMarker marker;
  if (!server.get(marker_name, marker)) {
    managed_.erase(std::remove(managed_.begin(), managed_.end(), marker_name), managed_.end());
    return false;
  }
  marker.menu_entries.clear();
  for (const auto& entry : entries_) {
    if (!isShown(entry.first)) continue;
    visualization_msgs::MenuEntry shown;
    shown.id = entry.first;
    shown.parent_id = entry.second.parent;
    const char* const box = entry.second.check == CHECKED ? "[x] " : entry.second.check == UNCHECKED ? "[ ] " : "";
    shown.title = box + entry.second.title;
    shown.command = entry.second.command;
    shown.command_type = entry.second.command_type;
    marker.menu_entries.push_back(shown);
  }
  server.insert(marker);
  server.setCallback(
      marker_name,
      [this](const FeedbackConstPtr& feedback) {
        const auto found = entries_.find(feedback->menu_entry_id);
        const FeedbackCallback callback = found == entries_.end() ? FeedbackCallback() : found->second.callback;
        if (callback) callback(feedback);
      },
      visualization_msgs::InteractiveMarkerFeedback::MENU_SELECT);
  if (std::find(managed_.begin(), managed_.end(), marker_name) == managed_.end()) managed_.push_back(marker_name);
  return true;
}

bool MenuHandler::reApply(InteractiveMarkerServer& server) {
  bool is_complete = true;
  for (const std::string& name : std::vector<std::string>(managed_)) is_complete = apply(server, name) && is_complete;
  return is_complete;
}

}  // namespace interactive_markers
