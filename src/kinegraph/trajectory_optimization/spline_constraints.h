#pragma once

#include <memory>
#include <vector>

#include "kinegraph/komo/collision/sampled_pairs.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/trajectory_optimization/spline_layout.h"

namespace kinegraph {

/// What pairs of shapes lack at instants of a spline between its slices, for objectives that are `on_the_way`: a sum per
/// motion,
///     phi = scale sum_i max(0, margin - distance_i)
/// or, in the separate form, a row per instant,
///     phi_i = scale (margin + slack - distance_i)    -far, scaled, where it is far or there is none yet
class SplineConstraints {
 public:
  /// Rows of one objective on one motion.
  struct Term {
    int objective, slice, first_row, rows;
  };

  SplineConstraints(const Path& path, std::shared_ptr<const SplineLayout> layout, std::vector<Objective> objectives,
                    bool is_separate);
  /// Of the same path and layout, with other objectives or in the other form.
  SplineConstraints(const Path& path, const SplineConstraints& other, std::vector<Objective> objectives,
                    bool is_separate);

  int rows() const { return rows_; }
  const std::vector<Objective>& objectives() const { return objectives_; }
  const std::vector<Term>& terms() const { return terms_; }
  const Term& termOf(int row) const;

  void addTo(Jacobian& J) const;  ///< appends the rows, of zeros

  /// At c, for which the path stands at M c + offset. `phi` and J (which may be null) have these rows from `first_row` on.
  void evaluate(const Path& path, const VectorXd& c, int first_row, VectorXd& phi, Jacobian* J);
  void evaluateTerm(int term, const Path& path, const VectorXd& c, int first_row, VectorXd& phi, Jacobian* J);

  /// Of a term, in place of as many that it had.
  void setSamples(const Path& path, int term, std::vector<CollisionSample> samples);

 private:
  struct Entry {
    int column;  ///< of c
    double weight;
  };
  /// A dof that the spline does not take.
  struct OtherDof {
    int dof, same;  ///< in the slice before, and in the slice itself; -1: it keeps its value
    std::vector<Entry> before, after;
  };
  struct Motion {
    std::vector<int> splined;  ///< dofs of the slice before
    std::vector<OtherDof> others;
    std::vector<std::pair<int, int>> segments;  ///< columns of c: first, width
  };
  struct Instants {
    std::unique_ptr<SampledPairs> pairs;  ///< null where all are empty
    std::vector<VectorXd> weights;        ///< of control points, per instant
  };

  void layOut(const Path& path);
  Motion motionInto(const Path& path, int slice) const;
  void place(const Path& path, const Term& term, double share, const VectorXd& weights, VectorXd& q) const;
  void spread(const Motion& motion, double share, const VectorXd& weights, double factor,
              const SampledPairs::Gradient& gradient);
  void collect(const Motion& motion, int row, Jacobian& J);

  std::shared_ptr<const SplineLayout> layout_;
  std::vector<Objective> objectives_;
  bool is_separate_;
  double tau_;
  int rows_ = 0;
  std::vector<Term> terms_;
  std::vector<Instants> samples_;                       ///< per term
  std::shared_ptr<const std::vector<Motion>> motions_;  ///< per slice
  MatrixXd points_;                                     ///< of c
  VectorXd row_;                                        ///< of the Jacobian
};

}  // namespace kinegraph
