#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/collisions.h"
#include "scene/collisions_docs.h"

namespace kinegraph::python {

namespace {

/// A MotionContact with frame names.
struct Contact {
  double time, distance;
  std::pair<std::string, std::string> frames;
  std::optional<std::string> limit;
};

nb::typed<nb::list, nb::str> pairList(const PyConfig& config) {
  nb::list names;
  for (const auto& [a, b] : config.getCollidablePairs()) {
    names.append(config.getFrame(a).getName());
    names.append(config.getFrame(b).getName());
  }
  return names;
}

using NamedPairs = nb::typed<nb::list, nb::typed<nb::tuple, nb::str, nb::str, nb::float_>>;

NamedPairs withNames(const PyConfig& config, const std::vector<Config::NearPair>& pairs) {
  nb::list named;
  for (const Config::NearPair& pair : pairs)
    named.append(nb::make_tuple(config.getFrame(pair.a).getName(), config.getFrame(pair.b).getName(), pair.distance));
  return named;
}

NamedPairs collisions(const PyConfig& config, double margin) {
  warnOfMissingContacts(config);
  return withNames(config, config.getCollisions(margin));
}

NamedPairs ignoreCollisions(PyConfig& config, double margin) {
  return withNames(config, ignoreCollisionsNow(config, margin));
}

std::optional<Contact> checkMotion(const PyConfig& config, const Numbers& start, const Numbers& end, double margin,
                                   double tolerance) {
  warnOfContacts(config);
  const std::optional<MotionContact> contact = config.checkMotion(start.values, end.values, margin, tolerance);
  if (!contact) return std::nullopt;
  Contact named{contact->time,
                contact->distance,
                {config.getFrame(contact->a).getName(), config.getFrame(contact->b).getName()},
                std::nullopt};
  if (contact->dof >= 0) named.limit = config.getJointNames()[std::size_t(contact->dof)];
  return named;
}

/// A SelfCollisionMatrix with frame names.
struct NamedMatrix {
  SelfCollisionMatrix matrix;
  std::vector<std::string> names;  ///< of all frames
};

using MatrixRows = nb::typed<nb::list, nb::typed<nb::tuple, nb::str, nb::str, nb::str, nb::float_>>;

MatrixRows matrixRows(const NamedMatrix& named) {
  nb::list rows;
  for (const SelfCollisionPair& pair : named.matrix.pairs) {
    rows.append(nb::make_tuple(named.names[std::size_t(pair.a)], named.names[std::size_t(pair.b)],
                               selfCollisionReasonName(pair.reason), double(pair.collisions) / named.matrix.samples));
  }
  return rows;
}

NamedMatrix selfCollisions(PyConfig& config, int samples, std::uint64_t seed, double margin, double always,
                           const std::string& root, int threads, bool apply) {
  NamedMatrix named{{}, config.getFrameNames()};
  {
    const nb::gil_scoped_release unlock;
    named.matrix = selfCollisionMatrix(config, {samples, seed, margin, always, root, threads});
  }
  if (apply) ignoreSelfCollisions(config, named.matrix);
  return named;
}

void bindSelfCollisions(nb::module_& m, nb::class_<PyConfig>& config) {
  nb::class_<NamedMatrix>(m, "SelfCollisionMatrix", "Self-collision classes of the pairs of a robot's frames.")
      .def_prop_ro("pairs", matrixRows, docs::collisions::pairs)
      .def_prop_ro(
          "samples", [](const NamedMatrix& n) { return n.matrix.samples; }, "Number of sampled configurations.")
      .def("__len__", [](const NamedMatrix& n) { return n.matrix.pairs.size(); })
      .def("__repr__", [](const NamedMatrix& n) { return cat("<SelfCollisionMatrix: ", n.matrix.str(), ">"); });
  const SelfCollisionOptions defaults;
  config.def("selfCollisionMatrix", selfCollisions, "samples"_a = defaults.samples, "seed"_a = defaults.seed,
             "margin"_a = defaults.margin, "always"_a = defaults.always, "root"_a = defaults.root,
             "threads"_a = defaults.threads, "apply"_a = false, docs::collisions::selfCollisionMatrix);
}

}  // namespace

void bindCollisions(nb::module_& m, nb::class_<PyConfig>& config) {
  bindSelfCollisions(m, config);
  nb::class_<Contact>(m, "MotionContact",
                      "First obstruction of a motion of q: two frames too close, or a joint beyond its limits.")
      .def_ro("time", &Contact::time,
              "In [0, 1]: 0 is the start of the motion, 1 its end. The motion is collision-free before.")
      .def_ro("distance", &Contact::distance,
              "Distance of the two frames at that time, m; negative: penetration depth. For a limit: the distance to "
              "it, rad or m.")
      .def_ro("frames", &Contact::frames, "Names of the two frames; for a limit, twice the joint's frame.")
      .def_ro("limit", &Contact::limit,
              "The dof that leaves its limits, named as in getJointNames; None for two frames.")
      .def("__repr__", [](const Contact& c) {
        if (c.limit) return cat("<MotionContact: joint ", *c.limit, " leaves its limits at time ", c.time, ">");
        return cat("<MotionContact: ", c.frames.first, " and ", c.frames.second, " at time ", c.time, ", distance ",
                   c.distance, ">");
      });
  config.def("getCollidablePairs", pairList, docs::collisions::getCollidablePairs)
      .def("getCollisions", collisions, "belowMargin"_a = 0., docs::collisions::getCollisions)
      .def("ignoreCollisionsNow", ignoreCollisions, "margin"_a = 0., docs::collisions::ignoreCollisionsNow)
      .def(
          "coll_totalViolation", [](const PyConfig& c, bool maximal) { return c.getTotalPenetration(maximal); },
          "return_maximal"_a = false, docs::collisions::coll_totalViolation)
      .def(
          "contactWarnings", [](const PyConfig& c) { return c.contactWarnings(); }, docs::collisions::contactWarnings)
      .def("checkMotion", checkMotion, "start"_a, "end"_a, "margin"_a = 0., "tolerance"_a = 1e-5,
           docs::collisions::checkMotion);
}

}  // namespace kinegraph::python
