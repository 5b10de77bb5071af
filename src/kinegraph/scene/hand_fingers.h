#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline scene_internal {

/// The fingers of a hand: an inactive joint, and the joints that mimic it. Whatever moves the fingers, `width` is the
/// opening between them in m: the distance between the colliding shapes of the two links that move the most against
/// each other. The opening of fingers that slide from zero on, and of fingers without shapes, is the sum of their
/// motions.
struct HandFingers {
  std::string joint;                 ///< the frame of the joint
  std::vector<std::string> fingers;  ///< the frames of the joint and of those that mimic it
  std::vector<std::string> pads;     ///< the frames between whose shapes the opening is measured
  VectorXd q, widths;                ///< samples; q increases from the lower to the upper limit

  double widthAt(double joint_position) const;

  /// The joint position of an opening (m), within the limits.
  double positionAt(double width) const;

  /// Change of the opening with the joint position, m per m or rad; negative if a larger position closes the hand.
  double slopeAt(double joint_position) const;

  /// Returns the opening as a function of scale * q. scale is not 0.
  HandFingers scaled(double scale) const;

  double minWidth() const { return q.size() > 0 ? widths.minCoeff() : 0.; }
  double maxWidth() const { return q.size() > 0 ? widths.maxCoeff() : 0.; }

  double per_position = 0.;  ///< of a linear opening, m per m; 0: see the samples
};

/// Returns all hands with fingers, in the order of their joints' frames.
std::vector<HandFingers> handFingersOf(const Config& C);

}  // namespace kinegraph::inline scene_internal
