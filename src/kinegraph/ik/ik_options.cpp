#include "kinegraph/ik/ik_options.h"

namespace kinegraph {

void IkOptions::validate() const { ikOptionTable().validate(*this); }

const OptionTable<IkOptions>& ikOptionTable() {
  using O = IkOptions;
  using R = OptionRange;
  static const OptionTable<O> table(
      "solveIk",
      {{"position_tolerance", &O::position_tolerance, "m", "Error of a position that is allowed.", R::positive()},
       {"rotation_tolerance", &O::rotation_tolerance, "rad", "Error of a rotation that is allowed.", R::positive()},
       {"attempts", &O::attempts, "",
        "Most starting points that are tried: the present q, then points spread evenly within the limits.",
        R::atLeastOne()},
       {"steps", &O::steps, "", "Most steps of an attempt towards its targets, and again out of collisions.",
        R::atLeastOne()},
       {"best", &O::best, "",
        "Makes all attempts and gives the answer nearest to the present q, instead of the first one."},
       {"collisions", &O::collisions, "", "True: the collidable pairs are kept apart."},
       {"margin", &O::margin, "m", "Distance that these pairs keep.", R::finite()},
       {"start_weight", &O::start_weight, "",
        "Weight of the squared distance |q - start|^2, where answers are compared; 1 with best, if both weights are 0.",
        R::notNegative()},
       {"home_weight", &O::home_weight, "", "Weight of the squared distance |q - home|^2, where answers are compared.",
        R::notNegative()},
       {"seed", &O::seed, "", "Shifts the sequence of starting points."}});
  return table;
}

}  // namespace kinegraph
