// SPDX-License-Identifier: Apache-2.0
// Thumbnails of textures.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"
#include "color/srgb.h"
#include "image/files.h"
#include "image/texture.h"
#include "scene/asset_path.h"
#include "studio/controller.h"
#include "studio/json_values.h"
#include "studio/request_error.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;

constexpr int kThumbnailSide = 96;
constexpr std::size_t kMostThumbnails = 256;

/// The picture reduced to kThumbnailSide, for display.
Image thumbnail_of(const Texture& texture, bool is_linear) {
  const float longest = static_cast<float>(std::max({texture.width(), texture.height(), 1}));
  const auto side = [&](int pixels) {
    return std::max(1, static_cast<int>(kThumbnailSide * static_cast<float>(pixels) / longest));
  };
  Image image(side(texture.width()), side(texture.height()), 3);
  const Vec2 step(1 / static_cast<float>(image.width), 1 / static_cast<float>(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vec2 uv((static_cast<float>(x) + 0.5f) * step.x,
                    1 - (static_cast<float>(y) + 0.5f) * step.y);
      const Rgba c = texture.sample(uv, {Vec2(step.x, 0), Vec2(0, step.y)},
                                    {.wrap_u = Wrap::Clamp, .wrap_v = Wrap::Clamp});
      float* to = image.at(x, y);
      const float channels[3] = {c.r, c.g, c.b};
      for (int i = 0; i < 3; ++i) {
        const float value = std::clamp(channels[i], 0.0f, 1.0f);
        to[i] = is_linear ? srgb_encode(value) : value;
      }
    }
  return image;
}

}  // namespace

json Controller::thumbnail(Loop& loop, const json& request) {
  const std::string name = text_field(request, "texture");
  const scene::Scene& scene = loop.scene().scene();
  const auto* element = scene.get<scene::Texture>(name);
  if (!element || element->file.empty())
    throw RequestError("not-found", "there is no texture of that name with a file");
  // Files that the scene may read, and no others.
  const std::string path = scene::find_asset(element->file, element->directory, scene.files);
  const OpenFile source = scene.files.open(path, FileUse::Asset);
  if (!source) throw RequestError("not-found", "the file cannot be read");
  TextureSystem system;
  const TextureSystem::Opened opened =
      system.open(source.path(), 1, scene.budgets[Budget::TextureTile]);
  if (!opened.texture) throw RequestError("not-found", "the file is not a picture");
  const std::string suffix = std::filesystem::path(path).extension().string();
  const Image image = thumbnail_of(*opened.texture, suffix == ".exr" || suffix == ".hdr");
  if (!opened.texture->error().empty()) throw RequestError("not-found", "the picture is damaged");
  const TemporaryFolder folder;
  write_image(folder.file("thumbnail.png"), image, {.srgb = true});
  std::string bytes = open_regular(folder.file("thumbnail.png")).read(std::size_t{1} << 20);
  const std::scoped_lock lock(results_mutex_);
  thumbnails_.push_back(
      {next_thumbnail_, "image/png", std::make_shared<const std::string>(std::move(bytes))});
  if (thumbnails_.size() > kMostThumbnails) thumbnails_.erase(thumbnails_.begin());
  return {{"url", "/api/thumbnail/" + std::to_string(next_thumbnail_++)},
          {"width", opened.texture->width()},
          {"height", opened.texture->height()}};
}

}  // namespace oriel::studio
