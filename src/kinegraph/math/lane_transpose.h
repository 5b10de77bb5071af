#pragma once

// Transposition between rows of numbers, one per configuration, and packs with one configuration per lane.

#include <utility>

#include "kinegraph/math/lane_math.h"

namespace kinegraph::lanes {

namespace {

/// Exchanges the off-diagonal blocks in each pair of packs with distance `Half`.
template <int Half, class S, int... Lane>
[[gnu::always_inline]] inline void forceExchangeBlocks(S* packs, std::integer_sequence<int, Lane...>) {
  constexpr int kCount = sizeof...(Lane);
  for (int i = 0; i < kCount; ++i) {
    if (i & Half) continue;
    const S a = packs[i], b = packs[i + Half];
    packs[i] = __builtin_shufflevector(a, b, (Lane & Half ? kCount + Lane - Half : Lane)...);
    packs[i + Half] = __builtin_shufflevector(a, b, (Lane & Half ? kCount + Lane : Lane + Half)...);
  }
}

/// Transposes as many packs as they have lanes: number j of pack i becomes number i of pack j.
template <class S>
[[gnu::always_inline]] inline void transpose(S* packs) {
  constexpr std::make_integer_sequence<int, kWidth<S>> lanes;
  forceExchangeBlocks<1>(packs, lanes);
  if constexpr (kWidth < S >> 2) forceExchangeBlocks<2>(packs, lanes);
  if constexpr (kWidth < S >> 4) forceExchangeBlocks<4>(packs, lanes);
}

template <class S>
S loadUnaligned(const double* from) {
  S pack;
  __builtin_memcpy(&pack, from, sizeof(S));
  return pack;
}

/// Sets packs[k] to entry k of `count` rows with distance `stride`; lanes without a row repeat the last row.
template <class S>
void gatherRows(const double* rows, long stride, int count, int size, S* packs) {
  constexpr int kCount = kWidth<S>;
  int k = 0;
  for (; k + kCount <= size; k += kCount) {
    for (int i = 0; i < kCount; ++i) packs[k + i] = loadUnaligned<S>(rows + (i < count ? i : count - 1) * stride + k);
    transpose(packs + k);
  }
  for (; k < size; ++k) {
    for (int i = 0; i < kCount; ++i) packs[k][i] = rows[(i < count ? i : count - 1) * stride + k];
  }
}

/// Copies the first `count` lanes back to rows.
template <class S>
void scatterRows(const S* packs, int size, double* rows, long stride, int count) {
  constexpr int kCount = kWidth<S>;
  if (count < kCount || size < kCount) {
    for (int i = 0; i < count; ++i) {
      const double* from = reinterpret_cast<const double*>(packs) + i;
      for (int k = 0; k < size; ++k) rows[i * stride + k] = from[k * kCount];
    }
    return;
  }
  for (int k = 0;;) {
    S square[kCount];
    for (int i = 0; i < kCount; ++i) square[i] = packs[k + i];
    transpose(square);
    for (int i = 0; i < kCount; ++i) __builtin_memcpy(rows + i * stride + k, &square[i], sizeof(S));
    if (k + kCount == size) return;
    k = k + 2 * kCount <= size ? k + kCount : size - kCount;  // the last block may overlap the one before
  }
}

}  // namespace

}  // namespace kinegraph::lanes
