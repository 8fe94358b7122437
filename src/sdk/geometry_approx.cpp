// SPDX-License-Identifier: Apache-2.0
// Approximations of geometry shaders, converted to statements of scene files.
#include <array>
#include <cmath>
#include <string_view>

#include "sdk/geometry_work.h"
#include "sdk/once.h"

namespace oriel::sdk {
namespace {

/// Collects the words and numbers of a statement.
struct Written {
  scene::Statement statement;

  void word(std::string_view text) { add_text(text, true); }
  void name(std::string_view text) { add_text(text, false); }
  void number(double value) {
    // Consecutive numbers form one value, as in the parser.
    auto& values = statement.values;
    if (values.empty() || values.back().kind != scene::Value::Kind::Numbers) {
      values.emplace_back();
      values.back().kind = scene::Value::Kind::Numbers;
    }
    values.back().numbers.push_back(value);
  }

 private:
  void add_text(std::string_view text, bool bare) {
    scene::Value v;
    v.kind = scene::Value::Kind::Text;
    v.text = text;
    v.bare = bare;
    statement.values.push_back(std::move(v));
  }
};

/// Words before `approximate`: the ray types that it applies to.
std::string rays_of(int flag) {
  constexpr std::pair<int, const char*> kRays[] = {{miAPPROX_FLAG_VISIBLE, "visible "},
                                                   {miAPPROX_FLAG_TRACE, "trace "},
                                                   {miAPPROX_FLAG_SHADOW, "shadow "},
                                                   {miAPPROX_FLAG_CAUSTIC, "caustic "},
                                                   {miAPPROX_FLAG_GLOBILLUM, "globillum "}};
  std::string words;
  const int known = flag & miAPPROX_FLAG_ANY;
  if (known == 0 || known == miAPPROX_FLAG_ANY) return words;
  for (const auto& [bit, word] : kRays)
    if (known & bit) words += word;
  return words;
}

/// Writes the technique with its constants. Returns false if none applies.
bool write_technique(const miApprox& approx, Written& out) {
  const miScalar* c = approx.cnst;
  const auto criterion = [&](std::string_view word, miScalar value) {
    if (!(value > 0)) return false;
    out.word(word);
    out.number(value);
    return true;
  };
  bool some = false;
  switch (approx.method) {
    case miAPPROX_PARAMETRIC:
    case miAPPROX_REGULAR:
    case miAPPROX_REGULAR_PERCENT:
      if (!(c[miCNST_UPARAM] > 0) && !(c[miCNST_VPARAM] > 0)) return false;
      if (approx.method != miAPPROX_PARAMETRIC) out.word("regular");
      out.word("parametric");
      out.number(c[miCNST_UPARAM]);
      out.number(c[miCNST_VPARAM]);
      if (approx.method == miAPPROX_REGULAR_PERCENT) out.word("%");
      return true;
    case miAPPROX_SPATIAL:
      return criterion("spatial", c[miCNST_LENGTH]);
    case miAPPROX_CURVATURE:
    case miAPPROX_LDA:
      if (approx.method == miAPPROX_LDA) some |= criterion("length", c[miCNST_LENGTH]);
      some |= criterion("distance", c[miCNST_DISTANCE]);
      some |= criterion("angle", c[miCNST_ANGLE]);
      return some;
    default:
      warn_once("OR-SDK-040",
                "a geometry shader uses an approximation method that surfaces do not support; "
                "ignored");
      return false;
  }
}

void write_style(const miApprox& approx, Written& out) {
  constexpr std::array<const char*, miAPPROX_NSTYLES> kStyles = {"",         "grid", "tree",
                                                                 "delaunay", "fine", "fine"};
  const auto style = static_cast<std::size_t>(approx.style);
  if (style > 0 && style < kStyles.size()) out.word(kStyles[style]);
  if (approx.style == miAPPROX_STYLE_FINE_NO_SMOOTHING) out.word("nosmoothing");
  if (approx.view_dep) out.word("view");
  if (approx.any) out.word("any");
  if (approx.sharp > 0) {
    out.word("sharp");
    out.number(approx.sharp);
  }
  if (approx.grading > 0) {
    out.word("grading");
    out.number(approx.grading);
  }
  if (approx.max > 0) {
    out.word("max");
    out.number(approx.max);
  }
}

miBoolean approximate(const miApprox* approx, std::string_view kind, const std::string& name) {
  scene::PolygonGroup* group = open_group();
  if (!group || !approx) return miFALSE;
  if (auto statement = statement_of(*approx, kind, name))
    group->settings.push_back(std::move(*statement));
  return miTRUE;
}

}  // namespace

std::optional<scene::Statement> statement_of(const miApprox& approx, std::string_view kind,
                                             const std::string& name) {
  if (approx.style == miAPPROX_STYLE_NONE) return std::nullopt;
  Written out;
  out.statement.keyword = rays_of(approx.flag) + "approximate";
  if (!kind.empty()) out.word(kind);
  write_style(approx, out);
  if (!write_technique(approx, out)) return std::nullopt;
  if (approx.subdiv[miMAX] > 0) {
    out.number(approx.subdiv[miMIN]);
    out.number(approx.subdiv[miMAX]);
  }
  if (!name.empty()) out.name(name);
  return out.statement;
}

}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

void oriel_approx_set(miApprox* approx, miApprox_style style) {
  if (!approx) return;
  *approx = {};
  approx->flag = miAPPROX_FLAG_ANY;
  approx->style = style;
  approx->subdiv[miMAX] = 5;
  if (style != miAPPROX_STYLE_FINE) return;
  approx->method = miAPPROX_LDA;
  approx->cnst[miCNST_LENGTH] = 0.25f;
  approx->view_dep = miTRUE;
  approx->subdiv[miMAX] = 7;
}

miBoolean mi_api_poly_approx(const miApprox* approx) { return approximate(approx, "", {}); }

miBoolean mi_api_surface_approx(const char* surface, const miApprox* approx) {
  return approximate(approx, "surface", taken(surface));
}

miBoolean mi_api_subdivsurf_approx(const void*, ...) {
  warn_once(
      "OR-SDK-040",
      "subdivision surfaces of geometry shaders are unsupported; their approximation is ignored");
  return miTRUE;
}

}  // extern "C"
