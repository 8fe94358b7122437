// SPDX-License-Identifier: Apache-2.0
// Test support: a wall with a window before a room, as IFC files of several exporters.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace oriel::ifc_house {

/// How the glass is made and how its style is connected.
enum class Glass {
  Assigned,      ///< a style assignment of the item (IFC2X3)
  Direct,        ///< a style of the item (IFC4)
  Material,      ///< a style of the product's material
  TypeMaterial,  ///< a style of the material of the product's type
  Constituent,   ///< styles of the materials of constituents, by shape aspects
};

/// A wall of 4 x .3 x 3 m from the origin, with an opening from (1, 1) to (3, 2.5). In the opening
/// a frame .1 m wide and a pane .02 m thick; behind the wall a space. z is up, the room is at y >
/// .3.
struct House {
  std::string schema = "IFC2X3";
  bool millimetres = false;
  bool with_history = true;
  Glass glass = Glass::Assigned;
  bool tessellated = false;  ///< the pane as a face set, else an extrusion
  bool divided = false;      ///< the profile of the wall has corners in the middle of its sides
  bool mapped = false;       ///< the window by a mapped item
  std::string transparency = "IFCSURFACESTYLERENDERING({},0.9,$,$,$,$,$,$,.NOTDEFINED.)";

  std::string text() const;
};

class HouseWriter : private House {
 public:
  explicit HouseWriter(const House& house) : House(house) {}

  std::string text() {
    setting();
    wall();
    window();
    room();
    return fmt::format(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
        "FILE_NAME('m.ifc','2020-01-01T00:00:00',(''),(''),'','','');\nFILE_SCHEMA(('{}'));\n"
        "ENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        schema, out_);
  }

 private:
  std::string add(const std::string& entity) {
    out_ += fmt::format("#{}={};\n", next_, entity);
    return fmt::format("#{}", next_++);
  }
  /// A rooted entity: its global id and history come first.
  std::string add_root(const std::string& name, const std::string& rest) {
    return add(fmt::format("{}('{:022}',{},{})", name, next_, history_, rest));
  }
  std::string length(double metres) const {
    return fmt::format("{:.6f}", millimetres ? metres * 1000 : metres);
  }
  std::string point(double x, double y, double z) {
    return add(fmt::format("IFCCARTESIANPOINT(({},{},{}))", length(x), length(y), length(z)));
  }
  std::string point(double x, double y) {
    return add(fmt::format("IFCCARTESIANPOINT(({},{}))", length(x), length(y)));
  }
  std::string rectangle(double x0, double y0, double x1, double y1) {
    const std::string p[] = {point(x0, y0), point(x1, y0), point(x1, y1), point(x0, y1)};
    return add(fmt::format("IFCPOLYLINE(({},{},{},{},{}))", p[0], p[1], p[2], p[3], p[0]));
  }
  /// Upwards from z = 0.
  std::string upright_box(double x0, double y0, double x1, double y1, double height) {
    const std::string profile =
        add(fmt::format("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,{})", rectangle(x0, y0, x1, y1)));
    return add(
        fmt::format("IFCEXTRUDEDAREASOLID({},{},{},{})", profile, axes_, up_, length(height)));
  }
  std::string divided_wall() {
    std::string corners;
    for (const auto& [x, y] :
         {std::pair(0., 0.), {1.8, 0.}, {4., 0.}, {4., .3}, {1.8, .3}, {0., .3}})
      corners += point(x, y) + ",";
    const std::string first = corners.substr(0, corners.find(','));
    const std::string curve = add(fmt::format("IFCPOLYLINE(({}{}))", corners, first));
    const std::string profile =
        add(fmt::format("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,{})", curve));
    return add(fmt::format("IFCEXTRUDEDAREASOLID({},{},{},{})", profile, axes_, up_, length(3)));
  }
  std::string shape(const std::string& type, const std::string& items) {
    const std::string body =
        add(fmt::format("IFCSHAPEREPRESENTATION({},'Body','{}',({}))", context_, type, items));
    return add(fmt::format("IFCPRODUCTDEFINITIONSHAPE($,$,({}))", body));
  }

  void setting() {
    history_ = "$";
    if (with_history) {
      const std::string person = add("IFCPERSON($,$,'',$,$,$,$,$)");
      const std::string firm = add("IFCORGANIZATION($,'',$,$,$)");
      const std::string both = add(fmt::format("IFCPERSONANDORGANIZATION({},{},$)", person, firm));
      const std::string program = add(fmt::format("IFCAPPLICATION({},'1','a','a')", firm));
      history_ = add(fmt::format("IFCOWNERHISTORY({},{},$,.ADDED.,$,$,$,0)", both, program));
    }
    up_ = add("IFCDIRECTION((0.,0.,1.))");
    axes_ = add(fmt::format("IFCAXIS2PLACEMENT3D({},$,$)", point(0, 0, 0)));
    place_ = add(fmt::format("IFCLOCALPLACEMENT($,{})", axes_));
    context_ =
        add(fmt::format("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,{},$)", axes_));
    const std::string unit =
        add(fmt::format("IFCSIUNIT(*,.LENGTHUNIT.,{},.METRE.)", millimetres ? ".MILLI." : "$"));
    const std::string angle = add("IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
    const std::string units = add(fmt::format("IFCUNITASSIGNMENT(({},{}))", unit, angle));
    const std::string project =
        add_root("IFCPROJECT", fmt::format("'p',$,$,$,$,({}),{}", context_, units));
    // IFC4 made the composition type optional.
    const std::string kind = schema == "IFC4" ? "$" : ".ELEMENT.";
    const std::string site =
        add_root("IFCSITE", fmt::format("'site',$,$,{},$,$,{},$,$,$,$,$", place_, kind));
    const std::string building =
        add_root("IFCBUILDING", fmt::format("'house',$,$,{},$,$,{},$,$,$", place_, kind));
    storey_ =
        add_root("IFCBUILDINGSTOREY", fmt::format("'Level 1',$,$,{},$,$,{},0.", place_, kind));
    add_root("IFCRELAGGREGATES", fmt::format("$,$,{},({})", project, site));
    add_root("IFCRELAGGREGATES", fmt::format("$,$,{},({})", site, building));
    add_root("IFCRELAGGREGATES", fmt::format("$,$,{},({})", building, storey_));
  }

  /// A surface style with its shading.
  std::string style(const std::string& name, const std::string& shading) {
    const std::string color = add("IFCCOLOURRGB($,0.5,0.5,0.5)");
    const std::string element = add(fmt::format(fmt::runtime(shading), color));
    return add(fmt::format("IFCSURFACESTYLE('{}',.BOTH.,({}))", name, element));
  }
  std::string assigned(const std::string& style) {
    if (schema == "IFC4") return style;
    return add(fmt::format("IFCPRESENTATIONSTYLEASSIGNMENT(({}))", style));
  }
  /// A material whose representation has the style.
  std::string material(const std::string& name, const std::string& style) {
    const std::string made = add(schema == "IFC4" ? fmt::format("IFCMATERIAL('{}',$,$)", name)
                                                  : fmt::format("IFCMATERIAL('{}')", name));
    if (style.empty()) return made;
    const std::string item = add(fmt::format("IFCSTYLEDITEM($,({}),$)", assigned(style)));
    const std::string styled =
        add(fmt::format("IFCSTYLEDREPRESENTATION({},'Style','Material',({}))", context_, item));
    add(fmt::format("IFCMATERIALDEFINITIONREPRESENTATION($,$,({}),{})", styled, made));
    return made;
  }

  void wall() {
    const std::string solid = upright_box(0, 0, 4, .3, 3);
    const std::string product =
        add_root("IFCWALLSTANDARDCASE",
                 fmt::format("'Basic Wall',$,$,{},{},$", place_, shape("SweptSolid", solid)));
    // Only the name of its material, by layers.
    const std::string brick = material("Brick, common", "");
    const std::string layer = add(fmt::format("IFCMATERIALLAYER({},{},$)", brick, length(.3)));
    const std::string layers = add(fmt::format("IFCMATERIALLAYERSET(({}),'w')", layer));
    const std::string usage =
        add(fmt::format("IFCMATERIALLAYERSETUSAGE({},.AXIS2.,.POSITIVE.,0.)", layers));
    add_root("IFCRELASSOCIATESMATERIAL", fmt::format("$,$,({}),{}", product, usage));
    const std::string low = add(fmt::format("IFCAXIS2PLACEMENT3D({},$,$)", point(0, 0, 1)));
    const std::string profile =
        add(fmt::format("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,{})", rectangle(1, 0, 3, .3)));
    const std::string hole =
        add(fmt::format("IFCEXTRUDEDAREASOLID({},{},{},{})", profile, low, up_, length(1.5)));
    opening_ = add_root("IFCOPENINGELEMENT",
                        fmt::format("'Opening',$,$,{},{},$", place_, shape("SweptSolid", hole)));
    add_root("IFCRELVOIDSELEMENT", fmt::format("$,$,{},{}", product, opening_));
    add_root("IFCRELCONTAINEDINSPATIALSTRUCTURE", fmt::format("$,$,({}),{}", product, storey_));
  }

  /// Extruded toward the room by the thickness, from y in the wall; the profile is in x and z.
  std::string facing(const std::string& profile, double y, double thickness) {
    const std::string normal = add("IFCDIRECTION((0.,-1.,0.))"),
                      x = add("IFCDIRECTION((1.,0.,0.))");
    const std::string axes =
        add(fmt::format("IFCAXIS2PLACEMENT3D({},{},{})", point(0, y + thickness, 0), normal, x));
    return add(
        fmt::format("IFCEXTRUDEDAREASOLID({},{},{},{})", profile, axes, up_, length(thickness)));
  }

  std::string pane() {
    if (!tessellated)
      return facing(add(fmt::format("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,{})",
                                    rectangle(1.1, 1.1, 2.9, 2.4))),
                    .15, .02);
    std::string points;
    for (const double y : {.15, .17})
      for (const auto& [x, z] : {std::pair(1.1, 1.1), {2.9, 1.1}, {2.9, 2.4}, {1.1, 2.4}})
        points +=
            fmt::format("{}({},{},{})", points.empty() ? "" : ",", length(x), length(y), length(z));
    const std::string list = add(fmt::format("IFCCARTESIANPOINTLIST3D(({}))", points));
    std::string faces;
    for (const char* corners :
         {"(1,2,3,4)", "(5,8,7,6)", "(1,5,6,2)", "(2,6,7,3)", "(3,7,8,4)", "(4,8,5,1)"})
      faces +=
          (faces.empty() ? "" : ",") + add(fmt::format("IFCINDEXEDPOLYGONALFACE({})", corners));
    return add(fmt::format("IFCPOLYGONALFACESET({},.T.,({}),$)", list, faces));
  }

  void window() {
    const std::string voids =
        add(fmt::format("IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,{},({}))",
                        rectangle(1, 1, 3, 2.5), rectangle(1.1, 1.1, 2.9, 2.4)));
    const std::string frame = facing(voids, .12, .06), glass = pane();
    std::string items = fmt::format("{},{}", frame, glass), type = "SolidModel";
    if (mapped) {
      const std::string body =
          add(fmt::format("IFCSHAPEREPRESENTATION({},'Body','{}',({}))", context_, type, items));
      const std::string map = add(fmt::format("IFCREPRESENTATIONMAP({},{})", axes_, body));
      const std::string target =
          add(fmt::format("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,{},$,$)", point(0, 0, 0)));
      items = add(fmt::format("IFCMAPPEDITEM({},{})", map, target));
      type = "MappedRepresentation";
    }
    const std::string whole = shape(type, items);
    const std::string product = add_root(
        "IFCWINDOW", fmt::format("'Window',$,$,{},{},$,{},{}{}", place_, whole, length(1.5),
                                 length(2), schema == "IFC4" ? ",.WINDOW.,$,$" : ""));
    add_root("IFCRELFILLSELEMENT", fmt::format("$,$,{},{}", opening_, product));
    add_root("IFCRELCONTAINEDINSPATIALSTRUCTURE", fmt::format("$,$,({}),{}", product, storey_));
    const std::string wood =
        style("Sash", "IFCSURFACESTYLESHADING({}" + std::string(schema == "IFC4" ? ",0.)" : ")"));
    connect(product, frame, glass, whole, wood, style("Glass, clear", transparency));
  }

  void connect(const std::string& product, const std::string& frame, const std::string& pane,
               const std::string& whole, const std::string& wood, const std::string& clear) {
    const auto item = [&](const std::string& shape, const std::string& style) {
      add(fmt::format("IFCSTYLEDITEM({},({}),$)", shape, assigned(style)));
    };
    if (glass == Glass::Assigned || glass == Glass::Direct) {
      item(frame, wood);
      item(pane, clear);
    } else if (glass == Glass::Constituent) {
      const std::string parts[] = {
          add(fmt::format("IFCMATERIALCONSTITUENT('Framing',$,{},$,$)", material("Oak", wood))),
          add(fmt::format("IFCMATERIALCONSTITUENT('Glazing',$,{},$,$)", material("Glass", clear)))};
      const std::string set =
          add(fmt::format("IFCMATERIALCONSTITUENTSET('Window',$,({},{}))", parts[0], parts[1]));
      add_root("IFCRELASSOCIATESMATERIAL", fmt::format("$,$,({}),{}", product, set));
      for (const auto& [name, part] : {std::pair("Framing", frame), {"Glazing", pane}}) {
        const std::string body =
            add(fmt::format("IFCSHAPEREPRESENTATION({},'Body','SolidModel',({}))", context_, part));
        add(fmt::format("IFCSHAPEASPECT(({}),'{}',$,.U.,{})", body, name, whole));
      }
    } else {
      item(frame, wood);
      std::string object = product;
      if (glass == Glass::TypeMaterial) {
        object = add_root("IFCWINDOWSTYLE", "'Type',$,$,$,$,$,.NOTDEFINED.,.NOTDEFINED.,.T.,.F.");
        add_root("IFCRELDEFINESBYTYPE", fmt::format("$,$,({}),{}", product, object));
      }
      add_root("IFCRELASSOCIATESMATERIAL",
               fmt::format("$,$,({}),{}", object, material("Glass", clear)));
    }
  }

  void room() {
    const std::string solid = upright_box(0, .3, 4, 3, 3);
    const std::string kind = schema == "IFC4" ? "$,.SPACE.,$" : ".ELEMENT.,.INTERNAL.,$";
    const std::string space = add_root("IFCSPACE", fmt::format("'Room 1',$,$,{},{},$,{}", place_,
                                                               shape("SweptSolid", solid), kind));
    add_root("IFCRELAGGREGATES", fmt::format("$,$,{},({})", storey_, space));
  }

  std::string out_, history_, up_, axes_, place_, context_, storey_, opening_;
  unsigned next_ = 1;
};

inline std::string House::text() const { return HouseWriter(*this).text(); }

}  // namespace oriel::ifc_house
