// SPDX-License-Identifier: Apache-2.0
// Shadow map settings of scene lights for queries of shaders; shadows are ray traced.
#include <string_view>

#include "sdk/made_record.h"

namespace oriel::sdk {
namespace {

constexpr std::string_view kPrefix = "shadowmap";

/// `what`: the words after `shadowmap`, which is on.
void store_setting(std::string_view what, const scene::Statement& s, miLight& out) {
  const auto number = [&] {
    return s.values.empty() || s.values[0].numbers.empty() ? 0.0 : s.values[0].numbers[0];
  };
  if (what == "detail") out.shadowmap_flags |= miSHADOWMAP_DETAIL;
  if (what == "merge") out.shadowmap_flags |= miSHADOWMAP_MERGE;
  if (what == "trace") out.shadowmap_flags |= miSHADOWMAP_TRACE;
  if (what == "window") out.shadowmap_flags |= miSHADOWMAP_WINDOW;
  if (what == "camera") out.shadowmap_flags |= miSHADOWMAP_CAMERA;
  if (what == "resolution") out.shadowmap_resolution = static_cast<int>(number());
  if (what == "samples") out.shadowmap_samples = static_cast<int>(number());
  if (what == "softness") out.shadowmap_softness = static_cast<miScalar>(number());
  if (what == "bias") out.shadowmap_bias = static_cast<miScalar>(number());
  if (what == "accuracy") out.shmap.accuracy = static_cast<miScalar>(number());
  if (what == "detail samples") out.shmap.samples = static_cast<int>(number());
  if (what == "color") out.shmap.type = 'c';
  if (what == "alpha") out.shmap.type = 'a';
  if (what == "filter" && !s.values.empty() && !s.values[0].text.empty())
    out.shmap.filter = s.values[0].text[0];
}

}  // namespace

void store_shadow_maps(const std::vector<scene::Statement>& from, miLight& out) {
  for (const scene::Statement& s : from) {
    const std::string_view keyword = s.keyword;
    if (keyword == kPrefix) {
      const bool off = !s.values.empty() && s.values[0].kind == scene::Value::Kind::Boolean &&
                       !s.values[0].boolean;
      out.use_shadow_maps = !off;
    } else if (keyword.starts_with(kPrefix) && keyword[kPrefix.size()] == ' ') {
      store_setting(keyword.substr(kPrefix.size() + 1), s, out);
    }
  }
}

}  // namespace oriel::sdk
