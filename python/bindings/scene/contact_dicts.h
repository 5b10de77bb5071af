#pragma once

#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "kinegraph/simulation/simulation_data.h"

namespace kinegraph::python {

/// Contacts as Python dicts; see Simulation.getContacts.
inline nb::typed<nb::list, nb::dict> contactDicts(const std::vector<Contact>& contacts) {
  nb::list found;
  for (const Contact& contact : contacts) {
    nb::dict each;
    each["frames"] = nb::make_tuple(contact.frame_a, contact.frame_b);
    each["position"] = toNumpy(VectorXd(contact.position));
    each["normal"] = toNumpy(VectorXd(contact.normal));
    each["distance"] = contact.distance;
    each["force"] = toNumpy(VectorXd(contact.force));
    found.append(each);
  }
  return nb::typed<nb::list, nb::dict>(found);
}

}  // namespace kinegraph::python
