// SPDX-License-Identifier: Apache-2.0
// Test support: tables of the shaders in corpus/; each one is rendered and compared with expected
// values.
#pragma once

#include <functional>
#include <vector>

#include "user_picture.h"

namespace oriel::testing {

/// A scene seen from (0, 0, 4) down at z = 0, 90 degrees wide: pixels show the places -4 to 4.
struct CorpusScene {
  std::string body;
  std::string members = "\"lamp_i\" \"square_i\"";
  std::string options = "";
  std::string camera = "";
  std::string prelude = "";  ///< before the options, e.g. declarations that they need

  std::string text() const;
};

/// One shader in one use.
struct CorpusRow {
  std::string name;  ///< file in the folder without its ending, then perhaps "/" and the use
  CorpusScene scene;
  /// What the picture shows where z = 0 has the place x, y; or else:
  std::function<Rgb(double x, double y)> wanted = nullptr;
  CorpusScene equivalent = {};  ///< the same picture from built-in shaders
  float tolerance = 2e-3f;
  std::uint32_t samples = 16;
  int buffer = -1;     ///< compares this buffer of shaders instead of the picture
  bool mean = false;   ///< compares only the mean of the image, for noisy images
  bool shown = false;  ///< compares what the output shaders of the camera leave
};

/// Builds all shaders of corpus/FOLDER with `oriel shader-build`, renders each row with one thread
/// and with two, and compares. Each source of the folder must have a row.
void run_corpus(const std::string& folder, const std::vector<CorpusRow>& rows,
                const std::string& flags = "");

/// A point light of colour 1 at (0, 0, 3) as instance "lamp_i".
extern const std::string kCorpusLamp;

/// The square z = 0 with this material.
std::string corpus_square(const std::string& material);

/// A row of that square.
CorpusRow corpus_surface(const std::string& name, const std::string& material,
                         std::function<Rgb(double x, double y)> wanted);

/// The square with a material, lit by two lights, "lamp_i" and "side_i".
CorpusScene corpus_two_lamps(const std::string& material);

/// A surface that shows a colour or shader unchanged.
std::string corpus_emitter(const std::string& color);

/// Cosine at x, y of the light of "lamp_i".
inline double lamp_cosine(double x, double y) { return 3 / std::sqrt(x * x + y * y + 9); }

}  // namespace oriel::testing
