// The kernel of lane_model.h for registers of `kLanes` doubles. Each source file that includes this is compiled for its
// own instruction set; all names are local to it.

#include "kinegraph/kinematics/lane_model.h"
#include "kinegraph/kinematics/place_lanes.h"
#include "kinegraph/math/lane_transpose.h"

namespace kinegraph::lanes {

namespace {

using Lane = Pack<kLanes>;
using Vector = Vec3<Lane>;
using Block = LaneRows::Block;

struct Quaternion {
  Lane w;
  Vector v;
};

/// Of a rotation matrix; the entry of greatest size, or w where the trace is positive, is the positive one.
Quaternion toQuaternion(const Vector* R) {
  const Lane trace = R[0].x + R[1].y + R[2].z;
  const auto w_leads = trace > 0.;
  const auto y_over_x = R[1].y > R[0].x;
  const auto z_leads = R[2].z > (y_over_x ? R[1].y : R[0].x);
  const Lane x_square = ((R[0].x - R[1].y) - R[2].z), y_square = ((R[1].y - R[2].z) - R[0].x),
             z_square = ((R[2].z - R[0].x) - R[1].y);
  const Lane twice = root((w_leads ? trace : z_leads ? z_square : y_over_x ? y_square : x_square) + 1.);
  const Lane lead = .5 * twice, over = .5 / twice;
  const Vector odd = over * Vector{R[1].z - R[2].y, R[2].x - R[0].z, R[0].y - R[1].x};
  const Vector even = over * Vector{R[1].z + R[2].y, R[2].x + R[0].z, R[0].y + R[1].x};  // yz, xz, xy
  Quaternion q;
  q.w = w_leads ? lead : z_leads ? odd.z : y_over_x ? odd.y : odd.x;
  q.v.x = w_leads ? odd.x : z_leads ? even.y : y_over_x ? even.z : lead;
  q.v.y = w_leads ? odd.y : z_leads ? even.x : y_over_x ? lead : even.z;
  q.v.z = w_leads ? odd.z : z_leads ? lead : y_over_x ? even.x : even.y;
  return q;
}

template <class Mask>
Quaternion negated(Mask mask, const Quaternion& q) {
  return {mask ? -q.w : q.w, choose(mask, -q.v, q.v)};
}

Quaternion canonical(const Quaternion& q) {
  const auto z = q.v.z < 0.;
  const auto y = (q.v.y < 0.) | ((q.v.y == 0.) & z);
  const auto x = (q.v.x < 0.) | ((q.v.x == 0.) & y);
  return negated((q.w < 0.) | ((q.w == 0.) & x), q);
}

/// a* b
Quaternion between(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w + dot(a.v, b.v), a.w * b.v - b.w * a.v - cross(a.v, b.v)};
}

Lane inner(const Quaternion& a, const Quaternion& b) { return a.w * b.w + dot(a.v, b.v); }

void storeQuaternion(const Quaternion& q, Lane* y) { y[0] = q.w, store(q.v, y + 1); }

/// dq / dt for an angular velocity
void storeRates(const Quaternion& q, const Vector& w, Lane* to) {
  to[0] = -.5 * dot(q.v, w);
  store(.5 * (q.w * w - cross(q.v, w)), to + 1);
}

/// Transposed R times a.
Vector inFrame(const Vector* R, const Vector& a) { return {dot(R[0], a), dot(R[1], a), dot(R[2], a)}; }

struct Memory {
  Lane *x, *pose, *motion, *frame, *y, *jacobian;
};

/// Writes the Jacobian of a block. `rate(entry, angular velocity, point or velocity, out)` gives the block's rows.
template <int Rows, class Rate>
void fillJacobian(const LaneModel& model, const LaneRows& rows, const Block& block, const Memory& memory,
                  const Rate& rate) {
  const int kept = Rows < block.rows ? Rows : block.rows;
  for (int e = block.first_entry; e < block.first_entry + block.entries; ++e) {
    const LaneRows::Entry& entry = rows.entry[e];
    const Lane* motion = memory.motion + entry.column * LaneMemory::kPerColumn;
    Lane column[Rows];
    rate(entry, load(motion), load(motion + 3), column);
    Lane* to = memory.jacobian + long(block.row) * model.variables + entry.variable;
    if (entry.adds) {
      for (int r = 0; r < kept; ++r) to[long(r) * model.variables] += column[r];
    } else {
      for (int r = 0; r < kept; ++r) to[long(r) * model.variables] = column[r];
    }
  }
}

Vector velocity(const LaneRows::Entry& entry, const Vector& angular, const Vector& point, const Vector& at) {
  return entry.turns ? cross(angular, at - point) : point;
}

void positionBlock(const LaneModel& model, const LaneRows& rows, const Block& block, const Memory& memory,
                   bool with_jacobian) {
  const Lane* a = memory.frame + block.a * LaneMemory::kPerPose;
  const Lane* b = memory.frame + block.b * LaneMemory::kPerPose;
  const Vector p_a = load(a + 9);
  Lane* y = memory.y + block.row;
  if (block.kind == Block::relative) {
    const Vector R[3] = {load(b), load(b + 3), load(b + 6)};
    const Vector value = inFrame(R, p_a - load(b + 9));
    y[0] = value.x;
    if (block.rows > 1) y[1] = value.y;
    if (block.rows > 2) y[2] = value.z;
    if (!with_jacobian) return;
    fillJacobian<3>(model, rows, block, memory,
                    [&](const LaneRows::Entry& entry, const Vector& angular, const Vector& point, Lane* to) {
                      const Vector rate = inFrame(R, velocity(entry, angular, point, p_a));
                      store(entry.of_b ? -rate : rate, to);
                    });
    return;
  }
  if (block.kind == Block::position) {
    store(p_a, y);
    if (!with_jacobian) return;
    fillJacobian<3>(model, rows, block, memory,
                    [&](const LaneRows::Entry& entry, const Vector& angular, const Vector& point, Lane* to) {
                      store(velocity(entry, angular, point, p_a), to);
                    });
    return;
  }
  const Vector p_b = load(b + 9);
  store(p_a - p_b, y);
  if (!with_jacobian) return;
  fillJacobian<3>(model, rows, block, memory,
                  [&](const LaneRows::Entry& entry, const Vector& angular, const Vector& point, Lane* to) {
                    const Vector rate = velocity(entry, angular, point, entry.of_b ? p_b : p_a);
                    store(entry.of_b ? -rate : rate, to);
                  });
}

void quaternionBlock(const LaneModel& model, const LaneRows& rows, const Block& block, const Memory& memory,
                     bool with_jacobian) {
  const auto columns = [&](int frame, Vector* R) {
    for (int k = 0; k < 3; ++k) R[k] = load(memory.frame + frame * LaneMemory::kPerPose + 3 * k);
  };
  Vector R_a[3], R_b[3];
  columns(block.a, R_a);
  const Quaternion q_a = block.canonical ? canonical(toQuaternion(R_a)) : toQuaternion(R_a);
  Lane* y = memory.y + block.row;
  if (block.kind == Block::quaternion) {
    storeQuaternion(q_a, y);
    if (!with_jacobian) return;
    fillJacobian<4>(
        model, rows, block, memory,
        [&](const LaneRows::Entry&, const Vector& angular, const Vector&, Lane* to) { storeRates(q_a, angular, to); });
    return;
  }
  columns(block.b, R_b);
  Quaternion q_b = toQuaternion(R_b);
  if (block.kind == Block::quaternion_relative) {
    const Quaternion q = between(q_b, q_a);
    storeQuaternion(q, y);
    if (!with_jacobian) return;
    fillJacobian<4>(model, rows, block, memory,
                    [&](const LaneRows::Entry& entry, const Vector& angular, const Vector&, Lane* to) {
                      const Vector w = inFrame(R_b, angular);
                      storeRates(q, entry.of_b ? -w : w, to);
                    });
    return;
  }
  q_b = negated(inner(q_a, q_b) < 0., q_b);
  storeQuaternion({q_a.w - q_b.w, q_a.v - q_b.v}, y);
  if (!with_jacobian) return;
  fillJacobian<4>(model, rows, block, memory,
                  [&](const LaneRows::Entry& entry, const Vector& angular, const Vector&, Lane* to) {
                    if (entry.of_b) {
                      storeRates(q_b, -angular, to);
                    } else {
                      storeRates(q_a, angular, to);
                    }
                  });
}

void axisBlock(const LaneModel& model, const LaneRows& rows, const Block& block, const Memory& memory,
               bool with_jacobian) {
  const Lane* a = memory.frame + block.a * LaneMemory::kPerPose;
  const Lane* b = memory.frame + block.b * LaneMemory::kPerPose;
  const Vector u = load(a + 3 * block.axis_a);
  Lane* y = memory.y + block.row;
  switch (block.kind) {
    case Block::axis:
      store(u, y);
      if (!with_jacobian) return;
      fillJacobian<3>(model, rows, block, memory,
                      [&](const LaneRows::Entry&, const Vector& angular, const Vector&, Lane* to) {
                        store(cross(angular, u), to);
                      });
      return;
    case Block::axis_offset: {
      const Vector v = load(b + 3 * block.axis_b);
      store(u - v, y);
      if (!with_jacobian) return;
      fillJacobian<3>(model, rows, block, memory,
                      [&](const LaneRows::Entry& entry, const Vector& angular, const Vector&, Lane* to) {
                        store(entry.of_b ? cross(v, angular) : cross(angular, u), to);
                      });
      return;
    }
    case Block::axis_relative: {
      const Vector R[3] = {load(b), load(b + 3), load(b + 6)};
      store(inFrame(R, u), y);
      if (!with_jacobian) return;
      fillJacobian<3>(model, rows, block, memory,
                      [&](const LaneRows::Entry& entry, const Vector& angular, const Vector&, Lane* to) {
                        store(inFrame(R, entry.of_b ? cross(u, angular) : cross(angular, u)), to);
                      });
      return;
    }
    default: {  // axis_product
      const Vector v = load(b + 3 * block.axis_b);
      *y = dot(u, v);
      if (!with_jacobian) return;
      const Vector across = cross(u, v);
      fillJacobian<1>(model, rows, block, memory,
                      [&](const LaneRows::Entry& entry, const Vector& angular, const Vector&, Lane* to) {
                        *to = dot(across, entry.of_b ? -angular : angular);
                      });
    }
  }
}

void twistBlock(const LaneModel& model, const LaneRows& rows, const Block& block, const Memory& memory) {
  const Vector p_a = load(memory.frame + block.a * LaneMemory::kPerPose + 9);
  fillJacobian<6>(model, rows, block, memory,
                  [&](const LaneRows::Entry& entry, const Vector& angular, const Vector& point, Lane* to) {
                    store(velocity(entry, angular, point, p_a), to);
                    store(angular, to + 3);
                  });
}

void evaluate(const LaneModel& model, const LaneRows& rows, const Memory& memory, bool with_jacobian) {
  for (int f = 0; f < rows.frames; ++f) {
    const LaneRows::Frame& frame = rows.frame[f];
    storePlace(moved<Vector>(memory.pose + frame.link * LaneMemory::kPerPose, frame.turn, frame.R, frame.p),
               memory.frame + f * LaneMemory::kPerPose);
  }
  for (int i = 0; i < rows.blocks; ++i) {
    const Block& block = rows.block[i];
    switch (block.kind) {
      case Block::position:
      case Block::offset:
      case Block::relative:
        positionBlock(model, rows, block, memory, with_jacobian);
        break;
      case Block::quaternion:
      case Block::quaternion_offset:
      case Block::quaternion_relative:
        quaternionBlock(model, rows, block, memory, with_jacobian);
        break;
      case Block::axis:
      case Block::axis_offset:
      case Block::axis_relative:
      case Block::axis_product:
        axisBlock(model, rows, block, memory, with_jacobian);
        break;
      case Block::twist:
        if (with_jacobian) twistBlock(model, rows, block, memory);
        break;
      case Block::joint:
        memory.y[block.row] = block.scale * memory.x[block.a] + block.shift;
        if (with_jacobian) memory.jacobian[long(block.row) * model.variables + block.a] = all<Lane>(block.scale);
        break;
    }
  }
}

void runRows(const LaneModel& model, const LaneRows& rows, const LaneMemory& raw, const LaneBatch& batch) {
  const auto lanes = [](double* numbers) { return reinterpret_cast<Lane*>(numbers); };
  const Memory memory = {lanes(raw.x),     lanes(raw.pose), lanes(raw.motion),
                         lanes(raw.frame), lanes(raw.y),    lanes(raw.jacobian)};
  const int n = model.variables;
  for (int first = 0; first < batch.count; first += kLanes) {
    const int count = batch.count - first < kLanes ? batch.count - first : kLanes;
    gatherRows(batch.Q + first * batch.Q_stride, batch.Q_stride, count, n, memory.x);
    placeLinks(model, memory.x, memory.pose, memory.motion);
    evaluate(model, rows, memory, batch.J != nullptr);
    if (batch.y) scatterRows(memory.y, rows.rows, batch.y + first * batch.y_stride, batch.y_stride, count);
    if (!batch.J) continue;
    double* J = batch.J + first * batch.J_stride;
    if (batch.row_stride == n) {
      scatterRows(memory.jacobian, rows.rows * n, J, batch.J_stride, count);
    } else {
      for (int r = 0; r < rows.rows; ++r)
        scatterRows(memory.jacobian + long(r) * n, n, J + r * batch.row_stride, batch.J_stride, count);
    }
  }
}

}  // namespace

}  // namespace kinegraph::lanes
