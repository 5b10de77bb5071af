#include "kinegraph/math/skyline.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

SkylineMatrix::SkylineMatrix(std::vector<int> first) : first_(std::move(first)), offset_(first_.size()) {
  std::ptrdiff_t used = 0;
  for (int i = 0; i < size(); ++i) {
    offset_[i] = used - first_[i];
    used += i - first_[i] + 1;
  }
  values_.assign(std::size_t(used), 0.);
}

void SkylineMatrix::setZero() { std::fill(values_.begin(), values_.end(), 0.); }

void SkylineMatrix::addToDiagonal(double x) {
  for (int i = 0; i < size(); ++i) at(i, i) += x;
}

void SkylineMatrix::addOuterProduct(const double* v, int column, int width, double w) {
  for (int i = 0; i < width; ++i) {
    if (v[i] == 0.) continue;
    double* row = values_.data() + offset_[column + i] + column;
    const double wi = w * v[i];
    for (int j = 0; j <= i; ++j) row[j] += wi * v[j];
  }
}

void SkylineMatrix::addCrossProduct(const double* u, int u_column, int u_width, const double* v, int v_column, int v_width,
                                    double w) {
  for (int i = 0; i < u_width; ++i) {
    double* row = values_.data() + offset_[u_column + i] + v_column;
    for (int j = 0; j < v_width; ++j) row[j] += w * u[i] * v[j];
  }
}

void SkylineMatrix::addProduct(const VectorXd& x, VectorXd& y) const {
  for (int i = 0; i < size(); ++i) {
    const double* row = values_.data() + offset_[i];
    double sum = row[i] * x[i];
    for (int j = first_[i]; j < i; ++j) {
      sum += row[j] * x[j];
      y[j] += row[j] * x[i];
    }
    y[i] += sum;
  }
}

bool SkylineMatrix::factorize() {
  for (int i = 0; i < size(); ++i) {
    double* row_i = values_.data() + offset_[i];
    double diagonal = row_i[i];
    for (int j = first_[i]; j < i; ++j) {
      const double* row_j = values_.data() + offset_[j];
      double sum = row_i[j];
      for (int k = std::max(first_[i], first_[j]); k < j; ++k) sum -= row_i[k] * row_j[k];
      sum /= row_j[j];
      row_i[j] = sum;
      diagonal -= sum * sum;
    }
    if (!(diagonal > 0.) || !std::isfinite(diagonal)) return false;
    row_i[i] = std::sqrt(diagonal);
  }
  return true;
}

void SkylineMatrix::solveInPlace(VectorXd& x) const {
  for (int i = 0; i < size(); ++i) {
    const double* row = values_.data() + offset_[i];
    double sum = x[i];
    for (int j = first_[i]; j < i; ++j) sum -= row[j] * x[j];
    x[i] = sum / row[i];
  }
  for (int i = size() - 1; i >= 0; --i) {
    const double* row = values_.data() + offset_[i];
    x[i] /= row[i];
    for (int j = first_[i]; j < i; ++j) x[j] -= row[j] * x[i];
  }
}

}  // namespace kinegraph
