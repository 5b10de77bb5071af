#pragma once

#include <memory>
#include <vector>

#include "kinegraph/komo/collision/sampled_pairs.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/trajectory_optimization/spline_layout.h"

namespace kinegraph::inline trajectory_optimization_internal {

/// Collision constraints at samples of a spline between its slices, for objectives that are `between_slices`: one sum
/// per motion,
///
///     phi = scale sum_i max(0, margin - distance_i)
///
/// or, in the separate form, one row per sample,
///
///     phi_i = scale (margin + slack - distance_i)    -cutoff, scaled, for distant pairs and empty samples
class SplineConstraints {
 public:
  /// Rows of one objective for one motion.
  struct Term {
    int objective, slice, first_row, rows;
  };

  SplineConstraints(const Path& path, std::shared_ptr<const SplineLayout> layout, std::vector<Objective> objectives,
                    bool is_separate);
  /// Reuses the path and layout of `other`, with other objectives or in the other form.
  SplineConstraints(const Path& path, const SplineConstraints& other, std::vector<Objective> objectives,
                    bool is_separate);

  int rows() const { return rows_; }
  const std::vector<Objective>& objectives() const { return objectives_; }
  const std::vector<Term>& terms() const { return terms_; }
  const Term& termOf(int row) const;

  void addTo(Jacobian& J) const;  ///< appends the rows, filled with zeros

  /// Evaluates at c; the path must be at M c + offset. The rows of `phi` and J (which may be null) start at
  /// `first_row`.
  void evaluate(const Path& path, const VectorXd& c, int first_row, VectorXd& phi, Jacobian* J);
  void evaluateTerm(int term, const Path& path, const VectorXd& c, int first_row, VectorXd& phi, Jacobian* J);

  /// Replaces the samples of a term by as many others.
  void setSamples(const Path& path, int term, std::vector<CollisionSample> samples);

 private:
  struct Entry {
    int column;  ///< of c
    double weight;
  };
  /// A dof that is not part of the spline.
  struct OtherDof {
    int dof, same;  ///< index in the previous slice, and in the slice itself; -1 if it keeps its value
    std::vector<Entry> before, after;
  };
  struct Motion {
    std::vector<int> splined;  ///< dofs of the previous slice
    std::vector<OtherDof> others;
    std::vector<std::pair<int, int>> segments;  ///< columns of c: first, width
  };
  struct SampleWeights {
    std::unique_ptr<SampledPairs> pairs;  ///< null if all samples are empty
    std::vector<VectorXd> weights;        ///< weights of the control points, per sample
  };

  void layOut(const Path& path);
  Motion motionInto(const Path& path, int slice) const;
  void place(const Path& path, const Term& term, double time, const VectorXd& weights, VectorXd& q) const;
  void addGradient(const Motion& motion, double time, const VectorXd& weights, double factor,
                   const SampledPairs::Gradient& gradient);
  void collect(const Motion& motion, int row, Jacobian& J);

  std::shared_ptr<const SplineLayout> layout_;
  std::vector<Objective> objectives_;
  bool is_separate_;
  double tau_;
  int rows_ = 0;
  std::vector<Term> terms_;
  std::vector<SampleWeights> samples_;                  ///< per term
  std::shared_ptr<const std::vector<Motion>> motions_;  ///< per slice
  MatrixXd points_;                                     ///< control points of c
  VectorXd row_;                                        ///< row of the Jacobian
};

}  // namespace kinegraph::inline trajectory_optimization_internal
