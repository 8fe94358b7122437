// SPDX-License-Identifier: Apache-2.0
#include "scene/approximation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/element_settings.h"

namespace oriel::scene {
namespace {

using Kind = Approximation::Kind;
using Style = Approximation::Style;
using Technique = Approximation::Technique;

// Default maxima. [K] for fine, which needs small triangles.
constexpr int kMaxDefaultSubdivisions = 5, kMaxDefaultFineSubdivisions = 7;

/// Reads the values of a statement word by word and number by number.
class Words {
 public:
  explicit Words(const std::vector<Value>& values) : values_(values) {}

  bool done() const { return value_ == values_.size(); }
  bool at_number() const { return !done() && values_[value_].kind == Value::Kind::Numbers; }
  const Value& value() const { return values_[value_]; }
  void skip() { ++value_, number_ = 0; }
  /// Number of consecutive numbers.
  std::size_t numbers() const { return at_number() ? value().numbers.size() - number_ : 0; }
  /// The next number, or 0 if it is missing, not positive or not finite.
  float positive() {
    if (numbers() == 0) return 0;
    const auto n = static_cast<float>(value().numbers[number_++]);
    if (number_ == value().numbers.size()) skip();
    return n > 0 && std::isfinite(n) ? n : 0;
  }
  int count(int most) { return static_cast<int>(std::min(positive(), static_cast<float>(most))); }
  bool accept(std::string_view word) {
    const bool here = !done() && value().kind == Value::Kind::Text && value().text == word;
    if (here) skip();
    return here;
  }

 private:
  const std::vector<Value>& values_;
  std::size_t value_ = 0, number_ = 0;
};

Kind read_kind(Words& words) {
  constexpr std::pair<std::string_view, Kind> kKinds[] = {
      {"surface", Kind::Surface}, {"ccmesh", Kind::CcMesh}, {"displace", Kind::Displace},
      {"curve", Kind::Curve},     {"trim", Kind::Trim},     {"trilist", Kind::Trilist}};
  for (const auto& [word, kind] : kKinds)
    if (words.accept(word)) return kind;
  if (words.accept("subdivision")) {
    words.accept("surface");
    return Kind::Subdivision;
  }
  if (words.accept("space")) {
    words.accept("curve");
    return Kind::SpaceCurve;
  }
  return Kind::Polygon;
}

std::uint8_t read_rays(std::string_view keyword) {
  constexpr std::pair<std::string_view, Approximation::Ray> kRays[] = {
      {"visible", Approximation::Visible},
      {"trace", Approximation::Trace},
      {"shadow", Approximation::Shadow},
      {"caustic", Approximation::Caustic},
      {"globillum", Approximation::Globillum}};
  unsigned rays = 0;
  for (const auto& [word, ray] : kRays)
    if (keyword.find(word) != std::string_view::npos) rays |= ray;
  return static_cast<std::uint8_t>(rays);
}

bool has_v_direction(Kind kind) {
  return kind != Kind::Curve && kind != Kind::SpaceCurve && kind != Kind::Trim;
}

// f [f] [%], before [min max]: an even count of numbers includes v. u and v may each have a %.
void read_parametric(Words& words, Approximation& a) {
  const std::size_t row = words.numbers();
  a.u = a.v = words.positive();
  bool percent = words.accept("%");
  const bool has_v = percent ? words.numbers() % 2 == 1 : row > 0 && row % 2 == 0;
  if (has_v && has_v_direction(a.kind)) a.v = words.positive();
  percent |= words.accept("%");
  a.percent = percent && a.technique == Technique::Regular;
}

bool read_style(Words& words, Approximation& a) {
  constexpr std::pair<std::string_view, Style> kStyles[] = {{"tree", Style::Tree},
                                                            {"grid", Style::Grid},
                                                            {"delaunay", Style::Delaunay},
                                                            {"fine", Style::Fine}};
  for (const auto& [word, style] : kStyles)
    if (words.accept(word)) {
      a.style = style;
      return true;
    }
  if (words.accept("view"))
    a.view = true;
  else if (words.accept("any"))
    a.any = true;
  else if (words.accept("offscreen"))
    a.offscreen = true;
  else if (words.accept("nosmoothing"))
    a.smooth = false;
  else if (words.accept("all"))
    a.all = true;
  else if (words.accept("sharp"))
    a.sharp = std::min(words.positive(), 1.0f);
  else if (words.accept("grading"))
    a.grading = words.positive();
  else if (words.accept("max"))
    a.max_triangles = words.count(1 << 30);
  else if (words.accept("samples"))
    a.samples = words.count(1 << 20);
  else
    return false;
  return true;
}

/// Reads the word and the numbers of a technique. Returns false if the next word is not a
/// technique.
bool read_technique(Words& words, Approximation& a) {
  const auto radians = [](float degrees) { return degrees * (kPi / 180); };
  if (words.accept("regular")) {
    words.accept("parametric");
    a.technique = Technique::Regular;
    read_parametric(words, a);
    return true;
  }
  if (words.accept("parametric")) {
    a.technique = Technique::Parametric;
    read_parametric(words, a);
    return true;
  }
  if (words.accept("spatial")) {
    a.view |= words.accept("view");
    a.length = words.positive();
  } else if (words.accept("curvature")) {
    a.view |= words.accept("view");
    a.distance = words.positive();
    a.angle = radians(words.positive());
  } else if (words.accept("length")) {
    a.length = words.positive();
  } else if (words.accept("distance")) {
    a.distance = words.positive();
  } else if (words.accept("angle")) {
    a.angle = radians(words.positive());
  } else {
    return false;
  }
  a.technique = Technique::Criteria;
  return true;
}

bool is_approximate(const Statement& s) {
  constexpr std::string_view kWord = "approximate";
  return !s.quoted && std::string_view(s.keyword).ends_with(kWord);
}

/// All approximations in a list of statements. A bare statement removes the previous ones.
std::vector<Approximation> approximations(const std::vector<Statement>& statements) {
  std::vector<Approximation> result;
  for (const Statement& s : statements) {
    if (!is_approximate(s)) continue;
    if (s.values.empty()) result.clear();
    if (auto a = approximation_of(s)) result.push_back(std::move(*a));
  }
  return result;
}

}  // namespace

std::optional<Approximation> approximation_of(const Statement& statement) {
  Approximation a;
  a.rays = read_rays(statement.keyword);
  Words words(statement.values);
  a.kind = read_kind(words);
  bool known = false, limited = false;
  while (!words.done()) {
    if (read_style(words, a)) continue;
    if (read_technique(words, a)) {
      known = true;
    } else if (words.at_number()) {
      // min max, or max only.
      const bool both = words.numbers() > 1;
      if (both) a.min_subdivisions = words.count(kMaxSubdivisions);
      a.max_subdivisions = words.count(kMaxSubdivisions);
      limited = true;
      while (words.numbers() > 0) words.positive();
    } else {
      if (words.value().kind == Value::Kind::Text && !words.value().bare)
        a.names.push_back(words.value().text);
      words.skip();
    }
  }
  if (!known) return std::nullopt;
  if (!limited)
    a.max_subdivisions =
        a.style == Style::Fine ? kMaxDefaultFineSubdivisions : kMaxDefaultSubdivisions;
  a.max_subdivisions = std::max(a.max_subdivisions, a.min_subdivisions);
  return a;
}

ApproximationRules::ApproximationRules(const PolygonGroup& group,
                                       const std::vector<const Instance*>& chain,
                                       const Options* options) {
  const auto add = [this](std::vector<Approximation> level) {
    if (!level.empty()) levels_.emplace_back(std::move(level));
  };
  if (options) add(approximations(options->statements));
  std::vector<std::vector<Approximation>> inherited;
  for (const Instance* instance : chain) {
    auto level = approximations(instance->flags);
    if (level.empty()) continue;
    if (settings_of(*instance).overrides)
      add(std::move(level));
    else
      inherited.insert(inherited.begin(), std::move(level));
  }
  add(approximations(group.settings));
  for (auto& level : inherited) add(std::move(level));
}

ApproximationRules::Level::Level(std::vector<Approximation> list) : all(std::move(list)) {
  // The last statement wins, except that camera rays have precedence over other rays.
  const auto enter = [this](const Approximation& a, std::size_t i, std::string name) {
    const auto [entry, is_new] = best.try_emplace({a.kind, std::move(name)}, i);
    if (!is_new && (a.is_for_camera() || !all[entry->second].is_for_camera())) entry->second = i;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].all || all[i].names.empty()) enter(all[i], i, {});
    for (const std::string& name : all[i].names) enter(all[i], i, name);
  }
}

const Approximation* ApproximationRules::find(Approximation::Kind kind,
                                              std::string_view name) const {
  for (const Level& level : levels_) {
    const auto named = level.best.find(std::pair(kind, std::string(name)));
    const auto any = level.best.find(std::pair(kind, std::string()));
    const auto end = level.best.end();
    if (named == end && any == end) continue;
    const bool by_name = named != end && (any == end || level.all[named->second].is_for_camera() ||
                                          !level.all[any->second].is_for_camera());
    return &level.all[(by_name ? named : any)->second];
  }
  return nullptr;
}

bool has_approximations(const std::vector<Statement>& statements) {
  return std::any_of(statements.begin(), statements.end(), is_approximate);
}

float TessellationView::pixels(const Vec3& a, const Vec3& b) const {
  const Vec3 from = transform_point(a, object_to_camera), to = transform_point(b, object_to_camera);
  constexpr float kDiagonal = 1.41421356f;
  const float scale = pixels_per_unit / kDiagonal;
  if (orthographic || !(scale > 0)) return std::max(scale, 0.0f) * oriel::length(to - from);
  // Uses the distance to the camera instead of the depth, so that reflections in mirrors with
  // another view direction are tessellated equally.
  const float away = oriel::length((from + to) * 0.5f);
  return scale * oriel::length(to - from) / std::max(away, 1e-20f);
}

}  // namespace oriel::scene
