#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinegraph::inline logic_internal {

/// Returns the end of a message about an unknown word: similar known words; if there are none, all known words, unless
/// they are many.
std::string knownWords(std::string_view word, const std::vector<std::string>& known);

}  // namespace kinegraph::inline logic_internal
