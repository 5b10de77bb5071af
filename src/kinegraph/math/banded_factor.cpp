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

/// y[i] += factor a[i], and the sum of a[i] x[i], for i in [begin, end).
[[gnu::always_inline]] inline double addColumn(const double* a, double factor, const double* x, double* y, int begin, int end) {
  Pack sums = {0., 0., 0., 0.};
  int i = begin;
  for (; i + kPack <= end; i += kPack) {
    packAt(y + i) = packAt(y + i) + factor * packAt(a + i);
    sums += packAt(a + i) * packAt(x + i);
  }
  double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  for (; i < end; ++i) {
    y[i] += factor * a[i];
    sum += a[i] * x[i];
  }
  return sum;
}

/// x[i] -= factor a[i]
[[gnu::always_inline]] inline void subtractColumn(const double* a, double factor, double* x, int begin, int end) {
  int i = begin;
  for (; i + kPack <= end; i += kPack) packAt(x + i) = packAt(x + i) - factor * packAt(a + i);
  for (; i < end; ++i) x[i] -= factor * a[i];
}

[[gnu::always_inline]] inline double sumOfProducts(const double* a, const double* x, int begin, int end) {
  Pack sums = {0., 0., 0., 0.};
  int i = begin;
  for (; i + kPack <= end; i += kPack) sums += packAt(a + i) * packAt(x + i);
  double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  for (; i < end; ++i) sum += a[i] * x[i];
  return sum;
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

[[gnu::always_inline]] inline void BandedMatrix::product(const double* x, double* y) const {
  for (int j = 0; j < size(); ++j) {
    double sum = at(j, j) * x[j];
    if (j < band_) sum += addColumn(values_.data() + offset_[j].band, x[j], x, y, j + 1, last_[j] + 1);
    sum += addColumn(values_.data() + offset_[j].border, x[j], x, y, std::max(j + 1, band_), size());
    y[j] += sum;
  }
}

[[gnu::always_inline]] inline void BandedMatrix::solve(double* x) const {
  const double* values = values_.data();
  for (int j = 0; j < size(); ++j) {
    x[j] *= inverse_[j];
    if (j < band_) subtractColumn(values + offset_[j].band, x[j], x, j + 1, last_[j] + 1);
    subtractColumn(values + offset_[j].border, x[j], x, std::max(j + 1, band_), size());
  }
  for (int j = size() - 1; j >= 0; --j) {
    double sum = sumOfProducts(values + offset_[j].border, x, std::max(j + 1, band_), size());
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
[[gnu::target("avx2")]] void BandedMatrix::productWide(const double* x, double* y) const { product(x, y); }
[[gnu::target("avx2")]] void BandedMatrix::solveWide(double* x) const { solve(x); }

bool BandedMatrix::factorize() { return hasWideRegisters() ? factorizeWide() : factorizeAll(); }

void BandedMatrix::addProduct(const VectorXd& x, VectorXd& y) const {
  hasWideRegisters() ? productWide(x.data(), y.data()) : product(x.data(), y.data());
}

void BandedMatrix::solveInPlace(VectorXd& x) const { hasWideRegisters() ? solveWide(x.data()) : solve(x.data()); }

#else

bool BandedMatrix::factorize() { return factorizeAll(); }
void BandedMatrix::addProduct(const VectorXd& x, VectorXd& y) const { product(x.data(), y.data()); }
void BandedMatrix::solveInPlace(VectorXd& x) const { solve(x.data()); }

#endif

}  // namespace kinegraph
