#pragma once

namespace kinegraph::inline common_internal {

/// Reports Ctrl-C (SIGINT) to threads that cannot wait for the program's own handler, which runs as before.
/// Signals are counted as long as one monitor exists. If the program has no handler, Ctrl-C ends the program and
/// nothing is counted. A handler that is installed later replaces the counting one.
class InterruptMonitor {
 public:
  InterruptMonitor();
  ~InterruptMonitor();
  InterruptMonitor(const InterruptMonitor&) = delete;

  /// Whether Ctrl-C was pressed since the last call, or since the construction.
  bool wasInterrupted();

 private:
  unsigned seen_;
};

}  // namespace kinegraph::inline common_internal
