// The kernel of sample_kernel.h for registers of `kLanes` doubles. Each source file that includes this is compiled for
// its own instruction set; all names are local to it.

#include "kinegraph/kinematics/place_lanes.h"
#include "kinegraph/kinematics/sample_kernel.h"
#include "kinegraph/math/lane_transpose.h"

namespace kinegraph::lanes {

namespace {

using Lane = Pack<kLanes>;
using Vector = Vec3<Lane>;

const Lane* packs(const double* numbers) { return reinterpret_cast<const Lane*>(numbers); }
Lane* packs(double* numbers) { return reinterpret_cast<Lane*>(numbers); }

void placeSampleLinks(const LaneModel& model, const double* Q, int count, int groups, const LaneMemory& memory) {
  const int n = model.variables;
  for (int g = 0; g < groups; ++g) {
    const int first = g * kLanes < count ? g * kLanes : count - 1, left = count - first;
    gatherRows(Q + long(first) * n, n, left < kLanes ? left : kLanes, n, packs(memory.x));
    placeLinks(model, packs(memory.x), packs(memory.pose) + long(g) * model.links * LaneMemory::kPerPose,
               packs(memory.motion));
  }
}

Place<Vector> placeAt(const double* poses, int link_rows, int link_row, int group) {
  const Lane* from = packs(poses) + long(group) * link_rows + link_row;
  return {{load(from), load(from + 3), load(from + 6)}, load(from + 9)};
}

void placeSampleBody(const double* poses, int link_rows, int link_row, const SampleKernel::Offset& offset, int groups,
                     double* rows) {
  for (int g = 0; g < groups; ++g) {
    const auto X = moved<Vector>(packs(poses) + long(g) * link_rows + link_row, offset.turn, offset.R, offset.p);
    Lane* to = packs(rows) + g * SampleKernel::kPerBody;
    storePlace(X, to);
    store(X.p + combine(X.R, offset.center), to + 12);
  }
}

void boundSamplePoint(const double* poses, int link_rows, int link_row, const double* point, int groups,
                      double* sphere) {
  Vector at[SampleKernel::kLanes / kLanes];
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (int g = 0; g < groups; ++g) {
    const Place<Vector> X = placeAt(poses, link_rows, link_row, g);
    at[g] = X.p + combine(X.R, point);
    const Lane of[3] = {at[g].x, at[g].y, at[g].z};
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < kLanes; ++i) {
        low[k] = smaller(low[k], double(of[k][i]));
        high[k] = larger(high[k], double(of[k][i]));
      }
    }
  }
  for (int k = 0; k < 3; ++k) sphere[k] = .5 * (low[k] + high[k]);
  const Vector middle = {all<Lane>(sphere[0]), all<Lane>(sphere[1]), all<Lane>(sphere[2])};
  double square = 0.;
  for (int g = 0; g < groups; ++g) {
    const Vector away = at[g] - middle;
    const Lane squares = dot(away, away);
    for (int i = 0; i < kLanes; ++i) square = larger(square, double(squares[i]));
  }
  sphere[3] = __builtin_sqrt(square);
}

/// How far a box A is from a box B along the direction from B to the middle of A.
Lane boxGap(const Lane* rows_a, const double* half_a, const Lane* rows_b, const double* half_b) {
  const Vector apart = load(rows_a + 12) - load(rows_b + 12);
  Lane square{};
  Vector world{};
  for (int k = 0; k < 3; ++k) {  // from the nearest point of B, in its axes
    const Vector axis = load(rows_b + 3 * k);
    const Lane along = dot(axis, apart), half = all<Lane>(half_b[k]),
               away = along - smaller(larger(along, -half), half);
    square = square + away * away;
    world = world + away * axis;
  }
  Lane extent{};
  for (int k = 0; k < 3; ++k) {
    if (half_a[k] > 0.) extent = extent + half_a[k] * magnitude(dot(load(rows_a + 3 * k), world));
  }
  const Lane norm = root(square), least = all<Lane>(1e-9), nothing = all<Lane>(-__builtin_inf());
  return norm > least ? norm - extent / larger(norm, least) : nothing;
}

void sampleBoxGaps(const SampleKernel::Box& a, const SampleKernel::Box& b, int groups, double enough, double* gaps) {
  for (int g = 0; g < groups; ++g) {
    const Lane *of_a = packs(a.rows) + g * SampleKernel::kPerBody, *of_b = packs(b.rows) + g * SampleKernel::kPerBody;
    Lane gap = all<Lane>(-__builtin_inf());
    if (a.is_point || !b.is_point) gap = boxGap(of_a, a.half, of_b, b.half);
    if (!a.is_point && any(gap < all<Lane>(enough))) gap = larger(gap, boxGap(of_b, b.half, of_a, a.half));
    packs(gaps)[g] = gap;
  }
}

constexpr SampleKernel kKernel = {kLanes, placeSampleLinks, placeSampleBody, boundSamplePoint, sampleBoxGaps};

}  // namespace

}  // namespace kinegraph::lanes
