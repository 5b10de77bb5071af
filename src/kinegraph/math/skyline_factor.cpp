#include <algorithm>
#include <cmath>

#include "kinegraph/math/skyline.h"

// The Cholesky factorization goes through the columns in panels of four, and takes the products of each panel off all rows
// that reach into it before it goes on: four columns at a time, so that a row is read and written once per panel. Small matrices
// are factorized row by row.

namespace kinegraph {

namespace {

constexpr int kPanel = SkylineMatrix::kPanel;
typedef double Pack __attribute__((vector_size(kPanel * sizeof(double)), aligned(sizeof(double)), may_alias));

[[gnu::always_inline]] inline const Pack& packAt(const double* x) { return *reinterpret_cast<const Pack*>(x); }

/// row[j] -= sum_p l[p] column_p[j] for j in [0, count), and for some beyond up to a multiple of the panel if `whole`. The
/// columns lie behind one another, `stride` apart.
[[gnu::always_inline]] inline void subtractProducts(double* row, const double* l, const double* column, std::ptrdiff_t stride,
                                                    int count, bool whole) {
  const double *c0 = column, *c1 = c0 + stride, *c2 = c1 + stride, *c3 = c2 + stride;
  const double l0 = l[0], l1 = l[stride], l2 = l[2 * stride], l3 = l[3 * stride];
  int j = 0;
  for (const int end = whole ? count : count - kPanel + 1; j < end; j += kPanel) {
    Pack& target = *reinterpret_cast<Pack*>(row + j);
    target = target - ((l0 * packAt(c0 + j) + l1 * packAt(c1 + j)) + (l2 * packAt(c2 + j) + l3 * packAt(c3 + j)));
  }
  for (; j < count; ++j) row[j] = row[j] - ((l0 * c0[j] + l1 * c1[j]) + (l2 * c2[j] + l3 * c3[j]));
}

/// Writes four rows of four as columns.
[[gnu::always_inline]] inline void transpose(const double* r0, const double* r1, const double* r2, const double* r3, double* column,
                                             std::ptrdiff_t stride) {
  typedef long long Order __attribute__((vector_size(kPanel * sizeof(long long))));
  const Order even = {0, 4, 2, 6}, odd = {1, 5, 3, 7}, low = {0, 1, 4, 5}, high = {2, 3, 6, 7};
  const Pack e01 = __builtin_shuffle(packAt(r0), packAt(r1), even), o01 = __builtin_shuffle(packAt(r0), packAt(r1), odd);
  const Pack e23 = __builtin_shuffle(packAt(r2), packAt(r3), even), o23 = __builtin_shuffle(packAt(r2), packAt(r3), odd);
  *reinterpret_cast<Pack*>(column) = __builtin_shuffle(e01, e23, low);
  *reinterpret_cast<Pack*>(column + stride) = __builtin_shuffle(o01, o23, low);
  *reinterpret_cast<Pack*>(column + 2 * stride) = __builtin_shuffle(e01, e23, high);
  *reinterpret_cast<Pack*>(column + 3 * stride) = __builtin_shuffle(o01, o23, high);
}

/// column -= column[0] of `left` times `left`, with some entries beyond `count`.
[[gnu::always_inline]] inline void subtractColumn(double* column, const double* left, int count) {
  const double l = left[0];
  for (int r = 0; r < count; r += kPanel) {
    Pack& target = *reinterpret_cast<Pack*>(column + r);
    target = target - l * packAt(left + r);
  }
}

[[gnu::always_inline]] inline void scaleColumn(double* column, double factor, int count) {
  for (int r = 0; r < count; r += kPanel) *reinterpret_cast<Pack*>(column + r) *= factor;
}

}  // namespace

/// One panel, columns [begin, begin + width): the entries of the rows that reach into it are copied into columns that lie
/// side by side in memory, factorized there, put back, and their products are taken off the rest of these rows.
[[gnu::always_inline]] inline bool SkylineMatrix::factorizePanel(int begin, int width, std::span<const Run> runs) {
  double *values = values_.data(), *panel = panel_.data();
  const std::ptrdiff_t stride = std::ptrdiff_t(panel_.size()) / kPanel;
  int rows = 0;
  for (const Run& run : runs) {
    const int end = run.row + run.count;
    for (int row = run.row; row < end;) {
      const auto isFull = [&](int r) __attribute__((always_inline)) { return first_[r] <= begin && r >= begin + kPanel - 1; };
      if (row + kPanel <= end && isFull(row) && isFull(row + 1) && isFull(row + 2) && isFull(row + 3)) {
        const double* entries = values + begin;
        transpose(entries + offset_[row], entries + offset_[row + 1], entries + offset_[row + 2], entries + offset_[row + 3],
                  panel + rows, stride);
        row += kPanel;
        rows += kPanel;
        continue;
      }
      for (int p = 0; p < kPanel; ++p) {
        const int column = begin + p;
        panel[p * stride + rows] = p < width && column <= row && column >= first_[row] ? values[offset_[row] + column] : 0.;
      }
      ++row;
      ++rows;
    }
  }
  for (int p = 0; p < width; ++p) {
    double* column = panel + p * stride;
    for (int q = 0; q < p; ++q) subtractColumn(column + p, panel + q * stride + p, rows - p);
    if (!(column[p] > 0.) || !std::isfinite(column[p])) return false;
    const double root = std::sqrt(column[p]);
    scaleColumn(column + p, 1. / root, rows - p);
    column[p] = root;
  }
  int place = 0;
  for (const Run& run : runs) {
    for (int row = run.row; row < run.row + run.count; ++row, ++place) {
      double* entries = values + offset_[row];
      const int end = std::min(width, row - begin + 1);
      for (int p = std::max(0, first_[row] - begin); p < end; ++p) entries[begin + p] = panel[p * stride + place];
      if (place < width) continue;  // that row belongs to the panel
      int columns = 0;  // of the rest of the row, those that are rows of the panel above
      for (const Run& other : runs) {
        const int skipped = columns == 0 ? width : 0;  // the panel's own
        const int first = other.row + skipped, count = std::min(other.row + other.count, row + 1) - first;
        if (count > 0) {
          const bool last = first + count == row + 1;
          subtractProducts(entries + first, panel + place, panel + columns + skipped, stride, count, last);
        }
        columns += other.count;
        if (other.row + other.count > row) break;
      }
    }
  }
  return true;
}

/// Row by row.
bool SkylineMatrix::factorizeSmall() {
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

[[gnu::always_inline]] inline bool SkylineMatrix::factorizePanels() {
  if (size() <= 2 * kPanel) return factorizeSmall();
  for (int panel = 0; panel + 1 < int(first_run_.size()); ++panel) {
    const int begin = panel * kPanel, width = std::min(kPanel, size() - begin);
    const std::span<const Run> runs(runs_.data() + first_run_[panel], runs_.data() + first_run_[panel + 1]);
    if (!factorizePanel(begin, width, runs)) return false;
  }
  return true;
}

#if defined(__x86_64__)

[[gnu::target("avx2")]] bool SkylineMatrix::factorizeWide() { return factorizePanels(); }

bool SkylineMatrix::factorize() {
  static const bool wide = __builtin_cpu_supports("avx2");
  return wide ? factorizeWide() : factorizePanels();
}

#else

bool SkylineMatrix::factorize() { return factorizePanels(); }

#endif

}  // namespace kinegraph
