#include "kinegraph/viewer/messages/input_events.h"

#include "kinegraph/common/text.h"

namespace kinegraph::inline viewer_internal {

namespace {

enum What { keyDown = 1, keyUp, clickDown, clickUp, scroll, modifier };

std::string keyName(int code) {
  switch (code) {
    case 27:
      return "esc";
    case 13:
      return "enter";
    case 32:
      return "space";
    case 259:
      return "backspace";
    case 9:
      return "tab";
    default:
      return code > 32 && code < 127 ? std::string(1, char(code)) : std::to_string(code);
  }
}

std::string modifierNames(int held) {
  std::string names = "mod";
  if (held & 1) names += " shift";
  if (held & 2) names += " ctrl";
  if (held & 4) names += " alt";
  return names;
}

}  // namespace

std::string eventName(const EventCommand& event) {
  constexpr const char* kButtons[] = {"left", "middle", "right"};
  const bool is_key = event.code > 0 && event.code <= 1000, is_button = event.code >= 0 && event.code < 3;
  switch (event.what) {
    case keyDown:
      return is_key ? "key down " + keyName(event.code) : "";
    case keyUp:
      return is_key ? "key up " + keyName(event.code) : "";
    case clickDown:
      return is_button ? cat("click down ", kButtons[event.code]) : "";
    case clickUp:
      return is_button ? cat("click up ", kButtons[event.code]) : "";
    case scroll:
      return event.code > 0 ? "scroll up" : "scroll down";
    case modifier:
      return modifierNames(event.modifiers);
    default:
      return "";
  }
}

void InputEvents::add(const EventCommand& event) {
  constexpr std::size_t kMaxEvents = 1000;
  std::string name = eventName(event);
  if (name.empty()) return;
  names_.push_back(std::move(name));
  if (names_.size() > kMaxEvents) names_.pop_front();
}

std::vector<std::string> InputEvents::take() {
  std::vector<std::string> names(names_.begin(), names_.end());
  names_.clear();
  return names;
}

}  // namespace kinegraph::inline viewer_internal
