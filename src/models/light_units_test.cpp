// SPDX-License-Identifier: Apache-2.0
// Lights and emission in files of Blender: ratio and units.
#include "models/light_units.h"

#include "models/testing/fbx_file.h"
#include "models/testing/gltf_file.h"

namespace oriel::models {
namespace light_units_test {

using testing::GltfFile;
using testing::json;
using testing::Made;

constexpr double kTolerance = .02;

TEST(LightUnits, DependOnTheProgramAndItsVersion) {
  const LightUnits converted{1, 1, 683}, watts{683 / (4 * kPi), 683, 683};
  EXPECT_EQ(light_units("Khronos glTF Blender I/O v3.4.50", ".glb"), converted);
  EXPECT_EQ(light_units("Khronos glTF Blender I/O v4.1.63", ".gltf"), converted);
  EXPECT_EQ(light_units("Khronos glTF Blender I/O v3.3.27", ".glb"), watts);
  EXPECT_EQ(light_units("Khronos glTF Blender I/O v1.2.75", ".glb"), watts);
  EXPECT_EQ(light_units("Blender (stable FBX IO) - 3.4.1 - 4.37.1", ".fbx"), watts);
  EXPECT_EQ(light_units("Blender 3.4.1", ".dae"), watts);
  EXPECT_EQ(light_units("Blender 3.4.1", ".obj"), converted);
  for (const char* other : {"", "Babylon.js glTF exporter", "FBX SDK/FBX Plugins version 2020"})
    EXPECT_EQ(light_units(other, ".glb"), LightUnits()) << other;
}

/// First number of a parameter of the light shader.
double number_in(const Made& made, const char* light, const char* parameter) {
  const auto* found = made.scene ? made.scene->get<scene::Light>(light) : nullptr;
  if (found)
    for (const scene::Argument& a : found->shaders[0].arguments)
      if (a.name == parameter) return a.value.numbers[0];
  ADD_FAILURE() << light;
  return 0;
}
/// Candela of a point light, lux of a sun.
double candela(const Made& made, const char* name) { return number_in(made, name, "color") / 4; }
double lux(const Made& made, const char* name) { return number_in(made, name, "color") * kPi; }

double emitted(const Made& made, const char* material) {
  if (!made.scene) return 0;
  const std::vector<double> color = testing::set_in(*made.scene, material, "additional_color");
  return color.empty() ? 0 : color[0];
}

/// Output of Blender 3.4 for a point light of 1000 W, a sun of 5 W/m2 and an emission of 7.
GltfFile blender_gltf(const char* generator) {
  GltfFile file;
  file.add_triangle();
  file.root["asset"]["generator"] = generator;
  file.material()["emissiveFactor"] = {1, .5, .2};
  file.material()["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 7;
  file.root["extensionsUsed"] = {"KHR_lights_punctual"};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}, {"intensity", 54351.41306588226}},
                   {{"type", "directional"}, {"intensity", 3415}}});
  for (const int i : {0, 1}) {
    file.root["nodes"].push_back({{"name", i == 0 ? "lamp" : "sun"},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    file.root["scenes"][0]["nodes"].push_back(i + 1);
  }
  return file;
}

// In Blender, 1000 W are 1000 / (4 pi) W/sr; an emission of 7 is 7 W/(m2 sr).
constexpr double kLampOverEmission = 1000 / (4 * kPi) / 7, kSunOverEmission = 5. / 7;

// acceptance: M3
TEST(LightUnits, BlendersGltfKeepsTheRatioOfLightsToEmission) {
  Made made;
  made.import(blender_gltf("Khronos glTF Blender I/O v3.4.50").text());
  const double emission = emitted(made, "paint");
  EXPECT_NEAR(candela(made, "lamp") / emission, kLampOverEmission, kTolerance * kLampOverEmission);
  EXPECT_NEAR(lux(made, "sun") / emission, kSunOverEmission, kTolerance * kSunOverEmission);
  EXPECT_NEAR(emission, 7 * 683, 1);
  EXPECT_TRUE(made.said("OR-MD-016"));
}

TEST(LightUnits, OtherProgramsUseTheSpecifiedUnits) {
  Made made;
  made.import(blender_gltf("another program").text());
  EXPECT_NEAR(emitted(made, "paint"), 7, 1e-5);
  EXPECT_NEAR(candela(made, "lamp"), 54351.4, 1);
  EXPECT_FALSE(made.said("OR-MD-016"));
}

TEST(LightUnits, TheScaleOfEmissionCanBeSet) {
  Made made;
  ImportOptions options{made.folder.path() / "t", made.folder.path()};
  options.emission_scale = 3;
  made.scene = import_model(
      made.folder.write("m.gltf", blender_gltf("Khronos glTF Blender I/O v3.4.50").text()), options,
      made.diagnostics);
  EXPECT_NEAR(emitted(made, "paint"), 21, 1e-5);
}

/// Output of Blender 3.4 for white lights. It defines their colour only in the template of lights,
/// which the template of cameras overrides.
std::string blender_fbx(const char* light) {
  testing::FbxFile file;
  file.creator = "Blender (stable FBX IO) - 3.4.1 - 4.37.1";
  file.camera = file.sun = "P: \"Visibility\", \"Visibility\", \"\", \"A\",1\n";
  file.light = light;
  file.definitions =
      "Definitions:  {\nVersion: 100\nCount: 1\nObjectType: \"NodeAttribute\" {\nCount: 2\n"
      "PropertyTemplate: \"FbxLight\" {\nProperties70:  {\n"
      "P: \"Color\", \"ColorRGB\", \"Color\", \"\",0.8,0.8,0.8\n}\n}\n}\n}\n";
  file.layers = testing::FbxFile::one_material();
  file.more =
      "Material: 40, \"Material::glow\", \"\" {\nVersion: 102\nShadingModel: \"Phong\"\n"
      "Properties70:  {\nP: \"DiffuseColor\", \"Color\", \"\", \"A\",0.8,0.4,0.2\n"
      "P: \"EmissiveColor\", \"Color\", \"\", \"A\",1,0.5,0.2\n"
      "P: \"EmissiveFactor\", \"Number\", \"\", \"A\",7\n"
      "P: \"ReflectionFactor\", \"Number\", \"\", \"A\",0.25\n"
      "P: \"Shininess\", \"Number\", \"\", \"A\",25\n}\n}\n";
  file.links = "C: \"OO\",40,11\n";
  return file.text();
}

// acceptance: M3
TEST(LightUnits, BlendersFbxKeepsTheRatioOfLightsToEmission) {
  const struct {
    const char* light;
    bool directional;
    double ratio;
  } kLights[] = {
      {"P: \"Intensity\", \"Number\", \"\", \"A\",100000\n", false, kLampOverEmission},
      {"P: \"LightType\", \"enum\", \"\", \"\",1\nP: \"Intensity\", \"Number\", \"\", \"A\",500\n",
       true, kSunOverEmission},
      {"P: \"LightType\", \"enum\", \"\", \"\",2\nP: \"Intensity\", \"Number\", \"\", "
       "\"A\",50000\nP: \"OuterAngle\", \"double\", \"Number\", \"\",60\n",
       false, kLampOverEmission / 2},
  };
  for (const auto& light : kLights) {
    Made made;
    made.import(blender_fbx(light.light), "m.fbx");
    const double written = light.directional ? lux(made, "sun") : candela(made, "sun");
    EXPECT_NEAR(written / emitted(made, "glow"), light.ratio, kTolerance * light.ratio)
        << light.light;
    EXPECT_NEAR(emitted(made, "glow"), 7 * 683, 1);
  }
}

TEST(LightUnits, BlendersFbxHasMetalnessAsReflectionFactor) {
  Made made;
  made.import(blender_fbx("P: \"Intensity\", \"Number\", \"\", \"A\",100\n"), "m.fbx");
  ASSERT_TRUE(made.scene);
  EXPECT_EQ(testing::set_in(*made.scene, "glow", "diffuse_weight"), (std::vector<double>{.75}));
}

}  // namespace light_units_test
}  // namespace oriel::models
