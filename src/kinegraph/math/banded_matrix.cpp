#include "kinegraph/math/banded_matrix.h"

#include <algorithm>

namespace kinegraph::inline math_internal {

namespace {

typedef double Pair __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));

/// Computes target[i] += factor source[i] for i in [begin, end).
inline void add(double* target, double factor, const double* source, int begin, int end) {
  int i = begin;
  for (; i + 2 <= end; i += 2) {
    Pair& pair = *reinterpret_cast<Pair*>(target + i);
    pair = pair + factor * *reinterpret_cast<const Pair*>(source + i);
  }
  if (i < end) target[i] += factor * source[i];
}

}  // namespace

BandedMatrix::BandedMatrix(std::vector<int> last, int border)
    : band_(int(last.size())),
      last_(std::move(last)),
      offset_(last_.size() + std::size_t(border)),
      inverse_(offset_.size()),
      x_(offset_.size() + kPadding),
      y_(x_) {
  for (int begin = 0, end_before = 0; begin < band_; begin += kPanel) {
    const int end = std::min(begin + kPanel, band_);
    int lowest = std::max(end_before, end - 1);
    for (int j = begin; j < end; ++j) lowest = std::max(lowest, last_[j]);
    std::fill(last_.begin() + begin, last_.begin() + end, lowest);
    end_before = lowest;
  }
  std::ptrdiff_t used = 0;
  for (int j = 0; j < size(); ++j) {
    offset_[j].band = used - j;
    if (j < band_) used += last_[j] - j + 1 + kPadding;
    offset_[j].border = used - band_;
    if (border > 0) used += border + kPadding;
  }
  values_.assign(std::size_t(used), 0.);
}

void BandedMatrix::setZero() { std::fill(values_.begin(), values_.end(), 0.); }

void BandedMatrix::copyFrom(const BandedMatrix& other, int first) {
  if (first >= size()) return;
  const std::ptrdiff_t start = place(first, first);
  std::copy(other.values_.begin() + start, other.values_.end(), values_.begin() + start);
}

void BandedMatrix::addToDiagonal(double x, int first) {
  for (int i = first; i < size(); ++i) at(i, i) += x;
}

void BandedMatrix::isolate(int i) {
  const int first = i < band_ ? int(std::lower_bound(last_.begin(), last_.end(), i) - last_.begin()) : 0;
  for (int j = first; j < i; ++j) at(i, j) = 0.;
  if (i < band_) {
    for (int row = i; row <= last_[i]; ++row) at(row, i) = 0.;
  }
  for (int row = std::max(i, band_); row < size(); ++row) at(row, i) = 0.;
  at(i, i) = 1.;
}

void BandedMatrix::addOuterProduct(const double* v, int first, int width, double w, int from) {
  const int inside = std::clamp(band_ - first, 0, width);  // entries before the border
  for (int j = std::max(from - first, 0); j < width; ++j) {
    if (v[j] == 0.) continue;
    const Offset& offset = offset_[first + j];
    add(values_.data() + offset.band + first, w * v[j], v, j, inside);
    add(values_.data() + offset.border + first, w * v[j], v, std::max(j, inside), width);
  }
}

void BandedMatrix::addCrossProduct(const double* u, int u_first, int u_width, const double* v, int v_first, int v_width,
                                   double w, int from) {
  const int inside = std::clamp(band_ - u_first, 0, u_width);
  for (int j = std::max(from - v_first, 0); j < v_width; ++j) {
    if (v[j] == 0.) continue;
    const Offset& offset = offset_[v_first + j];
    add(values_.data() + offset.band + u_first, w * v[j], u, 0, inside);
    add(values_.data() + offset.border + u_first, w * v[j], u, inside, u_width);
  }
}

}  // namespace kinegraph::inline math_internal
