#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinegraph/features/residual.h"
#include "kinegraph/komo/motion_problem.h"

namespace kinegraph::inline komo_internal {

/// The layout of objectives on a path: the rows of phi of each objective in each slice, and the place of its Jacobian.
/// Evaluates the present path. The structure of the path must not change after construction.
class PathProblem {
 public:
  /// An objective in a slice.
  struct Term {
    int objective;
    int slice;
    int residual;
    int first_row, rows;
    int first_run, runs;
    int first_value;  ///< of its rows in a Jacobian, if these are always stored
  };

  PathProblem(const Path& path, const Contacts& contacts, std::vector<Objective> objectives);

  const std::vector<Term>& terms() const { return terms_; }
  const std::vector<ObjectiveType>& types() const { return types_; }
  const std::vector<Objective>& objectives() const { return objectives_; }
  int rows() const { return int(types_.size()); }
  const Term& termOf(int row) const;

  bool isLinear() const;                 ///< true if the Jacobian is the same for all paths
  std::vector<char> linearRows() const;  ///< per row: true if its Jacobian is the same for all paths

  const std::vector<Nlp::CurvedRows>& curvedRows() const { return curved_rows_; }

  /// Adds the second derivatives of the k-th entry of curvedRows at the present path to H; see Nlp::addCurvature.
  void addCurvature(const Path& path, int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H);

  /// Creates a Jacobian with the values of linear rows; other rows are zero.
  Jacobian makeJacobian(const Path& path) const;

  /// Evaluates all terms; leaves linear rows of `J` unchanged.
  void evaluate(const Path& path, VectorXd& phi, Jacobian* J);

  /// Evaluates some of the terms and leaves the rows of others unchanged. `terms` contains either all sparse terms or
  /// none.
  void evaluateTerms(const Path& path, std::span<const int> terms, VectorXd& phi, Jacobian* J);

  /// Replaces the samples of a term that is between slices by as many others.
  void setSamples(const Path& path, const Contacts& contacts, const Term& term, std::vector<CollisionSample> samples);

  /// Evaluates one more term at the path at which the others were evaluated.
  void evaluateTerm(const Path& path, std::size_t index, VectorXd& phi, Jacobian& J) { evaluate(path, index, phi, &J); }

  bool isLinear(const Term& term) const { return residuals_[std::size_t(term.residual)].isLinear(); }
  bool storesAllRows(const Term& term) const { return !residuals_[std::size_t(term.residual)].reportsZeroRows(); }

 private:
  /// Consecutive columns of the window of slices, and their destination in the row.
  struct Run {
    int from, to, width;
  };
  /// Memory for the evaluation of a residual.
  struct Workspace {
    std::vector<double> jacobian;  ///< over the columns of the window of slices
    std::vector<double> zeros;     ///< the same size, always zero between evaluations
    std::vector<char> zero_row;
    std::vector<const State*> window;
  };
  Workspace makeWorkspace() const;
  void evaluate(const Path& path, std::size_t index, VectorXd& phi, Jacobian* J);
  std::span<const State* const> statesOf(const Path& path, const Term& term, Workspace& workspace) const;
  void findCurvedRows(const Path& path);
  void layOut(const Path& path, Term& term, std::vector<std::pair<int, int>>& segments);
  void evaluateTerm(const Path& path, std::size_t index, Residual& residual, Eigen::Ref<VectorXd> phi, double* jacobian,
                    Workspace& workspace) const;
  void evaluateSparse(const Path& path, std::size_t index, VectorXd& phi, Jacobian& J);

  std::vector<Objective> objectives_;
  std::vector<Term> terms_;
  std::vector<Residual> residuals_;
  std::vector<ObjectiveType> types_;
  std::vector<Run> runs_;
  std::vector<std::vector<std::pair<int, int>>> segments_;  ///< per term: columns and widths
  std::vector<int> width_;                                  ///< per term: total number of columns
  std::vector<Nlp::CurvedRows> curved_rows_;
  std::vector<int> curved_terms_;  ///< the term of each of curved_rows_
  Workspace workspace_;
  int stored_ =
      0;  ///< number of values of a Jacobian before those of sparse rows: zeros, then rows that are always stored
  int constant_ = 0;  ///< the part of stored_ before nonlinear rows
  int widest_state_ = 0, dimension_ = 0;
};

}  // namespace kinegraph::inline komo_internal
