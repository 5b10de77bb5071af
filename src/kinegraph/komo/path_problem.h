#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

/// Objectives on a path, laid out: which rows of phi each has in each slice, and where its Jacobian goes. Evaluates at
/// the path as it is then; its structure must be the one that it has when this is made.
class PathProblem {
 public:
  /// An objective in a slice.
  struct Term {
    int objective;
    int slice;
    int residual;
    int first_row, rows;
    int first_run, runs;
    int first_value;  ///< of its rows in a Jacobian, where these are always stored
  };

  PathProblem(const Path& path, const Contacts& contacts, std::vector<Objective> objectives);

  const std::vector<Term>& terms() const { return terms_; }
  const std::vector<ObjectiveType>& types() const { return types_; }
  const std::vector<Objective>& objectives() const { return objectives_; }
  int rows() const { return int(types_.size()); }
  const Term& termOf(int row) const;

  bool isLinear() const;                 ///< are all rows of the Jacobian the same for all paths?
  std::vector<char> linearRows() const;  ///< which are?

  const std::vector<Nlp::CurvedRows>& curvedRows() const { return curved_rows_; }

  /// Adds the second derivatives of the k-th of curvedRows at the present path to H; see Nlp::addCurvature.
  void addCurvature(const Path& path, int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H);

  /// With the values of linear rows; the others are zero.
  Jacobian makeJacobian(const Path& path) const;

  /// Leaves linear rows of `J` as they are.
  void evaluate(const Path& path, VectorXd& phi, Jacobian* J);

  /// The same for some of the terms, among them all or none whose rows come and go; leaves the rows of others as they are.
  void evaluateTerms(const Path& path, std::span<const int> terms, VectorXd& phi, Jacobian* J);

  /// Of an objective on the way to a slice: other instants, as many as before.
  void setSamples(const Path& path, const Contacts& contacts, const Term& term, std::vector<CollisionSample> samples);

  /// One of the terms, by its place, after evaluating others at the same path.
  void evaluateTerm(const Path& path, std::size_t index, VectorXd& phi, Jacobian& J) { evaluate(path, index, phi, &J); }

  bool isLinear(const Term& term) const { return residuals_[std::size_t(term.residual)].isLinear(); }
  bool storesAllRows(const Term& term) const { return !residuals_[std::size_t(term.residual)].tellsZeroRows(); }

 private:
  /// Consecutive columns of the window of slices, and where they go in the row.
  struct Run {
    int from, to, width;
  };
  /// What evaluating a residual needs beside it.
  struct Workspace {
    std::vector<double> jacobian;  ///< by columns of the window of slices
    std::vector<double> zeros;     ///< the same, filled with zeros
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
  std::vector<int> width_;                                  ///< per term: columns in all
  std::vector<Nlp::CurvedRows> curved_rows_;
  std::vector<int> curved_terms_;  ///< of each of them
  Workspace workspace_;
  int stored_ =
      0;  ///< values of a Jacobian before those of rows that come and go: zeros, then rows that are always stored
  int constant_ = 0;  ///< of these, before rows that are not linear
  int widest_state_ = 0, dimension_ = 0;
};

}  // namespace kinegraph
