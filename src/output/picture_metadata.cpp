// SPDX-License-Identifier: Apache-2.0
#include "output/picture_metadata.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include "base/math.h"

namespace oriel {
namespace {

ExrMatrix to_exr(const Mat4& m) {
  ExrMatrix values;
  std::copy_n(m.getValue(), values.size(), values.begin());
  return values;
}

/// From OpenEXR's camera space to NDC. Row vectors.
Mat4 camera_to_ndc(const Camera& c) {
  const float width = static_cast<float>(c.width), height = static_cast<float>(c.height);
  const float scale = c.orthographic ? 1 : c.focal;
  const float x = scale / c.aperture, y = scale * c.aspect / c.aperture;
  const float middle_x = 0.5f - c.offset.x / width, middle_y = 0.5f + c.offset.y / height;
  if (c.orthographic) return Mat4(x, 0, 0, 0, 0, -y, 0, 0, 0, 0, 1, 0, middle_x, middle_y, 0, 1);
  return Mat4(x, 0, 0, 0, 0, -y, 0, 0, middle_x, middle_y, 1, 1, 0, 0, 0, 0);
}

const ShaderNode* find_exposure(const World& world, const NodeList& outputs) {
  for (const NodeList* nodes : {&world.lens, &outputs})
    for (const ShaderNode* node : *nodes)
      if (node->spec().lens.settings) return node;
  return nullptr;
}

}  // namespace

std::map<std::string, ExrValue> picture_metadata(const World& world, const NodeList& outputs) {
  std::map<std::string, ExrValue> all;
  const Camera& c = world.camera;
  const Mat4 forward(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);
  const Mat4 to_camera = c.to_camera * forward;
  all["worldToCamera"] = to_exr(to_camera);
  all["worldToNDC"] = to_exr(to_camera * camera_to_ndc(c));
  if (!c.orthographic)
    all[kFieldOfViewKey] = 2 * math::atan(c.aperture / (2 * c.focal)) * 180 / kPi;
  const ShaderNode* exposure = find_exposure(world, outputs);
  if (!exposure) return all;
  all[kExposureKey] = std::string(exposure->spec().name);
  std::map<std::string, float> settings;
  exposure->spec().lens.settings(*exposure,
                                 [&](const char* name, float value) { settings[name] = value; });
  for (const auto& [name, value] : settings) all[kExposureKey + ("." + name)] = value;
  const auto iso = settings.find("film_iso");
  if (iso == settings.end() || !(iso->second > 0)) return all;
  all["isoSpeed"] = iso->second;
  all["aperture"] = settings["f_number"];
  if (settings["camera_shutter"] > 0) all["expTime"] = 1 / settings["camera_shutter"];
  return all;
}

std::optional<std::string> capture_date(bool now) {
  std::time_t time = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch && *epoch)
    time = static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10));
  else if (!now)
    return std::nullopt;
  std::tm utc = {};
  if (!gmtime_r(&time, &utc)) return std::nullopt;
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc));
}

}  // namespace oriel
