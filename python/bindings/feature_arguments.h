#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.h"

namespace kinegraph::python {

/// Frames as users give them: a name or a list of names.
using FrameNames = std::variant<std::vector<std::string>, std::string>;

std::vector<std::string> toNames(const FrameNames& frames);
MatrixXd toScale(const std::optional<Numbers>& scale);
VectorXd toTarget(const std::optional<Numbers>& target);

}  // namespace kinegraph::python
