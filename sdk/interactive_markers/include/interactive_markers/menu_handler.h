#pragma once

#include <map>
#include <string>
#include <vector>

#include "interactive_markers/interactive_marker_server.h"

namespace interactive_markers {

/** Menu of interactive markers. */
class MenuHandler {
 public:
  typedef uint32_t EntryHandle;
  typedef InteractiveMarkerServer::FeedbackConstPtr FeedbackConstPtr;
  typedef InteractiveMarkerServer::FeedbackCallback FeedbackCallback;
  enum CheckState { NO_CHECKBOX, CHECKED, UNCHECKED };

  EntryHandle insert(const std::string& title, const FeedbackCallback& feedback_cb) {
    return add(0, title, visualization_msgs::MenuEntry::FEEDBACK, "", feedback_cb);
  }
  EntryHandle insert(const std::string& title, const uint8_t command_type = visualization_msgs::MenuEntry::FEEDBACK,
                     const std::string& command = "") {
    return add(0, title, command_type, command, FeedbackCallback());
  }
  EntryHandle insert(EntryHandle parent, const std::string& title, const FeedbackCallback& feedback_cb) {
    return add(parent, title, visualization_msgs::MenuEntry::FEEDBACK, "", feedback_cb);
  }
  EntryHandle insert(EntryHandle parent, const std::string& title,
                     const uint8_t command_type = visualization_msgs::MenuEntry::FEEDBACK,
                     const std::string& command = "") {
    return add(parent, title, command_type, command, FeedbackCallback());
  }
  /** Hide or show an entry with those below it; apply() it then. */
  bool setVisible(EntryHandle handle, bool visible);
  bool setCheckState(EntryHandle handle, CheckState check_state);
  bool getCheckState(EntryHandle handle, CheckState& check_state) const;
  bool getTitle(EntryHandle handle, std::string& title) const;
  /** Give a marker this menu; false if there is no such marker. */
  bool apply(InteractiveMarkerServer& server, const std::string& marker_name);
  /** Give it anew to all markers that have it. */
  bool reApply(InteractiveMarkerServer& server);

 private:
  struct Entry {
    EntryHandle parent;
    std::string title, command;
    uint8_t command_type;
    FeedbackCallback callback;
    bool is_visible;
    CheckState check;
  };
  EntryHandle add(EntryHandle parent, const std::string& title, uint8_t command_type, const std::string& command,
                  const FeedbackCallback& callback);
  bool isShown(EntryHandle handle) const;

  std::map<EntryHandle, Entry> entries_;
  std::vector<std::string> managed_;
};

}  // namespace interactive_markers
