#include "kinegraph/math/skyline.h"

#include <algorithm>

namespace kinegraph {

namespace {

typedef double Pack __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

/// Sum of the products of entries, in four sums at a time.
double product(const double* a, const double* b, int count) {
  if (count < 8) {
    double sum = 0.;
    for (int i = 0; i < count; ++i) sum += a[i] * b[i];
    return sum;
  }
  Pack sums = {0., 0., 0., 0.};
  int i = 0;
  for (; i + 4 <= count; i += 4) sums += *reinterpret_cast<const Pack*>(a + i) * *reinterpret_cast<const Pack*>(b + i);
  double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

SkylineMatrix::SkylineMatrix(std::vector<int> first) : first_(std::move(first)), offset_(first_.size()), first_run_{0} {
  std::ptrdiff_t used = 0;
  for (int i = 0; i < size(); ++i) {
    offset_[i] = used - first_[i];
    used += i - first_[i] + 1 + kPanel - 1;  // whole panels may be written beyond the diagonal
  }
  values_.assign(std::size_t(used), 0.);
  std::vector<int> below;  // the rows that reach into a panel or further to the left
  std::size_t widest = 0;
  std::vector<std::vector<int>> starting(std::size_t(size() + kPanel - 1) / kPanel);
  for (int i = 0; i < size(); ++i) starting[first_[i] / kPanel].push_back(i);
  for (int panel = 0; panel < int(starting.size()); ++panel) {
    below.insert(below.end(), starting[panel].begin(), starting[panel].end());
    std::erase_if(below, [&](int row) { return row < panel * kPanel; });
    std::sort(below.begin(), below.end());
    for (int row : below) {
      if (int(runs_.size()) > first_run_.back() && runs_.back().row + runs_.back().count == row) {
        ++runs_.back().count;
      } else {
        runs_.push_back({row, 1});
      }
    }
    first_run_.push_back(int(runs_.size()));
    widest = std::max(widest, below.size());
  }
  panel_.assign(kPanel * (widest + 2 * kPanel), 0.);
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
    const int first = first_[i];
    const double* row = values_.data() + offset_[i];
    double* sums = y.data();
    const double xi = x[i];
    for (int j = first; j < i; ++j) sums[j] += row[j] * xi;
    sums[i] += product(row + first, x.data() + first, i - first + 1);
  }
}

void SkylineMatrix::solveInPlace(VectorXd& x) const {
  double* unknowns = x.data();
  for (int i = 0; i < size(); ++i) {
    const double* row = values_.data() + offset_[i];
    unknowns[i] = (unknowns[i] - product(row + first_[i], unknowns + first_[i], i - first_[i])) / row[i];
  }
  for (int i = size() - 1; i >= 0; --i) {
    const double* row = values_.data() + offset_[i];
    const double xi = unknowns[i] /= row[i];
    for (int j = first_[i]; j < i; ++j) unknowns[j] -= row[j] * xi;
  }
}

}  // namespace kinegraph
