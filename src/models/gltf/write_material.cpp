// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/write_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/file_text.h"
#include "base/temporary_folder.h"
#include "bsdf/gloss.h"
#include "image/files.h"
#include "models/gltf/plain_file.h"
#include "models/gltf/shader_call.h"
#include "scene/scene.h"

namespace oriel::models::gltf {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxChain = 20;  ///< shaders between a parameter and its texture

json list_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 clamped(const Vec3& v) { return {clamp01(v.x), clamp01(v.y), clamp01(v.z)}; }
float roughness_of(float gloss) { return std::sqrt(std::min(bsdf::gloss_to_alpha(gloss), 1.0f)); }
/// Reflectance at normal incidence of an index of refraction, and its inverse.
float reflectance_of(float ior) { return sqr((ior - 1) / (ior + 1)); }
float index_of_reflectance(float f0) {
  const float root = std::sqrt(clamp(f0, 0, .99f));
  return (1 + root) / (1 - root);
}

/// Values of the parameters, and the defaults of mia_material for the others.
struct Look {
  const scene::ShaderUse& use;

  const scene::Value* value(std::string_view name) const {
    for (const scene::Argument& a : use.arguments)
      if (a.name == name) return &a.value;
    return nullptr;
  }
  float number(std::string_view name, float fallback) const {
    const scene::Value* v = value(name);
    return v && !v->numbers.empty() ? static_cast<float>(v->numbers[0]) : fallback;
  }
  bool flag(std::string_view name) const {
    const scene::Value* v = value(name);
    return v && (v->boolean || (!v->numbers.empty() && v->numbers[0] != 0));
  }
  Vec3 color(std::string_view name, const Vec3& fallback) const {
    const scene::Value* v = value(name);
    if (!v || v->numbers.size() < 3) return fallback;
    return Vec3(static_cast<float>(v->numbers[0]), static_cast<float>(v->numbers[1]),
                static_cast<float>(v->numbers[2]));
  }
  std::string shader(std::string_view name) const {
    const scene::Value* v = value(name);
    return v && v->kind == scene::Value::Kind::Connection ? v->text : std::string();
  }

  float reflectivity() const { return number("reflectivity", .6f); }
  float ior() const { return std::max(number("refr_ior", 1.4f), 1.0f); }
  float facing() const {
    return reflectivity() *
           (flag("brdf_fresnel") ? reflectance_of(ior()) : number("brdf_0_degree_refl", .2f));
  }
  float metallic() const {
    if (flag("refl_is_metal")) return clamp01(reflectivity());
    if (number("transparency", 0) > 0) return 0;
    // The import writes diffuse_weight 1 - m and reflectance lerp(f0, 1, m).
    const float m = 1 - clamp01(number("diffuse_weight", 1));
    constexpr float kMin = .9f;
    return facing() >= kMin * m ? m : 0;
  }
};

}  // namespace

class MaterialWriter::Maker {
 public:
  Maker(const scene::Scene& scene, PlainFile& file, float unit)
      : scene_(scene), file_(file), unit_(unit) {}

  std::size_t index_of(const std::string& material);

  std::set<std::string> notes, extensions;

 private:
  json material_of(const std::string& name);
  void add_transmission(const Look& look, json& made);
  void add_reflection(const Look& look, json& made);
  void add_plastic(const Look& look, json& made);
  /// The texture behind a shader; none: null. `factor` is multiplied by constants on the way.
  json texture_behind(const std::string& shader, Vec3& factor, int depth = 0);
  json texture(const std::string& element);
  json& extension_of(json& made, const char* name);

  const scene::Scene& scene_;
  PlainFile& file_;
  float unit_;
  std::map<std::string, std::size_t> indices_;
  std::map<std::string, json> textures_;
};

json& MaterialWriter::Maker::extension_of(json& made, const char* name) {
  extensions.insert(name);
  return made["extensions"][name];
}

std::size_t MaterialWriter::Maker::index_of(const std::string& material) {
  const auto found = indices_.find(material);
  if (found != indices_.end()) return found->second;
  json made = material_of(material);
  json& all = file_.root["materials"];
  if (!all.is_array()) all = json::array();
  made["name"] = material;
  made["doubleSided"] = true;
  all.push_back(std::move(made));
  return indices_[material] = all.size() - 1;
}

json MaterialWriter::Maker::texture(const std::string& element) {
  const auto found = textures_.find(element);
  if (found != textures_.end()) return found->second;
  json& known = textures_[element];
  const auto* source = scene_.get<scene::Texture>(element);
  if (!source || source->file.empty()) return known;
  const OpenFile picture =
      scene_.files.open((fs::path(source->directory) / source->file).string(), FileUse::Asset);
  if (!picture) {
    notes.insert(fmt::format("picture \"{}\" cannot be read: {}", source->file, picture.reason()));
    return known;
  }
  const fs::path path = picture.path();
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool jpeg = suffix == ".jpg" || suffix == ".jpeg";
  std::string bytes;
  try {
    if (jpeg || suffix == ".png") {
      bytes = file_text(path);
    } else {
      const TemporaryFolder folder;
      const std::string png = folder.file("t.png");
      write_image(png, read_image(path.string()));
      bytes = file_text(png);
    }
  } catch (const std::exception&) {
    bytes.clear();
  }
  if (bytes.empty()) {
    notes.insert(fmt::format("picture \"{}\" cannot be read", source->file));
    return known;
  }
  json &images = file_.root["images"], &textures = file_.root["textures"];
  images.push_back({{"bufferView", file_.add_view(bytes)},
                    {"mimeType", jpeg ? "image/jpeg" : "image/png"},
                    {"name", element}});
  textures.push_back({{"source", images.size() - 1}});
  return known = {{"index", textures.size() - 1}};
}

json MaterialWriter::Maker::texture_behind(const std::string& shader, Vec3& factor, int depth) {
  const auto* element = scene_.get<scene::ShaderElement>(shader);
  if (!element || element->functions.empty() || depth > kMaxChain) return {};
  const scene::ShaderUse& use = element->functions.back();
  const Look look{use};
  for (const scene::Argument& a : use.arguments) {
    if (a.value.kind == scene::Value::Kind::Text && scene_.get<scene::Texture>(a.value.text))
      return texture(a.value.text);
    if (a.value.kind != scene::Value::Kind::Connection) continue;
    if (json found = texture_behind(a.value.text, factor, depth + 1); !found.is_null()) {
      constexpr int kMultiply = 4;
      if (use.type == "mib_color_mix" && look.number("mode_0", 0) == kMultiply)
        factor *= look.color("color_0", Vec3(1));
      else
        notes.insert(fmt::format("shader {} in front of a texture", use.type));
      return found;
    }
  }
  return {};
}

void MaterialWriter::Maker::add_transmission(const Look& look, json& made) {
  const float through = clamp01(look.number("transparency", 0));
  if (through <= 0) return;
  extension_of(made, "KHR_materials_transmission")["transmissionFactor"] = through;
  if (look.flag("refr_translucency")) notes.insert("translucency");
  if (look.flag("thin_walled")) return;
  json& volume = extension_of(made, "KHR_materials_volume");
  volume["thicknessFactor"] = 1;  // above 0: solid; its value is for rasterisers
  if (!look.flag("refr_falloff_on")) return;
  volume["attenuationDistance"] = look.number("refr_falloff_dist", 1);
  if (look.flag("refr_falloff_color_on"))
    volume["attenuationColor"] = list_of(clamped(look.color("refr_falloff_color", Vec3(0))));
  else
    notes.insert("absorption without a colour");
}

/// Index and strength of reflections of what is no metal.
void MaterialWriter::Maker::add_reflection(const Look& look, json& made) {
  const float metallic = look.metallic();
  // Without the share of the metal.
  const float facing = std::max(0.0f, (look.facing() - metallic) / (1 - metallic));
  const float own = reflectance_of(look.ior());
  const bool transmits = look.number("transparency", 0) > 0;
  const float ior = transmits || facing <= own ? look.ior() : index_of_reflectance(facing);
  constexpr float kDefault = 1.5f;
  if (std::fabs(ior - kDefault) > 1e-4f) extension_of(made, "KHR_materials_ior")["ior"] = ior;
  const float f0 = reflectance_of(ior);
  const float strength = f0 > 0 ? clamp01(facing / f0) : 0;
  const Vec3 hue = metallic > 0 ? Vec3(1) : clamped(look.color("refl_color", Vec3(1)));
  if (strength > .999f && hue == Vec3(1)) return;
  json& specular = extension_of(made, "KHR_materials_specular");
  specular["specularFactor"] = strength;
  specular["specularColorFactor"] = list_of(hue);
}

void MaterialWriter::Maker::add_plastic(const Look& look, json& made) {
  json& pbr = made["pbrMetallicRoughness"];
  Vec3 base = look.color("diffuse", Vec3(.5f));
  if (const std::string shader = look.shader("diffuse"); !shader.empty()) {
    base = Vec3(1);
    if (json found = texture_behind(shader, base); !found.is_null())
      pbr["baseColorTexture"] = std::move(found);
  }
  base = clamped(base);
  pbr["baseColorFactor"] = {base.x, base.y, base.z, 1};
  pbr["roughnessFactor"] = clamp01(look.number("roughness", .5f));
  if (!look.shader("roughness").empty()) notes.insert("texture of roughness");
  constexpr float kDefault = 1.5f;
  const float ior = std::max(look.number("ior", kDefault), 1.0f);
  if (std::fabs(ior - kDefault) > 1e-4f) extension_of(made, "KHR_materials_ior")["ior"] = ior;
  if (look.value("bump")) notes.insert("bumps");
}

json MaterialWriter::Maker::material_of(const std::string& name) {
  json made = json::object();
  json& pbr = made["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
  const auto* material = scene_.get<scene::Material>(name);
  const scene::ShaderUse* use =
      material && !material->shaders.empty() ? call_of(scene_, material->shaders.back()) : nullptr;
  if (use && use->type == "mib_glossy_reflection") {
    const Look coat{*use};
    json& clear = extension_of(made, "KHR_materials_clearcoat");
    clear["clearcoatFactor"] = clamp01(coat.number("reflection_edge_weight", 1));
    clear["clearcoatRoughnessFactor"] = std::sqrt(clamp01(coat.number("u_spread", 0)));
    scene::ShaderUse base;
    if (const scene::Value* v = coat.value("base_material")) base.reference = v->text;
    use = base.reference.empty() ? nullptr : call_of(scene_, base);
  }
  if (use && use->type == "oriel_plastic") {
    add_plastic(Look{*use}, made);
    return made;
  }
  if (!use || !use->type.starts_with("mia_material")) {
    notes.insert(fmt::format("materials of shader {}, as grey", use ? use->type : "none"));
    pbr["baseColorFactor"] = {.5, .5, .5, 1};
    return made;
  }
  const Look look{*use};
  const float metallic = look.metallic(), through = clamp01(look.number("transparency", 0));
  const bool is_glass = through >= .5f, metal = metallic > .5f && !look.flag("refl_is_metal");
  const char* base_name = is_glass ? "refr_color" : metal ? "refl_color" : "diffuse";
  Vec3 base = look.color(base_name, is_glass || metal ? Vec3(1) : Vec3(.5f));
  if (const std::string shader = look.shader(base_name); !shader.empty()) {
    base = Vec3(1);
    if (json found = texture_behind(shader, base); !found.is_null())
      pbr["baseColorTexture"] = std::move(found);
  }
  if (!is_glass && metallic <= 0) base *= look.number("diffuse_weight", 1);
  for (const char* parameter : {"refl_gloss", "reflectivity", "transparency", "diffuse_weight"})
    if (!look.shader(parameter).empty()) notes.insert(fmt::format("texture of {}", parameter));
  const float opacity = clamp01(look.number("cutout_opacity", 1));
  base = clamped(base);
  pbr["baseColorFactor"] = {base.x, base.y, base.z, opacity};
  if (opacity < 1 || !look.shader("cutout_opacity").empty()) made["alphaMode"] = "BLEND";
  pbr["metallicFactor"] = metallic;
  pbr["roughnessFactor"] = roughness_of(look.number(is_glass ? "refr_gloss" : "refl_gloss", 1));
  if (metallic < 1) add_reflection(look, made);
  add_transmission(look, made);
  Vec3 emission = look.color("additional_color", Vec3(0));
  if (const std::string shader = look.shader("additional_color"); !shader.empty()) {
    emission = Vec3(1);
    if (json found = texture_behind(shader, emission); !found.is_null())
      made["emissiveTexture"] = std::move(found);
    else
      emission = Vec3(0);
  }
  emission *= unit_;
  if (const float most = max_component(emission); most > 0) {
    made["emissiveFactor"] = list_of(emission / std::max(most, 1.0f));
    if (most > 1) extension_of(made, "KHR_materials_emissive_strength")["emissiveStrength"] = most;
  }
  for (const char* bump : {"bump", "overall_bump", "standard_bump"})
    if (look.value(bump)) notes.insert("bumps");
  if (look.number("anisotropy", 1) != 1) notes.insert("anisotropy");
  return made;
}

MaterialWriter::MaterialWriter(const scene::Scene& scene, PlainFile& file, float unit)
    : maker_(std::make_unique<Maker>(scene, file, unit)) {}
MaterialWriter::~MaterialWriter() = default;

std::size_t MaterialWriter::index_of(const std::string& material) {
  return maker_->index_of(material);
}
const std::set<std::string>& MaterialWriter::notes() const { return maker_->notes; }
const std::set<std::string>& MaterialWriter::extensions() const { return maker_->extensions; }

}  // namespace oriel::models::gltf
