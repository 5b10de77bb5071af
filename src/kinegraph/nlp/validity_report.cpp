#include "kinegraph/nlp/validity_report.h"

namespace kinegraph {

const ValidityReport& LazyValidity::get(const CancellationToken& cancellation) const {
  const std::lock_guard lock(mutex_);
  if (!known_) {
    known_ = judge_(cancellation ? cancellation : [] {});
    judge_ = nullptr;  // and what it holds
  }
  return *known_;
}

}  // namespace kinegraph
