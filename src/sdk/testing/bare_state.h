// SPDX-License-Identifier: Apache-2.0
// Test support: a shader state of a small scene.
#pragma once

#include <limits>
#include <string_view>

#include "prepare/testing/prepared_scene.h"
#include "sampling/sampler.h"
#include "sdk/call.h"
#include "sdk/host.h"

namespace oriel::testing {

/// Random numbers like those of a path; rays hit nothing, and irradiance is set by the test.
class NumbersOnly final : public Tracer {
 public:
  explicit NumbersOnly(std::uint32_t seed = 1) : seed_(seed) { start(0); }
  /// Starts the sample of another pixel, so that samples of a test are independent.
  void start(int pixel) { sampler_.start(pixel, 0, 0, seed_); }

  Vec2 next() override { return sampler_.next_2d(); }
  std::optional<Met> probe(const Vec3&, const Vec3&, float) override { return {}; }
  std::optional<Met> probe_from(const ShadingPoint&, const Vec3&, float) override { return {}; }
  PickedLights pick_lights(const Vec3&) override { return {}; }
  std::optional<Arriving> light(int, ShadingPoint&) override { return {}; }
  Depth depth() const override { return {}; }
  Seen trace(const ShadingPoint&, const SubRay&) override { return {}; }
  Rgb irradiance(const ShadingPoint&, const Vec3& normal) override {
    return normal.z > 0 ? above : below;
  }
  Rgba shade(const NodeList&, ShadingPoint&, MaterialOutputs*) override { return Rgba(0); }
  bool write_buffer(std::size_t, const Rgba&) override { return false; }
  std::optional<Rgba> read_buffer(std::size_t) const override { return {}; }

  Rgb above{0}, below{0};  ///< irradiance of surfaces that face +z and -z

 private:
  std::uint32_t seed_;
  sampling::Sampler sampler_;
};

/// The scene of scene_text() with a point light, its camera and square moved and rotated, and the
/// state of an eye ray that hit the square.
class BareState {
 public:
  explicit BareState(std::string_view options = {})
      : prepared_(text(options)),
        host_(prepared_.scene, builtin_shaders(), {}, prepared_.diagnostics) {
    host_.attach(*prepared_.world);
    point_.world = prepared_.world.get();
    point_.tracer = &numbers;
    frame_.emplace(host_, point_, nullptr);
    state().instance = sdk::make_tag(sdk::TagKind::Instance, 0);
    state().light_instance = sdk::make_tag(sdk::TagKind::LightInstance, 0);
  }

  miState& state() { return frame_->state; }
  sdk::Host& host() { return host_; }
  const World& world() const { return *prepared_.world; }
  Diagnostics& diagnostics() { return prepared_.diagnostics; }

  /// A ray along +x and down, with the given sine and cosine to the normal +z.
  void look_down(float sine, float cosine) {
    state().dir = {sine, 0, -cosine};
    state().normal = state().normal_geom = {0, 0, 1};
    state().dot_nd = -cosine;
  }

  NumbersOnly numbers;

 private:
  static std::string text(std::string_view options) {
    std::string t = scene_text(
        "material \"m\" \"mib_illum_lambert\" (\"diffuse\" .5 .5 .5) end material\n"
        "light \"lamp\" \"mib_light_point\" () origin 0 0 0 end light\n"
        "instance \"lamp_inst\" \"lamp\" transform 1 0 0 0  0 0 1 0  0 -1 0 0  -3 2 1 1 "
        "end instance\n",
        "\"lamp_inst\"", "", options);
    const auto place = [&](std::string_view instance, std::string_view transform) {
      const std::size_t at = t.find(instance);
      t.insert(at + instance.size(), transform);
    };
    // Both are inverses: from the space of the parent to that of the instance.
    place("instance \"cam_inst\" \"cam\"", " transform 0 0 -1 0  0 1 0 0  1 0 0 0  -1 -2 -5 1");
    place("instance \"square_inst\" \"square\"", " transform 2 0 0 0  0 .5 0 0  0 .5 1 0  1 2 3 1");
    return t;
  }

  PreparedScene prepared_;
  sdk::Host host_;
  ShadingPoint point_;
  std::optional<sdk::StateFrame> frame_;
};

}  // namespace oriel::testing
