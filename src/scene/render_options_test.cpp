// SPDX-License-Identifier: Apache-2.0
#include "scene/render_options.h"
#include "color/luminance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "scene/option_table.h"

namespace oriel::scene {
namespace render_options_test {

/// A statement from its text: words before the first value are the keyword; a keyword in quotes
/// makes a string option.
Statement statement(const std::string& text) {
  Statement s;
  std::istringstream in(text);
  std::string token;
  if (text[0] == '"') {
    s.quoted = true;
    s.keyword = text.substr(1, text.find('"', 1) - 1);
    in.seekg(static_cast<std::streamoff>(s.keyword.size() + 2));
  }
  while (in >> std::ws && !in.eof()) {
    Value v;
    if (in.peek() == '"') {
      in.get();
      std::getline(in, v.text, '"');
      v.kind = Value::Kind::Text;
      s.values.push_back(v);
      continue;
    }
    in >> token;
    const bool number = token.find_first_not_of("0123456789.-") == std::string::npos;
    if (number) {
      if (s.values.empty() || s.values.back().kind != Value::Kind::Numbers) {
        v.kind = Value::Kind::Numbers;
        s.values.push_back(v);
      }
      s.values.back().numbers.push_back(std::stod(token));
    } else if (token == "on" || token == "off") {
      v.kind = Value::Kind::Boolean;
      v.boolean = token == "on";
      s.values.push_back(v);
    } else if (s.values.empty() && !s.quoted) {
      s.keyword += (s.keyword.empty() ? "" : " ") + token;
    } else {
      v.kind = Value::Kind::Text;
      v.bare = true;
      v.text = token;
      s.values.push_back(v);
    }
  }
  return s;
}

RenderOptions read(std::initializer_list<std::string> lines, Diagnostics& diagnostics) {
  Options options;
  for (const auto& line : lines) options.statements.push_back(statement(line));
  return interpret_options(options, diagnostics);
}

RenderOptions read(std::initializer_list<std::string> lines) {
  Diagnostics diagnostics;
  RenderOptions o = read(lines, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
  return o;
}

// acceptance: H1
TEST(RenderOptions, AnEmptyBlockHasTheDocumentedDefaults) {
  const RenderOptions o = read({});
  EXPECT_EQ(o.samples_min, -2);
  EXPECT_EQ(o.samples_max, 0);
  EXPECT_EQ(o.contrast, Rgba(0.1f, 0.1f, 0.1f, 0.1f));
  EXPECT_EQ(o.time_contrast, Rgba(0.2f, 0.2f, 0.2f, 0.2f));
  EXPECT_EQ(o.filter, (PixelFilter{FilterKind::Box, 1, 1}));
  EXPECT_EQ(o.jitter, 0);
  EXPECT_EQ(o.photon_depth, (TraceDepth{5, 5, 5}));
  EXPECT_EQ(o.caustic.accuracy, 64);
  EXPECT_EQ(o.globillum.accuracy, 64);
  EXPECT_EQ(o.caustic.filter, PhotonOptions::Filter::Box);
  EXPECT_FLOAT_EQ(o.caustic.filter_constant, 1.1f);
  EXPECT_EQ(o.finalgather.rays, 400);
  EXPECT_EQ(o.finalgather.points, 10);
  EXPECT_FALSE(o.finalgather.depth.has_value());
  EXPECT_EQ(o.finalgather.presample_density, 1);
  EXPECT_EQ(o.gamma, 1);
  EXPECT_FLOAT_EQ(o.luminance_weight[1], 0.715160f);
}

TEST(RenderOptions, OneSampleLevelIsTheMaximumAndTheMinimumIsTwoBelow) {
  EXPECT_EQ(read({"samples 2"}).samples_min, 0);
  EXPECT_EQ(read({"samples 2"}).samples_max, 2);
  EXPECT_EQ(read({"samples -1 3"}).samples_min, -1);
  EXPECT_EQ(read({"samples -1 3 0 1"}).samples_max, 3);
}

TEST(RenderOptions, LaterStatementsOverrideAndAlphaIsTheMeanOfThreeContrasts) {
  const RenderOptions o = read({"contrast .1 .1 .1 .1", "contrast .1 .2 .6"});
  EXPECT_FLOAT_EQ(o.contrast.a, 0.3f);
  EXPECT_FLOAT_EQ(o.contrast.b, 0.6f);
}

TEST(RenderOptions, FiltersHaveTheirOwnDefaultSizes) {
  EXPECT_EQ(read({"filter triangle"}).filter, (PixelFilter{FilterKind::Triangle, 2, 2}));
  EXPECT_EQ(read({"filter gauss 0 0"}).filter, (PixelFilter{FilterKind::Gauss, 3, 3}));
  EXPECT_EQ(read({"filter lanczos 5"}).filter, (PixelFilter{FilterKind::Lanczos, 5, 5}));
  EXPECT_EQ(read({"filter mitchell 5 6"}).filter, (PixelFilter{FilterKind::Mitchell, 5, 6}));
  EXPECT_EQ(read({"filter clip lanczos"}).filter, (PixelFilter{FilterKind::ClipLanczos, 4, 4}));
}

TEST(RenderOptions, TraceDepthHasThreeForms) {
  EXPECT_EQ(read({"trace depth 2"}).trace_depth, (TraceDepth{2, 2, 4}));
  EXPECT_EQ(read({"trace depth 2 3"}).trace_depth, (TraceDepth{2, 3, 5}));
  EXPECT_EQ(read({"trace depth 2 2 3"}).trace_depth, (TraceDepth{2, 2, 3}));
  EXPECT_EQ(read({"photon trace depth 4"}).photon_depth, (TraceDepth{4, 4, 8}));
}

TEST(RenderOptions, GatherDepthHasFourForms) {
  using Depth = FinalGatherOptions::Depth;
  EXPECT_EQ(read({"finalgather trace depth 2"}).finalgather.depth, (Depth{2, 2, 4, 4}));
  EXPECT_EQ(read({"finalgather trace depth 2 3"}).finalgather.depth, (Depth{2, 3, 5, 5}));
  EXPECT_EQ(read({"finalgather trace depth 2 3 1"}).finalgather.depth, (Depth{2, 3, 1, 1}));
  EXPECT_EQ(read({"finalgather trace depth 1 1 0 2"}).finalgather.depth, (Depth{1, 1, 0, 2}));
}

TEST(RenderOptions, KeywordWordsAndSymbolValuesAreTheSame) {
  Statement split;
  split.keyword = "shadow";
  split.values.emplace_back();
  split.values[0].kind = Value::Kind::Text;
  split.values[0].text = "segments";
  Options options;
  options.statements = {split};
  Diagnostics d;
  EXPECT_EQ(interpret_options(options, d).shadow, ShadowMode::Segments);
  split.keyword = "filter";
  split.values[0].text = "clip mitchell";
  split.values[0].bare = true;
  options.statements = {split};
  EXPECT_EQ(interpret_options(options, d).filter.kind, FilterKind::ClipMitchell);
  EXPECT_EQ(read({"shadow segments"}).shadow, ShadowMode::Segments);
  EXPECT_EQ(read({"shadow on"}).shadow, ShadowMode::Simple);
  EXPECT_EQ(read({"shadow off"}).shadow, ShadowMode::Off);
  EXPECT_EQ(read({"shadow sort on"}).shadow, ShadowMode::Sort);
}

TEST(RenderOptions, AShutterThatOpensTurnsMotionBlurOn) {
  EXPECT_FALSE(read({"shutter 0"}).motion.on);
  EXPECT_TRUE(read({"shutter .5"}).motion.on);
  const RenderOptions o = read({"shutter .25 .75"});
  EXPECT_EQ(o.motion.delay, 0.25f);
  EXPECT_EQ(o.motion.shutter, 0.75f);
}

TEST(RenderOptions, FinalGatherOptionsAreTyped) {
  const RenderOptions o =
      read({"finalgather fastlookup", "finalgather accuracy view 200 20. 2", "globillum 3",
            "caustic on", "caustic accuracy 500 3.0", "caustic filter cone", "globillum scale 2",
            "finalgather rebuild freeze", "finalgather file \"a b\"", "finalgather falloff 7",
            "\"finalgather mode\" \"strict 3.4\"", "\"finalgather points\" 30"});
  EXPECT_TRUE(o.finalgather.on && o.finalgather.fast_lookup && o.finalgather.radius_in_pixels);
  EXPECT_EQ(o.finalgather.rays, 200);
  EXPECT_EQ(o.finalgather.max_radius, 20);
  EXPECT_EQ(o.finalgather.min_radius, 2);
  EXPECT_FALSE(o.globillum.on);
  EXPECT_EQ(o.globillum.object_flags, 3);
  EXPECT_TRUE(o.caustic.on);
  EXPECT_EQ(o.caustic.accuracy, 500);
  EXPECT_EQ(o.caustic.radius, 3);
  EXPECT_EQ(o.caustic.filter, PhotonOptions::Filter::Cone);
  EXPECT_EQ(o.globillum.scale, Rgba(2, 2, 2, 1));
  EXPECT_EQ(o.finalgather.rebuild, FinalGatherOptions::Rebuild::Freeze);
  EXPECT_EQ(o.finalgather.files, std::vector<std::string>{"a b"});
  EXPECT_EQ(o.finalgather.falloff_stop, 7);
  EXPECT_EQ(o.finalgather.mode, FinalGatherOptions::Mode::StrictRadius);
  EXPECT_EQ(o.finalgather.points, 30);
}

TEST(RenderOptions, DisplayAndSpaceOptionsAreTyped) {
  const RenderOptions o =
      read({"gamma 2.2", "desaturate on", "dither on", "premultiply off", "colorclip alpha",
            "luminance weight ntsc", "camera space", "face front", "\"indirect\" \"path\"",
            "frame buffer 2 \"-rgba_fp\"", "frame buffer 1 \"z\""});
  EXPECT_FLOAT_EQ(o.gamma, 2.2f);
  EXPECT_TRUE(o.desaturate && o.dither && !o.premultiply);
  EXPECT_EQ(o.colorclip, ColorClip::Alpha);
  EXPECT_EQ(o.luminance_weight, kNtscLuminance);
  EXPECT_EQ(o.space, Space::Camera);
  EXPECT_EQ(o.face, Face::Front);
  EXPECT_EQ(o.indirect, IndirectMethod::Path);
  ASSERT_EQ(o.frame_buffers.size(), 2u);
  EXPECT_EQ(o.frame_buffers[0], (UserFrameBuffer{2, "rgba_fp", false}));
  EXPECT_EQ(o.frame_buffers[1], (UserFrameBuffer{1, "z", true}));
}

TEST(RenderOptions, AnUnknownStringOptionIsSilentAndListedOnce) {
  const RenderOptions o =
      read({"\"maya shader glow\" on", "\"pixel preview\" 1", "\"maya shader glow\" off"});
  EXPECT_EQ(o.unknown_strings, (std::vector<std::string>{"maya shader glow", "pixel preview"}));
}

TEST(RenderOptions, WrongValuesAreReportedWithExpectationAndSkipped) {
  Diagnostics d;
  Options options;
  options.statements = {statement("trace depth 2.5 on"), statement("filter bpx 1 1"),
                        statement("gamm 2.2"), statement("\"finalgather points\" \"many\"")};
  options.statements[0].where = {1, 12, 3};
  const RenderOptions o = interpret_options(options, d);
  EXPECT_EQ(o.trace_depth, TraceDepth{});
  EXPECT_EQ(o.filter, PixelFilter{});
  ASSERT_EQ(d.all().size(), 4u);
  EXPECT_EQ(d.all()[0].code, "OR-SC-101");
  EXPECT_EQ(d.all()[0].where.line, 12u);
  EXPECT_EQ(d.all()[0].message, "trace depth 2.5 on is ignored");
  EXPECT_EQ(d.all()[0].hint, "expected: trace depth int [int [int]] (reflection, refraction, sum)");
  EXPECT_EQ(d.all()[1].code, "OR-SC-101");
  EXPECT_EQ(d.all()[2].hint, "did you mean 'gamma'?");
  EXPECT_EQ(d.all()[3].severity, Severity::Note);
}

TEST(RenderOptions, StatementsWithoutEffectAreListedUnlessDefault) {
  const RenderOptions o = read({"caustic off", "shutter 1", "shutter 0", "acceleration bsp",
                                "trace on", "contour store \"c\""});
  std::vector<std::string> listed;
  for (const auto& w : o.without_effect) listed.push_back(w.keyword);
  EXPECT_EQ(listed, (std::vector<std::string>{"acceleration", "contour store"}));
  EXPECT_EQ(o.without_effect[0].support, Support::Harmless);
}

TEST(RenderOptions, UnifiedSamplingOptionsApply) {
  // A count of 4^n samples is level n; twice the quality is half the default contrast of .1.
  const RenderOptions o =
      read({"\"samples min\" 1.", "\"samples max\" 64.", "\"samples quality\" 2. 2. 2. 2."});
  EXPECT_EQ(o.samples_min, 0);
  EXPECT_EQ(o.samples_max, 3);
  EXPECT_FLOAT_EQ(o.contrast.r, .05f);
  EXPECT_FLOAT_EQ(o.contrast.a, .05f);
  EXPECT_FLOAT_EQ(read({"\"samples quality\" .5"}).contrast.g, .2f);
  EXPECT_FLOAT_EQ(
      read({"\"samples quality\" 4.", "\"samples error cutoff\" .04 .04 .04 .04"}).contrast.g,
      .04f);
  EXPECT_EQ(read({"\"samples quality\" 0."}).contrast, RenderOptions{}.contrast);
  for (const char* off : {"\"unified sampling\" off", "\"unified sampling\" 0"})
    EXPECT_EQ(read({"\"samples max\" 64.", off}).samples_max, RenderOptions{}.samples_max) << off;
}

TEST(RenderOptions, GlobalIlluminationOfLaterVersionsIsPathTracing) {
  for (const char* on : {"\"gi\" on", "\"gi\" 1", "\"environment lighting mode\" \"automatic\""})
    EXPECT_EQ(read({on}).indirect, IndirectMethod::Path) << on;
  for (const char* off : {"\"gi\" off", "\"gi\" 0", "\"environment lighting mode\" \"off\""})
    EXPECT_EQ(read({off}).indirect, IndirectMethod::Scene) << off;
  EXPECT_EQ(read({"\"indirect\" \"fg\"", "\"gi\" on"}).indirect, IndirectMethod::FinalGather);
  EXPECT_EQ(read({"\"gi\" on", "\"indirect\" \"fg\""}).indirect, IndirectMethod::FinalGather);
  // Each is listed once; none is unknown.
  const RenderOptions o =
      read({"\"gi rays\" 34", "\"gi rays\" 50", "\"gi passes\" 0", "\"gi fg rays\" 12",
            "\"light importance sampling\" \"on\"", "\"trace camera clip\" on"});
  EXPECT_TRUE(o.unknown_strings.empty());
  EXPECT_EQ(o.without_effect.size(), 5u);
}

TEST(OptionTable, RowsAreUniqueAndEffectiveRowsHaveASetter) {
  std::vector<std::string_view> keywords;
  for (const Row<RenderOptions>& row : option_table().rows()) {
    keywords.push_back(row.keyword);
    if (row.support == Support::Effective || row.support == Support::NotYet) {
      EXPECT_NE(row.set, nullptr) << row.keyword;
    }
    EXPECT_FALSE(row.meaning.empty());
  }
  std::sort(keywords.begin(), keywords.end());
  EXPECT_EQ(std::adjacent_find(keywords.begin(), keywords.end()), keywords.end());
}

}  // namespace render_options_test
}  // namespace oriel::scene
