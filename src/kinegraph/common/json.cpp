#include "kinegraph/common/json.h"

#include <boost/json/src.hpp>  // the implementation of the library

namespace kinegraph::inline common_internal {

boost::json::value jsonOf(double number) {
  constexpr double kExact = 9007199254740992.;  // 2^53
  if (!std::isfinite(number)) return nullptr;
  const bool is_whole = number == std::trunc(number) && std::abs(number) < kExact;
  return is_whole ? boost::json::value(std::int64_t(number)) : boost::json::value(number);
}

}  // namespace kinegraph::inline common_internal
