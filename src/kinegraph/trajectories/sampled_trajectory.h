#pragma once

#include <string>

#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// A trajectory through given states. At a sample's time its state is returned to the bit; between two samples, each
/// dof is the quintic polynomial with their positions, velocities and accelerations (Hermite interpolation).
class SampledTrajectory final : public Trajectory {
 public:
  SampledTrajectory() = default;

  /// `samples` have at least one row; their times start at 0 and increase. Throws ValueError otherwise, for sizes that
  /// differ, and for numbers that are not finite.
  explicit SampledTrajectory(MotionStates samples);

  /// Reads a file of Trajectory::writeCsv. Throws FileError if it cannot be read, ParseError with line and column for
  /// other content, and ValueError as the constructor.
  static SampledTrajectory read(const std::string& file);

  int dimension() const override { return int(samples_.q.cols()); }
  double duration() const override { return samples_.times.size() ? samples_.times[samples_.times.size() - 1] : 0.; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  const MotionStates& samples() const { return samples_; }

 private:
  MotionStates samples_;
};

}  // namespace kinegraph
