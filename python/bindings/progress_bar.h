#pragma once

#include "bindings.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/stopwatch.h"

namespace kinegraph::python {

/// Checks for Ctrl-C while a call runs without the interpreter lock. With `verbose`, it draws a progress bar on a
/// terminal once the call takes long, or the time if the call has no parts.
class ProgressBar {
 public:
  /// `call` names the call on the terminal, and must outlive the bar.
  ProgressBar(const char* call, int verbose) : call_(call), verbose_(verbose) {}

  /// Receives the progress and draws it now and then.
  void operator()(const Progress& progress) {
    progress_ = progress;
    check();
  }

  /// Draws the last progress and checks for Ctrl-C, both now and then: a CancellationToken.
  void check() {
    if (check_.checkIfDue() && verbose_ > 0 && seconds() > kLong) draw();
  }

  /// Ends the line on the terminal, if there is one: full, or as it was last if the call has failed.
  void finish(bool is_complete = true) {
    if (is_complete) progress_.done = progress_.total;
    if (drawn_) draw(true);
  }

  double seconds() const { return stopwatch_.seconds(); }

 private:
  static constexpr double kLong = .5;  // s

  void draw(bool ends = false) {
    const nb::gil_scoped_acquire lock;
    drawn_ = true;
    const nb::module_ progress = nb::module_::import_("kinegraph.progress");
    if (progress_.total > 1)
      progress.attr("drawProgress")(call_, progress_.done, progress_.total, seconds(), ends);
    else if (ends)
      progress.attr("clearLine")();
    else
      progress.attr("drawTime")(call_, seconds());
  }

  const char* call_;
  int verbose_;
  Progress progress_;
  Stopwatch stopwatch_;
  CheckInterrupts check_;
  bool drawn_ = false;
};

}  // namespace kinegraph::python
