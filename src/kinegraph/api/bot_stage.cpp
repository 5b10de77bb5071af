#include "kinegraph/api/bot_stage.h"

#include <algorithm>

#include "kinegraph/viewer/server.h"

namespace kinegraph::inline api_internal {

std::vector<ShownRun::Contact> shownContacts(const std::vector<Contact>& contacts) {
  constexpr std::size_t kMaxContacts = 500;
  std::vector<ShownRun::Contact> shown(std::min(contacts.size(), kMaxContacts));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Contact& contact = contacts[i];
    shown[i] = {contact.position, contact.force.z() < 0. ? Vector3d(-contact.force) : contact.force};
  }
  return shown;
}

BotStage::~BotStage() {
  const auto viewer = viewer_.lock();
  if (viewer && viewer->isOpen()) viewer->server().endRun();
}

int BotStage::show(const BotOp& bot, Config& config, const std::shared_ptr<ConfigViewer>& viewer,
                   const std::string& message) {
  viewer_ = viewer;
  if (!viewer || !viewer->isOpen()) return 0;
  const int key = viewer->view(config, false, message, cancellation_);
  ShownRun run;
  run.is_steered = false;
  run.contacts = shownContacts(bot.getContacts());
  viewer->server().showRun(run);
  return key;
}

bool BotStage::isWatched() const {
  const auto viewer = viewer_.lock();
  return viewer && viewer->clients() > 0;
}

}  // namespace kinegraph::inline api_internal
