#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "kinegraph/features/forces.h"
#include "kinegraph/komo/komo_parts.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/path/mode.h"
#include "komo/py_komo.h"
#include "pickling.h"

namespace kinegraph::python {

namespace {

nb::tuple toTuple(const Objective& o) {
  const nb::object feature = featureState(o.feature);
  return nb::make_tuple(o.name(), feature, o.frames, int(o.type), toNumpy(o.scale), toNumpy(o.target), o.order, o.times,
                        o.from, o.to, o.time_integral, o.without_gravity, o.damped, o.margin, o.slack, o.between_slices,
                        o.frames_known);
}

Objective toObjective(nb::handle state) {
  const nb::tuple t = nb::cast<nb::tuple>(state);
  const FeatureSource feature = featureFrom(t[1]);
  return {feature,
          nb::cast<std::vector<std::string>>(t[2]),
          ObjectiveType(nb::cast<int>(t[3])),
          matrixFrom(t[4]),
          nb::cast<Numbers>(t[5]).values,
          nb::cast<int>(t[6]),
          nb::cast<std::vector<double>>(t[7]),
          nb::cast<int>(t[8]),
          nb::cast<int>(t[9]),
          nb::cast<bool>(t[10]),
          nb::cast<bool>(t[11]),
          nb::cast<bool>(t[12]),
          nb::cast<double>(t[13]),
          nb::cast<double>(t[14]),
          nb::cast<bool>(t[15]),
          nb::cast<int>(t[16])};
}

nb::tuple komoState(const PyKomo& komo) {
  Komo::Parts parts = komo.parts();
  nb::list modes, objectives, contacts, states;
  for (Mode& mode : parts.path.modes) {
    nb::list added;
    for (const auto& [frame, joint] : mode.added)
      added.append(nb::make_tuple(frame, joint.id, joint.stable, joint.parent));
    modes.append(nb::make_tuple(PyConfig{std::move(mode.config), nullptr}, added));
  }
  for (const Objective& objective : parts.objectives) objectives.append(toTuple(objective));
  for (const ContactForce& contact : parts.contacts) contacts.append(contactState(contact));
  for (const VectorXd& state : parts.path.states) states.append(toNumpy(state));
  const bool has_config = komo.slices() > 0 || parts.config.getFrameDimension() > 0;
  const nb::object config = has_config ? nb::cast(PyConfig{std::move(parts.config), nullptr}) : nb::none();
  return nb::make_tuple(config, parts.phases, parts.duration_per_phase, parts.slices_per_phase, parts.order,
                        parts.path.next_joint, modes, parts.path.mode_of, parts.path.shown_frames, objectives, contacts,
                        states);
}

Komo fromState(nb::tuple t) {
  if (nb::handle(t[0]).is_none()) return Komo();
  Komo::Parts parts{nb::cast<PyConfig&>(t[0]),
                    nb::cast<double>(t[1]),
                    nb::cast<double>(t[2]),
                    nb::cast<int>(t[3]),
                    nb::cast<int>(t[4]),
                    {},
                    {},
                    {}};
  parts.path.next_joint = nb::cast<int>(t[5]);
  for (nb::handle state : nb::cast<nb::list>(t[6])) {
    Mode mode{nb::cast<PyConfig&>(state[0]), {}};
    for (nb::handle added : nb::cast<nb::list>(state[1])) {
      mode.added[nb::cast<int>(added[0])] = {nb::cast<int>(added[1]), nb::cast<bool>(added[2]),
                                             nb::cast<std::string>(added[3])};
    }
    parts.path.modes.push_back(std::move(mode));
  }
  parts.path.mode_of = nb::cast<std::vector<int>>(t[7]);
  parts.path.shown_frames = nb::cast<std::vector<int>>(t[8]);
  for (nb::handle objective : nb::cast<nb::list>(t[9])) parts.objectives.push_back(toObjective(objective));
  for (nb::handle contact : nb::cast<nb::list>(t[10])) parts.contacts.push_back(contactFrom(contact));
  for (nb::handle state : nb::cast<nb::list>(t[11])) parts.path.states.push_back(nb::cast<Numbers>(state).values);
  return Komo(std::move(parts));
}

}  // namespace

void bindKomoCopies(nb::class_<PyKomo>& komo) {
  komo.def("__copy__",
           [](const PyKomo& k) {
             return std::make_shared<PyKomo>(PyKomo{k.clone(), nullptr});
           })
      .def(
          "__deepcopy__",
          [](const PyKomo& k, nb::object) {
            return std::make_shared<PyKomo>(PyKomo{k.clone(), nullptr});
          },
          "memo"_a)
      .def("__getstate__", komoState)
      .def(
          "__setstate__",
          [](PyKomo& k, nb::tuple state) {
            new (&k) PyKomo{fromState(state), nullptr};
          },
          "state"_a);
}

}  // namespace kinegraph::python
