#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"

namespace kinegraph {

/// The result of a check that goes beyond the constraints: whether a solution is valid between the points that the
/// constraints sample.
struct ValidityReport {
  bool valid = true;
  std::string message{};  ///< if not valid: the place and size of the violation
};

/// A validity report that is computed when it is requested first. Safe to use from several threads.
class LazyValidity {
 public:
  /// If the check throws, as it may if it is cancelled, the next request starts it again.
  using Check = std::function<ValidityReport(const CancellationToken& cancellation)>;

  explicit LazyValidity(Check check) : check_(std::move(check)) {}
  explicit LazyValidity(ValidityReport known) : known_(std::move(known)) {}

  const ValidityReport& get(const CancellationToken& cancellation = {}) const;

 private:
  mutable std::mutex mutex_;
  mutable Check check_;
  mutable std::optional<ValidityReport> known_;
};

}  // namespace kinegraph
