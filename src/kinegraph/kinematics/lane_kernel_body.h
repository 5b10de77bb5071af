// The kernel of lane_model.h for registers of `kLanes` doubles. Each source file that includes this is compiled for its
// own instruction set. All names are local to it.

#include "kinegraph/kinematics/lane_model.h"
#include "kinegraph/kinematics/place_lanes.h"
#include "kinegraph/kinematics/row_formulas.h"
#include "kinegraph/math/lane_transpose.h"

namespace kinegraph::lanes {

namespace {

using Lane = Pack<kLanes>;
using Vector = Vec3<Lane>;
using Block = LaneRows::Block;

struct Memory {
  Lane *x, *pose, *motion, *frame, *y, *jacobian;
};

/// The motion of a twist column, as input of the formulas.
struct ColumnMotion {
  bool is_rotation;
  Vector angular, point;  ///< a point on the axis; for translations, the velocity

  Vector velocityAt(const Vector& at) const { return is_rotation ? cross(angular, at - point) : point; }
};

/// Evaluates the formulas of a block.
struct BlockRows {
  const LaneModel& model;
  const LaneRows& rows;
  const Block& block;
  const Memory& memory;
  bool with_jacobian;

  const Lane* frame(int index) const { return memory.frame + index * LaneMemory::kPerPose; }
  Vector position(int index) const { return load(frame(index) + 9); }
  Vector column(int index, int axis) const { return load(frame(index) + 3 * axis); }
  Vector u() const { return column(block.a, block.axis_a); }
  Vector v() const { return column(block.b, block.axis_b); }

  template <class Formula>
  void evaluate(const Formula& formula) const {
    const int count = Formula::kRows < block.rows ? Formula::kRows : block.rows;
    Lane value[Formula::kRows];
    formula.value(value);
    for (int r = 0; r < count; ++r) memory.y[block.row + r] = value[r];
    if (with_jacobian) addRates(formula);
  }

  template <class Formula>
  void addRates(const Formula& formula) const {
    const int count = Formula::kRows < block.rows ? Formula::kRows : block.rows;
    for (int e = block.first_entry; e < block.first_entry + block.entries; ++e) {
      const LaneRows::Entry& entry = rows.entry[e];
      const Lane* motion = memory.motion + entry.column * LaneMemory::kPerColumn;
      Lane rate[Formula::kRows];
      formula.rate(ColumnMotion{entry.is_rotation, load(motion), load(motion + 3)}, entry.of_b, rate);
      Lane* to = memory.jacobian + long(block.row) * model.variables + entry.variable;
      if (entry.adds) {
        for (int r = 0; r < count; ++r) to[long(r) * model.variables] += rate[r];
      } else {
        for (int r = 0; r < count; ++r) to[long(r) * model.variables] = rate[r];
      }
    }
  }
};

void evaluateBlock(const BlockRows& at) {
  const Block& block = at.block;
  const auto rotation = [&at](int frame, Vector* R) {
    for (int k = 0; k < 3; ++k) R[k] = at.column(frame, k);
  };
  const auto quaternion = [&](int frame) {
    Vector R[3];
    rotation(frame, R);
    return toQuaternion(R);
  };
  Vector R_b[3];
  switch (block.kind) {
    case Block::position:
      return at.evaluate(PositionRows<Lane>{at.position(block.a)});
    case Block::offset:
      return at.evaluate(OffsetRows<Lane>{at.position(block.a), at.position(block.b)});
    case Block::relative:
      rotation(block.b, R_b);
      return at.evaluate(
          RelativePositionRows<Lane>{at.position(block.a), {R_b[0], R_b[1], R_b[2]}, at.position(block.b)});
    case Block::quaternion:
      return at.evaluate(QuaternionRows<Lane>{block.canonical ? canonical(quaternion(block.a)) : quaternion(block.a)});
    case Block::quaternion_offset:
      return at.evaluate(QuaternionOffsetRows<Lane>(quaternion(block.a), quaternion(block.b)));
    case Block::quaternion_relative:
      rotation(block.b, R_b);
      return at.evaluate(
          RelativeQuaternionRows<Lane>{between(toQuaternion(R_b), quaternion(block.a)), {R_b[0], R_b[1], R_b[2]}});
    case Block::axis:
      return at.evaluate(AxisRows<Lane>{at.u()});
    case Block::axis_offset:
      return at.evaluate(AxisOffsetRows<Lane>{at.u(), at.v()});
    case Block::axis_relative:
      rotation(block.b, R_b);
      return at.evaluate(RelativeAxisRows<Lane>{at.u(), {R_b[0], R_b[1], R_b[2]}});
    case Block::axis_product:
      return at.evaluate(AxisProductRows<Lane>(at.u(), at.v()));
    case Block::twist:
      if (at.with_jacobian) at.addRates(TwistRows<Lane>{at.position(block.a)});
      return;
    case Block::joint:
      at.memory.y[block.row] = block.scale * at.memory.x[block.a] + block.shift;
      if (at.with_jacobian) at.memory.jacobian[long(block.row) * at.model.variables + block.a] = all<Lane>(block.scale);
      return;
  }
}

void evaluate(const LaneModel& model, const LaneRows& rows, const Memory& memory, bool with_jacobian) {
  for (int f = 0; f < rows.frames; ++f) {
    const LaneRows::Frame& frame = rows.frame[f];
    storePlace(moved<Vector>(memory.pose + frame.link * LaneMemory::kPerPose, frame.rotation, frame.R, frame.p),
               memory.frame + f * LaneMemory::kPerPose);
  }
  for (int i = 0; i < rows.blocks; ++i) evaluateBlock({model, rows, rows.block[i], memory, with_jacobian});
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
