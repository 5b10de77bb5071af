#include "kinegraph/komo/path/contacts.h"

#include "kinegraph/komo/path/path.h"

namespace kinegraph::inline komo_internal {

std::vector<Interaction> Contacts::interactions(const Path& path) const {
  std::vector<Interaction> list;
  for (int t = 0; t < path.grid().slices(); ++t) {
    const State& state = path.state(t);
    for (const ContactForce& contact : forces_) {
      if (!contact.isIn(state)) continue;
      const std::vector<std::string>& names = state.model().frame_name;
      list.push_back(
          {t, names[contact.object], names[contact.from], state.position(contact.point), contact.value(state)});
    }
  }
  return list;
}

}  // namespace kinegraph::inline komo_internal
