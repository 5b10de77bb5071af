#include "ik/ik_objects.h"
#include "option_class.h"

namespace kinegraph::python {

namespace {

const OptionClass<IkOptions>& ikOptions() {
  using Class = OptionClass<IkOptions>;
  static const Class options(ikOptionTable(),
                             {{"tolerance"}, [](const Class& self, IkOptions& o, const std::string&, nb::handle value) {
                                self.setField(o, "position_tolerance", value);
                                self.setField(o, "rotation_tolerance", value);
                              }});
  return options;
}

}  // namespace

void setFields(IkOptions& options, nb::dict given) { ikOptions().setFields(options, given); }

void bindIkOptions(nb::module_& m) {
  nb::class_<IkOptions> options(
      m, "IkOptions", "Settings of solveIk; each field is also a keyword argument. tolerance sets both tolerances.");
  ikOptions().bind(options, "IkOptions", [] { return IkOptions(); });
}

}  // namespace kinegraph::python
