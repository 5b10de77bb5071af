#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/messages/shown_run.h"

namespace kinegraph::inline api_internal {

/// Converts contacts for the page, at most as many as it can draw.
std::vector<ShownRun::Contact> shownContacts(const std::vector<Contact>& contacts);

/// Shows the robot of a BotOp on the page of the last synced configuration, if the page is open.
class BotStage {
 public:
  /// Starts with the page of the configuration that the BotOp was made from. `cancellation` is checked while the page
  /// is updated.
  BotStage(std::weak_ptr<ConfigViewer> viewer, CancellationToken cancellation)
      : viewer_(std::move(viewer)), cancellation_(std::move(cancellation)) {}
  ~BotStage();  ///< removes the contacts from the page
  BotStage(const BotStage&) = delete;

  /// Shows a configuration on its page, with the contacts of the simulated world. Returns the key pressed, or 0.
  int show(const BotOp& bot, Config& config, const std::shared_ptr<ConfigViewer>& viewer, const std::string& message);
  bool isWatched() const;

 private:
  std::weak_ptr<ConfigViewer> viewer_;
  CancellationToken cancellation_;
};

}  // namespace kinegraph::inline api_internal
