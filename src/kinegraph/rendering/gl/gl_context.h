#pragma once

#include <mutex>
#include <string>

namespace kinegraph::inline rendering_internal {

/// An OpenGL context without window or display, made by EGL: on the first graphics card, or else in software. EGL is
/// loaded with the first context.
class GlContext {
 public:
  /// Throws FileError with the names of the packages if libEGL or a driver is missing; Error if no context can be
  /// created.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// While it exists, the calling thread alone draws into the context. Its destructor restores the previous current
  /// context.
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

  /// Returns the address of a function of OpenGL, or null.
  static void* function(const char* name);

  const std::string& device() const { return device_; }  ///< "graphics card" or "software"

 private:
  bool open(void* display, const char* device);

  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string device_;
  std::mutex mutex_;
};

}  // namespace kinegraph::inline rendering_internal
