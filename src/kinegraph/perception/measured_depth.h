#pragma once

namespace kinegraph::inline perception_internal {

/// Whether a pixel's depth (m) is a measurement. Cameras mark others by zero, negative or non-finite numbers, or by the
/// largest one of their format, such as 65.535 m: a range that no camera for arms has.
inline bool isMeasured(float depth) { return depth > 0.f && depth <= 50.f; }

}  // namespace kinegraph::inline perception_internal
