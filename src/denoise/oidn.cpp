// SPDX-License-Identifier: Apache-2.0
#include "denoise/oidn.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace oriel::denoising {

// Source: the public C interface of Open Image Denoise 1.4 and 2.x. Functions that set values have
//         other names in version 2; both have the same parameters.
struct Oidn::Functions {
  void* (*new_device)(int type);
  void (*commit_device)(void* device);
  int (*device_error)(void* device, const char** message);
  int (*device_int)(void* device, const char* name);
  void* (*new_filter)(void* device, const char* type);
  void (*set_image)(void* filter, const char* name, void* data, int format, std::size_t width,
                    std::size_t height, std::size_t offset, std::size_t pixel_stride,
                    std::size_t row_stride);
  void (*set_bool)(void* filter, const char* name, bool value);
  void (*commit_filter)(void* filter);
  void (*execute_filter)(void* filter);
  void (*release_filter)(void* filter);
};

namespace {

/// Values of the interface. The processor, since pictures must not depend on the graphics card.
constexpr int kDeviceCpu = 1, kFormatFloat3 = 3;

using Pixels = std::vector<float>;  ///< RGB of each pixel, rows from the top

Pixels interleaved(const Planes& planes, int first) {
  Pixels out(3 * planes.size());
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < planes.size(); ++i) out[3 * i + c] = planes.plane(first + c)[i];
  return out;
}

/// The first of the names that the library has.
template <class F>
bool load(void* library, F& function, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    function = reinterpret_cast<F>(dlsym(library, name));
    if (function) return true;
  }
  return false;
}

void* open_library() {
  if (const char* chosen = std::getenv("ORIEL_OIDN_LIBRARY"))
    return *chosen ? dlopen(chosen, RTLD_NOW | RTLD_LOCAL) : nullptr;
  for (const char* name :
       {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1", "libOpenImageDenoise.so"})
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  return nullptr;
}

}  // namespace

Oidn::Oidn(const Functions& functions)
    : functions_(&functions), device_(functions.new_device(kDeviceCpu)) {
  if (!device_) return;
  functions.commit_device(device_);
  const int version = functions.device_int(device_, "version");  // 20103 = 2.1.3
  name_ = fmt::format("Open Image Denoise {}.{}.{}", version / 10000, version / 100 % 100,
                      version % 100);
}

const Oidn* Oidn::open() {
  void* library = open_library();
  if (!library) return nullptr;
  static Functions f;
  const bool complete = load(library, f.new_device, {"oidnNewDevice"}) &&
                        load(library, f.commit_device, {"oidnCommitDevice"}) &&
                        load(library, f.device_error, {"oidnGetDeviceError"}) &&
                        load(library, f.device_int, {"oidnGetDeviceInt", "oidnGetDevice1i"}) &&
                        load(library, f.new_filter, {"oidnNewFilter"}) &&
                        load(library, f.set_image, {"oidnSetSharedFilterImage"}) &&
                        load(library, f.set_bool, {"oidnSetFilterBool", "oidnSetFilter1b"}) &&
                        load(library, f.commit_filter, {"oidnCommitFilter"}) &&
                        load(library, f.execute_filter, {"oidnExecuteFilter"}) &&
                        load(library, f.release_filter, {"oidnReleaseFilter"});
  if (!complete) return nullptr;
  static const Oidn oidn(f);
  const char* message = nullptr;
  return oidn.device_ && f.device_error(oidn.device_, &message) == 0 ? &oidn : nullptr;
}

const Oidn* Oidn::find() {
  static const Oidn* const found = open();
  return found;
}

Planes Oidn::denoise(const Planes& color, const Planes* features) const {
  static std::mutex one_at_a_time;  // the library reports errors by device
  const std::lock_guard lock(one_at_a_time);
  const Functions& f = *functions_;
  const auto width = static_cast<std::size_t>(color.width);
  const auto height = static_cast<std::size_t>(color.height);

  struct Input {
    const char* name;
    Pixels* pixels;
  };
  const auto run = [&](std::initializer_list<Input> inputs, std::initializer_list<const char*> on) {
    Pixels output(3 * width * height);
    const std::unique_ptr<void, decltype(f.release_filter)> filter(f.new_filter(device_, "RT"),
                                                                   f.release_filter);
    const auto set = [&](const char* name, Pixels& pixels) {
      f.set_image(filter.get(), name, pixels.data(), kFormatFloat3, width, height, 0, 0, 0);
    };
    for (const Input& input : inputs) set(input.name, *input.pixels);
    set("output", output);
    for (const char* name : on) f.set_bool(filter.get(), name, true);
    f.commit_filter(filter.get());
    f.execute_filter(filter.get());
    const char* message = nullptr;
    if (f.device_error(device_, &message) != 0)
      throw std::runtime_error(fmt::format("{}: {}", name_, message ? message : "failed"));
    return output;
  };

  Pixels noisy = interleaved(color, 0), result;
  if (!features) {
    result = run({{"color", &noisy}}, {"hdr"});
  } else {
    Pixels albedo = interleaved(*features, 0), normal = interleaved(*features, 3);
    for (float& v : albedo) v = std::clamp(v, 0.0f, 1.0f);
    // Noise of depth of field, motion and glass is taken out of the features first.
    albedo = run({{"albedo", &albedo}}, {});
    normal = run({{"normal", &normal}}, {});
    result =
        run({{"color", &noisy}, {"albedo", &albedo}, {"normal", &normal}}, {"hdr", "cleanAux"});
  }
  Planes out(color.width, color.height, 3);
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < out.size(); ++i)
      out.plane(c)[i] = std::max(result[3 * i + c], 0.0f);
  return out;
}

}  // namespace oriel::denoising
