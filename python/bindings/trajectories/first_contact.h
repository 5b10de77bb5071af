#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "bindings.h"
#include "kinegraph/tool_paths/plan_tool_path.h"

namespace kinegraph::python {

/// The first contact of a motion: time, both frames, distance; None if it is free.
template <class Motion>
std::optional<std::tuple<double, std::string, std::string, double>> firstContactOf(const Motion& motion,
                                                                                   const PyConfig& config,
                                                                                   double margin) {
  const Config scene(config);  // a copy, because the caller may change it
  const nb::gil_scoped_release unlock;
  const std::optional<MotionTouch> touch = firstContact(scene, motion, margin);
  if (!touch) return std::nullopt;
  return std::tuple(touch->t, touch->a, touch->b, touch->distance);
}

}  // namespace kinegraph::python
