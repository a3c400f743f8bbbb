// SPDX-License-Identifier: Apache-2.0
#include "gpu/device.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <vector>

namespace skysweep::gpu {

struct Device::Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::recursive_mutex mutex;
  int depth = 0;  // of nested Current objects of the thread that holds the mutex
  bool lost = false;
  std::string name;
  bool is_software = false;
  DeviceLimits limits;

  ~Context() {
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    // Displays are shared by the whole process and stay: another device may be on this one.
  }
};

namespace {

// libepoxy ends the program when it finds no library to load, so we look first.
bool has_library(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL)) {
      dlclose(library);
      return true;
    }
  return false;
}

bool lists(const char* extensions, const char* extension) {
  return extensions && std::strstr(extensions, extension) != nullptr;
}

std::optional<std::string> missing_library() {
  if (!has_library({"libEGL.so.1"})) return "There is no EGL library (libEGL.so.1) on this machine.";
  if (!has_library({"libOpenGL.so.0", "libGL.so.1"})) return "There is no OpenGL library (libGL.so.1) on this machine.";
  return std::nullopt;
}

struct EglDevice {
  EGLDeviceEXT device;
  bool is_software;
};

std::vector<EglDevice> egl_devices() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_EXT_platform_device") ||
      !(lists(extensions, "EGL_EXT_device_base") || lists(extensions, "EGL_EXT_device_enumeration")))
    return {};
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(devices.size(), devices.data(), &count)) return {};
  std::vector<EglDevice> found;
  for (EGLint i = 0; i < count; ++i)
    found.push_back(
        {devices[i], lists(eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software")});
  return found;
}

struct Candidate {
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string where;
};

// Displays worth trying, real GPUs first.
std::vector<Candidate> candidates() {
  std::vector<Candidate> real, software;
  for (const EglDevice& device : egl_devices()) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.device, nullptr);
    std::vector<Candidate>& list = device.is_software ? software : real;
    list.push_back({display, (device.is_software ? "software device " : "GPU ") + std::to_string(list.size())});
  }
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (lists(extensions, "EGL_MESA_platform_surfaceless"))
    software.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                        "Mesa without a surface"});
  real.insert(real.end(), software.begin(), software.end());
  return real;
}

// A context that says when it was lost, if the driver can tell.
EGLContext context_on(EGLDisplay display, EGLint major, EGLint minor, const char* extensions) {
  std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                    EGL_CONTEXT_MINOR_VERSION,       5,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
  std::vector<EGLint> telling = attributes;
  if (major > 1 || minor >= 5)
    telling.insert(telling.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  else if (lists(extensions, "EGL_EXT_create_context_robustness"))
    telling.insert(telling.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT, EGL_LOSE_CONTEXT_ON_RESET_EXT});
  for (std::vector<EGLint>* wanted : {&telling, &attributes}) {
    wanted->push_back(EGL_NONE);
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted->data());
    if (context != EGL_NO_CONTEXT) return context;
  }
  return EGL_NO_CONTEXT;
}

std::string text(GLenum name) {
  const GLubyte* value = glGetString(name);
  return value ? reinterpret_cast<const char*>(value) : "unknown";
}

std::int64_t limit(GLenum name) {
  GLint64 value = 0;
  glGetInteger64v(name, &value);
  return value;
}

// Fills in what can only be asked with the context current; nothing, or why the context cannot serve.
std::optional<std::string> describe(std::string& name, bool& is_software, DeviceLimits& limits) {
  if (epoxy_gl_version() < 45) return "it has only OpenGL " + text(GL_VERSION);
  const std::string renderer = text(GL_RENDERER);
  name = renderer + ", OpenGL " + text(GL_VERSION);
  for (const char* rasteriser : {"llvmpipe", "softpipe", "SWR", "Software Rasterizer"})
    is_software = is_software || renderer.find(rasteriser) != std::string::npos;
  limits = {limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE), static_cast<int>(limit(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE)),
            static_cast<int>(limit(GL_MAX_TEXTURE_SIZE)), static_cast<int>(limit(GL_MAX_ARRAY_TEXTURE_LAYERS))};
  return std::nullopt;
}

}  // namespace

Device::Device(std::unique_ptr<Context> context) : context_(std::move(context)) {}
Device::~Device() = default;

bool Device::lists_real_gpu() {
  if (missing_library()) return false;
  const std::vector<EglDevice> devices = egl_devices();
  return std::any_of(devices.begin(), devices.end(), [](const EglDevice& device) { return !device.is_software; });
}

std::unique_ptr<Device> Device::open() {
  if (const auto missing = missing_library()) throw DeviceError(Trouble::unavailable, *missing);
  std::string reasons;
  for (const Candidate& candidate : candidates()) {
    const auto refuse = [&](const std::string& why) { reasons += " " + candidate.where + ": " + why + "."; };
    EGLint major = 0, minor = 0;
    if (candidate.display == EGL_NO_DISPLAY || !eglInitialize(candidate.display, &major, &minor)) {
      refuse("its display cannot be opened");
      continue;
    }
    const char* extensions = eglQueryString(candidate.display, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API)) {
      refuse("it makes no OpenGL contexts without a surface");
      continue;
    }
    auto context = std::make_unique<Context>();
    context->display = candidate.display;
    context->context = context_on(candidate.display, major, minor, extensions);
    if (context->context == EGL_NO_CONTEXT ||
        !eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context)) {
      refuse("it gives no OpenGL 4.5 core context");
      continue;
    }
    const auto problem = describe(context->name, context->is_software, context->limits);
    eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (!problem) return std::unique_ptr<Device>(new Device(std::move(context)));
    refuse(*problem);
  }
  throw DeviceError(Trouble::unavailable,
                    "No GPU gives an OpenGL 4.5 context." + (reasons.empty() ? " EGL lists no device." : reasons));
}

const std::string& Device::name() const { return context_->name; }
bool Device::is_software() const { return context_->is_software; }
const DeviceLimits& Device::limits() const { return context_->limits; }

void Device::finish() {
  const Current current(*this);
  glFinish();
  check("waiting for it");
}

void Device::check(const std::string& doing) {
  const Current current(*this);
  const GLenum error = glGetError();
  const std::string where = context_->name + ", " + doing + ": ";
  if (error == GL_CONTEXT_LOST || glGetGraphicsResetStatus() != GL_NO_ERROR) {
    context_->lost = true;
    throw DeviceError(Trouble::lost, where + "the driver gave up the context.");
  }
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  if (error == GL_OUT_OF_MEMORY) throw DeviceError(Trouble::out_of_memory, where + "out of memory.");
  throw DeviceError(Trouble::refused, where + "OpenGL error " + std::to_string(error) + ".");
}

void Device::give_up() {
  const std::lock_guard lock(context_->mutex);
  context_->lost = true;
}

Current::Current(Device& device) : device_(device), lock_(device.context_->mutex) {
  Device::Context& c = *device.context_;
  if (c.lost) throw DeviceError(Trouble::lost, c.name + ": the driver gave up the context.");
  if (c.depth == 0 && !eglMakeCurrent(c.display, EGL_NO_SURFACE, EGL_NO_SURFACE, c.context)) {
    c.lost = true;
    throw DeviceError(Trouble::lost, c.name + ": the context cannot be used any more.");
  }
  ++c.depth;
}

Current::~Current() {
  Device::Context& c = *device_.context_;
  if (--c.depth == 0) eglMakeCurrent(c.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace skysweep::gpu
