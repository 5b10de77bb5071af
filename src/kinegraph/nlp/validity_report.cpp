#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

const ValidityReport& LazyValidity::get(const CancellationToken& cancellation) const {
  const std::lock_guard lock(mutex_);
  if (!known_) {
    known_ = check_(cancellation ? cancellation : [] {});
    check_ = nullptr;  // frees its captures
  }
  return *known_;
}

}  // namespace kinegraph
