// SPDX-License-Identifier: Apache-2.0
// Open Image Denoise, if its library is on this machine. Oriel does not depend on it: the library
// is opened by name at run time.
#pragma once

#include <string>

#include "denoise/denoise_planes.h"

namespace oriel::denoising {

/// The library of version 1 or 2 of Open Image Denoise. Instances exist once per process, since
/// threads of the library stay alive.
class Oidn {
 public:
  /// Opens the library: that of the environment variable ORIEL_OIDN_LIBRARY if it is set (a path or
  /// name; empty = none), else libOpenImageDenoise.so.2, .so.1 or .so. Null if there is none, or if
  /// it is no such library.
  static const Oidn* find();

  /// "Open Image Denoise 2.1.0"
  const std::string& name() const { return name_; }

  /// The denoised picture: linear, 3 channels, without upper bound.
  ///
  /// Inputs:  features: see Noisy, or null; albedo and normals are denoised first.
  /// Errors:  std::runtime_error with the message of the library.
  Planes denoise(const Planes& color, const Planes* features) const;

 private:
  struct Functions;
  explicit Oidn(const Functions& functions);
  static const Oidn* open();

  const Functions* functions_;
  void* device_;
  std::string name_;
};

}  // namespace oriel::denoising
