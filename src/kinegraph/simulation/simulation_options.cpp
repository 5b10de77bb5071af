#include "kinegraph/simulation/simulation_data.h"

namespace kinegraph {

void SimulationOptions::validate() const {
  simulationOptionTable().validate(*this);
  if (servo_frequency * inner_step > .5)
    throw ValueError(cat("SimulationOptions: servo_frequency ", servo_frequency, " rad/s times inner_step ", inner_step,
                         " s exceeds .5: joints would oscillate"));
}

const OptionTable<SimulationOptions>& simulationOptionTable() {
  using Options = SimulationOptions;
  static const OptionTable<Options> table(
      "SimulationOptions",
      {
          {"inner_step",
           &Options::inner_step,
           "s",
           "Longest inner step; a step consists of equal inner steps.",
           {[](double v) { return v >= 1e-5 && v <= .05; }, "1e-5 to .05"}},
          {"servo_frequency", &Options::servo_frequency, "rad/s", "Stiffness by which joints follow their references.",
           OptionRange::positive()},
          {"reference_acceleration", &Options::reference_acceleration, "rad/s^2 or m/s^2",
           "Acceleration of references towards distant targets.", OptionRange::positive()},
          {"friction", &Options::friction, "", "Friction of frames without the attribute friction.",
           OptionRange::notNegative()},
          {"torsional_friction", &Options::torsional_friction, "m", "Friction against spinning on the spot.",
           OptionRange::notNegative()},
          {"rolling_friction", &Options::rolling_friction, "m", "Friction against rolling.",
           OptionRange::notNegative()},
          {"gravity", &Options::gravity, "m/s^2", "Gravity along -z.", OptionRange::finite()},
          {"armature", &Options::armature, "kg m^2 or kg", "Inertia of motors, added to actuated joints.",
           OptionRange::notNegative()},
          {"ground", &Options::ground, "", "A plane at z = 0."},
          {"speculative", &Options::speculative, "",
           "Predicts contacts, which keeps fast objects from passing through thin walls."},
          {"sleep", &Options::sleep, "", "Free bodies at rest are not computed until something moves them."},
      });
  return table;
}

}  // namespace kinegraph
