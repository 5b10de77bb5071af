#include "kinegraph/simulation/simulation_options.h"

namespace kinegraph {

void SimulationOptions::validate() const {
  simulationOptionTable().validate(*this);
  if (servo_frequency * inner_step > .5)
    throw ValueError(cat("SimulationOptions: servo_frequency ", servo_frequency, " rad/s times inner_step ", inner_step,
                         " s is more than .5: joints would swing up"));
}

const OptionTable<SimulationOptions>& simulationOptionTable() {
  using Options = SimulationOptions;
  static const OptionTable<Options> table(
      "SimulationOptions",
      {
          {"inner_step",
           &Options::inner_step,
           "s",
           "A step is made of equal ones that are not longer.",
           {[](double v) { return v >= 1e-5 && v <= .05; }, "1e-5 to .05"}},
          {"servo_frequency", &Options::servo_frequency, "rad/s", "How stiff joints follow their references.",
           OptionRange::positive()},
          {"reference_acceleration", &Options::reference_acceleration, "rad/s^2 or m/s^2",
           "How fast references move towards far targets.", OptionRange::positive()},
          {"friction", &Options::friction, "", "Of frames without the attribute friction.", OptionRange::notNegative()},
          {"torsional_friction", &Options::torsional_friction, "m", "Against spinning on the spot.",
           OptionRange::notNegative()},
          {"rolling_friction", &Options::rolling_friction, "m", "Against rolling.", OptionRange::notNegative()},
          {"gravity", &Options::gravity, "m/s^2", "Along -z.", OptionRange::finite()},
          {"armature", &Options::armature, "kg m^2 or kg", "Inertia of motors, added to that of driven joints.",
           OptionRange::notNegative()},
          {"ground", &Options::ground, "", "A plane at z = 0."},
          {"speculative", &Options::speculative, "",
           "Contacts before they happen: stops what would fly through thin walls."},
          {"sleep", &Options::sleep, "", "What rests costs nothing; states then replay in the same object only."},
      });
  return table;
}

}  // namespace kinegraph
