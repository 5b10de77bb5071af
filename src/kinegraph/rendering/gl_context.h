#pragma once

#include <mutex>
#include <string>

namespace kinegraph {

/// An OpenGL context without window or display, by EGL: on the first graphics card that EGL knows, or else in software.
/// EGL is loaded when the first context is made; nothing needs it before.
class GlContext {
 public:
  /// Throws FileError if libEGL or a driver is not installed, naming the packages; Error if no context can be made.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// While it lives, the calling thread draws into the context, and no other thread does. What was current before is
  /// current again afterwards.
  class Use {
   public:
    explicit Use(GlContext& context);
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    std::unique_lock<std::mutex> lock_;
    void *display_, *draw_, *read_, *context_;
    unsigned api_;
    void* own_display_;
  };

  const std::string& device() const { return device_; }  ///< "graphics card" or "software"

 private:
  bool open(void* display, const char* device);

  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string device_;
  std::mutex mutex_;
};

}  // namespace kinegraph
