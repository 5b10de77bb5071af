#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "logic/logic_objects.h"

namespace kinegraph::python {

namespace {

using Words = std::vector<std::string>;

nb::tuple state(const SourcePosition& where) { return nb::make_tuple(where.file, where.line, where.column); }

SourcePosition positionFrom(nb::handle t) {
  return {nb::cast<std::string>(t[0]), nb::cast<int>(t[1]), nb::cast<int>(t[2])};
}

nb::list state(const std::vector<Literal>& literals) {
  nb::list list;
  for (const Literal& literal : literals)
    list.append(nb::make_tuple(literal.predicate, literal.arguments, literal.negated, state(literal.where)));
  return list;
}

std::vector<Literal> literalsFrom(nb::handle list) {
  std::vector<Literal> literals;
  for (nb::handle t : list)
    literals.push_back({nb::cast<std::string>(t[0]), nb::cast<Words>(t[1]), nb::cast<bool>(t[2]), positionFrom(t[3])});
  return literals;
}

nb::tuple domainState(const LogicDomain& domain) {
  nb::list rules;
  for (const LogicRule& rule : domain.rules)
    rules.append(nb::make_tuple(rule.name, rule.variables, rule.types, state(rule.pre), state(rule.eff),
                                rule.is_decision, state(rule.where)));
  return nb::make_tuple(domain.name, domain.symbols, rules, domain.types, state(domain.start),
                        domain.distinct_variables);
}

LogicDomain domainFrom(const nb::tuple& t) {
  LogicDomain domain;
  domain.name = nb::cast<std::string>(t[0]);
  domain.symbols = nb::cast<Words>(t[1]);
  for (nb::handle rule : t[2])
    domain.rules.push_back({nb::cast<std::string>(rule[0]), nb::cast<Words>(rule[1]), nb::cast<Words>(rule[2]),
                            literalsFrom(rule[3]), literalsFrom(rule[4]), nb::cast<bool>(rule[5]),
                            positionFrom(rule[6])});
  domain.types = nb::cast<std::vector<std::pair<std::string, std::string>>>(t[3]);
  domain.start = literalsFrom(t[4]);
  domain.distinct_variables = nb::cast<bool>(t[5]);
  return domain;
}

}  // namespace

void bindDomainCopies(nb::class_<LogicDomain>& domain) {
  domain.def("__getstate__", domainState)
      .def(
          "__setstate__", [](LogicDomain& d, const nb::tuple& state) { new (&d) LogicDomain(domainFrom(state)); },
          "state"_a);
}

}  // namespace kinegraph::python
