#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

/// What a page shows of these contacts; not more than it can draw.
std::vector<ShownRun::Contact> shownContacts(const std::vector<Contact>& contacts);

/// Where people see what a BotOp moves: the page of the configuration that was synced last, if it is open.
class BotStage {
 public:
  /// At first, the page of the configuration that the BotOp is made from. `cancellation` is asked while the page is
  /// drawn.
  BotStage(std::weak_ptr<ConfigViewer> viewer, CancellationToken cancellation)
      : viewer_(std::move(viewer)), cancellation_(std::move(cancellation)) {}
  ~BotStage();  ///< contacts are shown no longer
  BotStage(const BotStage&) = delete;

  /// Shows a configuration on its page, with what touches in the simulated world. Returns the key pressed, or 0.
  int show(const BotOp& bot, Config& config, const std::shared_ptr<ConfigViewer>& viewer, const std::string& message);
  bool isWatched() const;

 private:
  std::weak_ptr<ConfigViewer> viewer_;
  CancellationToken cancellation_;
};

}  // namespace kinegraph
