#pragma once

#include "kinegraph/common/errors.h"

namespace kinegraph::inline scene_internal {

/// A frame would be attached below itself.
class FrameCycle : public ValueError {
 public:
  using ValueError::ValueError;
};

}  // namespace kinegraph::inline scene_internal
