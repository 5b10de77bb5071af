#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace kinegraph {

/// Is a motion free of collisions at all times, and not just at those that constraints look at?
struct MotionVerdict {
  bool free = true;
  std::string message{};  ///< where it is not: which shapes, when, how deep
};

/// A verdict that costs something, and so is found when it is first asked for. Threads may ask.
class LazyVerdict {
 public:
  /// Calls the function that it is given from time to time; that may throw, and the next one who asks begins anew.
  using Judge = std::function<MotionVerdict(const std::function<void()>& between)>;

  explicit LazyVerdict(Judge judge) : judge_(std::move(judge)) {}
  explicit LazyVerdict(MotionVerdict known) : known_(std::move(known)) {}

  const MotionVerdict& get(const std::function<void()>& between = {}) const;

 private:
  mutable std::mutex mutex_;
  mutable Judge judge_;
  mutable std::optional<MotionVerdict> known_;
};

}  // namespace kinegraph
