#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/math/banded_matrix.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// The linear algebra of a SemismoothModel of any size. Matrices are banded with a border, in an order of the variables
/// that makes the band narrow. Rows are those of the Jacobian.
class BandAlgebra {
 public:
  using Vector = VectorXd;

  BandAlgebra(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& constraints, bool full);

  int size() const { return n_; }
  Vector zeroVector() const { return VectorXd::Zero(n_); }

  /// Copies the box of a step; padding entries are inside.
  void takeBox(const VectorXd& low, const VectorXd& high, Vector& to_low, Vector& to_high) const {
    to_low = low, to_high = high;
  }

  // Rows of the Jacobian. `j` is the index of a constraint.
  void setJacobian(const Jacobian& J) { J_ = &J; }
  double rowTimes(int j, const Vector& d) const { return J_->rowTimes(constraints_[std::size_t(j)], d); }
  void addRowTo(int j, double factor, Vector& x) const { J_->addRowTo(constraints_[std::size_t(j)], factor, x); }
  double largestRise(int j, const Vector& low, const Vector& high) const;  ///< largest J_j d for d in the box
  int firstColumn(int j) const;  ///< first column of the factor that a row changes

  // The Hessian H. That of linear costs is kept; other terms are added to a copy.
  void setLinearCosts(const std::vector<int>& rows);
  void addLinearCostGradient(const std::vector<int>& rows, const VectorXd& phi, Vector& g) const;
  void useLinearCosts() { H_ = &H_linear_; }
  void copyLinearCosts();
  void setMultipleOfIdentity(double weight);
  void addCost(int row, double weight) { addRow(*H_, row, weight, 0); }
  void addEntry(int i, int j, double value) {
    H_->at(std::max(place_[i], place_[j]), std::min(place_[i], place_[j])) += value;
  }
  void addCostGradient(int row, double factor, Vector& g) const { J_->addRowTo(row, factor, g); }
  double largestEntry() const;
  double diagonal(int i) const { return H_->at(place_[i], place_[i]); }
  void addHessianProduct(const Vector& d, Vector& sum);

  /// Adds a symmetric block of consecutive variables to H, until dropBlocks. `addTo(M)` adds its lower triangle to a
  /// matrix; `storage` has the size of the block and must outlive it.
  template <class AddTo>
  void addBlock(int column, MatrixXd& storage, const AddTo& addTo) {
    storage.setZero();
    addTo(storage);
    blocks_.push_back({column, &storage});
  }
  void dropBlocks() { blocks_.clear(); }

  /// Computes K = H + damping I + sum_active mu J_j^T J_j, with the rows of fixed variables replaced by the identity,
  /// and factorizes it. Only columns from `first` on have changed since the last call. False if K is not positive
  /// definite.
  bool factorize(double damping, double mu, const std::vector<int>& active, const std::vector<char>& fixed, int first);
  void solve(Vector& x);  ///< x <- K^-1 x

  /// Returns the pivot of a variable: close to zero if K is nearly singular.
  double pivot(int i) const { return K_.at(place_[std::size_t(i)], place_[std::size_t(i)]); }

 private:
  /// Part of a row of J with consecutive columns in the matrices.
  struct Run {
    const double* values;
    int place, width;
  };
  struct Block {
    int column;
    const MatrixXd* lower;
  };
  void addRow(BandedMatrix& matrix, int row, double weight, int from);
  void addBlocksTo(BandedMatrix& matrix, int from) const;

  int n_;
  const Jacobian* J_ = nullptr;
  const std::vector<int>& constraints_;
  std::vector<int> place_;  ///< index of each variable in H and K
  bool reordered_ = false;
  std::vector<Run> runs_;
  std::vector<Block> blocks_;
  VectorXd placed_, placed_sum_;
  BandedMatrix H_linear_, H_own_, K_;
  BandedMatrix* H_ = &H_linear_;
};

}  // namespace kinegraph::inline solvers_internal
