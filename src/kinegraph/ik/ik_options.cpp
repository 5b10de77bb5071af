#include "kinegraph/ik/ik_target.h"

namespace kinegraph {

void IkOptions::validate() const { ikOptionTable().validate(*this); }

const OptionTable<IkOptions>& ikOptionTable() {
  using O = IkOptions;
  using R = OptionRange;
  static const OptionTable<O> table(
      "solveIk",
      {{"position_tolerance", &O::position_tolerance, "m", "Largest accepted position error.", R::positive()},
       {"rotation_tolerance", &O::rotation_tolerance, "rad", "Largest accepted rotation error.", R::positive()},
       {"attempts", &O::attempts, "",
        "Maximum number of starting points: the present q, then points spread evenly within the limits.",
        R::atLeastOne()},
       {"steps", &O::steps, "",
        "Maximum number of steps of an attempt towards its targets, and as many again out of collisions.",
        R::atLeastOne()},
       {"best", &O::best, "",
        "Makes all attempts and returns the answer nearest to the present q, instead of the first one."},
       {"collisions", &O::collisions, "", "Keeps the collidable pairs apart."},
       {"margin", &O::margin, "m", "Minimum distance of these pairs.", R::finite()},
       {"max_start_penetration", &O::max_start_penetration, "m",
        "Pairs that no joint of a target separates may overlap by this much, with a warning; deeper ones rule out "
        "every "
        "answer.",
        R::notNegative()},
       {"start_weight", &O::start_weight, "",
        "Weight of |q - start|^2 in the cost that compares answers; 1 with best, if both weights are 0.",
        R::notNegative()},
       {"home_weight", &O::home_weight, "", "Weight of |q - home|^2 in the cost that compares answers.",
        R::notNegative()},
       {"seed", &O::seed, "", "Shift of the sequence of starting points."}});
  return table;
}

}  // namespace kinegraph
