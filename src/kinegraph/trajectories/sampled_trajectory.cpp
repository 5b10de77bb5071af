#include "kinegraph/trajectories/trajectory.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

SampledTrajectory::SampledTrajectory(MotionStates samples) : samples_(std::move(samples)) {
  constexpr const char* call = "SampledTrajectory";
  const MotionStates& s = samples_;
  const Eigen::Index count = s.times.size(), n = s.q.cols();
  if (count == 0) throw ValueError(cat(call, ": there are no samples; expected one at least"));
  for (const auto& [name, values] :
       {std::pair("q", &s.q), {"velocity", &s.velocity}, {"acceleration", &s.acceleration}}) {
    if (values->rows() != count || values->cols() != n)
      throw ValueError(cat(call, ": ", name, " has shape (", values->rows(), ", ", values->cols(), "); expected (",
                           count, ", ", n, "), one row per time"));
    if (!values->allFinite()) throw ValueError(cat(call, ": ", name, " has numbers that are not finite"));
  }
  if (s.times[0] != 0.) throw ValueError(cat(call, ": the first time is ", s.times[0], " s; expected 0"));
  for (Eigen::Index k = 1; k < count; ++k) {
    if (!(s.times[k] > s.times[k - 1]) || !std::isfinite(s.times[k]))
      throw ValueError(cat(call, ": times[", k, "] is ", s.times[k], " s; expected a number above ", s.times[k - 1]));
  }
}

void SampledTrajectory::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  const MotionStates& s = samples_;
  if (s.times.size() == 0) throw ValueError("SampledTrajectory::eval: there are no samples");
  if (std::isnan(t)) throw ValueError("SampledTrajectory::eval: t is NaN; expected a time in s");
  const double time = std::clamp(t, 0., duration());
  const auto after = std::upper_bound(s.times.begin(), s.times.end(), time);
  const Eigen::Index i = (after - s.times.begin()) - 1;
  const double tau = time - s.times[i];
  const auto n = Eigen::Index(dimension());
  Eigen::Map<VectorXd> out_q(q, n), out_velocity(velocity, n), out_acceleration(acceleration, n);
  out_q = s.q.row(i).transpose();
  out_velocity = s.velocity.row(i).transpose();
  out_acceleration = s.acceleration.row(i).transpose();
  if (tau == 0.) return;
  // q0 + v0 tau + a0/2 tau^2 + c3 tau^3 + c4 tau^4 + c5 tau^5; the last three meet the state at the end of the
  // interval.
  const double h = s.times[i + 1] - s.times[i];
  for (Eigen::Index j = 0; j < n; ++j) {
    const double v0 = out_velocity[j], a0 = out_acceleration[j];
    const double p = (s.q(i + 1, j) - out_q[j] - h * (v0 + .5 * h * a0)) / (h * h * h);
    const double v = (s.velocity(i + 1, j) - v0 - h * a0) / (h * h), a = (s.acceleration(i + 1, j) - a0) / h;
    const double c3 = 10. * p - 4. * v + .5 * a, c4 = (-15. * p + 7. * v - a) / h,
                 c5 = (6. * p - 3. * v + .5 * a) / (h * h);
    out_q[j] += tau * (v0 + tau * (.5 * a0 + tau * (c3 + tau * (c4 + tau * c5))));
    out_velocity[j] = v0 + tau * (a0 + tau * (3. * c3 + tau * (4. * c4 + tau * 5. * c5)));
    out_acceleration[j] = a0 + tau * (6. * c3 + tau * (12. * c4 + tau * 20. * c5));
  }
}

}  // namespace kinegraph
