#pragma once

namespace kinegraph {

/// Counts how often Ctrl-C (SIGINT) came while one of these exists, beside whoever handles it: for threads that cannot
/// wait until the program's main thread has time to say so. Where nobody handles it, Ctrl-C ends the program as ever, and
/// nothing is counted. Whoever installs another handler later takes the place of the counting one.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;

  /// True if Ctrl-C came since the last call, or since this was made.
  bool takeNew();

 private:
  unsigned seen_;
};

}  // namespace kinegraph
