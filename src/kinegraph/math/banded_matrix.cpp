#include "kinegraph/math/banded_matrix.h"

#include <algorithm>

namespace kinegraph {

BandedMatrix::BandedMatrix(std::vector<int> last, int border)
    : band_(int(last.size())), last_(std::move(last)), offset_(last_.size() + std::size_t(border)), inverse_(offset_.size()),
      x_(offset_.size() + kPadding), y_(x_) {
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

void BandedMatrix::addToDiagonal(double x) {
  for (int i = 0; i < size(); ++i) at(i, i) += x;
}

void BandedMatrix::isolate(int i) {
  for (int j = 0; j < i; ++j) {
    if (keeps(i, j)) at(i, j) = 0.;
  }
  for (int row = i; row < size(); ++row) {
    if (row >= band_ || row <= last_[i]) at(row, i) = 0.;
  }
  at(i, i) = 1.;
}

void BandedMatrix::addOuterProduct(const double* v, int first, int width, double w) {
  const int inside = std::clamp(band_ - first, 0, width);  // entries before the border
  for (int j = 0; j < width; ++j) {
    if (v[j] == 0.) continue;
    const double wj = w * v[j];
    double* column = values_.data() + offset_[first + j].band + first;
    for (int i = j; i < inside; ++i) column[i] += wj * v[i];
    column = values_.data() + offset_[first + j].border + first;
    for (int i = std::max(j, inside); i < width; ++i) column[i] += wj * v[i];
  }
}

void BandedMatrix::addCrossProduct(const double* u, int u_first, int u_width, const double* v, int v_first, int v_width, double w) {
  const int inside = std::clamp(band_ - u_first, 0, u_width);
  for (int j = 0; j < v_width; ++j) {
    if (v[j] == 0.) continue;
    const double wj = w * v[j];
    double* column = values_.data() + offset_[v_first + j].band + u_first;
    for (int i = 0; i < inside; ++i) column[i] += wj * u[i];
    column = values_.data() + offset_[v_first + j].border + u_first;
    for (int i = inside; i < u_width; ++i) column[i] += wj * u[i];
  }
}

}  // namespace kinegraph
