#include "kinegraph/nlp/validity_report.h"

namespace kinegraph {

const ValidityReport& LazyValidity::get(const std::function<void()>& between) const {
  const std::lock_guard lock(mutex_);
  if (!known_) {
    known_ = judge_(between ? between : [] {});
    judge_ = nullptr;  // and what it holds
  }
  return *known_;
}

}  // namespace kinegraph
