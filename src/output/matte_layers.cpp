// SPDX-License-Identifier: Apache-2.0
#include "output/matte_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "image/cryptomatte.h"
#include "output/layer_table.h"
#include "scene/element_settings.h"

namespace oriel {
namespace {

constexpr std::array<MatteKind, 3> kKinds = {MatteKind::Object, MatteKind::Material,
                                             MatteKind::Asset};

const char* type_name(MatteKind kind) {
  return kind == MatteKind::Object     ? "CryptoObject"
         : kind == MatteKind::Material ? "CryptoMaterial"
                                       : "CryptoAsset";
}

std::vector<std::string> names_of(const RenderSession& session, MatteKind kind) {
  const World& world = session.world();
  std::vector<std::string> names;
  if (kind == MatteKind::Asset) return session.mattes()->names().assets;
  if (kind == MatteKind::Object) return session.mattes()->names().objects;
  for (const Material& m : world.materials) names.push_back(m.name);
  return names;
}

/// The name without `_inst` or `_inst_N`; unchanged if nothing would remain.
std::string without_suffix(const std::string& name) {
  constexpr std::string_view kSuffix = "_inst";
  const std::size_t at = name.rfind(kSuffix);
  if (at == std::string::npos || at == 0) return name;
  std::string_view rest = std::string_view(name).substr(at + kSuffix.size());
  if (rest.empty()) return name.substr(0, at);
  if (rest.front() == '_') rest.remove_prefix(1);
  const bool number = !rest.empty() && rest.find_first_not_of("0123456789") == rest.npos;
  return number ? name.substr(0, at) : name;
}

/// Object names from names and elements of the instances.
std::vector<std::string> object_names(const std::vector<std::string>& instances,
                                      const std::vector<std::string>& elements) {
  std::map<std::string, std::set<std::string>> elements_of;
  std::set<std::string> ambiguous;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    std::string name = without_suffix(instances[i]);
    if (!elements_of[name].insert(elements[i]).second) ambiguous.insert(std::move(name));
  }
  std::vector<std::string> names;
  for (const std::string& instance : instances) {
    const std::string name = without_suffix(instance);
    names.push_back(ambiguous.contains(name) ? instance : name);
  }
  return names;
}

/// The instance that covers most of a pixel, over all of its materials.
Mattes::Share foremost(const std::vector<Mattes::Share>& shares) {
  Mattes::Share most;
  for (const Mattes::Share& share : shares) {
    float sum = 0;
    for (const Mattes::Share& other : shares)
      if (other.seen.instance == share.seen.instance) sum += other.coverage;
    if (sum > most.coverage) most = {share.seen, sum};
  }
  return most;
}

/// Ranks of one kind as an image of 2 x ranks channels.
Image ranked(const RenderSession& session, MatteKind kind, int ranks) {
  std::vector<float> ids;
  for (const std::string& name : names_of(session, kind)) ids.push_back(cryptomatte_id(name));
  const Material* first = session.world().materials.data();
  const auto id_of = [&](const FirstSurface& seen) {
    if (seen.instance < 0) return 0.0f;
    return kind == MatteKind::Material ? ids[static_cast<std::size_t>(seen.material - first)]
                                       : ids[static_cast<std::size_t>(seen.instance)];
  };
  return collect_pixels(session, 2 * ranks, [&](int x, int y, float* to) {
    const std::vector<Mattes::Share> seen = session.mattes()->shares(x, y);
    std::vector<CryptomatteShare> shares;
    shares.reserve(seen.size());
    for (const Mattes::Share& s : seen) shares.push_back({id_of(s.seen), s.coverage});
    rank_shares(shares, {to, static_cast<std::size_t>(2 * ranks)});
  });
}

}  // namespace

MatteNames matte_names(const scene::Scene& scene, const World& world, int depth) {
  MatteNames names;
  names.depth = depth;
  std::vector<std::string> instances;
  for (const InstanceData& data : world.instances) {
    const auto* instance = scene.get<scene::Instance>(data.name);
    const auto* object = instance ? scene.get<scene::Object>(instance->element) : nullptr;
    instances.push_back(data.name);
    names.assets.push_back(object ? object->name : data.name);
    const std::uint32_t label = instance ? scene::settings_of(*instance).label : 0;
    names.labels.push_back(label == 0 && object ? scene::settings_of(*object).label : label);
  }
  names.objects = object_names(instances, names.assets);
  return names;
}

std::vector<Layer> cryptomatte_layers(const RenderSession& session) {
  std::vector<Layer> layers;
  if (!session.mattes()) return layers;
  const int files = (session.mattes()->names().depth + 1) / 2;
  for (const MatteKind kind : kKinds) {
    if (files == 0) break;
    const Image all = ranked(session, kind, 2 * files);
    for (int i = 0; i < files; ++i) {
      Image image(all.width, all.height, 4);
      for (std::size_t p = 0; p < all.pixel_count(); ++p)
        std::copy_n(
            &all.pixels[p * static_cast<std::size_t>(4 * files) + static_cast<std::size_t>(4 * i)],
            4, &image.pixels[4 * p]);
      layers.push_back(
          {fmt::format("{}{:02}", type_name(kind), i), {"r", "g", "b", "a"}, std::move(image)});
    }
  }
  return layers;
}

std::map<std::string, std::string> cryptomatte_metadata(const RenderSession& session) {
  std::map<std::string, std::string> all;
  if (!session.mattes() || session.mattes()->names().depth == 0) return all;
  for (const MatteKind kind : kKinds)
    all.merge(cryptomatte_metadata(type_name(kind), names_of(session, kind)));
  return all;
}

void write_label(const RenderSession& session, int x, int y, float* to) {
  const FirstSurface seen = foremost(session.mattes()->shares(x, y)).seen;
  const auto& labels = session.mattes()->names().labels;
  *to = seen.instance < 0 ? 0 : static_cast<float>(labels[static_cast<std::size_t>(seen.instance)]);
}

void write_coverage(const RenderSession& session, int x, int y, float* to) {
  const Mattes::Share most = foremost(session.mattes()->shares(x, y));
  *to = most.seen.instance < 0 ? 0 : most.coverage;
}

}  // namespace oriel
