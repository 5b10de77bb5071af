#include "kinegraph/logic/known_words.h"

#include "kinegraph/common/text.h"

namespace kinegraph::inline logic_internal {

namespace {

constexpr std::size_t kMany = 20;  ///< words that a message does not list

}  // namespace

std::string knownWords(std::string_view word, const std::vector<std::string>& known) {
  const std::string similar = similarHint(word, known);
  if (!similar.empty() || known.empty() || known.size() > kMany) return similar;
  return cat("; expected one of ", join(known));
}

}  // namespace kinegraph::inline logic_internal
