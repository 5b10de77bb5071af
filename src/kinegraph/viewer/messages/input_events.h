#pragma once

#include <deque>
#include <string>
#include <vector>

#include "kinegraph/viewer/messages/commands.h"

namespace kinegraph {

/// What people do with mouse and keyboard on a page, as the reference names it: "click down left", "key up a", "scroll
/// up", "mod shift" (the modifiers that are held from now on; "mod" alone: none). Empty for what is none of these.
std::string eventName(const EventCommand& event);

/// The last 1000 events.
class InputEvents {
 public:
  void add(const EventCommand& event);
  std::vector<std::string> take();  ///< and forgets them

 private:
  std::deque<std::string> names_;
};

}  // namespace kinegraph
