#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"

namespace kinegraph {

/// Is a motion free of collisions at all times, and not just at those that constraints look at?
struct ValidityReport {
  bool free = true;
  std::string message{};  ///< where it is not: which shapes, when, how deep
};

/// A verdict that costs something, and so is found when it is first asked for. Threads may ask.
class LazyValidity {
 public:
  /// Calls the function that it is given from time to time; that may throw, and the next one who asks begins anew.
  using Judge = std::function<ValidityReport(const CancellationToken& cancellation)>;

  explicit LazyValidity(Judge judge) : judge_(std::move(judge)) {}
  explicit LazyValidity(ValidityReport known) : known_(std::move(known)) {}

  const ValidityReport& get(const CancellationToken& cancellation = {}) const;

 private:
  mutable std::mutex mutex_;
  mutable Judge judge_;
  mutable std::optional<ValidityReport> known_;
};

}  // namespace kinegraph
