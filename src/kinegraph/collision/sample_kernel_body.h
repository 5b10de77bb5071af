// The kernel of sample_kernel.h for registers of `kLanes` doubles. Each source file that includes this is compiled for
// its own instruction set; all names are local to it.

#include "kinegraph/collision/sample_kernel.h"
#include "kinegraph/collision/support_lanes.h"
#include "kinegraph/kinematics/place_lanes.h"
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
    const auto X = moved<Vector>(packs(poses) + long(g) * link_rows + link_row, offset.rotation, offset.R, offset.p);
    Lane* to = packs(rows) + g * SampleKernel::kPerBody;
    storePlace(X, to);
    store(X.p + combine(X.R, offset.center), to + 12);
  }
}

void boundSamplePoint(const double* poses, int link_rows, int link_row, const double* point, int groups,
                      double* sphere) {
  Vector at[SampleKernel::kLanes / kLanes], low{}, high{};
  for (int g = 0; g < groups; ++g) {
    const Place<Vector> X = placeAt(poses, link_rows, link_row, g);
    at[g] = X.p + combine(X.R, point);
    low = g == 0 ? at[0] : Vector{smaller(low.x, at[g].x), smaller(low.y, at[g].y), smaller(low.z, at[g].z)};
    high = g == 0 ? at[0] : Vector{larger(high.x, at[g].x), larger(high.y, at[g].y), larger(high.z, at[g].z)};
  }
  const auto middleOf = [](Lane least, Lane most) { return .5 * (leastOf(least) - leastOf(-most)); };
  sphere[0] = middleOf(low.x, high.x), sphere[1] = middleOf(low.y, high.y), sphere[2] = middleOf(low.z, high.z);
  const Vector middle = {all<Lane>(sphere[0]), all<Lane>(sphere[1]), all<Lane>(sphere[2])};
  Lane square{};
  for (int g = 0; g < groups; ++g) {
    const Vector away = at[g] - middle;
    square = larger(square, dot(away, away));
  }
  sphere[3] = __builtin_sqrt(-leastOf(-square));
}

/// Tests whether a sphere may come within `margin` of static boxes.
void nearBoxes(const SampleKernel::FixedBoxes& boxes, const double* sphere, double margin, std::int64_t* near) {
  const Vector center = {all<Lane>(sphere[0]), all<Lane>(sphere[1]), all<Lane>(sphere[2])};
  const Lane reach = all<Lane>(sphere[3] + margin);
  for (int g = 0; g * kLanes < boxes.count; ++g) {
    const Lane* rows = packs(boxes.rows) + g * SampleKernel::FixedBoxes::kRows;
    const Vector apart = center - load(rows + 9);
    Lane square{};
    for (int k = 0; k < 3; ++k) {
      const Lane away = larger(magnitude(dot(load(rows + 3 * k), apart)) - rows[12 + k], Lane{});
      square = square + away * away;
    }
    const Lane needed = larger(reach + rows[15], Lane{}), around = reach + rows[16];
    const auto is_near = ((square <= needed * needed) & (dot(apart, apart) <= around * around)) | (around < Lane{});
    __builtin_memcpy(near + g * kLanes, &is_near, sizeof(is_near));
  }
}

/// The gap of boxes A and B along the direction from B to the center of A. Lowers `top` to an upper bound of the
/// distance of the body in A from B.
Lane boxGap(const Lane* rows_a, const SampleKernel::Box& a, const Lane* rows_b, const SampleKernel::Box& b, Lane& top) {
  const Vector apart = load(rows_a + 12) - load(rows_b + 12);
  Lane square{};
  Vector world{};
  for (int k = 0; k < 3; ++k) {  // from the closest point of B, in its axes
    const Vector axis = load(rows_b + 3 * k);
    const Lane along = dot(axis, apart), half = all<Lane>(b.half[k]),
               away = along - smaller(larger(along, -half), half);
    square = square + away * away;
    world = world + away * axis;
  }
  Lane extent{};
  for (int k = 0; k < 3; ++k) {
    if (a.half[k] > 0.) extent = extent + a.half[k] * magnitude(dot(load(rows_a + 3 * k), world));
  }
  const Lane norm = root(square);
  if (b.is_whole) top = smaller(top, norm - a.inner);
  const Lane least = all<Lane>(1e-9), nothing = all<Lane>(-__builtin_inf());
  return norm > least ? norm - extent / larger(norm, least) : nothing;
}

void sampleBoxGaps(const SampleKernel::Box& a, const SampleKernel::Box& b, int groups, double enough, double* gaps,
                   double* tops) {
  for (int g = 0; g < groups; ++g) {
    const Lane *of_a = packs(a.rows) + g * SampleKernel::kPerBody, *of_b = packs(b.rows) + g * SampleKernel::kPerBody;
    Lane gap = all<Lane>(-__builtin_inf()), top = all<Lane>(__builtin_inf());
    if (a.is_point || !b.is_point) gap = boxGap(of_a, a, of_b, b, top);
    if (!a.is_point && any(gap < all<Lane>(enough))) gap = larger(gap, boxGap(of_b, b, of_a, a, top));
    packs(gaps)[g] = gap;
    packs(tops)[g] = top;
  }
}

/// The least of n p over the points p of the core.
Lane leastAlong(SampleKernel::PlacedConvex& body, int group, const Vector& n) {
  const Lane* X = packs(body.rows) + group * SampleKernel::kPerBody;
  const Vector local = {-dot(load(X), n), -dot(load(X + 3), n), -dot(load(X + 6), n)};
  return dot(n, load(X + 9)) - reachAlong(*body.core, local, body.corner);
}

void sampleGaps(SampleKernel::PlacedConvex& a, SampleKernel::PlacedConvex& b, const double* n, const double* poses,
                int link_rows, int link_row, int groups, double* gaps) {
  Vector world = {all<Lane>(n[0]), all<Lane>(n[1]), all<Lane>(n[2])};
  for (int g = 0; g < groups; ++g) {
    if (poses) {
      const auto X = placeAt(poses, link_rows, link_row, g);
      world = n[0] * X.R[0] + n[1] * X.R[1] + n[2] * X.R[2];
    }
    packs(gaps)[g] = leastAlong(a, g, world) + leastAlong(b, g, -world);
  }
}

constexpr SampleKernel kKernel = {kLanes,    placeSampleLinks, placeSampleBody, boundSamplePoint,
                                  nearBoxes, sampleBoxGaps,    sampleGaps};

}  // namespace

}  // namespace kinegraph::lanes
