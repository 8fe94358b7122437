// SPDX-License-Identifier: Apache-2.0
#include "models/ifc_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/math.h"
#include "base/vec.h"
#include "models/step_text.h"

namespace oriel::models {
namespace {

using Point = std::vector<double>;  // as written; map coordinates have many digits

/// Points of arcs, between its ends.
constexpr int kArcPieces = 16;
constexpr std::size_t kGuid = 24;  // 22 digits in quotes

/// Relations and properties without anything to be seen.
bool is_dropped(const std::string& name) {
  static const std::unordered_set<std::string> kDropped = {"IFCRELDEFINESBYPROPERTIES",
                                                           "IFCRELDEFINESBYTYPE",
                                                           "IFCRELDEFINESBYTEMPLATE",
                                                           "IFCPROPERTYSET",
                                                           "IFCELEMENTQUANTITY",
                                                           "IFCRELASSIGNSTOGROUP",
                                                           "IFCRELASSOCIATESDOCUMENT",
                                                           "IFCRELASSOCIATESMATERIAL",
                                                           "IFCRELASSOCIATESCLASSIFICATION",
                                                           "IFCRELDECLARES",
                                                           "IFCRELSPACEBOUNDARY",
                                                           "IFCRELSPACEBOUNDARY2NDLEVEL",
                                                           "IFCRELCONNECTSPATHELEMENTS"};
  return kDropped.contains(name);
}

/// Products of IFC4 and IFC4X3 that IFC2X3 does not have.
constexpr std::string_view kNewProducts[] = {"IFCCHIMNEY",
                                             "IFCSHADINGDEVICE",
                                             "IFCFURNITURE",
                                             "IFCSYSTEMFURNITUREELEMENT",
                                             "IFCGEOGRAPHICELEMENT",
                                             "IFCCIVILELEMENT",
                                             "IFCLIGHTFIXTURE",
                                             "IFCLAMP",
                                             "IFCSANITARYTERMINAL",
                                             "IFCOUTLET",
                                             "IFCAIRTERMINAL",
                                             "IFCAIRTERMINALBOX",
                                             "IFCBOILER",
                                             "IFCBURNER",
                                             "IFCCABLECARRIERFITTING",
                                             "IFCCABLECARRIERSEGMENT",
                                             "IFCCABLEFITTING",
                                             "IFCCABLESEGMENT",
                                             "IFCCHILLER",
                                             "IFCCOIL",
                                             "IFCCOMMUNICATIONSAPPLIANCE",
                                             "IFCCOMPRESSOR",
                                             "IFCCONDENSER",
                                             "IFCCOOLINGTOWER",
                                             "IFCDAMPER",
                                             "IFCDUCTFITTING",
                                             "IFCDUCTSEGMENT",
                                             "IFCDUCTSILENCER",
                                             "IFCELECTRICAPPLIANCE",
                                             "IFCELECTRICDISTRIBUTIONBOARD",
                                             "IFCELECTRICFLOWSTORAGEDEVICE",
                                             "IFCELECTRICGENERATOR",
                                             "IFCELECTRICMOTOR",
                                             "IFCENGINE",
                                             "IFCEVAPORATOR",
                                             "IFCFAN",
                                             "IFCFILTER",
                                             "IFCFIRESUPPRESSIONTERMINAL",
                                             "IFCFLOWMETER",
                                             "IFCHEATEXCHANGER",
                                             "IFCHUMIDIFIER",
                                             "IFCINTERCEPTOR",
                                             "IFCJUNCTIONBOX",
                                             "IFCMEDICALDEVICE",
                                             "IFCMOTORCONNECTION",
                                             "IFCPIPEFITTING",
                                             "IFCPIPESEGMENT",
                                             "IFCPROTECTIVEDEVICE",
                                             "IFCPUMP",
                                             "IFCSENSOR",
                                             "IFCSOLARDEVICE",
                                             "IFCSPACEHEATER",
                                             "IFCSTACKTERMINAL",
                                             "IFCSWITCHINGDEVICE",
                                             "IFCTANK",
                                             "IFCTRANSFORMER",
                                             "IFCTUBEBUNDLE",
                                             "IFCUNITARYEQUIPMENT",
                                             "IFCVALVE",
                                             "IFCWASTETERMINAL",
                                             "IFCWALLELEMENTEDCASE",
                                             "IFCSLABSTANDARDCASE",
                                             "IFCSLABELEMENTEDCASE",
                                             "IFCBEAMSTANDARDCASE",
                                             "IFCCOLUMNSTANDARDCASE",
                                             "IFCMEMBERSTANDARDCASE",
                                             "IFCPLATESTANDARDCASE",
                                             "IFCDOORSTANDARDCASE",
                                             "IFCWINDOWSTANDARDCASE",
                                             "IFCBUILTELEMENT",
                                             "IFCPAVEMENT",
                                             "IFCKERB",
                                             "IFCCOURSE",
                                             "IFCEARTHWORKSFILL",
                                             "IFCRAIL",
                                             "IFCTRACKELEMENT",
                                             "IFCSIGN",
                                             "IFCSIGNAL",
                                             "IFCBEARING",
                                             "IFCDEEPFOUNDATION",
                                             "IFCCAISSONFOUNDATION"};

bool is_new_product(const std::string& name) {
  static const std::unordered_set<std::string_view> kNew(std::begin(kNewProducts),
                                                         std::end(kNewProducts));
  return kNew.contains(name);
}

/// Arguments that IFC4 made optional, by entity.
struct Required {
  const char* name;
  std::size_t argument;
  const char* value;
};
constexpr Required kRequired[] = {
    {"IFCSITE", 8, ".ELEMENT."},           {"IFCBUILDING", 8, ".ELEMENT."},
    {"IFCBUILDINGSTOREY", 8, ".ELEMENT."}, {"IFCSPACE", 8, ".ELEMENT."},
    {"IFCSPACE", 9, ".INTERNAL."},         {"IFCSTAIR", 8, ".NOTDEFINED."},
    {"IFCROOF", 8, ".NOTDEFINED."},        {"IFCRAMP", 8, ".NOTDEFINED."},
    {"IFCOWNERHISTORY", 3, ".NOCHANGE."},  {"IFCSURFACESTYLERENDERING", 8, ".NOTDEFINED."}};

/// Arguments of IFC2X3; some files leave the last ones out.
constexpr std::pair<const char*, std::size_t> kCounts[] = {
    {"IFCSITE", 14}, {"IFCBUILDING", 12}, {"IFCBUILDINGSTOREY", 10}, {"IFCSPACE", 11}};

Point point_of(const std::string& list) {
  Point p;
  for (const std::string& number : step_list(list))
    p.push_back(std::strtod(number.c_str(), nullptr));
  return p;
}

std::string real(double x) {
  std::string text = fmt::format("{}", x);
  const std::size_t exponent = text.find('e');
  if (text.find('.') == text.npos) text.insert(exponent == text.npos ? text.size() : exponent, ".");
  std::replace(text.begin(), text.end(), 'e', 'E');
  return text;
}

/// "name (count), ..." of shapes that assimp does not know.
std::string unread_shapes(const StepFile& file) {
  static const std::unordered_set<std::string> kUnread = {"IFCADVANCEDBREP",
                                                          "IFCADVANCEDBREPWITHVOIDS",
                                                          "IFCSECTIONEDSOLID",
                                                          "IFCSECTIONEDSOLIDHORIZONTAL",
                                                          "IFCSECTIONEDSURFACE",
                                                          "IFCEXTRUDEDAREASOLIDTAPERED",
                                                          "IFCREVOLVEDAREASOLIDTAPERED",
                                                          "IFCFIXEDREFERENCESWEPTAREASOLID",
                                                          "IFCSURFACECURVESWEPTAREASOLID",
                                                          "IFCCSGSOLID"};
  std::map<std::string, int> count;
  for (const StepEntity& e : file.entities)
    if (kUnread.contains(e.name)) ++count[e.name];
  std::string list;
  for (const auto& [name, n] : count)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", name, n);
  return list;
}

class Rewriter {
 public:
  explicit Rewriter(StepFile file) : file_(std::move(file)) {
    for (std::size_t i = 0; i < file_.entities.size(); ++i) {
      by_id_[file_.entities[i].id] = i;
      next_ = std::max(next_, file_.entities[i].id + 1);
    }
  }

  std::string text() {
    const std::size_t count = file_.entities.size();
    for (std::size_t i = 0; i < count; ++i) {
      StepEntity entity = std::move(file_.entities[i]);
      rewrite(entity);
      file_.entities[i] = std::move(entity);
    }
    std::erase_if(file_.entities, [](const StepEntity& e) { return is_dropped(e.name); });
    file_.entities.insert(file_.entities.end(), added_.begin(), added_.end());
    return file_.text();
  }

 private:
  /// Null where there is none of that name.
  const StepEntity* find(const std::string& reference, std::string_view name) const {
    const auto found = by_id_.find(step_reference(reference));
    if (found == by_id_.end()) return nullptr;
    const StepEntity& entity = file_.entities[found->second];
    return entity.name == name ? &entity : nullptr;
  }

  std::string add(std::string name, std::vector<std::string> arguments) {
    added_.push_back({next_, std::move(name), std::move(arguments)});
    return fmt::format("#{}", next_++);
  }

  void rewrite(StepEntity& e) {
    if (is_dropped(e.name)) return;
    // Rooted entities begin with their global id.
    if (e.arguments.size() >= 4 && e.arguments[0].size() == kGuid && e.arguments[1] == "$")
      e.arguments[1] = owner_history();
    if (is_new_product(e.name) && e.arguments.size() >= 8) {
      e.name = "IFCBUILDINGELEMENTPROXY";
      e.arguments.resize(8);
      e.arguments.emplace_back("$");
    }
    // assimp leaves blanks out of strings.
    for (std::string& argument : e.arguments)
      if (argument.starts_with('\'')) std::replace(argument.begin(), argument.end(), ' ', '_');
    for (const auto& [name, count] : kCounts)
      if (e.name == name && e.arguments.size() < count) e.arguments.resize(count, "$");
    for (const Required& r : kRequired)
      if (e.name == r.name && r.argument < e.arguments.size() && e.arguments[r.argument] == "$")
        e.arguments[r.argument] = r.value;
    if (e.name == "IFCSURFACESTYLESHADING" && e.arguments.size() > 1) {
      e.name = "IFCSURFACESTYLERENDERING";
      e.arguments = {e.arguments[0], e.arguments[1], "$", "$", "$", "$", "$", "$", ".NOTDEFINED."};
    } else if (e.name == "IFCSTYLEDITEM" && e.arguments.size() > 1) {
      assign_styles(e);
    } else if (e.name == "IFCINDEXEDPOLYCURVE" && !e.arguments.empty()) {
      make_polyline(e);
    } else if (e.name == "IFCTRIANGULATEDFACESET" || e.name == "IFCPOLYGONALFACESET") {
      make_surface_model(e);
    }
  }

  std::string owner_history() {
    if (!owner_history_.empty()) return owner_history_;
    for (const StepEntity& e : file_.entities)
      if (e.name == "IFCOWNERHISTORY") return owner_history_ = fmt::format("#{}", e.id);
    const std::string person = add("IFCPERSON", {"$", "$", "''", "$", "$", "$", "$", "$"});
    const std::string firm = add("IFCORGANIZATION", {"$", "''", "$", "$", "$"});
    const std::string both = add("IFCPERSONANDORGANIZATION", {person, firm, "$"});
    const std::string program = add("IFCAPPLICATION", {firm, "''", "''", "''"});
    return owner_history_ =
               add("IFCOWNERHISTORY", {both, program, "$", ".NOCHANGE.", "$", "$", "$", "0"});
  }

  void assign_styles(StepEntity& e) {
    std::vector<std::string> styles = step_list(e.arguments[1]), direct;
    const auto is_direct = [&](const std::string& s) { return find(s, "IFCSURFACESTYLE"); };
    std::copy_if(styles.begin(), styles.end(), std::back_inserter(direct), is_direct);
    if (direct.empty()) return;
    std::erase_if(styles, is_direct);
    styles.push_back(
        add("IFCPRESENTATIONSTYLEASSIGNMENT", {fmt::format("({})", fmt::join(direct, ","))}));
    e.arguments[1] = fmt::format("({})", fmt::join(styles, ","));
  }

  std::string add_point(const Point& p) {
    std::vector<std::string> numbers;
    for (const double x : p) numbers.push_back(real(x));
    return add("IFCCARTESIANPOINT", {fmt::format("({})", fmt::join(numbers, ","))});
  }

  /// Of a point list in two or three dimensions.
  std::vector<Point> points_of(const std::string& reference) const {
    std::vector<Point> points;
    for (const char* name : {"IFCCARTESIANPOINTLIST2D", "IFCCARTESIANPOINTLIST3D"})
      if (const StepEntity* list = find(reference, name); list && !list->arguments.empty())
        for (const std::string& point : step_list(list->arguments[0]))
          points.push_back(point_of(point));
    return points;
  }

  void make_polyline(StepEntity& e) {
    const std::vector<Point> points = points_of(e.arguments[0]);
    std::vector<Point> path;
    const auto go_to = [&](const Point& p) {
      if (path.empty() || path.back() != p) path.push_back(p);
    };
    const auto segments =
        e.arguments.size() > 1 ? step_list(e.arguments[1]) : std::vector<std::string>();
    if (segments.empty()) path = points;
    for (const std::string& segment : segments) {
      const std::size_t open = segment.find('(');
      if (open == segment.npos || segment.back() != ')') continue;
      std::vector<Point> corners;
      std::string indices = segment.substr(open);
      if (indices.starts_with("((")) indices = indices.substr(1, indices.size() - 2);
      for (const std::string& index : step_list(indices)) {
        const std::size_t i = std::strtoull(index.c_str(), nullptr, 10);
        if (i >= 1 && i <= points.size()) corners.push_back(points[i - 1]);
      }
      if (segment.starts_with("IFCARCINDEX") && corners.size() == 3 && corners[0].size() == 2)
        corners = arc(corners);
      for (const Point& p : corners) go_to(p);
    }
    std::vector<std::string> references;
    references.reserve(path.size());
    for (const Point& p : path) references.push_back(add_point(p));
    // A closed curve ends at its first point, not at one beside it.
    if (path.size() > 2 && path.front() == path.back()) references.back() = references.front();
    e.name = "IFCPOLYLINE";
    e.arguments = {fmt::format("({})", fmt::join(references, ","))};
  }

  /// Through three points of a plane; straight if they lie in a line.
  static std::vector<Point> arc(const std::vector<Point>& p) {
    const double ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1];
    const double bx = p[2][0] - p[0][0], by = p[2][1] - p[0][1];
    const double twice = 2 * (ax * by - ay * bx);
    if (twice == 0) return p;
    const double aa = ax * ax + ay * ay, bb = bx * bx + by * by;
    const double cx = (by * aa - ay * bb) / twice, cy = (ax * bb - bx * aa) / twice;
    const auto angle = [&](double x, double y) {
      return math::atan2(static_cast<float>(y - cy), static_cast<float>(x - cx));
    };
    const double start = angle(0, 0);
    double turn = angle(bx, by) - start;
    // Counter-clockwise if the middle point lies to the right of the chord.
    if (twice > 0 && turn < 0) turn += kTwoPi;
    if (twice < 0 && turn > 0) turn -= kTwoPi;
    std::vector<Point> path{p[0]};
    for (int i = 1; i < kArcPieces; ++i) {
      const auto t = static_cast<float>(turn * i / kArcPieces);
      const double c = math::cos(t), s = math::sin(t);
      path.push_back({p[0][0] + cx - cx * c + cy * s, p[0][1] + cy - cx * s - cy * c});
    }
    path.push_back(p[2]);
    return path;
  }

  /// Triangles: Coordinates, Normals, Closed, CoordIndex, PnIndex; polygons: Coordinates, Closed,
  /// Faces, PnIndex.
  void make_surface_model(StepEntity& e) {
    const bool triangles = e.name == "IFCTRIANGULATEDFACESET";
    const std::size_t list = triangles ? 3 : 2, renumbered = list + 1;
    if (e.arguments.size() <= list) return;
    const std::vector<Point> points = points_of(e.arguments[0]);
    std::vector<std::string> references(points.size());
    std::vector<std::string> numbers;
    if (e.arguments.size() > renumbered) numbers = step_list(e.arguments[renumbered]);
    const auto corner = [&](const std::string& index) -> std::string {
      std::size_t i = std::strtoull(index.c_str(), nullptr, 10);
      if (!numbers.empty())
        i = i >= 1 && i <= numbers.size() ? std::strtoull(numbers[i - 1].c_str(), nullptr, 10) : 0;
      if (i < 1 || i > points.size()) return {};
      std::string& known = references[i - 1];
      if (known.empty()) known = add_point(points[i - 1]);
      return known;
    };
    const auto loop = [&](const std::vector<std::string>& indices) -> std::string {
      std::vector<std::string> corners;
      for (const std::string& index : indices)
        if (std::string c = corner(index); !c.empty()) corners.push_back(std::move(c));
      if (corners.size() < 3) return {};
      return add("IFCPOLYLOOP", {fmt::format("({})", fmt::join(corners, ","))});
    };
    std::vector<std::string> faces;
    const auto add_face = [&](const std::vector<std::string>& outer,
                              const std::vector<std::string>& holes) {
      const std::string around = loop(outer);
      if (around.empty()) return;
      std::vector<std::string> bounds{add("IFCFACEOUTERBOUND", {around, ".T."})};
      for (const std::string& hole : holes)
        if (const std::string inner = loop(step_list(hole)); !inner.empty())
          bounds.push_back(add("IFCFACEBOUND", {inner, ".T."}));
      faces.push_back(add("IFCFACE", {fmt::format("({})", fmt::join(bounds, ","))}));
    };
    for (const std::string& item : step_list(e.arguments[list])) {
      if (triangles) {
        add_face(step_list(item), {});
      } else if (const StepEntity* face = find(item, "IFCINDEXEDPOLYGONALFACE")) {
        if (!face->arguments.empty()) add_face(step_list(face->arguments[0]), {});
      } else if (const StepEntity* open = find(item, "IFCINDEXEDPOLYGONALFACEWITHVOIDS")) {
        if (open->arguments.size() > 1)
          add_face(step_list(open->arguments[0]), step_list(open->arguments[1]));
      }
    }
    const std::string shell =
        add("IFCCONNECTEDFACESET", {fmt::format("({})", fmt::join(faces, ","))});
    e.name = "IFCFACEBASEDSURFACEMODEL";
    e.arguments = {fmt::format("({})", shell)};
  }

  StepFile file_;
  std::vector<StepEntity> added_;
  std::unordered_map<std::uint64_t, std::size_t> by_id_;
  std::uint64_t next_ = 1;
  std::string owner_history_;
};

}  // namespace

IfcText as_ifc2x3(std::string_view text) {
  StepFile file = parse_step(text);
  if (file.entities.empty()) return {std::string(text), {}};
  IfcText made;
  made.unread = unread_shapes(file);
  made.text = Rewriter(std::move(file)).text();
  return made;
}

}  // namespace oriel::models
