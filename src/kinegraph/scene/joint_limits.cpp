#include "kinegraph/scene/joint_limits.h"

#include "kinegraph/base/text.h"

namespace kinegraph {

std::string limitsMistake(std::span<const double> limits) {
  const std::size_t dofs = limits.size() / 2;
  bool crossed = false, all_equal = true, in_turn = dofs > 1, a_range = false;
  for (std::size_t i = 0; i < dofs; ++i) {
    crossed |= limits[i] > limits[dofs + i];
    all_equal &= limits[i] == limits[dofs + i];
    in_turn &= limits[2 * i] <= limits[2 * i + 1];
    a_range |= limits[2 * i] < limits[2 * i + 1];
  }
  if (!crossed && !(all_equal && in_turn && a_range)) return "";
  const char* mistake = crossed ? "a lower limit is above its upper limit" : "each lower limit equals its upper limit";
  if (!in_turn) return mistake;
  std::string lower, upper;
  for (std::size_t i = 0; i < dofs; ++i) {
    lower += cat(limits[2 * i], " ");
    upper += cat(limits[2 * i + 1], i + 1 < dofs ? " " : "");
  }
  return cat(mistake, "; all lower limits come first, then all upper ones: [", lower, upper,
             "] if these are the lower and upper limit of each dof in turn");
}

}  // namespace kinegraph
