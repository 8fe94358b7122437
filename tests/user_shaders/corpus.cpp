// SPDX-License-Identifier: Apache-2.0
#include "corpus.h"

#include <cstring>
#include <set>
#include <sstream>

#include "base/parallel.h"

namespace oriel::testing {
namespace {

namespace fs = std::filesystem;

constexpr int kSize = 32;               // pixels; two tiles in each direction
constexpr double kPixel = 8.0 / kSize;  // on the plane z = 0
const fs::path kCorpus = fs::path(ORIEL_SOURCE_DIR) / "tests/user_shaders/corpus";

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Pixels of one rendering from the lowest row up, and its messages.
struct Shot {
  std::vector<Rgba> pixels;
  std::string messages;

  Rgb at(int x, int y) const {
    return rgb(pixels[static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)]);
  }
};

Shot shoot(const ShaderFolder& folder, const std::string& text, const CorpusRow& row, int threads) {
  const ThreadLimit limit(threads);
  Shot shot;
  UserScene scene(folder, text);
  const UserPicture picture(scene, row.samples);
  const Film& film = picture.session->film();
  const auto buffer = static_cast<std::size_t>(row.buffer);
  if (row.buffer >= 0 && buffer >= film.user_buffers())
    throw std::runtime_error("no such buffer\n" + scene.messages());
  std::optional<Image> shown;
  if (row.shown) {
    const scene::Camera* camera = find_camera(scene.scene, scene.scene.renders.back());
    const NodeList shaders = camera_output_shaders(*camera, scene.scene, scene.host->registry(),
                                                   *scene.world, scene.diagnostics);
    shown = shown_image(*picture.session, shaders, nullptr);
  }
  for (int y = kSize - 1; y >= 0; --y)
    for (int x = 0; x < kSize; ++x) {
      if (shown)
        shot.pixels.emplace_back(shown->at(x, y)[0], shown->at(x, y)[1], shown->at(x, y)[2], 1);
      else if (row.buffer >= 0)
        shot.pixels.push_back(film.user_buffer(x, y, buffer));
      else
        shot.pixels.push_back(film.pixel(x, y).beauty);
    }
  shot.messages = scene.messages();
  return shot;
}

void expect_same_bytes(const Shot& one, const Shot& two) {
  EXPECT_EQ(std::memcmp(one.pixels.data(), two.pixels.data(), one.pixels.size() * sizeof(Rgba)), 0)
      << "one thread and two show different pictures";
}

/// Greatest difference between the colours of a place and of those one pixel around it.
float unevenness(const CorpusRow& row, double x, double y) {
  const Rgb middle = row.wanted(x, y);
  float most = 0;
  for (int i = 0; i < 9; ++i) {
    const Rgb there = row.wanted(x + (i % 3 - 1) * kPixel, y + (i / 3 - 1) * kPixel);
    for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(there[k] - middle[k]));
  }
  return most;
}

/// Mean over a pixel, as its samples are spread.
Rgb mean_over(const CorpusRow& row, double x, double y) {
  constexpr int kSteps = 8;
  Rgb sum(0);
  for (int i = 0; i < kSteps * kSteps; ++i)
    sum += row.wanted(x + ((i % kSteps + .5) / kSteps - .5) * kPixel,
                      y + ((i / kSteps + .5) / kSteps - .5) * kPixel);
  return sum / static_cast<float>(kSteps * kSteps);
}

void compare_means(const CorpusRow& row, const Shot& shot, const Shot& equivalent) {
  const auto mean = [](const Shot& of) {
    Rgb sum(0);
    for (const Rgba& pixel : of.pixels) sum += rgb(pixel);
    return sum / static_cast<float>(of.pixels.size());
  };
  const Rgb found = mean(shot), wanted = mean(equivalent);
  EXPECT_GT(wanted.x, .05f);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(found[k] / wanted[k], 1, row.tolerance) << "channel " << k;
}

void compare(const CorpusRow& row, const Shot& shot, const Shot* equivalent) {
  int compared = 0, wrong = 0;
  float highest = 0, lowest = 1e9f;
  std::string worst;
  float worst_difference = 0;
  for (int py = 0; py < kSize; ++py)
    for (int px = 0; px < kSize; ++px) {
      const double x = (px + .5) * kPixel - 4, y = (py + .5) * kPixel - 4;
      // Edges fall on a part of the samples; on slopes the mean of their places counts.
      const float uneven = equivalent ? 0 : unevenness(row, x, y);
      if (uneven > .1f) continue;
      const Rgb wanted = equivalent ? equivalent->at(px, py) : mean_over(row, x, y);
      const Rgb found = shot.at(px, py);
      float difference = 0;
      for (int k = 0; k < 3; ++k) {
        const float d = std::abs(found[k] - wanted[k]) / std::max(1.0f, std::abs(wanted[k]));
        difference = d <= difference ? difference : std::isfinite(d) ? d : 1e9f;
        highest = std::max(highest, wanted[k]);
        lowest = std::min(lowest, wanted[k]);
      }
      ++compared;
      wrong += difference > row.tolerance + .2f * uneven;
      if (difference <= worst_difference) continue;
      worst_difference = difference;
      std::ostringstream text;
      text << "pixel " << px << " " << py << ": found " << found[0] << " " << found[1] << " "
           << found[2] << ", wanted " << wanted[0] << " " << wanted[1] << " " << wanted[2];
      worst = text.str();
    }
  EXPECT_EQ(wrong, 0) << "of " << compared << " pixels; worst: " << worst << "\n" << shot.messages;
  EXPECT_GT(compared, kSize * kSize / 3) << "too few pixels are even";
  EXPECT_GT(highest - std::min(lowest, 0.0f), .05f) << "nothing to see";
}

void expect_row_for_each_source(const fs::path& sources, const std::vector<CorpusRow>& rows) {
  std::set<std::string> used;
  for (const CorpusRow& row : rows) used.insert(row.name.substr(0, row.name.find('/')));
  for (const auto& entry : fs::directory_iterator(sources)) {
    const std::string ending = entry.path().extension();
    if (ending != ".c" && ending != ".cpp") continue;
    EXPECT_EQ(used.count(entry.path().stem()), 1u) << entry.path() << " has no row";
  }
}

}  // namespace

const std::string kCorpusLamp =
    "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 3 end light "
    "instance \"lamp_i\" \"lamp\" end instance ";

std::string CorpusScene::text() const {
  return prelude + " options \"opt\" samples 0 trace depth 4 4 8 " + options +
         " end options camera \"cam\" focal 1 aperture 2 aspect 1 resolution 32 32 " + camera +
         " end camera instance \"cam_i\" \"cam\" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -4 1 end "
         "instance " +
         body + " instgroup \"world\" \"cam_i\" " + members +
         " end instgroup render \"world\" \"cam_i\" \"opt\"\n";
}

std::string corpus_square(const std::string& material) {
  return kCorpusLamp + "material \"m\" " + material + " end material " + UserScene::square("m");
}

CorpusRow corpus_surface(const std::string& name, const std::string& material,
                         std::function<Rgb(double, double)> wanted) {
  return {name, {corpus_square(material)}, std::move(wanted)};
}

CorpusScene corpus_two_lamps(const std::string& material) {
  return {
      "light \"side\" \"mib_light_point\" ( \"color\" .2 .4 .6, \"shadow\" on ) origin 3 1 2 "
      "end light instance \"side_i\" \"side\" end instance " +
          corpus_square(material),
      "\"lamp_i\" \"side_i\" \"square_i\""};
}

std::string corpus_emitter(const std::string& color) {
  return "\"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" " + color +
         ", \"diffuse\" 0 0 0 )";
}

void run_corpus(const std::string& folder, const std::vector<CorpusRow>& rows,
                const std::string& flags) {
  const ShaderFolder built;
  const fs::path sources = kCorpus / folder;
  expect_row_for_each_source(sources, rows);
  const std::string log = built.file("log.txt");
  const std::string command = std::string("\"" ORIEL_PROGRAM "\" shader-build \"") +
                              sources.string() + "\" -o \"" + built.file(folder + ".so") + "\" " +
                              flags + " 2> \"" + log + "\"";
  ASSERT_EQ(std::system(command.c_str()), 0) << text_of_file(log);
  const std::string declared =
      "link \"" + folder + ".so\"\n" + text_of_file(sources / "declarations.mi");
  for (const CorpusRow& row : rows) {
    SCOPED_TRACE(folder + "/" + row.name);
    try {
      const std::string text = declared + row.scene.text();
      const Shot one = shoot(built, text, row, 1);
      expect_same_bytes(one, shoot(built, text, row, 2));
      EXPECT_EQ(one.messages, "");
      if (row.wanted) {
        compare(row, one, nullptr);
      } else {
        CorpusRow plain = row;
        plain.buffer = -1;
        const Shot other = shoot(built, row.equivalent.text(), plain, 2);
        EXPECT_EQ(other.messages, "") << "of the built-in shaders";
        if (row.mean)
          compare_means(row, one, other);
        else
          compare(row, one, &other);
      }
    } catch (const std::exception& problem) {
      ADD_FAILURE() << problem.what();
    }
  }
}

}  // namespace oriel::testing
