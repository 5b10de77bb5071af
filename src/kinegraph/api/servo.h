#pragma once

#include <functional>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/control/diff_ik.h"
#include "kinegraph/control/gamepad.h"
#include "kinegraph/control/target_file.h"

namespace kinegraph {

/// Where a target is at a time in s: a position (3,) or a pose (7,). A TargetFile is one.
using TargetSource = std::function<VectorXd(double t)>;

struct ServoOptions {
  double seconds = 10.;  ///< how long
  double dt = .005;      ///< s, of a step
  std::optional<bool>
      show;              ///< shows the scene thirty times a second; by itself: if people are to drag the target there
  bool realtime = true;  ///< waits so that steps come as time goes on; else as fast as they can

  /// Shows the scene and takes over what people dragged; empty: Config::view.
  std::function<void(Config&)> view;
  CancellationToken cancellation;  ///< called while it waits and after each step; what it throws ends the call
};

/// Steps a DiffIk, which has a task at the frame `target`, while that frame moves: by a file or a function, by a gamepad, or
/// by hand in the browser. Throws ValueError for times that are not positive and for numbers that are no pose,
/// FrameNotFound.
void servo(DiffIk& ik, Config& config, const std::string& target, const TargetSource& source,
           const ServoOptions& options = {});
void servo(DiffIk& ik, Config& config, const std::string& target, Gamepad& gamepad, const ServoOptions& options = {});
void servo(DiffIk& ik, Config& config, const std::string& target, const ServoOptions& options = {});

}  // namespace kinegraph
