// SPDX-License-Identifier: Apache-2.0
// Indirect light maps in files, and passes that are observed and interrupted.
#include <filesystem>
#include <fstream>

#include "support/files.h"
#include "support/picture.h"

namespace oriel::testing {
namespace map_files_test {

/// A point light in a grey box, with option statements.
std::string lit_box(const std::string& options) {
  SceneText s("trace depth 4 4 8 photon trace depth 5 5 8 " + options);
  s.lambert("grey", .5f)
      .box("grey", Vec3(-1, -1, -3), Vec3(1, 1, .5f), true)
      .light("lamp",
             "\"physical_light\" ( \"color\" 4 4 4 ) origin 0 .9 -1.5 energy 4 4 4 globillum "
             "photons 4000")
      .camera("focal 1 aperture 1.5 aspect 1 resolution 24 24");
  std::string text = s.str();
  return text.replace(text.find("\"path\""), 6, "\"scene\"");
}

struct Rendered {
  Image picture;
  RayCounts rays;
  std::size_t gather_points = 0;
  StopReason reason{};
  std::vector<std::string> stages, messages;
};

Rendered render(const std::string& options, const MapFiles& files = {},
                const std::string& cancel_at = {}) {
  const Probe probe(lit_box(options));
  Diagnostics diagnostics;
  RenderSession session(
      probe.world(), {.budget = {.samples = 4}, .map_files = files, .diagnostics = &diagnostics});
  Rendered r;
  std::atomic<bool> cancel{false};
  r.reason = session.run({[&](const Progress& p) {
                            if (!p.stage) return;
                            if (r.stages.empty() || r.stages.back() != p.stage)
                              r.stages.emplace_back(p.stage);
                            if (p.stage == cancel_at) cancel = true;
                          },
                          {}},
                         &cancel);
  r.picture = film_layers(session, {}).front().image;
  r.rays = session.rays();
  r.gather_points = session.integrator().gather_points();
  for (const Diagnostic& d : diagnostics.all()) r.messages.push_back(d.code);
  return r;
}

bool shows_light(const Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (!(image.at(x, y)[0] > 0)) return false;
  return true;
}

const std::string kGather = "finalgather on finalgather accuracy 60 ";

// acceptance: H2
TEST(MapFiles, GatherPointsAreKeptExtendedAndFrozen) {
  const TestFolder folder;
  const MapFiles files{.photons = {}, .gather = {folder.file("box.fgm")}};
  const Rendered made = render(kGather, files);
  EXPECT_TRUE(std::filesystem::exists(files.gather[0]));
  const Rendered frozen = render(kGather + "finalgather rebuild freeze", files);
  EXPECT_EQ(frozen.picture.pixels, made.picture.pixels);
  EXPECT_LT(frozen.rays.gather, made.rays.gather / 4);
  const auto size = std::filesystem::file_size(files.gather[0]);
  const Rendered extended =
      render(kGather + "finalgather rebuild off finalgather presample density 8", files);
  EXPECT_GT(extended.gather_points, made.gather_points);
  EXPECT_GT(std::filesystem::file_size(files.gather[0]), size);
  render(kGather, files);
  EXPECT_EQ(std::filesystem::file_size(files.gather[0]), size) << "rebuild on starts over";
}

// acceptance: H2
TEST(MapFiles, IncompatibleMapIsRecomputed) {
  const TestFolder folder;
  const MapFiles files{.photons = folder.file("x.phm"), .gather = {folder.file("x.fgm")}};
  for (const std::string& path : {files.photons, files.gather[0]})
    std::ofstream(path) << "mental ray map with unknown contents";
  const Rendered r =
      render(kGather + "finalgather rebuild off globillum on photonmap rebuild off", files);
  EXPECT_EQ(r.messages,
            (std::vector<std::string>{"OR-RN-042", "OR-RN-068", "OR-TR-102", "OR-TR-101"}));
  for (const std::string& path : {files.photons, files.gather[0]})
    EXPECT_EQ(oriel::text_of(path), "mental ray map with unknown contents");
  EXPECT_TRUE(shows_light(r.picture));
  EXPECT_GT(r.gather_points, 0u);
}

// acceptance: H3
TEST(MapFiles, PhotonsAreReadInsteadOfEmitted) {
  const TestFolder folder;
  const MapFiles files{.photons = folder.file("box.phm"), .gather = {}};
  const Rendered made = render("globillum on", files);
  const Rendered read = render("globillum on photonmap rebuild off", files);
  EXPECT_EQ(read.picture.pixels, made.picture.pixels);
  EXPECT_EQ(read.rays.gather, 0u);
  EXPECT_GT(made.rays.gather, 1000u);
}

// An interrupted map lacks points in a part of the picture.
TEST(MapFiles, InterruptedMapsDoNotReplaceCompleteOnes) {
  const TestFolder folder;
  const MapFiles files{.photons = folder.file("a.phm"), .gather = {folder.file("a.fgm")}};
  const std::string options = kGather + "globillum on";
  render(options, files);
  const auto photons = bytes_of(files.photons), points = bytes_of(files.gather[0]);
  for (const char* stage : {"photons", "gather points"}) {
    EXPECT_EQ(render(options, files, stage).reason, StopReason::Cancelled);
    EXPECT_TRUE(bytes_of(files.photons) == photons) << stage;
    EXPECT_TRUE(bytes_of(files.gather[0]) == points) << stage;
  }
}

// acceptance: H2, H3
TEST(MapFiles, MapsOnlyMakesNoPicture) {
  const TestFolder folder;
  const MapFiles files{.photons = folder.file("a.phm"), .gather = {folder.file("a.fgm")}};
  EXPECT_EQ(render("finalgather only", files).reason, StopReason::MapsOnly);
  EXPECT_TRUE(std::filesystem::exists(files.gather[0]));
  EXPECT_EQ(render("globillum on photonmap only on", files).reason, StopReason::MapsOnly);
  EXPECT_TRUE(std::filesystem::exists(files.photons));
}

TEST(IndirectStages, AreNamedInTheirOrder) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(render(kGather).stages, (Names{"gather points"}));
  EXPECT_EQ(render(kGather + "finalgather trace depth 2 2 2 4").stages,
            (Names{"bounces", "gather points"}));
  EXPECT_EQ(render(kGather + "globillum on").stages, (Names{"photons", "gather points"}));
  EXPECT_EQ(render("").stages, Names{});
}

TEST(IndirectStages, EachLeavesAPictureWhenInterrupted) {
  const std::string options = kGather + "finalgather trace depth 2 2 2 4";
  for (const char* stage : {"bounces", "gather points"}) {
    const Rendered r = render(options, {}, stage);
    EXPECT_EQ(r.reason, StopReason::Cancelled) << stage;
    EXPECT_TRUE(shows_light(r.picture)) << stage;
  }
  const Rendered r = render("globillum on", {}, "photons");
  EXPECT_EQ(r.reason, StopReason::Cancelled);
  EXPECT_TRUE(shows_light(r.picture));
}

// acceptance: H3
TEST(PhotonOptions, ScaleRadiusAndCountsAct) {
  const auto mean = [](const std::string& options) {
    const Image image = render("globillum on " + options).picture;
    Imath::Vec3<double> sum(0.0);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        sum += Imath::Vec3<double>(image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]);
    return sum / double(image.pixel_count());
  };
  const auto plain = mean(""), none = mean("globillum scale 0 0 0"),
             some = mean("globillum scale 1 .5 0");
  EXPECT_GT(plain.x, 1.2 * none.x);
  EXPECT_NEAR(some.x, plain.x, 1e-6);
  EXPECT_NEAR(some.y, .5 * (plain.y + none.y), 1e-4);
  EXPECT_NEAR(some.z, none.z, 1e-6);
  EXPECT_NEAR(mean("globillum accuracy 400 .6").x / plain.x, 1, .1);
  EXPECT_NEAR(mean("globillum filter cone 1.1").x / plain.x, 1, .05);
  EXPECT_NEAR(mean("globillum filter gauss").x / plain.x, 1, .05);
}

}  // namespace map_files_test
}  // namespace oriel::testing
