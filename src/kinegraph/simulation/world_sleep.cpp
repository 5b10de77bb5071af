// Bodies at rest. MuJoCo groups bodies that touch into islands. An island of free bodies that are slower than the
// tolerance for ten steps falls asleep: its velocities become zero, and its positions keep their bits until it wakes.
// It wakes by contact with a moving body, by forces, and by all changes from outside.
#include <algorithm>

#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/simulation/world.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr int kAwake = -(1 + mjMINAWAKE);  ///< of mjData::tree_asleep: not at rest

}  // namespace

void World::wake() {
  std::fill_n(data_->tree_asleep, physics_->ntree, kAwake);
  physics().mj_updateSleep(physics_.get(), data_.get());
  resting_contacts_.clear();
}

void World::wake(int body) {
  const int tree = physics_->body_treeid[model_->body_id[std::size_t(body)]];
  if (tree < 0) return;
  const bool was_asleep = data_->tree_asleep[tree] >= 0;
  wakeTree(tree);
  if (!was_asleep) return;
  physics().mj_updateSleep(physics_.get(), data_.get());
  forgetWokenContacts();
}

/// Wakes a tree and the cycle of trees that sleep with it.
void World::wakeTree(int tree) {
  int next = std::exchange(data_->tree_asleep[tree], kAwake);
  while (next >= 0) next = std::exchange(data_->tree_asleep[next], kAwake);
}

bool World::isGeomAsleep(int geom) const {
  const int tree = physics_->body_treeid[physics_->geom_bodyid[geom]];
  return tree >= 0 && data_->tree_asleep[tree] >= 0;
}

/// Restores which trees sleep. Steps do not compute quantities of sleeping bodies, so these are computed here, at
/// positions and velocities that they had when they fell asleep: with the same bits.
void World::restoreSleep(const std::vector<int>& sleep) {
  wake();
  if (sleep.empty() || !options_.sleep) return;
  const bool is_any_asleep = std::ranges::any_of(sleep, [](int next) { return next >= 0; });
  if (is_any_asleep) {
    const MujocoErrors thrown;
    physics().mj_forward(physics_.get(), data_.get());
  }
  std::ranges::copy(sleep, data_->tree_asleep);
  if (!is_any_asleep) return;
  keepRestingContacts();
  physics().mj_updateSleep(physics_.get(), data_.get());
}

/// Keeps bodies awake that touch nothing: a body in the air is slow for an instant only, and one without gravity stays
/// slow without being at rest.
void World::keepUnsupportedAwake() {
  if (!options_.sleep) return;
  const mjModel& m = *physics_;
  mjData& d = *data_;
  is_supported_.assign(std::size_t(m.ntree), false);
  for (int i = 0; i < d.ncon; ++i) {
    if (d.contact[i].efc_address < 0) continue;
    for (const int geom : d.contact[i].geom) {
      const int tree = m.body_treeid[m.geom_bodyid[geom]];
      if (tree >= 0) is_supported_[std::size_t(tree)] = true;
    }
  }
  for (int tree = 0; tree < m.ntree; ++tree) {
    if (d.tree_asleep[tree] < 0 && !is_supported_[std::size_t(tree)]) d.tree_asleep[tree] = kAwake;
  }
}

GeomContact World::contactOf(const mjData& d, int i) const {
  const mjContact& contact = d.contact[i];
  mjtNum force[6];
  physics().mj_contactForce(physics_.get(), &d, i, force);
  // the contact frame's rows: the normal from geom 0 to geom 1, and two tangents
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(contact.frame);
  return {contact.geom[0],
          contact.geom[1],
          Vector3d(contact.pos),
          axes.row(0),
          contact.dist - contact.includemargin,
          axes.transpose() * Eigen::Map<const Vector3d>(force)};
}

std::vector<GeomContact> World::contacts() const {
  const mjData& d = computed();
  std::vector<GeomContact> found;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    const bool is_kept = isGeomAsleep(contact.geom[0]) || isGeomAsleep(contact.geom[1]);  // in the last step awake
    if (contact.efc_address >= 0 && !is_kept) found.push_back(contactOf(d, i));
  }
  found.insert(found.end(), resting_contacts_.begin(), resting_contacts_.end());
  return found;
}

/// Adds the contacts of trees that fell asleep: steps do not find them any more.
void World::keepRestingContacts() {
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    if (contact.efc_address >= 0 && (isGeomAsleep(contact.geom[0]) || isGeomAsleep(contact.geom[1])))
      resting_contacts_.push_back(contactOf(*data_, i));
  }
}

void World::forgetWokenContacts() {
  std::erase_if(resting_contacts_, [&](const GeomContact& contact) {
    return !isGeomAsleep(contact.geom_a) && !isGeomAsleep(contact.geom_b);
  });
}

}  // namespace kinegraph::inline simulation_internal
