// SPDX-License-Identifier: Apache-2.0
#include "effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace {

/// "test_show": all that it was given as light, so that results of any type can be seen.
struct TestShow {
  Rgba color;
  float scalar;
  Vec3 vector;
  int integer;
  bool boolean;
};
constexpr ParamSpec kTestShowRows[] = {
    {ORIEL_PARAM(TestShow, color)},   {ORIEL_PARAM(TestShow, scalar)},
    {ORIEL_PARAM(TestShow, vector)},  {ORIEL_PARAM(TestShow, integer)},
    {ORIEL_PARAM(TestShow, boolean)},
};
constexpr ShaderSpec kTestShow = {
    .name = "test_show",
    .library = "test",
    .apply = kApplyTexture | kApplyMaterial,
    .params = kTestShowRows,
    .params_size = sizeof(TestShow),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<TestShow>();
          const float number = p.scalar + static_cast<float>(p.integer) + (p.boolean ? 1.0f : 0.0f);
          const Rgb sum = Rgb(p.color.r, p.color.g, p.color.b) + Rgb(p.vector) + Rgb(number);
          *static_cast<Rgba*>(result) = Rgba(sum.x, sum.y, sum.z, p.color.a);
        },
};

/// The parameter of test_show that a result of that type connects to.
const char* entrance_of(ParamType type) {
  switch (type) {
    case ParamType::Scalar:
      return "scalar";
    case ParamType::Vector:
      return "vector";
    case ParamType::Integer:
      return "integer";
    case ParamType::Boolean:
      return "boolean";
    default:
      return "color";
  }
}

/// The shader that a call names.
const ShaderSpec& shader_of(const std::string& call) {
  const std::size_t first = call.find('"') + 1;
  const ShaderSpec* spec = known_shaders().find(call.substr(first, call.find('"', first) - first));
  if (!spec) throw std::runtime_error("no shader of " + call);
  return *spec;
}

/// Type of the result, or of that member of it.
ParamType type_of(const ShaderSpec& spec, const std::string& member) {
  if (member.empty()) return spec.result;
  for (const ParamSpec& row : spec.results)
    if (row.name == member) return row.type;
  throw std::runtime_error("no result " + member);
}

/// The quoted names of the instances that the text `elements` defines, each followed by a space.
std::string instances_of(const std::string& elements) {
  static const std::regex word("(end )?instance \"([^\"]*)\"");
  std::string names;
  for (std::sregex_iterator i(elements.begin(), elements.end(), word), end; i != end; ++i)
    if (!(*i)[1].matched) names += "\"" + (*i)[2].str() + "\" ";
  return names;
}

/// "name value, name value" cut at the commas between parameters.
std::vector<std::pair<std::string, std::string>> split(const std::string& list) {
  std::vector<std::pair<std::string, std::string>> found;
  std::string part;
  int depth = 0;
  bool quoted = false;
  const auto end_part = [&] {
    const std::size_t start = part.find_first_not_of(" \n");
    if (start != std::string::npos) {
      const std::size_t stop = part.find_first_of(" \n", start);
      const std::string name = part.substr(start, stop - start);
      std::erase_if(found, [&](const auto& f) { return f.first == name; });
      found.emplace_back(name, stop == std::string::npos ? "" : part.substr(stop));
    }
    part.clear();
  };
  for (const char c : list) {
    if (c == '"') quoted = !quoted;
    if (!quoted) depth += (c == '[' || c == '{' || c == '(') - (c == ']' || c == '}' || c == ')');
    if (c == ',' && depth == 0 && !quoted)
      end_part();
    else
      part += c;
  }
  end_part();
  return found;
}

std::string name_of(const std::string& parameter) {
  return parameter.substr(parameter.find('.') + 1);
}

Measured measured(const std::string& parameter, const Stage& stage, const std::string& others,
                  const std::string& value) {
  const std::string shader = parameter.substr(0, parameter.find('.'));
  return stage(call_of(shader, others + ", " + name_of(parameter) + " " + value));
}

Case ordered(const std::string& parameter, Stage stage, const std::string& others,
             std::vector<std::string> values, int channel) {
  return {parameter, [=] {
            ASSERT_GE(values.size(), 2u);
            Measured before = measured(parameter, stage, others, values[0]);
            for (std::size_t i = 1; i < values.size(); ++i) {
              SCOPED_TRACE(values[i - 1] + " against " + values[i]);
              const Measured now = measured(parameter, stage, others, values[i]);
              expect_more(now, before, channel);
              before = now;
            }
          }};
}

/// The square with the camera above it that stages of materials share.
SceneText square_of(const std::string& call) {
  SceneText scene;
  scene.statement(
      fmt::format("shader \"s\" {}\nmaterial \"m\" = \"s\" shadow = \"s\" end material", call));
  return scene.plate("m");
}

Measured seen_value(const std::string& call, const std::string& member, const std::string& elements,
                    Vec2 place) {
  const Probe probe(
      testing::scene_text(shown_as_light(call, elements, member), instances_of(elements)),
      known_shaders());
  const Vec2 raster(place.x * 16, place.y * 12);
  return probe.over(64, [&](sampling::Sampler&, int) {
    return std::pair(probe.world().camera.ray(raster), raster);
  });
}

Measured seen_from_above(const SceneText& scene, float degrees, int samples) {
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), Vec3(0, 0, 1), degrees, samples);
}

}  // namespace

const Registry& known_shaders() {
  static const Registry all = testing::test_registry_with({&kTestShow});
  return all;
}

std::string shown_as_light(const std::string& call, const std::string& elements,
                           const std::string& result) {
  return fmt::format(
      "{}\nshader \"seen\" {}\nmaterial \"m\" \"test_show\" ( \"{}\" = \"seen{}{}\" ) "
      "end material\n",
      elements, call, entrance_of(type_of(shader_of(call), result)), result.empty() ? "" : ".",
      result);
}

std::string call_of(std::string_view shader, const std::string& parameters) {
  std::string text;
  for (const auto& [name, value] : split(parameters))
    text += fmt::format("{}\"{}\"{}", text.empty() ? "" : ", ", name, value);
  return fmt::format("\"{}\" ( {} )", shader, text);
}

void expect_more(const Measured& more, const Measured& less, int channel) {
  const float error = std::hypot(more.error[channel], less.error[channel]);
  EXPECT_GT(more.mean[channel] - less.mean[channel],
            4 * error + testing::kRounding * std::abs(more.mean[channel]))
      << more.mean[channel] << " against " << less.mean[channel];
}

Case rises(const std::string& parameter, Stage stage, const std::string& others,
           std::vector<std::string> values, int channel) {
  return ordered(parameter, std::move(stage), others, std::move(values), channel);
}

Case falls(const std::string& parameter, Stage stage, const std::string& others,
           std::vector<std::string> values, int channel) {
  std::reverse(values.begin(), values.end());
  return ordered(parameter, std::move(stage), others, std::move(values), channel);
}

Case gives(const std::string& parameter, Stage stage, const std::string& others,
           std::vector<Given> values) {
  return {parameter, [=] {
            ASSERT_GE(values.size(), 2u);
            for (const Given& each : values)
              testing::expect_exact(parameter + " " + each.value,
                                    measured(parameter, stage, others, each.value), each.expected,
                                    .05f);
          }};
}

Case scales(const std::string& parameter, Stage stage, const std::string& others,
            const std::string& one, const std::string& other, float factor) {
  return {parameter, [=] {
            Measured expected = measured(parameter, stage, others, one);
            EXPECT_GT(max_component(expected.mean), 0) << "nothing is scaled";
            expected.mean *= factor;
            expected.error *= factor;
            testing::expect_same(parameter, measured(parameter, stage, others, other), expected,
                                 .05f);
          }};
}

Case shows(const std::string& parameter, std::function<void()> check) {
  return {parameter, std::move(check)};
}

Case both(Case first, const Case& second) {
  EXPECT_EQ(first.parameter, second.parameter);
  return {first.parameter, [one = first.check, other = second.check] {
            one();
            other();
          }};
}

Stage value(const std::string& elements, Vec2 place) { return member("", elements, place); }

Stage member(const std::string& name, const std::string& elements, Vec2 place) {
  return [=](const std::string& call) { return seen_value(call, name, elements, place); };
}

Stage material_in_sun(float degrees, int samples) {
  return [=](const std::string& call) {
    SceneText scene = square_of(call);
    scene.light("sun",
                "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
    return seen_from_above(scene, degrees, samples);
  };
}

Stage material_in_sky(float degrees, int samples) {
  return [=](const std::string& call) {
    return seen_from_above(square_of(call).uniform_sky(1), degrees, samples);
  };
}

Stage light(const std::string& element, const Vec3& at, int samples) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.lambert("white", 1).square("white", Vec3(0), 5, Vec3(0, 0, 1));
    scene.light("l", call + " " + element);
    return Probe(scene.str(), known_shaders()).onto(at, Vec3(0, 0, 1), 0, samples);
  };
}

Stage environment(const Vec3& direction, int samples) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.environment(call);
    return Probe(scene.str(), known_shaders()).ray(Vec3(0), direction, samples);
  };
}

}  // namespace oriel::effects
