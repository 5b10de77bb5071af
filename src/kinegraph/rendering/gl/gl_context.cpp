#include "kinegraph/rendering/gl/gl_context.h"

#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline rendering_internal {

namespace {

// The used part of EGL 1.5 and its extensions, declared here because its headers may not be installed.
using Bool = unsigned;
using Int = std::int32_t;
constexpr Int kNone = 0x3038, kSurfaceType = 0x3033, kPbufferBit = 1, kRenderableType = 0x3040, kOpenGlBit = 8;
constexpr Int kRed = 0x3024, kGreen = 0x3023, kBlue = 0x3022, kExtensions = 0x3055, kDraw = 0x3059, kRead = 0x305A;
constexpr unsigned kOpenGlApi = 0x30A2, kPlatformDevice = 0x313F, kPlatformSurfaceless = 0x31DD;

constexpr const char* kPackages = "on Debian and Ubuntu: apt-get install libegl1 libgl1-mesa-dri";

struct Egl {
  void* (*getProcAddress)(const char*);
  Bool (*initialize)(void*, Int*, Int*);
  Bool (*bindApi)(unsigned);
  unsigned (*queryApi)();
  Bool (*chooseConfig)(void*, const Int*, void**, Int, Int*);
  void* (*createContext)(void*, void*, void*, const Int*);
  Bool (*destroyContext)(void*, void*);
  Bool (*makeCurrent)(void*, void*, void*, void*);
  void* (*getCurrentContext)();
  void* (*getCurrentDisplay)();
  void* (*getCurrentSurface)(Int);
  void* (*getPlatformDisplay)(unsigned, void*, const Int*);  // EGL_EXT_platform_base
  Bool (*queryDevices)(Int, void**, Int*) = nullptr;         // EGL_EXT_device_enumeration, may be missing
  const char* (*queryDeviceString)(void*, Int) = nullptr;    // EGL_EXT_device_query, may be missing
};

Egl loadEgl() {
  // global, because the renderer searches eglGetProcAddress among the symbols of the process
  void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL);
  if (!library) throw FileError(cat("camera images need EGL, but libEGL.so.1 cannot be loaded; ", kPackages));
  Egl egl;
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    if (!function) throw FileError(cat("camera images need EGL 1.4, but libEGL.so.1 has no ", name, "; ", kPackages));
  };
  load(egl.getProcAddress, "eglGetProcAddress");
  load(egl.initialize, "eglInitialize");
  load(egl.bindApi, "eglBindAPI");
  load(egl.queryApi, "eglQueryAPI");
  load(egl.chooseConfig, "eglChooseConfig");
  load(egl.createContext, "eglCreateContext");
  load(egl.destroyContext, "eglDestroyContext");
  load(egl.makeCurrent, "eglMakeCurrent");
  load(egl.getCurrentContext, "eglGetCurrentContext");
  load(egl.getCurrentDisplay, "eglGetCurrentDisplay");
  load(egl.getCurrentSurface, "eglGetCurrentSurface");
  const auto extension = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(egl.getProcAddress(name));
  };
  extension(egl.getPlatformDisplay, "eglGetPlatformDisplayEXT");
  extension(egl.queryDevices, "eglQueryDevicesEXT");
  extension(egl.queryDeviceString, "eglQueryDeviceStringEXT");
  if (!egl.getPlatformDisplay)
    throw FileError(cat("camera images need EGL_EXT_platform_base, which libEGL.so.1 lacks; ", kPackages));
  return egl;
}

const Egl& egl() {
  static const Egl loaded = loadEgl();
  return loaded;
}

/// Returns the devices that are graphics cards.
std::vector<void*> graphicsCards() {
  if (!egl().queryDevices || !egl().queryDeviceString) return {};
  std::array<void*, 32> devices;
  Int count = 0;
  if (!egl().queryDevices(Int(devices.size()), devices.data(), &count)) return {};
  std::vector<void*> cards;
  for (Int i = 0; i < count; ++i) {
    const char* extensions = egl().queryDeviceString(devices[i], kExtensions);
    if (extensions && std::string_view(extensions).find("EGL_MESA_device_software") == std::string_view::npos)
      cards.push_back(devices[i]);
  }
  return cards;
}

}  // namespace

bool GlContext::open(void* display, const char* device) {
  if (!display || !egl().initialize(display, nullptr, nullptr)) return false;
  const unsigned api = egl().queryApi();
  egl().bindApi(kOpenGlApi);
  const Int attributes[] = {kSurfaceType, kPbufferBit, kRenderableType, kOpenGlBit, kRed, 8,
                            kGreen,       8,           kBlue,           8,          kNone};
  void* config = nullptr;
  Int count = 0;
  const Int none[] = {kNone};
  if (egl().chooseConfig(display, attributes, &config, 1, &count) && count > 0)
    context_ = egl().createContext(display, config, nullptr, none);
  egl().bindApi(api);
  display_ = display;
  device_ = device;
  return context_ != nullptr;
}

GlContext::GlContext() {
  for (void* card : graphicsCards()) {
    if (open(egl().getPlatformDisplay(kPlatformDevice, card, nullptr), "graphics card")) return;
  }
  if (!open(egl().getPlatformDisplay(kPlatformSurfaceless, nullptr, nullptr), "software")) {
    throw FileError(cat("camera images need an OpenGL driver, but EGL finds none; ", kPackages));
  }
}

// The display stays initialized, because EGL shares it among all users in the process.
GlContext::~GlContext() { egl().destroyContext(display_, context_); }

void* GlContext::function(const char* name) { return egl().getProcAddress(name); }

GlContext::Use::Use(GlContext& context) : lock_(context.mutex_), own_display_(context.display_) {
  api_ = egl().queryApi();
  display_ = egl().getCurrentDisplay();
  draw_ = egl().getCurrentSurface(kDraw);
  read_ = egl().getCurrentSurface(kRead);
  context_ = egl().getCurrentContext();
  egl().bindApi(kOpenGlApi);
  if (!egl().makeCurrent(context.display_, nullptr, nullptr, context.context_)) {
    egl().bindApi(api_);
    throw Error(cat("the OpenGL context (", context.device_, ") needs a surface; install a newer driver"));
  }
}

GlContext::Use::~Use() {
  egl().makeCurrent(own_display_, nullptr, nullptr, nullptr);
  egl().bindApi(api_);
  if (context_) egl().makeCurrent(display_, draw_, read_, context_);
}

}  // namespace kinegraph::inline rendering_internal
