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

#include "models/ifc_curves.h"
#include "models/ifc_profiles.h"
#include "models/ifc_styles.h"
#include "models/step_text.h"

namespace oriel::models {
namespace {

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
    {"IFCOWNERHISTORY", 3, ".NOCHANGE."}};

/// Arguments of IFC2X3; some files leave the last ones out.
constexpr std::pair<const char*, std::size_t> kCounts[] = {
    {"IFCSITE", 14}, {"IFCBUILDING", 12}, {"IFCBUILDINGSTOREY", 10}, {"IFCSPACE", 11}};

std::string real(double x) {
  std::string text = fmt::format("{}", x);
  const std::size_t exponent = text.find('e');
  if (text.find('.') == text.npos) text.insert(exponent == text.npos ? text.size() : exponent, ".");
  std::replace(text.begin(), text.end(), 'e', 'E');
  return text;
}

/// A highlight by roughness r as the Phong exponent of a lobe of that width, 2/r^4 - 2.
std::string as_exponent(const std::string& highlight) {
  constexpr std::string_view kRoughness = "IFCSPECULARROUGHNESS(";
  constexpr double kSmoothest = .03;
  if (!highlight.starts_with(kRoughness)) return highlight;
  const double r = std::strtod(highlight.c_str() + kRoughness.size(), nullptr);
  const double width = std::clamp(r, kSmoothest, 1.0) * std::clamp(r, kSmoothest, 1.0);
  return fmt::format("IFCSPECULAREXPONENT({})", real(2 / (width * width) - 2));
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
                                                          "IFCSECTIONEDSPINE",
                                                          "IFCCOMPOSITEPROFILEDEF",
                                                          "IFCDERIVEDPROFILEDEF",
                                                          "IFCMIRROREDPROFILEDEF",
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
  explicit Rewriter(StepFile file)
      : file_(std::move(file)),
        curves_([this](const std::string& reference) { return find(reference); },
                angle_unit(file_)) {
    for (std::size_t i = 0; i < file_.entities.size(); ++i) {
      by_id_[file_.entities[i].id] = i;
      next_ = std::max(next_, file_.entities[i].id + 1);
    }
  }

  std::string text() {
    const std::size_t count = file_.entities.size();
    // Profiles first, because they refer to curves that are changed below.
    for (StepEntity& entity : file_.entities)
      if (const auto outline = profile_outline(entity, curves_)) make_outline(entity, *outline);
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
    const StepEntity* entity = find(reference);
    return entity && entity->name == name ? entity : nullptr;
  }
  const StepEntity* find(const std::string& reference) const {
    const auto found = by_id_.find(step_reference(reference));
    return found == by_id_.end() ? nullptr : &file_.entities[found->second];
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
    if (e.name == "IFCOPENINGSTANDARDCASE") e.name = "IFCOPENINGELEMENT";
    constexpr std::size_t kRepresentation = 6;
    if (e.name == "IFCVIRTUALELEMENT" && e.arguments.size() > kRepresentation)
      e.arguments[kRepresentation] = "$";
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
    if (e.name == "IFCSURFACESTYLERENDERING") {
      e.arguments.resize(std::max<std::size_t>(e.arguments.size(), 9), "$");
      e.arguments[7] = as_exponent(e.arguments[7]);
      if (e.arguments[8] == "$") e.arguments[8] = ".NOTDEFINED.";
    }
    if ((e.name == "IFCEXTRUDEDAREASOLID" || e.name == "IFCREVOLVEDAREASOLID") &&
        e.arguments.size() > 1 && e.arguments[1] == "$")
      e.arguments[1] = origin();
    if (e.name == "IFCSURFACESTYLESHADING" && e.arguments.size() > 1) {
      e.name = "IFCSURFACESTYLERENDERING";
      e.arguments = {e.arguments[0], e.arguments[1], "$", "$", "$", "$", "$", "$", ".NOTDEFINED."};
    } else if (e.name == "IFCSTYLEDITEM" && e.arguments.size() > 1) {
      assign_styles(e);
    } else if (e.name == "IFCINDEXEDPOLYCURVE" && !e.arguments.empty()) {
      make_polyline(e, curves_.indexed_path(e));
    } else if (e.name == "IFCTRIANGULATEDFACESET" || e.name == "IFCPOLYGONALFACESET") {
      make_surface_model(e);
    }
  }

  /// The placement at the origin.
  std::string origin() {
    if (origin_.empty())
      origin_ = add("IFCAXIS2PLACEMENT3D", {add_point({0.0, 0.0, 0.0}), "$", "$"});
    return origin_;
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

  std::string add_point(const IfcPoint& p) {
    std::vector<std::string> numbers;
    for (const double x : p) numbers.push_back(real(x));
    return add("IFCCARTESIANPOINT", {fmt::format("({})", fmt::join(numbers, ","))});
  }

  void make_polyline(StepEntity& e, const std::vector<IfcPoint>& path) {
    std::vector<std::string> references;
    references.reserve(path.size());
    for (const IfcPoint& p : path) references.push_back(add_point(p));
    // A closed curve ends at its first point, not at one beside it.
    if (path.size() > 2 && path.front() == path.back()) references.back() = references.front();
    e.name = "IFCPOLYLINE";
    e.arguments = {fmt::format("({})", fmt::join(references, ","))};
  }

  void make_outline(StepEntity& profile, const Outline& outline) {
    std::vector<IfcPoint> path;
    for (const auto& corner : outline) path.push_back({corner[0], corner[1]});
    path.push_back(path.front());
    StepEntity curve{next_++, {}, {}};
    make_polyline(curve, path);
    profile.name = "IFCARBITRARYCLOSEDPROFILEDEF";
    profile.arguments = {".AREA.", "$", fmt::format("#{}", curve.id)};
    added_.push_back(std::move(curve));
  }

  /// Triangles: Coordinates, Normals, Closed, CoordIndex, PnIndex; polygons: Coordinates, Closed,
  /// Faces, PnIndex.
  void make_surface_model(StepEntity& e) {
    const bool triangles = e.name == "IFCTRIANGULATEDFACESET";
    const std::size_t list = triangles ? 3 : 2, renumbered = list + 1;
    if (e.arguments.size() <= list) return;
    const std::vector<IfcPoint> points = curves_.points(e.arguments[0]);
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
  IfcCurves curves_;
  std::vector<StepEntity> added_;
  std::unordered_map<std::uint64_t, std::size_t> by_id_;
  std::uint64_t next_ = 1;
  std::string owner_history_, origin_;
};

}  // namespace

IfcText as_ifc2x3(std::string_view text) {
  StepFile file = parse_step(text);
  if (file.entities.empty()) return {std::string(text), {}};
  IfcText made;
  made.unread = unread_shapes(file);
  add_styles_of_materials(file);
  made.text = Rewriter(std::move(file)).text();
  return made;
}

}  // namespace oriel::models
