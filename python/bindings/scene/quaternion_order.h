#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph::python {

/// Warns of a quaternion far from unit length, or one that is probably x y z w: it is often a misordered pose. The
/// texts are constant, so that Python shows them once.
void warnOfOrder(const Vector4d& wxyz);

}  // namespace kinegraph::python
