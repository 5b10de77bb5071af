#pragma once

#include <memory>
#include <vector>

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// Concatenation of features: a pose is a position and a quaternion.
class Stacked final : public Feature {
 public:
  explicit Stacked(std::vector<std::unique_ptr<Feature>> parts) : parts_(std::move(parts)) {}

  int rows() const override {
    int rows = 0;
    for (const auto& part : parts_) rows += part->rows();
    return rows;
  }

  int order() const override { return parts_.front()->order(); }

  int quaternionRow() const override {
    int row = 0;
    for (const auto& part : parts_) {
      if (part->quaternionRow() >= 0) return row + part->quaternionRow();
      row += part->rows();
    }
    return -1;
  }

  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override {
    int row = 0;
    for (const auto& part : parts_) {
      const int rows = part->rows();
      if (J) {
        JacobianRows own = J->middleRows(row, rows);
        part->eval(states, tau, y.segment(row, rows), &own);
      } else {
        part->eval(states, tau, y.segment(row, rows), nullptr);
      }
      row += rows;
    }
  }

  bool addLaneRows(LaneRowList& list) const override {
    LaneRowList longer = list;
    for (const auto& part : parts_) {
      if (!part->addLaneRows(longer)) return false;
    }
    list = std::move(longer);
    return true;
  }

 private:
  std::vector<std::unique_ptr<Feature>> parts_;
};

}  // namespace kinegraph::inline features_internal
