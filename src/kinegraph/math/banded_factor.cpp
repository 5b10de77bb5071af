#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/math/banded_matrix.h"

// The factorization L D L^T processes panels of four columns. It subtracts the products of a panel from all later
// columns in its band, four at a time, to read and write these once per panel. Each column stores L D and the inverse
// of D, so that it waits for one division of the column before. The order of sums does not depend on the width of
// registers.

namespace kinegraph::inline math_internal {

namespace {

constexpr int kPack = 4;
typedef double Pack __attribute__((vector_size(kPack * sizeof(double)), aligned(sizeof(double)), may_alias));

[[gnu::always_inline]] inline Pack& packAt(double* x) { return *reinterpret_cast<Pack*>(x); }
[[gnu::always_inline]] inline const Pack& packAt(const double* x) { return *reinterpret_cast<const Pack*>(x); }

/// Computes target[i] -= factor source[i] for i in [begin, end), rounded up to whole packs.
[[gnu::always_inline]] inline void subtract(double* target, double factor, const double* source, int begin, int end) {
  for (int i = begin; i < end; i += kPack) packAt(target + i) = packAt(target + i) - factor * packAt(source + i);
}

/// Computes target[i] -= sum_p factors[p] columns[p][i] for i in [begin, end), rounded up to whole packs.
[[gnu::always_inline]] inline void subtractProducts(double* target, const std::array<const double*, kPack>& columns,
                                                    const std::array<double, kPack>& factors, int begin, int end) {
  const double *c0 = columns[0], *c1 = columns[1], *c2 = columns[2], *c3 = columns[3];
  const double l0 = factors[0], l1 = factors[1], l2 = factors[2], l3 = factors[3];
  for (int i = begin; i < end; i += kPack) {
    packAt(target + i) = packAt(target + i) -
                         ((l0 * packAt(c0 + i) + l1 * packAt(c1 + i)) + (l2 * packAt(c2 + i) + l3 * packAt(c3 + i)));
  }
}

/// Adds factor a[i] to y[i] and returns the sum of a[i] x[i], for i in [begin, end) and zero padding.
[[gnu::always_inline]] inline double addColumn(const double* a, double factor, const double* x, double* y, int begin,
                                               int end) {
  Pack sums = {0., 0., 0., 0.};
  for (int i = begin; i < end; i += kPack) {
    packAt(y + i) = packAt(y + i) + factor * packAt(a + i);
    sums += packAt(a + i) * packAt(x + i);
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Adds columns[p][i] x[i] to sums[p] for i in [begin, end) and zero padding.
[[gnu::always_inline]] inline void addProducts(Pack (&sums)[kPack], const std::array<const double*, kPack>& columns,
                                               const double* x, int begin, int end) {
  for (int i = begin; i < end; i += kPack) {
    const Pack xi = packAt(x + i);
    for (int p = 0; p < kPack; ++p) sums[p] += packAt(columns[p] + i) * xi;
  }
}

}  // namespace

/// Returns up to four columns from `begin` on, all of the band or all of the border; missing ones repeat the first.
[[gnu::always_inline]] inline BandedMatrix::Panel BandedMatrix::panelAt(int begin) const {
  const bool in_band = begin < band_;
  Panel panel;
  panel.begin = begin;
  panel.width = std::min(kPanel, (in_band ? band_ : size()) - begin);
  panel.end = in_band ? last_[begin] + 1 : size();
  panel.has_border = in_band && band_ < size();
  for (int p = 0; p < kPanel; ++p) {
    const Offset& offset = offset_[begin + (p < panel.width ? p : 0)];
    panel.columns[p] = values_.data() + (in_band ? offset.band : offset.border);
    panel.borders[p] = values_.data() + offset.border;
  }
  return panel;
}

[[gnu::always_inline]] inline bool BandedMatrix::factorizePanel(int begin) {
  double* values = values_.data();
  const int n = size();
  const Panel panel = panelAt(begin);
  const bool in_band = begin < band_;
  const auto column = [&](int j) __attribute__((always_inline)) {
    return values + (in_band ? offset_[j].band : offset_[j].border);
  };
  for (int p = 0; p < panel.width; ++p) {
    const int j = begin + p;
    double *own = column(j), *own_border = values + offset_[j].border;
    for (int q = 0; q < p; ++q) {
      const double factor = panel.columns[q][j] * inverse_[begin + q];
      subtract(own, factor, panel.columns[q], j, panel.end);
      if (panel.has_border) subtract(own_border, factor, panel.borders[q], band_, n);
    }
    if (!(own[j] > 0.) || !std::isfinite(own[j])) return false;
    inverse_[j] = 1. / own[j];
  }
  takeProducts(panel, begin + panel.width);
  return true;
}

/// Subtracts the products of a factorized panel from its later columns, from `first` on.
[[gnu::always_inline]] inline void BandedMatrix::takeProducts(const Panel& panel, int first) {
  double* values = values_.data();
  const int n = size();
  const bool in_band = panel.begin < band_;
  std::array<double, kPanel> inverse{}, factors;  // zero for missing columns
  for (int p = 0; p < panel.width; ++p) inverse[p] = inverse_[panel.begin + p];
  for (int j = first; j < panel.end; ++j) {
    double* target = values + (in_band ? offset_[j].band : offset_[j].border);
    for (int p = 0; p < kPanel; ++p) factors[p] = inverse[p] * panel.columns[p][j];
    subtractProducts(target, panel.columns, factors, j, panel.end);
    if (panel.has_border) subtractProducts(values + offset_[j].border, panel.borders, factors, band_, n);
  }
  for (int j = panel.has_border ? band_ : n; j < n; ++j) {
    for (int p = 0; p < kPanel; ++p) factors[p] = inverse[p] * panel.borders[p][j];
    subtractProducts(values + offset_[j].border, panel.borders, factors, j, n);
  }
}

[[gnu::always_inline]] inline bool BandedMatrix::factorizeAll(int first) {
  for (int begin = 0; begin < first; begin += kPanel) {
    if (last_[begin] >= first) takeProducts(panelAt(begin), first);
  }
  for (int begin = first; begin < band_; begin += kPanel) {
    if (!factorizePanel(begin)) return false;
  }
  for (int begin = band_; begin < size(); begin += kPanel) {
    if (!factorizePanel(begin)) return false;
  }
  return true;
}

/// Computes y_ = this * x_.
[[gnu::always_inline]] inline void BandedMatrix::product() {
  const double *values = values_.data(), *x = x_.data();
  double* y = y_.data();
  const int n = size();
  std::fill(y_.begin(), y_.end(), 0.);
  for (int j = 0; j < band_; ++j) {
    double sum =
        addColumn(values + offset_[j].band, x[j], x, y, j + 1, last_[j] + 1) + values[offset_[j].band + j] * x[j];
    if (band_ < n) sum += addColumn(values + offset_[j].border, x[j], x, y, band_, n);
    y[j] += sum;
  }
  for (int j = band_; j < n; ++j) {
    const double* column = values + offset_[j].border;
    y[j] += addColumn(column, x[j], x, y, j + 1, n) + column[j] * x[j];
  }
}

/// Replaces x_ by the solution, panel by panel to shorten chains of dependent operations.
[[gnu::always_inline]] inline void BandedMatrix::solve() {
  double* x = x_.data();
  const int n = size();
  const int band_panels = (band_ + kPanel - 1) / kPanel, panels = band_panels + (border() + kPanel - 1) / kPanel;
  for (int i = 0; i < panels; ++i) {
    const Panel panel = panelAt(i < band_panels ? i * kPanel : band_ + (i - band_panels) * kPanel);
    std::array<double, kPanel> own = {0., 0., 0., 0.};
    for (int p = 0; p < panel.width; ++p) {
      const int j = panel.begin + p;
      own[p] = x[j];
      for (int q = 0; q < p; ++q) own[p] -= panel.columns[q][j] * own[q];
      x[j] = own[p] *= inverse_[j];
    }
    subtractProducts(x, panel.columns, own, panel.begin + panel.width, panel.end);
    if (panel.has_border) subtractProducts(x, panel.borders, own, band_, n);
  }
  for (int i = panels - 1; i >= 0; --i) {
    const Panel panel = panelAt(i < band_panels ? i * kPanel : band_ + (i - band_panels) * kPanel);
    constexpr Pack zero = {0., 0., 0., 0.};
    Pack sums[kPanel] = {zero, zero, zero, zero};
    addProducts(sums, panel.columns, x, panel.begin + panel.width, panel.end);
    if (panel.has_border) addProducts(sums, panel.borders, x, band_, n);
    for (int p = panel.width - 1; p >= 0; --p) {
      const int j = panel.begin + p;
      double rest = (sums[p][0] + sums[p][1]) + (sums[p][2] + sums[p][3]);
      for (int q = p + 1; q < panel.width; ++q) rest += panel.columns[p][panel.begin + q] * x[panel.begin + q];
      x[j] -= rest * inverse_[j];
    }
  }
}

#if defined(__x86_64__)

namespace {

bool hasWideRegisters() {
  static const bool wide = __builtin_cpu_supports("avx2");
  return wide;
}

}  // namespace

[[gnu::target("avx2")]] bool BandedMatrix::factorizeWide(int first) { return factorizeAll(first); }
[[gnu::target("avx2")]] void BandedMatrix::productWide() { product(); }
[[gnu::target("avx2")]] void BandedMatrix::solveWide() { solve(); }

#else

namespace {

constexpr bool hasWideRegisters() { return false; }

}  // namespace

bool BandedMatrix::factorizeWide(int first) { return factorizeAll(first); }
void BandedMatrix::productWide() { product(); }
void BandedMatrix::solveWide() { solve(); }

#endif

bool BandedMatrix::factorize(int first) { return hasWideRegisters() ? factorizeWide(first) : factorizeAll(first); }

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

}  // namespace kinegraph::inline math_internal
