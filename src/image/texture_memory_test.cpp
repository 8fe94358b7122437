// SPDX-License-Identifier: Apache-2.0
// Memory of texture files: pictures that are kept whole, and the tile cache.
#include <ImfTiledRgbaFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "image/files.h"
#include "image/texture.h"
#include "image/texture_statistics.h"
#include "support/files.h"

namespace oriel {
namespace texture_memory_test {

/// A texture whose pixels are not kept, so that OpenImageIO filters it.
const Texture* open_tiles(TextureSystem& system, const std::string& path, float gamma = 1) {
  TextureSystem::set_cache_megabytes(0);
  const auto opened = system.open(path, gamma);
  TextureSystem::set_cache_megabytes(1024);
  return opened.texture;
}

TEST(FileTexture, StatisticsCountTilesThatWereRead) {
  const TestFolder folder;
  write_image(folder.file("a.tif"), Image(256, 256, 3), {});  // 4 x 4 tiles of 64 x 64
  TextureSystem system;
  const Texture* t = open_tiles(system, folder.file("a.tif"));
  ASSERT_NE(t, nullptr);
  const auto look_at_all = [t] {
    const TextureStatistics before = texture_statistics();
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) t->sample({(float(x) + 0.5f) / 4, (float(y) + 0.5f) / 4}, {}, {});
    const TextureStatistics after = texture_statistics();
    EXPECT_GE(after.tile_requests - before.tile_requests, 16);
    return after.tile_misses - before.tile_misses;
  };
  // One tile request may read a whole row of tiles.
  const std::int64_t misses = look_at_all();
  EXPECT_GE(misses, 4);
  EXPECT_LE(misses, 16);
  EXPECT_EQ(look_at_all(), 0);
  EXPECT_GE(texture_statistics().bytes_held, std::int64_t{256} * 256 * 3);
  EXPECT_GE(texture_statistics().files, 1);
}

TEST(FileTexture, KeptPixelsGiveTheSameValues) {
  const TestFolder folder;
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> value(0, 100), place(-2.5f, 3.5f);
  for (const char* name : {"grey.exr", "color.exr", "color.tif", "alpha.png"}) {
    const std::string text(name);
    Image image(37, 23, text.starts_with("grey") ? 1 : text.starts_with("alpha") ? 4 : 3);
    for (float& p : image.pixels) p = text.ends_with("exr") ? value(engine) : value(engine) / 100;
    write_image(folder.file(name), image);
    TextureSystem kept_system, tile_system;
    const Texture* kept = kept_system.open(folder.file(name), 2.2f).texture;
    const Texture* tiles = open_tiles(tile_system, folder.file(name), 2.2f);
    ASSERT_TRUE(kept && tiles) << name;
    const std::int64_t requests = texture_statistics().tile_requests;
    kept->sample({0.5f, 0.5f}, {}, {});
    EXPECT_EQ(texture_statistics().tile_requests, requests) << name;
    for (const Wrap wrap : {Wrap::Black, Wrap::Periodic, Wrap::Clamp, Wrap::Mirror})
      for (const Interpolation how : {Interpolation::Bilinear, Interpolation::Nearest})
        for (int i = 0; i < 1000; ++i) {
          Vec2 uv(place(engine), place(engine));
          // At the border, where the nearest texel may be on either side.
          if (i % 10 == 0 && how == Interpolation::Bilinear) uv.x = std::round(uv.x);
          const TextureSampling sampling{.wrap_u = wrap, .wrap_v = wrap, .interpolation = how};
          const Rgba a = kept->sample(uv, {}, sampling), b = tiles->sample(uv, {}, sampling);
          for (int c = 0; c < 4; ++c)
            ASSERT_NEAR(a[c], b[c], 2e-3f) << name << " " << uv.x << " " << uv.y;
        }
  }
}

TEST(FileTexture, TiledPicturesAreKeptWhole) {
  const TestFolder folder;
  constexpr int kWidth = 40, kHeight = 24, kTile = 16;  // the last tiles are not full
  std::vector<Imf::Rgba> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      pixels.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y),
                          1.0f);
  {
    Imf::TiledRgbaOutputFile file(folder.file("a.exr").c_str(), kWidth, kHeight, kTile, kTile,
                                  Imf::ONE_LEVEL, Imf::ROUND_DOWN, Imf::WRITE_RGB);
    file.setFrameBuffer(pixels.data(), 1, kWidth);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  TextureSystem system;
  const Texture* texture = system.open(folder.file("a.exr")).texture;
  ASSERT_NE(texture, nullptr);
  const std::int64_t requests = texture_statistics().tile_requests;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Vec2 uv((static_cast<float>(x) + 0.5f) / kWidth,
                    1 - (static_cast<float>(y) + 0.5f) / kHeight);
      const Rgba got = texture->sample(uv, {}, {});
      ASSERT_NEAR(got.r, static_cast<float>(x), 1e-3f) << x << ' ' << y;
      ASSERT_NEAR(got.g, static_cast<float>(y), 1e-3f) << x << ' ' << y;
      ASSERT_NEAR(got.b, static_cast<float>(x * y), 1e-2f) << x << ' ' << y;
      ASSERT_EQ(got.a, 1);
    }
  EXPECT_EQ(texture_statistics().tile_requests, requests);
}

TEST(FileTexture, TheNextSystemFindsPicturesInMemory) {
  const TestFolder folder;
  const std::string path = folder.file("a.tif");
  const auto value_of = [&] {
    TextureSystem system;
    return system.open(path).texture->sample({0.5f, 0.5f}, {}, {}).r;
  };
  write_image(path, Image(64, 64, 3, 0.2f));
  const auto time = std::filesystem::last_write_time(path);
  const std::int64_t read = texture_statistics().bytes_read;
  EXPECT_NEAR(value_of(), 0.2f, 2e-3f);
  EXPECT_EQ(texture_statistics().bytes_read - read, std::int64_t{64} * 64 * 3);
  const std::int64_t held = texture_statistics().bytes_held;
  EXPECT_GE(held, std::int64_t{64} * 64 * 3);
  // Other pixels with the same time stamp show whether the file is read.
  write_image(path, Image(64, 64, 3, 0.8f));
  std::filesystem::last_write_time(path, time);
  EXPECT_NEAR(value_of(), 0.2f, 2e-3f);
  EXPECT_EQ(texture_statistics().bytes_held, held);
  EXPECT_EQ(texture_statistics().bytes_read - read, std::int64_t{64} * 64 * 3);
  // Pictures that nobody uses make room for others.
  TextureSystem::set_cache_megabytes(0);
  TextureSystem small;
  small.open(path);
  TextureSystem::set_cache_megabytes(1024);
  EXPECT_LT(texture_statistics().bytes_held, held);
  EXPECT_NEAR(value_of(), 0.8f, 2e-3f);
}

TEST(FileTexture, KeptPixelsAreFilteredLikeTiles) {
  const TestFolder folder;
  Image image(256, 128, 3);  // waves of 64, 32 and 16 texels
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y)[0] = 0.5f + 0.5f * std::sin(float(x) * kTwoPi / 64);
      image.at(x, y)[1] = 0.5f + 0.5f * std::sin(float(y) * kTwoPi / 32);
      image.at(x, y)[2] = 0.5f + 0.5f * std::sin(float(x + y) * kTwoPi / 16);
    }
  std::mt19937 engine(11);
  std::uniform_real_distribution<float> place(0, 1), angle(0, kPi), exponent(-1, 4);
  for (const float gamma : {1.0f, 2.2f}) {
    write_image(folder.file("a.tif"), image);
    TextureSystem kept_system, tile_system;
    const Texture* kept = kept_system.open(folder.file("a.tif"), gamma).texture;
    const Texture* tiles = open_tiles(tile_system, folder.file("a.tif"), gamma);
    ASSERT_TRUE(kept && tiles);
    double sum = 0, most = 0;
    constexpr int kLookUps = 4000;
    for (int i = 0; i < kLookUps; ++i) {
      // Ellipses of half a texel to sixteen, up to eight times as long as wide.
      const float a = angle(engine), along = std::exp2(exponent(engine)) / 256;
      const float across = along * std::exp2(-place(engine) * 3);
      const TextureFootprint footprint{Vec2(std::cos(a), 2 * std::sin(a)) * along,
                                       Vec2(-std::sin(a), 2 * std::cos(a)) * across};
      const Vec2 uv(place(engine), place(engine));
      const Rgba x = kept->sample(uv, footprint, {}), y = tiles->sample(uv, footprint, {});
      for (int c = 0; c < 3; ++c) {
        const double difference = std::abs(x[c] - y[c]);
        sum += difference / (3 * kLookUps);
        most = std::max(most, difference);
      }
    }
    // The library weighs its probes otherwise. With swapped axes these are .03 and .45.
    EXPECT_LT(sum, 0.02) << gamma;
    EXPECT_LT(most, 0.35) << gamma;
  }
}

TEST(FileTexture, SmallCacheGivesTheSameValues) {
  const TestFolder folder;
  Image image(2048, 2048, 3);  // float: three times the minimum cache size
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i % 8191);
  FileOptions options;
  options.format = SampleFormat::Float;
  write_image(folder.file("a.tif"), image, options);
  TextureSystem::set_cache_megabytes(16);
  TextureSystem system;
  const Texture* t = system.open(folder.file("a.tif")).texture;
  TextureSystem::set_cache_megabytes(1024);
  ASSERT_NE(t, nullptr);
  for (int i = 0; i < 64; ++i) {
    const int x = (i * 769) % 2048, y = (i * 1361) % 2048;
    const Rgba got = t->sample({(x + 0.5f) / 2048, 1 - (y + 0.5f) / 2048}, {}, {});
    ASSERT_NEAR(got.g, image.at(x, y)[1], 1);
  }
}

}  // namespace texture_memory_test
}  // namespace oriel
