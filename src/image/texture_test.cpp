// SPDX-License-Identifier: Apache-2.0
// File and memory textures follow the same rules, so most tests run on both.
#include "image/texture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "image/exr.h"
#include "image/files.h"
#include "image/png.h"
#include "image/texture_statistics.h"
#include "support/files.h"

#if defined(__SANITIZE_ADDRESS__)
// OpenImageIO's PNG reader loses the error message when libpng reports an error by longjmp.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOpenImageIO\n"; }
#endif

namespace oriel {
namespace texture_test {

using Bytes = std::vector<std::uint8_t>;

/// Makes the same texture from a TIFF file or from bytes; three components, rows from the top.
class TextureTest : public ::testing::TestWithParam<const char*> {
 protected:
  const Texture* make(int width, int height, const Bytes& rgb, float gamma = 1) {
    if (std::string(GetParam()) == "memory") {
      memory_ = make_memory_texture(width, height, 3, rgb, gamma, RowOrder::TopDown);
      return memory_.get();
    }
    Image image(width, height, 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) image.pixels[i] = rgb[i] / 255.0f;
    const std::string path = folder_.file(fmt::format("{}.tif", count_++));
    write_image(path, image);
    const auto opened = system_.open(path, gamma);
    EXPECT_NE(opened.texture, nullptr) << opened.message;
    return opened.texture;
  }

  /// Grey values of the columns, repeated in `height` rows.
  const Texture* columns(const Bytes& columns, int height, float gamma = 1) {
    Bytes rgb;
    for (int y = 0; y < height; ++y)
      for (const std::uint8_t c : columns) rgb.insert(rgb.end(), 3, c);
    return make(int(columns.size()), height, rgb, gamma);
  }

  static TextureSampling wrap(Wrap mode) {
    TextureSampling how;
    how.wrap_u = how.wrap_v = mode;
    return how;
  }

 private:
  TestFolder folder_;
  TextureSystem system_;
  std::unique_ptr<Texture> memory_;
  int count_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Sources, TextureTest, ::testing::Values("file", "memory"),
                         [](const auto& source) { return std::string(source.param); });

TEST(FileTexture, AFileThatIsOpenedAheadIsReportedByTheFirstOpen) {
  const TestFolder folder;
  const std::string bad = folder.file("bad.png"), good = folder.file("good.png");
  std::ofstream(bad) << "no picture";
  write_image(good, Image(2, 2, 3));
  TextureSystem ahead, plain;
  for (const std::string& path : {bad, good, good}) ahead.open_ahead(path, 1, UINT64_MAX);
  const auto expected = plain.open(bad), first = ahead.open(bad), second = ahead.open(bad);
  EXPECT_EQ(first.texture, nullptr);
  EXPECT_FALSE(expected.message.empty());
  EXPECT_EQ(first.message, expected.message);
  EXPECT_EQ(second.message, "");
  EXPECT_NE(ahead.open(good).texture, nullptr);
}

TEST_P(TextureTest, OriginIsLowerLeftAndTexelCentresAreExact) {
  const int w = 4, h = 3;
  Bytes rgb;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int c = 0; c < 3; ++c) rgb.push_back(std::uint8_t(60 * x + 20 * y + 5 * c));
  const Texture* t = make(w, h, rgb);
  ASSERT_NE(t, nullptr);
  EXPECT_EQ(t->width(), w);
  EXPECT_EQ(t->height(), h);
  for (const auto mode : {Interpolation::Nearest, Interpolation::Bilinear}) {
    TextureSampling how = wrap(Wrap::Clamp);
    how.interpolation = mode;
    for (int j = 0; j < h; ++j)  // from the bottom
      for (int i = 0; i < w; ++i) {
        const Rgba got = t->sample({(i + 0.5f) / w, (j + 0.5f) / h}, {}, how);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(got[c], (60 * i + 20 * (h - 1 - j) + 5 * c) / 255.0f, 2e-6f);
        EXPECT_EQ(got.a, 1);
      }
  }
}

TEST_P(TextureTest, NearestIsOneTexelEverywhere) {
  const Texture* t = columns({252, 3, 252, 3}, 4);
  for (const Wrap mode : {Wrap::Black, Wrap::Periodic, Wrap::Clamp, Wrap::Mirror}) {
    TextureSampling how = wrap(mode);
    how.interpolation = Interpolation::Nearest;
    for (int i = 0; i < 1000; ++i) {
      const float u = (i + 0.5f) / 1000;
      EXPECT_NEAR(t->sample({u, 0.3f}, {}, how).r, (int(u * 4) % 2 ? 3 : 252) / 255.0f, 2e-6f) << u;
    }
  }
}

TEST_P(TextureTest, BetweenTwoCentresIsTheLinearMix) {
  const Texture* t = columns({0, 255, 51, 102}, 4);
  const TextureSampling how = wrap(Wrap::Clamp);
  EXPECT_NEAR(t->sample({0.25f, 0.5f}, {}, how).r, 0.5f, 1e-5f);
  EXPECT_NEAR(t->sample({1.75f / 4, 0.5f}, {}, how).g, 0.75f * 1 + 0.25f * 0.2f, 1e-5f);
}

TEST_P(TextureTest, WrapModesActOutside) {
  const Texture* t = columns({0, 51, 102, 255}, 4);
  const auto at = [&](float u, Wrap mode) { return t->sample({u, 0.5f}, {}, wrap(mode)); };
  EXPECT_NEAR(at(1.125f, Wrap::Periodic).r, 0, 1e-5f);
  EXPECT_NEAR(at(-0.125f, Wrap::Periodic).r, 1, 1e-5f);
  EXPECT_NEAR(at(0, Wrap::Periodic).r, 0.5f, 1e-5f) << "the border mixes both ends";
  EXPECT_NEAR(at(7.125f, Wrap::Clamp).r, 1, 1e-5f);
  EXPECT_NEAR(at(0, Wrap::Clamp).r, 0, 1e-5f);
  EXPECT_NEAR(at(1.125f, Wrap::Mirror).r, 1, 1e-5f);
  EXPECT_NEAR(at(1.375f, Wrap::Mirror).r, 0.4f, 1e-5f);
  for (const float u : {-0.01f, 1.0f, 3.5f}) EXPECT_EQ(at(u, Wrap::Black), Rgba(0, 0, 0, 0)) << u;
  EXPECT_NEAR(at(0.999f, Wrap::Black).r, 1, 1e-5f) << "no dark rim inside";
  EXPECT_EQ(at(0.999f, Wrap::Black).a, 1);
}

TEST_P(TextureTest, MinificationConvergesToTheMean) {
  Bytes rgb;
  double sum = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t v = std::uint8_t((x * 37 + y * 101 + x * y) % 256);
      rgb.insert(rgb.end(), 3, v);
      sum += v / 255.0;
    }
  const Texture* t = make(64, 64, rgb);
  const TextureFootprint all{{1, 0}, {0, 1}};
  EXPECT_NEAR(t->sample({0.3f, 0.6f}, all, {}).r, sum / 4096, 0.004);
  const TextureFootprint more{{40, 0}, {0, 40}};
  EXPECT_NEAR(t->sample({0.3f, 0.6f}, more, {}).r, sum / 4096, 0.004);
}

TEST_P(TextureTest, FootprintBlursAlongItsOwnDirectionOnly) {
  Bytes stripes;  // each 8 texels wide
  for (int x = 0; x < 128; ++x) stripes.push_back(x / 8 % 2 ? 255 : 0);
  const Texture* t = columns(stripes, 128);
  const Vec2 uv(12.0f / 128, 0.5f);  // centre of a white stripe
  const float thin = 1.0f / 128, wide = 16.0f / 128;
  EXPECT_NEAR(t->sample(uv, {{thin, 0}, {0, wide}}, {}).r, 1, 0.02f);
  EXPECT_NEAR(t->sample(uv, {{0, wide}, {thin, 0}}, {}).r, 1, 0.02f);
  EXPECT_NEAR(t->sample(uv, {{wide, 0}, {0, thin}}, {}).r, 0.5f, 0.15f);
}

TEST_P(TextureTest, DiagonalFootprintFollowsTheUpwardAxis) {
  // Stripes along u = v: a footprint along (1, 1) stays inside, one along (1, -1) crosses them.
  Bytes rgb;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const int down = (x - (127 - y) + 128 + 4) % 16;
      rgb.insert(rgb.end(), 3, down < 8 ? 255 : 0);
    }
  const Texture* t = make(128, 128, rgb);
  const float wide = 12.0f / 128, thin = 0.7f / 128;
  EXPECT_GT(t->sample({0.5f, 0.5f}, {{wide, wide}, {thin, -thin}}, {}).r, 0.9f);
  EXPECT_LT(t->sample({0.5f, 0.5f}, {{wide, -wide}, {thin, thin}}, {}).r, 0.75f);
}

TEST_P(TextureTest, GammaDecodesBeforeFiltering) {
  const Texture* t = columns({0, 255, 0, 255}, 4, 2.2f);
  EXPECT_NEAR(t->sample({0.5f, 0.5f}, {{1, 0}, {0, 1}}, {}).r, 0.5f, 2e-3f);
  const Texture* grey = columns({128, 128, 128, 128}, 4, 2.2f);
  const float want = std::pow(128 / 255.0f, 2.2f);
  EXPECT_NEAR(grey->sample({0.5f, 0.5f}, {}, {}).g, want, want * 0x1p-11f);
}

TEST_P(TextureTest, NanCoordinatesAreBlack) {
  const Texture* t = columns({255, 255}, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, inf, -inf}) {
    EXPECT_EQ(t->sample({bad, 0.5f}, {}, {}), Rgba(0, 0, 0, 0));
    EXPECT_NEAR(t->sample({0.5f, 0.5f}, {{bad, bad}, {bad, 0}}, {}).r, 1, 1e-5f);
  }
  EXPECT_NEAR(t->sample({1e30f, -1e30f}, {}, {}).r, 1, 1e-5f);
}

TEST_P(TextureTest, ScalarLookupIsTheMeanOfTheColour) {
  const Texture* t = make(1, 1, {30, 60, 240});
  EXPECT_NEAR(t->sample_scalar({0.5f, 0.5f}, {}, {}), 110 / 255.0f, 1e-6f);
}

TEST(MemoryTexture, ComponentsAreGreyColourAndAlpha) {
  const Bytes bytes = {51, 102, 153, 204};
  const auto at = [&](int n) {
    const auto t = make_memory_texture(1, 1, n, std::span(bytes).first(std::size_t(n)));
    return t->sample({0.5f, 0.5f}, {}, {});
  };
  const auto expect = [](const Rgba& got, float r, float g, float b, float a) {
    const Rgba want(r, g, b, a);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], want[i], 1e-6f);
  };
  expect(at(1), 0.2f, 0.2f, 0.2f, 1);
  expect(at(2), 0.2f, 0.2f, 0.2f, 0.4f);
  expect(at(3), 0.2f, 0.4f, 0.6f, 1);
  expect(at(4), 0.2f, 0.4f, 0.6f, 0.8f);
}

TEST(MemoryTexture, RowsRunUpwardsByDefault) {
  const Bytes bytes = {0, 255};
  const auto up = make_memory_texture(1, 2, 1, bytes);
  EXPECT_EQ(up->sample({0.5f, 0.25f}, {}, {}).r, 0);
  const auto down = make_memory_texture(1, 2, 1, bytes, 1, RowOrder::TopDown);
  EXPECT_EQ(down->sample({0.5f, 0.25f}, {}, {}).r, 1);
}

TEST(MemoryTexture, WrongByteCountsAreRefused) {
  const Bytes bytes(12);
  EXPECT_EQ(make_memory_texture(2, 2, 4, bytes), nullptr);
  EXPECT_EQ(make_memory_texture(0, 2, 3, bytes), nullptr);
  EXPECT_EQ(make_memory_texture(1 << 20, 1 << 20, 3, bytes), nullptr);
  EXPECT_EQ(make_memory_texture(2, 1, 6, bytes), nullptr);
}

TEST(FileTexture, InvalidFileIsReportedOnce) {
  const TestFolder folder;
  TextureSystem system;
  write_bytes(folder.file("broken.tif"), {'I', 'I', '*', 0, 1, 2, 3});
  for (const char* name : {"missing.tif", "broken.tif"}) {
    const auto first = system.open(folder.file(name));
    EXPECT_EQ(first.texture, nullptr);
    EXPECT_NE(first.message.find(name), std::string::npos) << first.message;
    const auto second = system.open(folder.file(name));
    EXPECT_EQ(second.texture, nullptr);
    EXPECT_EQ(second.message, "");
  }
}

TEST(FileTexture, TruncatedFileIsMagentaAndReported) {
  const TestFolder folder;
  write_image(folder.file("a.png"), Image(64, 64, 3, 0.5f));
  std::vector<char> bytes = bytes_of(folder.file("a.png"));
  bytes.resize(bytes.size() / 2);
  write_bytes(folder.file("a.png"), bytes);
  TextureSystem system;
  const auto opened = system.open(folder.file("a.png"));
  if (!opened.texture) {
    EXPECT_NE(opened.message, "");
    return;
  }
  EXPECT_EQ(opened.texture->sample({0.5f, 0.1f}, {}, {}), Rgba(1, 0, 1, 1));
  EXPECT_NE(opened.texture->error(), "");
}

TEST(FileTexture, ColourUnderAlphaIsUnchanged) {
  const TestFolder folder;
  Image image(2, 2, 4, 0.6f);
  for (int i = 0; i < 4; ++i) image.pixels[4 * i + 3] = 0.2f;
  write_png(folder.file("a.png"), image);
  for (const float gamma : {1.0f, 2.0f}) {
    TextureSystem system;
    const Rgba got = system.open(folder.file("a.png"), gamma).texture->sample({0.5f, 0.5f}, {}, {});
    EXPECT_NEAR(got.r, std::pow(0.6f, gamma), 1e-3f);
    EXPECT_NEAR(got.a, 0.2f, 1e-3f);
  }
}

TEST(FileTexture, FloatPicturesIgnoreGammaAndKeepHighValues) {
  const TestFolder folder;
  write_exr(folder.file("a.exr"), {{"", {"R", "G", "B"}, Image(4, 4, 3, 37.5f)}});
  TextureSystem system;
  const auto opened = system.open(folder.file("a.exr"), 2.2f);
  ASSERT_NE(opened.texture, nullptr) << opened.message;
  EXPECT_FLOAT_EQ(opened.texture->sample({0.5f, 0.5f}, {}, {}).r, 37.5f);
}

TEST(FileTexture, NewSystemSeesAChangedFile) {
  const TestFolder folder;
  const std::string path = folder.file("a.tif");
  for (const float gamma : {1.0f, 2.0f})
    for (const int step : {51, 204}) {
      write_image(path, Image(4, 4, 3, float(step) / 255));
      // Time stamps have a resolution of one second; the test runs faster than that.
      std::filesystem::last_write_time(
          path, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(step));
      TextureSystem system;
      const Rgba got = system.open(path, gamma).texture->sample({0.5f, 0.5f}, {}, {});
      EXPECT_NEAR(got.r, std::pow(float(step) / 255, gamma), 1e-3f) << gamma;
    }
}

TEST(FileTexture, ThreadsSeeTheSameValues) {
  const TestFolder folder;
  Image image(256, 256, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i % 251) / 250;
  write_image(folder.file("a.tif"), image);
  TextureSystem system;
  const Texture* t = system.open(folder.file("a.tif")).texture;
  ASSERT_NE(t, nullptr);
  std::vector<Rgba> results[4];
  std::vector<std::thread> threads;
  for (auto& mine : results)
    threads.emplace_back([&mine, t] {
      for (int i = 0; i < 2000; ++i) {
        const float x = std::fmod(i * 0.618034f, 1.0f), y = std::fmod(i * 0.754878f, 1.0f);
        mine.push_back(t->sample({x, y}, {{0.02f, 0}, {0, 0.003f}}, {}));
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (int i = 1; i < 4; ++i) EXPECT_EQ(results[i], results[0]);
}

/// Looks up all textures from several threads, with an open-file limit far below their number.
[[noreturn]] void look_into(const std::vector<std::string>& files) {
  constexpr rlim_t kOpen = 600;
  const rlimit limit{kOpen, kOpen};
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) std::_Exit(2);
  TextureSystem system;
  std::vector<const Texture*> textures;
  for (const std::string& file : files) textures.push_back(system.open(file, 1).texture);
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (std::size_t i = 0; i < 3 * textures.size(); ++i) {
        // The steps are different primes, so the threads visit the textures in different orders.
        const Texture* t = textures[(i * (7 + 4 * k)) % textures.size()];
        if (!t || std::abs(t->sample({.5f, .5f}, {}, {}).r - .2f) > 1e-5f) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  std::_Exit(wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}

// OpenImageIO's own limit causes a deadlock.
TEST(TextureFiles, MayExceedTheOpenFileLimit) {
  TestFolder folder;
  constexpr int kFiles = 701;
  Image grey(4, 4, 3);
  std::fill(grey.pixels.begin(), grey.pixels.end(), .2f);
  write_image(folder.file("0.tif"), grey);
  std::vector<std::string> files = {folder.file("0.tif")};
  for (int i = 1; i < kFiles; ++i) {
    files.push_back(folder.file(fmt::format("{}.tif", i)));
    std::filesystem::create_hard_link(files[0], files.back());
  }
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // runs in a process without open textures
  EXPECT_EXIT(look_into(files), ::testing::ExitedWithCode(EXIT_SUCCESS), "");
}

}  // namespace texture_test
}  // namespace oriel
