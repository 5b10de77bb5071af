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

nb::tuple state(const Formula& formula) {
  nb::list parts;
  for (const Formula& part : formula.parts) parts.append(state(part));
  return nb::make_tuple(int(formula.kind), state(std::vector<Literal>{formula.literal}), parts, formula.variables,
                        formula.types);
}

Formula formulaFrom(nb::handle t) {
  Formula formula;
  formula.kind = Formula::Kind(nb::cast<int>(t[0]));
  formula.literal = literalsFrom(t[1]).at(0);
  for (nb::handle part : t[2]) formula.parts.push_back(formulaFrom(part));
  formula.variables = nb::cast<Words>(t[3]);
  formula.types = nb::cast<Words>(t[4]);
  return formula;
}

nb::list state(const std::vector<Signature>& signatures) {
  nb::list list;
  for (const Signature& one : signatures) list.append(nb::make_tuple(one.name, one.variables, one.types));
  return list;
}

std::vector<Signature> signaturesFrom(nb::handle list) {
  std::vector<Signature> signatures;
  for (nb::handle t : list)
    signatures.push_back({nb::cast<std::string>(t[0]), nb::cast<Words>(t[1]), nb::cast<Words>(t[2])});
  return signatures;
}

nb::tuple ruleState(const LogicRule& rule) {
  nb::list conditions, conditional;
  for (const Formula& formula : rule.conditions) conditions.append(state(formula));
  for (const ConditionalEffect& effect : rule.conditional)
    conditional.append(nb::make_tuple(effect.variables, effect.types, state(effect.when), state(effect.eff)));
  return nb::make_tuple(rule.name, rule.variables, rule.types, state(rule.pre), state(rule.eff), rule.is_decision,
                        state(rule.where), conditions, conditional, rule.cost, state(rule.cost_functions),
                        rule.is_derived);
}

LogicRule ruleFrom(nb::handle t) {
  LogicRule rule{nb::cast<std::string>(t[0]), nb::cast<Words>(t[1]), nb::cast<Words>(t[2]), literalsFrom(t[3]),
                 literalsFrom(t[4]),          nb::cast<bool>(t[5]),  positionFrom(t[6])};
  for (nb::handle formula : t[7]) rule.conditions.push_back(formulaFrom(formula));
  for (nb::handle effect : t[8])
    rule.conditional.push_back(
        {nb::cast<Words>(effect[0]), nb::cast<Words>(effect[1]), formulaFrom(effect[2]), literalsFrom(effect[3])});
  rule.cost = nb::cast<double>(t[9]);
  rule.cost_functions = literalsFrom(t[10]);
  rule.is_derived = nb::cast<bool>(t[11]);
  return rule;
}

nb::tuple domainState(const LogicDomain& domain) {
  nb::list rules;
  for (const LogicRule& rule : domain.rules) rules.append(ruleState(rule));
  return nb::make_tuple(domain.name, domain.symbols, rules, domain.types, state(domain.start),
                        domain.distinct_variables, domain.constants, state(domain.predicates), state(domain.functions));
}

LogicDomain domainFrom(const nb::tuple& t) {
  LogicDomain domain;
  domain.name = nb::cast<std::string>(t[0]);
  domain.symbols = nb::cast<Words>(t[1]);
  for (nb::handle rule : t[2]) domain.rules.push_back(ruleFrom(rule));
  domain.types = nb::cast<std::vector<std::pair<std::string, std::string>>>(t[3]);
  domain.start = literalsFrom(t[4]);
  domain.distinct_variables = nb::cast<bool>(t[5]);
  domain.constants = nb::cast<Words>(t[6]);
  domain.predicates = signaturesFrom(t[7]);
  domain.functions = signaturesFrom(t[8]);
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
