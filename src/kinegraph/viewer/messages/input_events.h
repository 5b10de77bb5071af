#pragma once

#include <deque>
#include <string>
#include <vector>

#include "kinegraph/viewer/messages/commands.h"

namespace kinegraph::inline viewer_internal {

/// Returns the reference's name of a mouse or keyboard event: "click down left", "key up a", "scroll up", "mod shift"
/// (the pressed modifiers from now on; "mod" alone: none). Returns an empty name for an unknown event.
std::string eventName(const EventCommand& event);

/// A queue of the last 1000 events.
class InputEvents {
 public:
  void add(const EventCommand& event);
  std::vector<std::string> take();  ///< returns the events and clears the queue

 private:
  std::deque<std::string> names_;
};

}  // namespace kinegraph::inline viewer_internal
