#pragma once

#include <functional>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/control/diff_ik.h"
#include "kinegraph/control/gamepad.h"
#include "kinegraph/control/target_file.h"

namespace kinegraph {

/// Returns the target at a time in s: a position (3,) or a pose (7,). A TargetFile is one.
using TargetSource = std::function<VectorXd(double t)>;

struct ServoOptions {
  double seconds = 10.;      ///< s
  double dt = .005;          ///< s, of one step
  std::optional<bool> show;  ///< shows the scene at 30 Hz; by default only if users are to drag the target
  bool realtime = true;      ///< steps in real time; else as fast as possible

  /// Shows the scene and applies users' edits; empty: Config::view.
  std::function<void(Config&)> view;
  CancellationToken cancellation;  ///< checked while waiting and after each step; its exceptions end the call
};

/// Steps a DiffIk with a task at the frame `target` while that frame moves: by a file or a function, by a gamepad, or
/// by hand in the browser. Throws ValueError for times that are not positive and for invalid poses, and FrameNotFound.
void servo(DiffIk& ik, Config& config, const std::string& target, const TargetSource& source,
           const ServoOptions& options = {});
/// The same with a gamepad, which moves the target.
void servo(DiffIk& ik, Config& config, const std::string& target, Gamepad& gamepad, const ServoOptions& options = {});
/// The same with a target that users drag in the browser.
void servo(DiffIk& ik, Config& config, const std::string& target, const ServoOptions& options = {});

}  // namespace kinegraph
