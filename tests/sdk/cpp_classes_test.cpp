// SPDX-License-Identifier: Apache-2.0
// The C++ classes for shaders call the renderer's C functions, which the test replaces.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "shader.h"

namespace {

/// State of the test renderer, and the calls it received.
struct Told {
  std::vector<miTag> linked = {7, 8};
  std::map<miTag, int> samples = {{7, 1}, {8, 3}, {9, 2}};
  std::vector<float> cones;
  std::map<std::string, float> scalars;
  std::map<std::string, std::string> strings;
  int open = 0;
} told;

}  // namespace

extern "C" {
miBoolean mi_instance_lightlist(int* n, miTag** lights, miState*) {
  *n = static_cast<int>(told.linked.size());
  *lights = told.linked.data();
  return miTRUE;
}
miBoolean oriel_light_sample(miColor* result, miVector* dir, miScalar* dot_nl, miState*,
                             miTag light, int* samples, const miVector* axis, miScalar cos_spread) {
  if (*samples >= told.samples[light]) return miFALSE;
  told.cones.push_back(axis != nullptr ? cos_spread : -9);
  *result = {static_cast<float>(light), 0, 0, 1};
  *dir = {0, 0, 1};
  *dot_nl = .5f;
  ++*samples;
  return miTRUE;
}
void oriel_spectrum_from_color(miSpectrum* result, miState*, const miColor* color) {
  result->value[0] = color->r;
}
oriel_shader_interface* mi_get_shader_interface(int version) {
  return version == ORIEL_SHADER_INTERFACE_VERSION
             ? reinterpret_cast<oriel_shader_interface*>(&told)
             : nullptr;
}
oriel_string_options* oriel_options_open(miTag) {
  ++told.open;
  return reinterpret_cast<oriel_string_options*>(&told);
}
void oriel_options_close(oriel_string_options*) { --told.open; }
miBoolean oriel_options_set_boolean(oriel_string_options*, const char* name, miBoolean value) {
  told.strings[name] = value != 0 ? "on" : "off";
  return miTRUE;
}
miBoolean oriel_options_set_integer(oriel_string_options*, const char* name, int value) {
  told.strings[name] = "int " + std::to_string(value);
  return miTRUE;
}
miBoolean oriel_options_set_scalars(oriel_string_options*, const char* name, const float* values,
                                    int n) {
  for (int i = 0; i < n; ++i) told.scalars[name + std::to_string(i)] = values[i];
  return miTRUE;
}
miBoolean oriel_options_set_string(oriel_string_options*, const char* name, const char* value) {
  told.strings[name] = value;
  return miTRUE;
}
miBoolean oriel_options_get_boolean(const oriel_string_options*, const char*, miBoolean* value) {
  *value = 2;
  return miTRUE;
}
miBoolean oriel_options_get_integer(const oriel_string_options*, const char*, int* value) {
  *value = 12;
  return miTRUE;
}
miBoolean oriel_options_get_scalars(const oriel_string_options*, const char* name, float* values,
                                    int n) {
  for (int i = 0; i < n; ++i) {
    const auto found = told.scalars.find(name + std::to_string(i));
    if (found == told.scalars.end()) return miFALSE;
    values[i] = found->second;
  }
  return miTRUE;
}
miBoolean oriel_options_get_string(const oriel_string_options*, const char*, const char** value) {
  *value = "path";
  return miTRUE;
}
miBoolean oriel_options_remove(oriel_string_options*, const char* name) {
  return told.strings.erase(name) > 0 ? miTRUE : miFALSE;
}
}

namespace oriel {
namespace {

using mi::shader::LightIterator;

/// Lights and samples as a shader's loop meets them.
std::vector<std::pair<miTag, int>> met(LightIterator light) {
  std::vector<std::pair<miTag, int>> all;
  for (; !light.at_end(); ++light) {
    while (light->sample()) {
      miColor color;
      light->get_contribution(&color);
      EXPECT_EQ(color.r, static_cast<float>(*light));
      EXPECT_EQ(light->get_dot_nl(), .5f);
      EXPECT_EQ(light->get_direction().z, 1);
      miSpectrum spectrum;
      light->get_contribution(&spectrum);
      EXPECT_EQ(spectrum.value[0], color.r);
    }
    all.emplace_back(*light, light->get_number_of_samples());
  }
  return all;
}

using Met = std::vector<std::pair<miTag, int>>;

TEST(LightIterator, IteratesOverAListOrTheObjectsLights) {
  miState state = {};
  miTag list[2] = {9, 7};
  EXPECT_EQ(met(LightIterator(&state, list, 2)), (Met{{9, 2}, {7, 1}}));
  EXPECT_EQ(met(LightIterator(&state)), (Met{{7, 1}, {8, 3}}));
  EXPECT_EQ(met(LightIterator(&state, list, 0)), (Met{{7, 1}, {8, 3}}));
  told.linked.clear();
  EXPECT_TRUE(LightIterator(&state).at_end());
  told.linked = {7, 8};
}

TEST(LightIterator, AnAxisReplacesTheNormal) {
  miState state = {};
  miTag list[1] = {7};
  const miVector axis = {0, 1, 0};
  told.cones.clear();
  met(LightIterator(&state, list, 1));
  met(LightIterator(&state, axis, .25f, list, 1));
  EXPECT_EQ(told.cones, (std::vector<float>{-9, .25f}));
}

TEST(LightIterator, CopiesKeepTheirPosition) {
  miState state = {};
  miTag list[3] = {7, 8, 9};
  LightIterator a(&state, list, 3);
  LightIterator b = a++;
  EXPECT_EQ(*b, 7u);
  EXPECT_EQ(*a, 8u);
  EXPECT_TRUE(a != b);
  EXPECT_TRUE(a == ++b);
  b = a;
  EXPECT_TRUE(b->sample());
  EXPECT_EQ(a->get_number_of_samples(), 0);
}

TEST(ShaderOptions, ValuesRoundTripByType) {
  using namespace mi::shader;
  EXPECT_EQ(Interface::get(-1), nullptr);
  Interface* const all = Interface::get();
  Options* const options = all->getOptions(1);
  EXPECT_EQ(told.open, 1);
  options->set("flag", true);
  options->set("text", "words");
  options->set("count", 3);
  options->set("colour", .1f, .2f, .3f);
  EXPECT_EQ(told.strings["flag"], "on");
  EXPECT_EQ(told.strings["text"], "words");
  EXPECT_EQ(told.strings["count"], "int 3");
  float r = 0, g = 0, b = 0, a = 9;
  EXPECT_TRUE(options->get("colour", &r, &g, &b));
  EXPECT_EQ(g, .2f);
  EXPECT_FALSE(options->get("colour", r, g, b, a));
  EXPECT_EQ(a, 9);
  bool flag = false;
  EXPECT_TRUE(options->get("flag", flag));
  EXPECT_TRUE(flag);
  int count = 0;
  EXPECT_TRUE(options->get("count", &count));
  EXPECT_EQ(count, 12);
  const char* text = nullptr;
  EXPECT_TRUE(options->get("text", &text));
  EXPECT_STREQ(text, "path");
  EXPECT_TRUE(options->remove("text"));
  EXPECT_FALSE(options->remove("text"));
  options->release();
  EXPECT_EQ(told.open, 0);
  all->release();
}

}  // namespace
}  // namespace oriel
