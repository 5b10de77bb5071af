#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <variant>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/solvers/sampling/sampler.h"
#include "nlp_objects.h"
#include "solving.h"

namespace kinegraph::python {

namespace {

/// A sampler with the random numbers that it draws from, call after call.
struct PySampler {
  NlpSampler sampler;
  Rng rng{defaults().seed};

  explicit PySampler(std::shared_ptr<Nlp> problem) : sampler(std::move(problem)) {}
};

using Field = std::variant<double SamplerOptions::*, int SamplerOptions::*, std::string SamplerOptions::*>;

const std::vector<std::pair<const char*, Field>>& fields() {
  using O = SamplerOptions;
  static const std::vector<std::pair<const char*, Field>> all = {{"seedMethod", &O::seedMethod},
                                                                 {"seedCandidates", &O::seedCandidates},
                                                                 {"seedAttempts", &O::seedAttempts},
                                                                 {"tolerance", &O::tolerance},
                                                                 {"downhillMethod", &O::downhillMethod},
                                                                 {"downhillMaxSteps", &O::downhillMaxSteps},
                                                                 {"penaltyMu", &O::penaltyMu},
                                                                 {"slackStepAlpha", &O::slackStepAlpha},
                                                                 {"slackMaxStep", &O::slackMaxStep},
                                                                 {"slackRegLambda", &O::slackRegLambda},
                                                                 {"ineqOverstep", &O::ineqOverstep},
                                                                 {"downhillNoiseMethod", &O::downhillNoiseMethod},
                                                                 {"downhillNoiseSigma", &O::downhillNoiseSigma},
                                                                 {"downhillRejectMethod", &O::downhillRejectMethod},
                                                                 {"interiorMethod", &O::interiorMethod},
                                                                 {"interiorBurnInSteps", &O::interiorBurnInSteps},
                                                                 {"interiorSampleSteps", &O::interiorSampleSteps},
                                                                 {"interiorNoiseSigma", &O::interiorNoiseSigma},
                                                                 {"hitRunEqMargin", &O::hitRunEqMargin},
                                                                 {"eps", &O::eps},
                                                                 {"langevinTauPrime", &O::langevinTauPrime},
                                                                 {"verbose", &O::verbose}};
  return all;
}

void setField(SamplerOptions& options, const std::string& name, nb::handle value) {
  std::vector<std::string> names;
  for (const auto& [known, field] : fields()) {
    names.push_back(known);
    if (known != name) continue;
    try {
      std::visit([&](auto member) { options.*member = nb::cast<std::decay_t<decltype(options.*member)>>(value); },
                 field);
    } catch (const nb::cast_error&) {
      throw ValueError(
          cat("option ", name, " is ", nb::cast<std::string>(nb::repr(value)), ", which is of a wrong type"));
    }
    return;
  }
  const bool old =
      name == "useCentering" || (name == "interiorNoiseMethod" && nb::cast<std::string>(nb::str(value)) == "iso");
  if (!old) throw ValueError(cat("there is no sampler option '", name, "'", similarHint(name, names)));
}

PySampler& setOptions(PySampler& self, nb::kwargs given) {
  SamplerOptions options;
  for (const auto& [name, value] : given) setField(options, nb::cast<std::string>(name), value);
  options.validate();
  self.sampler.options = options;
  return self;
}

SolverResult sample(PySampler& self) {
  return runInterruptibly("NLP_Sampler", *self.sampler.problem(), self.sampler.options.verbose,
                          [&](const EvaluationHook& hook) { return self.sampler.sample(self.rng, hook); });
}

}  // namespace

void bindSampler(nb::module_& m) {
  nb::class_<PySampler>(m, "NLP_Sampler",
                        "Draws points that satisfy the constraints of a problem. A call of sample() goes from a seed "
                        "downhill to the constraints,\n"
                        "and then makes interior steps within them.")
      .def(nb::init<std::shared_ptr<Nlp>>(), "problem"_a)
      .def(
          "setOptions", setOptions, "options"_a, nb::rv_policy::none,
          "Sets options by name; all others go to their defaults. Returns the sampler.\n\n"
          "    seedMethod: 'uni' in the bounds, 'gauss' at the problem's initial point, 'nov' or 'dist' away from "
          "earlier samples,\n"
          "        chosen among seedCandidates. seedAttempts: seeds tried until the way down reaches the constraints.\n"
          "    tolerance: sum of all violations that a sample may have.\n"
          "    downhillMethod: 'GN' or 'grad', in downhillMaxSteps steps no longer than slackMaxStep, with "
          "downhillNoiseMethod\n"
          "        ('none', 'iso', 'cov') of downhillNoiseSigma; downhillRejectMethod 'none', 'Wolfe' or 'MH'.\n"
          "    interiorMethod: 'HR' (hit-and-run: with many steps uniform on the feasible set), 'MCMC' or 'Langevin' "
          "(in proportion\n"
          "        to exp(-costs), on the surface of the equalities), 'manifoldRRT', 'none'; interiorBurnInSteps +\n"
          "        interiorSampleSteps steps of size interiorNoiseSigma.\n"
          "    hitRunEqMargin: HR walks where |eq| is below it. eps: violation that HR may have on its way.")
      .def(
          "getOptions",
          [](const PySampler& s) {
            nb::dict dict;
            for (const auto& [name, field] : fields()) {
              std::visit([&, key = name](auto member) { dict[key] = nb::cast(s.sampler.options.*member); }, field);
            }
            return dict;
          },
          "All options as a dict.")
      .def(
          "setSeed", [](PySampler& s, std::uint64_t seed) -> PySampler& { return s.rng = Rng(seed), s; }, "seed"_a,
          nb::rv_policy::none, "The samples that follow depend on it alone. Without it: on rnd_seed.")
      .def(
          "sample", sample,
          "Draws a sample. The SolverReturn is feasible, or its message says where the way down ended. Ctrl-C ends it.")
      .def(
          "getProblem", [](const PySampler& s) { return s.sampler.problem(); }, "The problem.");
}

}  // namespace kinegraph::python
