#pragma once

#include <memory>
#include <optional>

#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/nlp/initial_guesses.h"
#include "kinegraph/nlp/lazy_constraints.h"
#include "kinegraph/nlp/mapped_nlp.h"
#include "kinegraph/trajectory_optimization/spline_constraints.h"
#include "kinegraph/trajectory_optimization/spline_curve.h"

namespace kinegraph::inline trajectory_optimization_internal {

/// The problem of a SplineMotion: that of its Komo in the control points of the spline. Objectives that are
/// `between_slices` constrain the spline, and reports refer to it. The rows of its samples come after those of the
/// slices, and are generated like those of a Komo; see continuous_collisions.h.
class SplineNlp final : public Nlp, public InitialGuesses, public LazyConstraints {
 public:
  SplineNlp(std::shared_ptr<Komo> komo, std::shared_ptr<const SplineLayout> layout);

  Jacobian makeJacobian() const override;
  void evaluate(const VectorXd& c, VectorXd& phi, Jacobian* J) override;
  bool mayBeCancelled() const override { return slices_->mayBeCancelled(); }
  void leaveAt(const VectorXd& c) override { slices_->leaveAt(c); }
  bool addCostHessian(const VectorXd& c, MatrixXd& H) override { return slices_->addCostHessian(c, H); }
  std::span<const CurvedRows> curvedRows() const override { return slices_->curvedRows(); }
  void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) override {
    slices_->addCurvature(k, weights, H);
  }
  Separation separation() override;
  std::shared_ptr<const LazyValidity> validity(const VectorXd& c) override;
  Refinement refine(const VectorXd& c, VectorXd& dual) override;
  bool hasCapacity() const override { return is_separate_ && rows_.rows() > 0; }
  Refinement activate(const VectorXd& c, bool is_solution, VectorXd& phi, Jacobian& J, std::vector<int>& rows) override;
  InitialGuesses* initialGuesses() override { return this; }
  LazyConstraints* lazyConstraints() override { return this; }
  GuessKind guessKind(const VectorXd& c) override;
  std::optional<VectorXd> initialGuess(const VectorXd& c, int number) override;
  VectorXd initialPoint(Rng& rng) override { return slices_->initialPoint(rng); }
  std::string rowName(int row) const override;
  RowDescription describeRow(int row) const override;
  VariableDescription describeVariable(int variable) const override { return slices_->describeVariable(variable); }
  std::vector<std::string> detailsOf(int row) const override;
  std::string report(int verbose) const override { return slices_->report(verbose); }
  bool mayBeQuadratic() const override { return rows_.rows() == 0 && slices_->mayBeQuadratic(); }

 private:
  SplineNlp(const SplineNlp& summed, std::shared_ptr<MappedNlp> slices);

  int rowsOfSlices() const { return int(slices_->types().size()); }
  void layOut();
  void moveTo(const VectorXd& c);
  double addSamplesTo(std::vector<Objective>& objectives);
  void replace(std::vector<Objective> objectives);
  VectorXd carriedOver(const VectorXd& dual, const SplineConstraints& before, const SplineConstraints& now) const;

  std::shared_ptr<Komo> komo_;
  std::shared_ptr<const SplineLayout> layout_;
  std::shared_ptr<MappedNlp> slices_;
  bool is_separate_;
  SplineConstraints rows_;
  SplineCurve curve_;
  MotionProbe probe_{kFreeTolerance};
  std::vector<std::vector<CheckedMotion>> checked_;  ///< per objective and motion
  VectorXd free_at_;                                 ///< solution at which a solver found no further violations
  VectorXd phi_;                                     ///< of the slices
  Separation separation_;
  bool separation_is_known_ = false;
};

}  // namespace kinegraph::inline trajectory_optimization_internal
