#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include <vector>

#include "arrays.h"
#include "kinegraph/perception/register_scene.h"

namespace kinegraph::python {

/// One view, or a sequence of them.
inline std::vector<DepthView> depthViews(nb::handle views) {
  if (nb::isinstance<DepthView>(views)) return {nb::cast<DepthView>(views)};
  return nb::cast<std::vector<DepthView>>(views);
}

/// x y z qw qx qy qz of a pose.
inline Array seenPose(const Pose& pose) { return toNumpy(VectorXd(pose.numbers())); }

}  // namespace kinegraph::python
