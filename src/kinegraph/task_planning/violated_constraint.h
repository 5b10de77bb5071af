#pragma once

#include <functional>
#include <memory>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// The demand of a problem that stands in the way of the others, where its path is, in words: "cup and table overlap by
/// 3 mm"; "" if all hold. `cancellation`, where given, is called at every evaluation, and may throw.
std::string violatedConstraint(const std::shared_ptr<Komo>& komo, const CancellationToken& cancellation = {});

}  // namespace kinegraph
