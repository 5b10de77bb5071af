#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/math/banded_matrix.h"

// The Cholesky factorization goes through the columns in panels of four, and takes the products of each panel off all columns
// that it reaches, four at a time, so that these are read and written once per panel. No sum depends on the width of registers.

namespace kinegraph {

namespace {

constexpr int kPack = 4;
typedef double Pack __attribute__((vector_size(kPack * sizeof(double)), aligned(sizeof(double)), may_alias));

[[gnu::always_inline]] inline Pack& packAt(double* x) { return *reinterpret_cast<Pack*>(x); }
[[gnu::always_inline]] inline const Pack& packAt(const double* x) { return *reinterpret_cast<const Pack*>(x); }

/// target[i] -= factor source[i] for i in [begin, end), and for some beyond up to a whole pack.
[[gnu::always_inline]] inline void subtract(double* target, double factor, const double* source, int begin, int end) {
  for (int i = begin; i < end; i += kPack) packAt(target + i) = packAt(target + i) - factor * packAt(source + i);
}

[[gnu::always_inline]] inline void scale(double* target, double factor, int begin, int end) {
  for (int i = begin; i < end; i += kPack) packAt(target + i) *= factor;
}

/// target[i] -= sum_p columns[p][row] columns[p][i] for i in [row, end), and for some beyond up to a whole pack.
[[gnu::always_inline]] inline void subtractProducts(double* target, const std::array<const double*, kPack>& columns,
                                                    const std::array<double, kPack>& factors, int begin, int end) {
  const double *c0 = columns[0], *c1 = columns[1], *c2 = columns[2], *c3 = columns[3];
  const double l0 = factors[0], l1 = factors[1], l2 = factors[2], l3 = factors[3];
  for (int i = begin; i < end; i += kPack) {
    packAt(target + i) = packAt(target + i) - ((l0 * packAt(c0 + i) + l1 * packAt(c1 + i)) + (l2 * packAt(c2 + i) + l3 * packAt(c3 + i)));
  }
}

/// y[i] += factor a[i], and the sum of a[i] x[i], for i in [begin, end) and beyond, where a is zero.
[[gnu::always_inline]] inline double addColumn(const double* a, double factor, const double* x, double* y, int begin, int end) {
  Pack sums = {0., 0., 0., 0.};
  for (int i = begin; i < end; i += kPack) {
    packAt(y + i) = packAt(y + i) + factor * packAt(a + i);
    sums += packAt(a + i) * packAt(x + i);
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

[[gnu::always_inline]] inline double sumOfProducts(const double* a, const double* x, int begin, int end) {
  Pack sums = {0., 0., 0., 0.};
  for (int i = begin; i < end; i += kPack) sums += packAt(a + i) * packAt(x + i);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

/// Columns [begin, begin + width), all of the band or all of the border.
[[gnu::always_inline]] inline bool BandedMatrix::factorizePanel(int begin, int width) {
  double* values = values_.data();
  const int n = size();
  const bool in_band = begin < band_;
  const int end = in_band ? last_[begin] + 1 : n;             // of the rows next to the diagonal
  const bool has_border = in_band && band_ < n;
  const auto column = [&](int j) __attribute__((always_inline)) { return values + (in_band ? offset_[j].band : offset_[j].border); };
  for (int p = 0; p < width; ++p) {
    const int j = begin + p;
    double *own = column(j), *own_border = values + offset_[j].border;
    for (int q = 0; q < p; ++q) {
      const double* left = column(begin + q);
      const double factor = left[j];
      subtract(own, factor, left, j, end);
      if (has_border) subtract(own_border, factor, values + offset_[begin + q].border, band_, n);
    }
    if (!(own[j] > 0.) || !std::isfinite(own[j])) return false;
    const double root = std::sqrt(own[j]);
    inverse_[j] = 1. / root;
    scale(own, inverse_[j], j, end);
    own[j] = root;
    if (has_border) scale(own_border, inverse_[j], band_, n);
  }
  std::array<const double*, kPack> columns, borders;
  std::array<double, kPack> factors{};
  for (int p = 0; p < kPack; ++p) {
    columns[p] = column(begin + (p < width ? p : 0));  // those that are not there have the factor zero
    borders[p] = values + offset_[begin + (p < width ? p : 0)].border;
  }
  for (int j = begin + width; j < end; ++j) {
    for (int p = 0; p < width; ++p) factors[p] = columns[p][j];
    subtractProducts(column(j), columns, factors, j, end);
    if (has_border) subtractProducts(values + offset_[j].border, borders, factors, band_, n);
  }
  for (int j = has_border ? band_ : n; j < n; ++j) {
    for (int p = 0; p < width; ++p) factors[p] = borders[p][j];
    subtractProducts(values + offset_[j].border, borders, factors, j, n);
  }
  return true;
}

[[gnu::always_inline]] inline bool BandedMatrix::factorizeAll() {
  for (int begin = 0; begin < band_; begin += kPanel) {
    if (!factorizePanel(begin, std::min(kPanel, band_ - begin))) return false;
  }
  for (int begin = band_; begin < size(); begin += kPanel) {
    if (!factorizePanel(begin, std::min(kPanel, size() - begin))) return false;
  }
  return true;
}

/// y_ = this * x_
[[gnu::always_inline]] inline void BandedMatrix::product() {
  const double *values = values_.data(), *x = x_.data();
  double* y = y_.data();
  const int n = size();
  std::fill(y_.begin(), y_.end(), 0.);
  for (int j = 0; j < band_; ++j) {
    double sum = addColumn(values + offset_[j].band, x[j], x, y, j + 1, last_[j] + 1) + values[offset_[j].band + j] * x[j];
    if (band_ < n) sum += addColumn(values + offset_[j].border, x[j], x, y, band_, n);
    y[j] += sum;
  }
  for (int j = band_; j < n; ++j) {
    const double* column = values + offset_[j].border;
    y[j] += addColumn(column, x[j], x, y, j + 1, n) + column[j] * x[j];
  }
}

/// x_ <- inverse * x_
[[gnu::always_inline]] inline void BandedMatrix::solve() {
  const double* values = values_.data();
  double* x = x_.data();
  const int n = size();
  for (int j = 0; j < n; ++j) {
    x[j] *= inverse_[j];
    if (j < band_) subtract(x, x[j], values + offset_[j].band, j + 1, last_[j] + 1);
    if (band_ < n) subtract(x, x[j], values + offset_[j].border, std::max(j + 1, band_), n);
  }
  for (int j = n - 1; j >= 0; --j) {
    double sum = 0.;
    if (band_ < n) sum += sumOfProducts(values + offset_[j].border, x, std::max(j + 1, band_), n);
    if (j < band_) sum += sumOfProducts(values + offset_[j].band, x, j + 1, last_[j] + 1);
    x[j] = (x[j] - sum) * inverse_[j];
  }
}

#if defined(__x86_64__)

namespace {

bool hasWideRegisters() {
  static const bool wide = __builtin_cpu_supports("avx2");
  return wide;
}

}  // namespace

[[gnu::target("avx2")]] bool BandedMatrix::factorizeWide() { return factorizeAll(); }
[[gnu::target("avx2")]] void BandedMatrix::productWide() { product(); }
[[gnu::target("avx2")]] void BandedMatrix::solveWide() { solve(); }

#else

namespace {

constexpr bool hasWideRegisters() { return false; }

}  // namespace

bool BandedMatrix::factorizeWide() { return factorizeAll(); }
void BandedMatrix::productWide() { product(); }
void BandedMatrix::solveWide() { solve(); }

#endif

bool BandedMatrix::factorize() { return hasWideRegisters() ? factorizeWide() : factorizeAll(); }

void BandedMatrix::addProduct(const VectorXd& x, VectorXd& y) {
  std::fill(std::copy(x.begin(), x.end(), x_.begin()), x_.end(), 0.);
  hasWideRegisters() ? productWide() : product();
  y += Eigen::Map<const VectorXd>(y_.data(), size());
}

void BandedMatrix::solveInPlace(VectorXd& x) {
  std::fill(std::copy(x.begin(), x.end(), x_.begin()), x_.end(), 0.);
  hasWideRegisters() ? solveWide() : solve();
  std::copy(x_.begin(), x_.begin() + size(), x.begin());
}

}  // namespace kinegraph
