#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/sampling/sampler.h"
#include "option_class.h"
#include "solvers/nlp_objects.h"
#include "solvers/sampler_docs.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

/// A sampler with the random numbers that it draws from, call after call.
struct PySampler {
  NlpSampler sampler;
  Rng rng{defaults().seed};

  explicit PySampler(std::shared_ptr<Nlp> problem) : sampler(std::move(problem)) {}
};

/// Options of the package robotic without effect are ignored.
const OptionClass<SamplerOptions>& samplerOptions() {
  using Class = OptionClass<SamplerOptions>;
  static const Class options(samplerOptionTable(),
                             {{"useCentering", "interiorNoiseMethod"},
                              [](const Class&, SamplerOptions&, const std::string& name, nb::handle value) {
                                if (name == "useCentering" || nb::cast<std::string>(nb::str(value)) == "iso") return;
                                throw ValueError(cat("NlpSampler: option interiorNoiseMethod is ",
                                                     nb::cast<std::string>(nb::repr(value)), "; expected 'iso'"));
                              }});
  return options;
}

PySampler& setSamplerOptions(PySampler& self, nb::kwargs given) {
  samplerOptions().setFields(self.sampler.options, given);
  return self;
}

SolverResult sample(PySampler& self) {
  return runInterruptibly("NLP_Sampler", *self.sampler.problem(), self.sampler.options.verbose,
                          [&](const EvaluationCallback& callback) { return self.sampler.sample(self.rng, callback); });
}

}  // namespace

void bindSampler(nb::module_& m) {
  const std::string set_options_doc =
      "Sets options by name; all others keep their values.\n\nArgs:\n    options: Fields by name.\n" +
      samplerOptions().docs("        ") +
      "Returns:\n    The sampler itself.\nRaises:\n    ArgumentError: There is no such option, or the "
      "value is invalid.";
  nb::class_<PySampler>(m, "NLP_Sampler",
                        "Samples points that satisfy the constraints of a problem. A call of sample() descends from a "
                        "seed to the constraints,\n"
                        "and then makes interior steps within them.")
      .def(nb::init<std::shared_ptr<Nlp>>(), "problem"_a, docs::sampler::make)
      .def("setOptions", setSamplerOptions, "options"_a, nb::rv_policy::none, set_options_doc.c_str())
      .def(
          "getOptions", [](const PySampler& s) { return Attributes(samplerOptions().dict(s.sampler.options)); },
          "Returns all options as a dict.")
      .def(
          "setSeed", [](PySampler& s, std::uint64_t seed) -> PySampler& { return s.rng = Rng(seed), s; }, "seed"_a,
          nb::rv_policy::none, docs::sampler::setSeed)
      .def("sample", sample, docs::sampler::sample)
      .def(
          "getProblem", [](const PySampler& s) { return s.sampler.problem(); }, "The problem.");
}

}  // namespace kinegraph::python
