// SPDX-License-Identifier: Apache-2.0
#include "models/import_material.h"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "models/import_layers.h"
#include "models/light_units.h"
#include "models/lobe_width.h"
#include "models/material_source.h"
#include "models/obj_materials.h"

namespace oriel::models {
namespace {

/// Reflectance at normal incidence for an index of refraction of 1.5, the default of glTF.
constexpr float kDielectric = .04f;
/// Exponent of Schlick's formula, and default of brdf_curve.
constexpr float kCurve = 5;

/// Reads the properties of one material and makes its shaders.
class MaterialMaker {
 public:
  explicit MaterialMaker(MaterialSource source) : m_(std::move(source)), extras_(m_.extras()) {}

  ImportedMaterial make(Diagnostics& diagnostics) {
    ImportedMaterial made;
    m_.needs_own_package = add_bump(m_, call_);
    const auto metallic = m_.number(AI_MATKEY_METALLIC_FACTOR);
    const bool pbr = metallic || m_.number(AI_MATKEY_ROUGHNESS_FACTOR);
    // IFC has the same number for methods of reflectance that are not defined.
    const bool says_unlit =
        !m_.words(AI_MATKEY_GLTF_ALPHAMODE).empty() || m_.choice(AI_MATKEY_OBJ_ILLUM);
    if (says_unlit && m_.choice(AI_MATKEY_SHADING_MODEL) == aiShadingMode_Unlit)
      unlit();
    else if (const auto glossiness = m_.number(AI_MATKEY_GLOSSINESS_FACTOR))
      specular_glossiness(*glossiness);
    else if (pbr)
      metallic_roughness(metallic.value_or(0));
    else
      classic();
    if (pbr && m_.words(AI_MATKEY_GLTF_ALPHAMODE).empty())
      see_through(m_.number(AI_MATKEY_REFRACTI).value_or(1));
    transmission();
    emission();
    coverage();
    transmits_ = call_.has("transparency") || call_.has("cutout_opacity");
    call_ = coated(m_, sheened(m_, std::move(call_)));
    leave_out(diagnostics);
    made.name = m_.name();
    made.needs_own_package = m_.needs_own_package;
    made.surface = std::move(m_.surface);
    made.absorbs = absorbs_;
    return made;
  }
  const ShaderCall& call() const { return call_; }
  bool transmits() const { return transmits_; }

 private:
  /// Factor of the base colour: a texture, vertex colours or both. Created once.
  std::string base_map() {
    if (!base_map_)
      base_map_ = m_.colored(m_.texture(m_.has(aiTextureType_BASE_COLOR) ? aiTextureType_BASE_COLOR
                                                                         : aiTextureType_DIFFUSE));
    return *base_map_;
  }

  /// FBX may combine factors of the metallic-roughness model with colours of the older model.
  Vec3 base_color() const {
    const auto written = m_.color(AI_MATKEY_BASE_COLOR);
    return written ? *written : m_.color(AI_MATKEY_COLOR_DIFFUSE).value_or(Vec3(1));
  }

  /// Uses a diffuse surface: unlit materials would be black under physical lights.
  void unlit() {
    m_.tinted(call_, "diffuse", base_map(), base_color(), "base");
    call_.set("diffuse_weight", 1.0f).set("reflectivity", 0.0f);
    m_.left_out.emplace_back("unlit (shaded as a matte surface instead)");
  }

  void metallic_roughness(float metallic) {
    const Vec3 base = base_color();
    const float roughness = m_.number(AI_MATKEY_ROUGHNESS_FACTOR).value_or(1);
    const std::string map = base_map();
    const std::string both = m_.data(AI_MATKEY_GLTF_PBRMETALLICROUGHNESS_METALLICROUGHNESS_TEXTURE);
    const float ior = m_.number(AI_MATKEY_REFRACTI).value_or(1.5f);
    const float index = m_.number(AI_MATKEY_REFRACTI) ? sqr((ior - 1) / (ior + 1)) : kDielectric;
    // Dielectric part: the specular colour scales the reflectance at all angles.
    const float brightest = max_component(extras_.specular_color);
    const float edge = extras_.specular, f0 = std::min(index * brightest, 1.0f) * edge;
    const Vec3 hue = brightest > 0 ? extras_.specular_color / brightest : Vec3(1);
    m_.tinted(call_, "diffuse", map, base, "base");
    call_.set("reflectivity", 1.0f).set("brdf_fresnel", false);
    call_.set("brdf_curve", kCurve).set("refr_ior", std::max(ior, 1.0f));
    brushed_reflection(roughness, both.empty() ? "" : m_.channel(both, 1, "roughness"));
    const std::string metal = both.empty() ? "" : m_.channel(both, 2, "metallic");
    const auto by_metal = [&](const char* parameter, const char* suffix, float from, float to) {
      if (metal.empty())
        call_.set(parameter, lerp(from, to, metallic));
      else
        call_.connect(parameter, m_.curve(metal, suffix,
                                          [&](float x) { return lerp(from, to, metallic * x); }));
    };
    by_metal("diffuse_weight", "diffuse_weight", 1, 0);
    if (extras_.iridescence > 0) {
      film_reflection(specular_color(hue * f0), map, base, metallic, metal);
      return;
    }
    by_metal("brdf_0_degree_refl", "f0", f0, 1);
    if (edge < 1)
      by_metal("brdf_90_degree_refl", "f90", edge, 1);
    else
      call_.set("brdf_90_degree_refl", 1.0f);
    set_or_connect(call_, "refl_color",
                   reflected(specular_color(hue), map, base, metallic, metal, "tint"));
  }

  /// A constant colour, or the name of a shader.
  struct Color {
    Vec3 value{0};
    std::string shader = {};
  };
  static void set_or_connect(ShaderCall& call, const char* parameter, const Color& color) {
    if (color.shader.empty())
      call.set(parameter, color.value);
    else
      call.connect(parameter, color.shader);
  }

  /// The colour of the dielectric part times the textures of KHR_materials_specular.
  Color specular_color(const Vec3& factor) {
    std::string colors = m_.texture(aiTextureType_UNKNOWN, kSpecularColorTexture);
    if (const std::string map = m_.data(aiTextureType_UNKNOWN, kSpecularTexture); !map.empty()) {
      const std::string strength = m_.alpha(map, "specular_strength");
      colors = colors.empty() ? strength : m_.product(strength, colors, "specular_colors");
    }
    if (colors.empty() || factor == Vec3(1)) return {factor, colors};
    return {factor, m_.add("specular", MaterialSource::multiplied(colors, factor))};
  }

  /// The colour of the dielectric part, with the base colour over it in proportion to metallic.
  Color reflected(const Color& dielectric, const std::string& map, const Vec3& base, float metallic,
                  const std::string& metal, const char* suffix) {
    const bool constant = map.empty() && dielectric.shader.empty() && metal.empty();
    if (metallic <= 0) return dielectric;
    if (constant) return {dielectric.value * (1 - metallic) + base * metallic};
    ShaderCall mix("mib_color_mix");
    mix.set("num", 1).set("mode_0", 1);
    set_or_connect(mix, "color_base", dielectric);
    m_.tinted(mix, "color_0", map, base, "tinted");
    if (!metal.empty())
      mix.connect("weight_0", m_.curve(metal, "metal", [&](float x) { return metallic * x; }));
    else if (metallic < 1)
      mix.set("weight_0", metallic);
    return {Vec3(0), m_.add(suffix, mix)};
  }

  /// A film over the reflecting surface: the colour of the reflection changes with the angle.
  void film_reflection(const Color& dielectric, const std::string& map, const Vec3& base,
                       float metallic, const std::string& metal) {
    ShaderCall film("oriel_thin_film");
    set_or_connect(film, "reflectance",
                   reflected(dielectric, map, base, metallic, metal, "under_film"));
    film.set("ior", extras_.film_ior);
    if (const std::string much = m_.data(aiTextureType_UNKNOWN, kIridescenceTexture); much.empty())
      film.set("factor", extras_.iridescence);
    else
      film.connect("factor", m_.curve(m_.channel(much, 0, "iridescence"), "film_factor",
                                      [&](float x) { return extras_.iridescence * x; }));
    const std::string thick = m_.data(aiTextureType_UNKNOWN, kIridescenceThicknessTexture);
    if (thick.empty())
      film.set("thickness", extras_.film_thickness);
    else
      film.connect("thickness",
                   m_.curve(m_.channel(thick, 1, "film"), "film_thickness", [&](float x) {
                     return lerp(extras_.film_least, extras_.film_thickness, x);
                   }));
    call_.connect("refl_color", m_.add("film", film));
    call_.set("brdf_0_degree_refl", 1.0f).set("brdf_90_degree_refl", 1.0f);
    m_.needs_own_package = true;
  }

  /// The lobe of the reflection; `rough` is a shader or empty.
  void brushed_reflection(float roughness, const std::string& rough) {
    const std::string map =
        extras_.anisotropy > 0 ? m_.data(aiTextureType_UNKNOWN, kAnisotropyTexture) : std::string();
    const std::string strength = map.empty() ? "" : m_.channel(map, 2, "brushed_strength");
    // A value by the texture of roughness, or by that of the strength; by both it is mixed between
    // the curves of no strength and of the whole.
    const auto set = [&](const char* parameter, const std::string& suffix,
                         float (*value)(const Brushed&)) {
      const auto at = [&](float x, float y) {
        return value(brushed(roughness * x, extras_.anisotropy * y));
      };
      const auto by_roughness = [&](float y, const char* which) {
        return m_.curve(rough, suffix + which, [&](float x) { return at(x, y); });
      };
      if (rough.empty() && strength.empty()) {
        call_.set(parameter, at(1, 1));
      } else if (strength.empty()) {
        call_.connect(parameter, by_roughness(1, ""));
      } else if (rough.empty()) {
        call_.connect(parameter, m_.curve(strength, suffix, [&](float y) { return at(1, y); }));
      } else {
        ShaderCall mix("mib_color_mix");
        mix.set("num", 1).set("mode_0", 1).connect("weight_0", strength);
        mix.connect("color_base", by_roughness(0, "_round"));
        mix.connect("color_0", by_roughness(1, "_brushed"));
        call_.connect(parameter, m_.add(suffix, mix));
      }
    };
    set("refl_gloss", "gloss", [](const Brushed& b) { return b.gloss; });
    if (extras_.anisotropy <= 0) return;
    set("anisotropy", "stretched", [](const Brushed& b) { return b.ratio; });
    // Anisotropic reflections follow the texture coordinates of the tangents.
    m_.need_a_space();
    constexpr int kDerivatives = -3;
    const float turn = extras_.anisotropy_turn / kTwoPi;
    call_.set("anisotropy_channel", kDerivatives);
    if (map.empty()) {
      call_.set("anisotropy_rotation", turn);
      return;
    }
    ShaderCall angle("oriel_direction_angle");
    angle.connect("direction", map).set("offset", turn);
    call_.connect("anisotropy_rotation", m_.add("brushed_angle", angle));
    m_.needs_own_package = true;
  }

  /// Specular reflection with the given colour at normal incidence; the hue is kept at all angles.
  void shine(const Vec3& specular, float roughness) {
    const float brightest = max_component(specular);
    call_.set("reflectivity", brightest > 0 ? 1.0f : 0.0f);
    if (brightest <= 0) return;
    call_.set("refl_color", specular / brightest);
    call_.set("refl_gloss", gloss_of_roughness(roughness));
    call_.set("brdf_fresnel", false).set("brdf_0_degree_refl", clamp01(brightest));
    call_.set("brdf_90_degree_refl", 1.0f).set("brdf_curve", kCurve);
  }

  void specular_glossiness(float glossiness) {
    m_.tinted(call_, "diffuse", base_map(), m_.color(AI_MATKEY_COLOR_DIFFUSE).value_or(Vec3(1)),
              "diffuse");
    call_.set("diffuse_weight", 1.0f);
    shine(m_.color(AI_MATKEY_COLOR_SPECULAR).value_or(Vec3(1)), 1 - glossiness);
    if (m_.has(aiTextureType_SPECULAR)) m_.left_out.emplace_back("specular-glossiness texture");
  }

  /// Reflectance at normal incidence for a Phong highlight of strength k. Materials that are marked
  /// as mirrors use k. Otherwise the highlight of a small light has the brightness of Phong's k
  /// cos^n: f0 times the peak of a lobe with that exponent is (n + 2) / 8 times the value of a
  /// white surface. Without this, k = .5, which some programs write for all dielectrics, would act
  /// as a mirror. The minimum is that of glass.
  float reflectance(float k, float exponent) const {
    constexpr int kFirstMirror = 3, kShadowCatcher = 10;  // values of `illum` in MTL
    k = clamp01(k);
    const int illum = m_.choice(AI_MATKEY_OBJ_ILLUM).value_or(0);
    if (illum >= kFirstMirror && illum < kShadowCatcher) return k;
    return std::min(k, std::max(kDielectric, 8 * k / (exponent + 2)));
  }

  void classic() {
    const std::string map = m_.texture(aiTextureType_DIFFUSE);
    const bool colored = m_.colors().are == ColorsAre::Pictures;
    m_.tinted(call_, "diffuse", m_.colored(map),
              colored ? Vec3(1) : m_.color(AI_MATKEY_COLOR_DIFFUSE).value_or(Vec3(.6f)), "diffuse");
    call_.set("diffuse_weight", 1.0f);
    const Vec3 specular = m_.color(AI_MATKEY_COLOR_SPECULAR).value_or(Vec3(0));
    const float strength = m_.number(AI_MATKEY_SHININESS_STRENGTH).value_or(1);
    const float exponent = m_.number(AI_MATKEY_SHININESS).value_or(0);
    const float ior = std::max(m_.number(AI_MATKEY_REFRACTI).value_or(1), 1.0f);
    const auto mode = m_.choice(AI_MATKEY_SHADING_MODEL);
    // assimp gives Collada's lambert a specular colour; in OBJ the shading mode is not reliable.
    const bool matte = (mode == aiShadingMode_Flat || mode == aiShadingMode_Gouraud) &&
                       !m_.choice(AI_MATKEY_OBJ_ILLUM);
    const float brightest = max_component(specular);
    const bool shines = !matte && brightest > 0 && exponent > 0;
    // alpha = roughness squared, hence two square roots for gloss_of_roughness.
    shine(shines ? specular * (reflectance(brightest * strength, exponent) / brightest) : Vec3(0),
          std::sqrt(std::sqrt(2 / (exponent + 2))));
    if (ior > 1) call_.set("refr_ior", ior);
    see_through(ior);
  }

  /// The surface as a whole, as formats other than glTF define it: its opacity, with the colour
  /// that passes, and a picture of where it is.
  void see_through(float ior) {
    if (const std::string mask = m_.data(aiTextureType_OPACITY); !mask.empty())
      call_.connect("cutout_opacity", mask);
    const float opacity = clamp01(m_.number(AI_MATKEY_OPACITY).value_or(1));
    Vec3 passing(1 - opacity);
    if (const auto filter = m_.color(ORIEL_MATKEY_FILTER)) {
      passing = opacity < 1 ? *filter * (1 - opacity) : *filter;
    } else if (m_.number(AI_MATKEY_TRANSPARENCYFACTOR)) {  // FBX
      const Vec3 color = m_.color(AI_MATKEY_COLOR_TRANSPARENT).value_or(Vec3(1));
      if (max_component(color) > 0) passing *= color / max_component(color);
    }
    const float most = clamp01(max_component(passing));
    if (most <= 0) return;
    call_.set("transparency", most).set("refr_color", passing / most);
    call_.set("thin_walled", ior <= 1);
  }

  void transmission() {
    const float through = clamp01(m_.number(AI_MATKEY_TRANSMISSION_FACTOR).value_or(0));
    if (through <= 0) return;
    const float thickness = m_.number(AI_MATKEY_VOLUME_THICKNESS_FACTOR).value_or(0);
    const float roughness = m_.number(AI_MATKEY_ROUGHNESS_FACTOR).value_or(0);
    if (const std::string map = m_.data(AI_MATKEY_TRANSMISSION_TEXTURE); map.empty())
      call_.set("transparency", through);
    else
      call_.connect("transparency", m_.curve(m_.channel(map, 0, "transmission"), "transparency",
                                             [&](float x) { return through * x; }));
    call_.set("thin_walled", thickness <= 0);
    call_.set("refr_color", base_color());
    // Microfacets deflect transmitted rays less than reflected ones, but refr_gloss gives both the
    // same width.
    const float ior = m_.number(AI_MATKEY_REFRACTI).value_or(1.5f);
    const float bending = thickness > 0 ? std::abs(1 - 1 / std::max(ior, 1.0f)) / 2 : 1;
    call_.set("refr_gloss", gloss_of_roughness(roughness * std::sqrt(bending)));
    const float distance = m_.number(AI_MATKEY_VOLUME_ATTENUATION_DISTANCE).value_or(0);
    if (thickness <= 0 || !(distance > 0)) return;
    const Vec3 tint = m_.color(AI_MATKEY_VOLUME_ATTENUATION_COLOR).value_or(Vec3(1));
    call_.set("refr_falloff_on", true).set("refr_falloff_dist", distance);
    call_.set("refr_falloff_color_on", true).set("refr_falloff_color", tint);
    absorbs_ = true;
  }

  void emission() {
    const Vec3 emissive = m_.color(AI_MATKEY_COLOR_EMISSIVE).value_or(Vec3(0));
    const float strength =
        m_.number(AI_MATKEY_EMISSIVE_INTENSITY).value_or(extras_.emissive_strength) *
        m_.number(ORIEL_MATKEY_EMISSION_SCALE).value_or(1);
    if (max_component(emissive) > 0)
      m_.tinted(call_, "additional_color", m_.texture(aiTextureType_EMISSIVE), emissive * strength,
                "emission");
  }

  void coverage() {
    const std::string mode = m_.words(AI_MATKEY_GLTF_ALPHAMODE);
    if (mode.empty() || mode == "OPAQUE") return;
    const float alpha = clamp01(m_.number(AI_MATKEY_OPACITY).value_or(1));
    const bool mask = mode == "MASK";
    const float cutoff = m_.number(AI_MATKEY_GLTF_ALPHACUTOFF).value_or(.5f);
    const std::string map = base_map();
    if (map.empty()) {
      const float covered = !mask ? alpha : alpha >= cutoff ? 1.0f : 0.0f;
      if (covered < 1) call_.set("cutout_opacity", covered);
      return;
    }
    ShaderCall coverage("mib_color_alpha");
    coverage.connect("input", map).set("factor", alpha);
    std::string covered = m_.add("coverage", coverage);
    if (mask) covered = m_.add("mask", step_at(cutoff, covered));
    call_.connect("cutout_opacity", covered);
  }

  /// 1 from a value on, 0 below it.
  static ShaderCall step_at(float value, const std::string& shader) {
    constexpr float kWidth = 1e-4f;  // below half a step of 8-bit pictures
    ShaderCall step("mib_color_interpolate");
    step.connect("input", shader).set("num", 4);
    step.set("weight_1", clamp01(value - kWidth)).set("weight_2", clamp01(value));
    step.set("color_0", Vec3(value <= 0 ? 1 : 0)).set("color_1", Vec3(value <= 0 ? 1 : 0));
    return step.set("color_2", Vec3(1)).set("color_3", Vec3(value > 1 ? 0 : 1));
  }

  void leave_out(Diagnostics& diagnostics) {
    std::vector<std::string> parts = m_.left_out;
    parts.insert(parts.end(), extras_.left_out.begin(), extras_.left_out.end());
    if (!parts.empty())
      diagnostics.note("OR-MD-003", {},
                       fmt::format("material \"{}\": unsupported properties are ignored: {}",
                                   m_.name(), fmt::join(parts, ", ")));
  }

  MaterialSource m_;
  const GltfExtras extras_;
  std::optional<std::string> base_map_;
  ShaderCall call_{"mia_material_x"};
  bool transmits_ = false, absorbs_ = false;
};

}  // namespace

std::string unique_name(const scene::Scene& scene, const std::string& wish) {
  constexpr std::size_t kLongestName = 200;
  std::string name;
  for (const char c : wish.substr(0, kLongestName))
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) name = "_" + name;
  if (!scene.find(name)) return name;
  for (int i = 2;; ++i)
    if (std::string numbered = fmt::format("{}_{}", name, i); !scene.find(numbered))
      return numbered;
}

std::string add_shader(scene::Scene& scene, const std::string& wish, const ShaderCall& call) {
  scene::ShaderElement shader;
  shader.name = unique_name(scene, wish);
  shader.functions = {call.use()};
  std::string name = shader.name;
  scene.add(std::move(shader));
  return name;
}

ImportedMaterial add_material(const aiScene& model, unsigned index,
                              const std::map<std::string, GltfExtras>& extras, ColorsAre colors,
                              TextureMaker& textures, scene::Scene& scene,
                              Diagnostics& diagnostics) {
  const aiMaterial& source = *model.mMaterials[index];
  const std::string written = const_cast<aiMaterial&>(source).GetName().C_Str();
  scene::Material material;
  material.name =
      unique_name(scene, !written.empty() ? written : fmt::format("material_{}", index));
  const std::string name = material.name;
  scene.add(material);  // reserves the name before its shaders are named
  const auto more = extras.find(written);
  MaterialMaker maker({model, source, more == extras.end() ? nullptr : &more->second,
                       vertex_colors(model, index, colors), name, textures, scene});
  ImportedMaterial made = maker.make(diagnostics);
  // A shader has to follow the shaders that it refers to.
  scene.remove(name);
  if (maker.transmits()) {
    scene::ShaderUse surface;
    surface.reference = add_shader(scene, name + "_surface", maker.call());
    material.shaders = {surface};
    material.slots = {{"shadow", {surface}}, {"photon", {surface}}};
  } else {
    material.shaders = {maker.call().use()};
  }
  scene.add(std::move(material));
  return made;
}

}  // namespace oriel::models
