#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/scene_edits.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph {

/// Shows a configuration in the browser. The server starts, and a browser opens, when there is first something to show.
class ConfigViewer {
 public:
  explicit ConfigViewer(ViewerOptions options = {}) : options_(std::move(options)) {}

  /// Takes over what people have changed in browsers (see `takeEdits`), and shows the configuration as it is then.
  /// Returns the key pressed since the last call, or 0. With `pause`, waits for a new key: in the browser, or Enter on
  /// the terminal. Nothing waits where KINEGRAPH_HEADLESS is set, or for more than 5 s in which no browser is
  /// connected; at a terminal or over ssh, though, for as long as none has been there.
  int view(Config& config, bool pause, const std::optional<std::string>& message,
           const CancellationToken& cancellation);

  /// Shows a message, and waits for a key with `pause`, as view does. Changes nothing else.
  int wait(bool pause, const std::optional<std::string>& message, const CancellationToken& cancellation);

  /// Shows, without looking at keys and edits.
  void update(const Config& config);

  /// Moves joint values and poses that people have set in browsers into the configuration, if it is the one that is
  /// shown, with the same structure. True if there were any.
  bool takeEdits(Config& config);

  /// Of the scene that is shown, as in SceneItems.
  int structure() const { return items_.structure(); }

  /// True if people have changed something that takeEdits has not taken over.
  bool hasEdits() const { return edits_->hasAny(); }

  /// Shows a motion of the configuration, with a time slider. Waits until it has been played once, if it plays by
  /// itself, then, with `pause`, for a key; a key ends both. Waits as view does. Returns the key, or 0.
  int showMotion(const Config& config, const ShownMotion& motion, bool pause, const std::optional<std::string>& message,
                 const CancellationToken& cancellation);

  /// Shows a text in the corner of the page, which starts if it does not run.
  void setMessage(const std::string& text);
  /// The same, on a page that runs; one that starts later shows it from its beginning.
  void noteMessage(const std::string& text);
  std::string message() const;
  void setError(const std::string& text) { server().setError(text); }
  void setTitle(const std::string& text);
  void select(int frame) { server().select(frame); }  ///< shows the card of a frame, with handles to move it
  std::string recording();                            ///< an HTML page with all that is shown inside
  void setCamera(const PageCamera& camera) { server().setCamera(camera); }
  std::optional<PageCamera> takeViewpoint() { return isOpen() ? server_->takeViewpoint() : std::nullopt; }
  std::string url() { return server().url(); }
  int clients() const { return isOpen() ? server_->clients() : 0; }
  int takeKey() { return isOpen() ? server_->takeKey() : 0; }
  bool isOpen() const { return server_ && server_->isOurs(); }
  void close();

  ViewerServer& server();

  /// Serves the page at this address from now on: "0.0.0.0" for browsers on other machines, which then need the token
  /// that is part of `url()`. A page that runs elsewhere ends. Throws ValueError for an address that cannot be.
  void serveAt(const std::string& host, int port);

  /// With false, nothing waits for people from now on, as with KINEGRAPH_HEADLESS; pages are shown all the same.
  void setWaits(bool waits) { waits_ = waits; }
  bool waits() const { return waits_ && !isHeadless(); }

 private:
  /// Shows the message with a request for a key, and waits for one.
  int ask(const std::optional<std::string>& message, const CancellationToken& cancellation);
  int waitKey(const std::string& prompt, const CancellationToken& cancellation);
  void remember(const std::string& text);

  ViewerOptions options_;
  mutable std::mutex message_mutex_;  ///< a picture may be made while another thread waits for a key
  std::string message_;
  bool waits_ = true;
  std::unique_ptr<ViewerServer> server_;
  SceneItems items_;
  std::shared_ptr<SceneEdits> edits_ = std::make_shared<SceneEdits>();
};

/// True if somebody may still come: at a terminal, or over ssh, where the port is to be forwarded first.
bool isPatient();

/// True if Enter was pressed on the terminal since the last call.
bool enterWasPressed();

}  // namespace kinegraph
