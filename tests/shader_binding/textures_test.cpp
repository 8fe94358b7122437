// SPDX-License-Identifier: Apache-2.0
// Texture lookups by shaders: files, inline pixels, procedures, coordinates, spheres.
#include <fmt/format.h>

#include <cmath>

#include "base/temporary_folder.h"
#include "image/exr.h"
#include "image/png.h"
#include "probe.h"

namespace oriel {
namespace textures_test {

#define EXPECT_SILENT(s) EXPECT_TRUE((s).diagnostics.all().empty()) << (s).messages()

/// 2 x 2 texels, from the top: red green / blue white.
Image four_colours() {
  Image image(2, 2, 3);
  const float texels[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) image.at(i % 2, i / 2)[c] = texels[i][c];
  return image;
}

Rgba look_up(const ProbeScene& s, std::string_view name = "m") {
  ShadingPoint point;
  point.world = s.world.get();
  const ShaderNode* node = s.node(name);
  EXPECT_NE(node, nullptr) << s.messages();
  return node ? node->color(point) : Rgba(-1);
}

std::string lookup_at(float u, float v, std::string_view texture) {
  return fmt::format(
      "{}\nmaterial \"m\" \"mib_texture_lookup\" ( \"tex\" \"t\", \"coord\" {} {} 0 ) "
      "end material",
      texture, u, v);
}

void expect_rgb_near(const Rgba& c, float r, float g, float b, float tolerance = 0.003f) {
  EXPECT_NEAR(c.r, r, tolerance);
  EXPECT_NEAR(c.g, g, tolerance);
  EXPECT_NEAR(c.b, b, tolerance);
}

TEST(Textures, FilesHaveTheirOriginAtTheLowerLeft) {
  const TemporaryFolder folder;
  write_png(folder.file("four.png"), four_colours());
  write_exr(folder.file("four.exr"), {Layer{"", {"R", "G", "B"}, four_colours()}});
  for (const char* name : {"four.png", "four.exr"}) {
    const std::string t = fmt::format("color texture \"t\" \"{}\"", folder.file(name));
    const ProbeScene s(lookup_at(.25f, .25f, t));
    EXPECT_SILENT(s);
    expect_rgb_near(look_up(s), 0, 0, 1);
    expect_rgb_near(look_up(ProbeScene(lookup_at(.75f, .25f, t))), 1, 1, 1);
    expect_rgb_near(look_up(ProbeScene(lookup_at(.25f, .75f, t))), 1, 0, 0);
    expect_rgb_near(look_up(ProbeScene(lookup_at(.75f, .75f, t))), 0, 1, 0);
    // The middle is the mean of all four.
    expect_rgb_near(look_up(ProbeScene(lookup_at(.5f, .5f, t))), .5f, .5f, .5f, 0.01f);
  }
}

TEST(Textures, OutsideTheUnitSquareIsTransparentBlack) {
  const std::string t = "color texture \"t\" [1 1 3] 'ffffff'";
  for (const auto& [u, v] : {std::pair{-.1f, .5f}, {1.1f, .5f}, {.5f, -2.f}, {.5f, 3.f}})
    expect_color(look_up(ProbeScene(lookup_at(u, v, t))), 0, 0, 0, 0);
  EXPECT_EQ(look_up(ProbeScene(lookup_at(.5f, .5f, t))).r, 1);
}

TEST(Textures, PixelsMayBeInline) {
  const ProbeScene s(lookup_at(.75f, .5f, "color texture \"t\" [2 1 3] 'ff0000' '00ff00'"));
  EXPECT_SILENT(s);
  expect_rgb_near(look_up(s), 0, 1, 0);
}

TEST(Textures, MissingFilesAreMagentaAndReportedOnce) {
  const ProbeScene s(
      lookup_at(.5f, .5f, "color texture \"t\" \"/nowhere/at/all.png\"") +
      "\nshader \"again\" \"mib_texture_lookup\" ( \"tex\" \"t\", \"coord\" .1 .1 0 )");
  const Diagnostic* message = s.only("OR-RT-020");
  ASSERT_NE(message, nullptr) << s.messages();
  EXPECT_NE(message->message.find("\"t\""), std::string::npos);
  EXPECT_GT(message->where.line, 0u);
  expect_rgb_near(look_up(s), 1, 0, 1);
  EXPECT_EQ(s.report.binding.missing_textures, (std::vector<std::string>{"/nowhere/at/all.png"}));
}

TEST(Textures, PixelsThatDoNotFillTheSizeAreMagenta) {
  const ProbeScene s(lookup_at(.5f, .5f, "color texture \"t\" [4 4 3] 'ff0000'"));
  EXPECT_GT(s.diagnostics.count(Severity::Warning) + s.diagnostics.count(Severity::Error), 0u);
  const Rgba c = look_up(s);
  EXPECT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b));
}

TEST(Textures, ProceduresSeeTheLookUpCoordinate) {
  const ProbeScene s(lookup_at(.25f, .625f,
                               "color texture \"t\" \"probe\" ( \"tint\" = shader \"here\" "
                               "\"mib_texture_vector\" ( \"select\" 0 ) )"));
  EXPECT_SILENT(s);
  expect_rgb_near(look_up(s), .25f, .625f, 0);
}

TEST(Textures, RecursiveProceduresTerminate) {
  const ProbeScene s(lookup_at(
      .5f, .5f, "color texture \"t\" \"mib_texture_lookup\" ( \"tex\" \"t\", \"coord\" .5 .5 0 )"));
  EXPECT_TRUE(std::isfinite(look_up(s).r));
}

TEST(Textures, GreyPicturesGiveGreyAndScalarsTheirMean) {
  const ProbeScene s(probe_call("\"amount\" = \"l\", \"tint\" = \"l\"",
                                "scalar texture \"t\" [1 1 1] '80'\n"
                                "shader \"l\" \"mib_texture_lookup\" ( \"tex\" \"t\", \"coord\" .5 "
                                ".5 0 )\n"));
  EXPECT_NEAR(s.params().amount, 128 / 255.0, 1e-5);
  expect_rgb_near(s.params().tint, 128 / 255.0f, 128 / 255.0f, 128 / 255.0f);
}

/// The vector that shader `call` gives at a point.
Vec3 vector_of(std::string_view call, ShadingPoint& point) {
  const ProbeScene s(fmt::format("material \"m\" {} end material", call));
  EXPECT_SILENT(s);
  point.world = s.world.get();
  return s.node() ? s.node()->vector(point) : Vec3(-99);
}

Vec3 vector_of(std::string_view call) {
  ShadingPoint nowhere;
  return vector_of(call, nowhere);
}

void expect_vec(const Vec3& v, float x, float y, float z) {
  EXPECT_NEAR(v.x, x, 1e-5);
  EXPECT_NEAR(v.y, y, 1e-5);
  EXPECT_NEAR(v.z, z, 1e-5);
}

TEST(TextureVector, SelectsAndProjects) {
  ShadingPoint p;
  p.position = Vec3(1, 2, 3);
  p.normal = Vec3(0, 1, 0);
  p.ray_direction = Vec3(0, 0, -1);
  p.texture_spaces = 4;
  p.tex[0] = Vec3(.1f, .2f, 0);
  p.tex[3] = Vec3(.3f, .4f, .5f);
  const auto of = [&](int select, int project) {
    return vector_of(fmt::format("\"mib_texture_vector\" ( \"select\" {}, \"selspace\" 2, "
                                 "\"project\" {} )",
                                 select, project),
                     p);
  };
  expect_vec(of(0, 0), .1f, .2f, 0);
  expect_vec(of(3, 0), .3f, .4f, .5f);
  expect_vec(of(4, 0), 1, 2, 3);
  expect_vec(of(-1, 0), 1, 2, 3);
  expect_vec(of(-2, 0), 0, 1, 0);
  expect_vec(of(-4, 0), 0, 0, -1);
  expect_vec(of(-1, 1), 1, 2, 0);
  expect_vec(of(-1, 2), 1, 3, 0);
  expect_vec(of(-1, 3), 2, 3, 0);
}

TEST(TextureVector, ObjectSpaceUndoesTheInstance) {
  ShadingPoint p;
  p.position = Vec3(11, 2, 3);
  const Mat4 to_object(.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, 0, 0, 1);
  p.to_object = &to_object;
  expect_vec(vector_of("\"mib_texture_vector\" ( \"select\" -1, \"selspace\" 1 )", p), .5f, 2, 3);
  expect_vec(vector_of("\"mib_texture_vector\" ( \"select\" -1, \"selspace\" 2 )", p), 11, 2, 3);
}

TEST(TextureRemap, WorksInItsDeclaredOrder) {
  const auto remap = [](std::string_view arguments) {
    return vector_of(fmt::format("\"mib_texture_remap\" ( {} )", arguments));
  };
  expect_vec(remap("\"input\" .3 .6 0"), .3f, .6f, 0);
  // Three copies side by side: .7 lies .1 into the third.
  expect_vec(remap("\"input\" .7 .2 0, \"repeat\" 3 2 0"), .1f, .4f, 0);
  // Every other copy mirrored: .4 lies .2 into the second, counted from its end.
  expect_vec(remap("\"input\" .4 .2 0, \"repeat\" 3 0 0, \"alt_x\" on"), .8f, .2f, 0);
  // Outside of 0..1 repeating does not act, wrapping does.
  expect_vec(remap("\"input\" 1.3 -.2 0, \"repeat\" 3 3 0"), 1.3f, -.2f, 0);
  expect_vec(remap("\"input\" 1.3 -.2 0, \"torus_x\" on, \"torus_y\" on"), .3f, .8f, 0);
  // The offset comes last and is not wrapped.
  expect_vec(remap("\"input\" .5 .5 0, \"torus_x\" on, \"offset\" .75 0 2"), 1.25f, .5f, 2);
  // The matrix comes first, and counts only with a last element.
  expect_vec(remap("\"input\" .1 .1 0, \"repeat\" 2 0 0, "
                   "\"transform\" 2 0 0 0 0 2 0 0 0 0 2 0 .1 0 0 1"),
             .6f, .2f, 0);
  expect_vec(remap("\"input\" .1 .1 0, \"transform\" 2 0 0 0 0 2 0 0 0 0 2 0 .1 0 0 0"), .1f, .1f,
             0);
}

TEST(TextureRemap, HugeRepeatsStayInRange) {
  for (const char* repeat : {"1e38", "-1e38", "1e10", "16777217"}) {
    const Vec3 v = vector_of(fmt::format(
        "\"mib_texture_remap\" ( \"input\" .37 .37 0, \"repeat\" {0} {0} 0, \"alt_x\" on )",
        repeat));
    EXPECT_TRUE(v.x >= 0 && v.x <= 1) << repeat << ' ' << v.x;
  }
}

/// 4 x 2 texels; from below: grey 0 .1 .2 .3 / .5 .6 .7 .8.
constexpr std::string_view kPanorama =
    "color texture \"t\" [4 2 3] '000000' '1a1a1a' '333333' '4d4d4d' "
    "'808080' '999999' 'b3b3b3' 'cccccc'\n";

Rgba environment(const ProbeScene& s, const Vec3& direction) {
  ShadingPoint point;
  point.world = s.world.get();
  point.environment = true;
  point.ray_direction = normalize(direction);
  return s.node()->color(point);
}

TEST(LookupSpherical, RowsAreElevationsAndTheSeamIsPeriodic) {
  const ProbeScene s(std::string(kPanorama) +
                     "material \"m\" \"mib_lookup_spherical\" ( \"tex\" \"t\" ) end material");
  EXPECT_SILENT(s);
  EXPECT_GT(environment(s, Vec3(0, 1, .001f)).r, .45f);
  EXPECT_LT(environment(s, Vec3(0, -1, .001f)).r, .35f);
  // Going round once passes every column and comes back without a jump.
  float least = 2, most = -1, last = environment(s, Vec3(0, -1, -1)).r;
  for (int i = 1; i <= 720; ++i) {
    const float a = kTwoPi * static_cast<float>(i) / 720;
    const float c = environment(s, Vec3(std::sin(a), -1, -std::cos(a))).r;
    EXPECT_LT(std::abs(c - last), .02f) << i;
    last = c;
    least = std::min(least, c);
    most = std::max(most, c);
  }
  EXPECT_LT(least, .02f);
  EXPECT_GT(most, .28f);
}

TEST(LookupSpherical, RotateTurnsThePictureByRadians) {
  const ProbeScene still(std::string(kPanorama) +
                         "material \"m\" \"mib_lookup_spherical\" ( \"tex\" \"t\" ) end material");
  const ProbeScene turned(std::string(kPanorama) +
                          "material \"m\" \"mib_lookup_spherical\" ( \"tex\" \"t\", \"rotate\" "
                          "1.5707963 ) end material");
  // One of two senses must match everywhere.
  float worst[2] = {0, 0};
  for (int i = 0; i < 64; ++i) {
    const float a = kTwoPi * (static_cast<float>(i) + .5f) / 64;
    const auto at = [&](const ProbeScene& s, float angle) {
      return environment(s, Vec3(std::sin(angle), .3f, -std::cos(angle))).r;
    };
    for (int sense = 0; sense < 2; ++sense)
      worst[sense] = std::max(
          worst[sense], std::abs(at(turned, a) - at(still, a + (sense ? kPi / 2 : -kPi / 2))));
  }
  EXPECT_LT(std::min(worst[0], worst[1]), .01f);
}

TEST(LookupBackground, ThePictureFillsTheCamerasFrame) {
  const ProbeScene s(std::string(kPanorama) +
                     "material \"m\" \"mib_lookup_background\" ( \"tex\" \"t\" ) end material");
  EXPECT_SILENT(s);
  const Camera& camera = s.world->camera;
  const auto at = [&](float x, float y) {
    return environment(s, camera
                              .ray(Vec2(x * static_cast<float>(camera.width),
                                        y * static_cast<float>(camera.height)))
                              .direction)
        .r;
  };
  // The centres of the texels, lower row first.
  const float rows[2][4] = {{0, .1f, .2f, .3f}, {.5f, .6f, .7f, .8f}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_NEAR(at((static_cast<float>(x) + .5f) / 4, (static_cast<float>(y) + .5f) / 2),
                  rows[y][x], .01f)
          << x << ' ' << y;
  EXPECT_EQ(environment(s, Vec3(0, 0, 1)).a, 0);
}

TEST(LookupBackground, ZoomAndPanAreInPictures) {
  const ProbeScene s(
      std::string(kPanorama) +
      "material \"m\" \"mib_lookup_background\" ( \"tex\" \"t\", \"zoom\" 2 2 0 ) end "
      "material");
  const Camera& camera = s.world->camera;
  // Twice as large: the frame's left edge shows what lay at a quarter.
  const Vec3 left = camera.ray(Vec2(0.001f, 0.25f * static_cast<float>(camera.height))).direction;
  EXPECT_NEAR(environment(s, left).r, .05f + .125f, .13f);
}

}  // namespace textures_test
}  // namespace oriel
