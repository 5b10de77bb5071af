#pragma once

#include <chrono>

namespace kinegraph::inline common_internal {

/// Measures elapsed time with the steady clock, from its construction or the last `restart` on.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace kinegraph::inline common_internal
