// SPDX-License-Identifier: Apache-2.0
// IFC files of any version as IFC2X3, which is what assimp reads.
#pragma once

#include <string>
#include <string_view>

namespace oriel::models {

struct IfcText {
  std::string text;
  std::string unread;  ///< kinds of shapes that are not read and how many there are, as a list
};

/// The text of an IFC file with what IFC4 changed written as in IFC2X3.
///
/// Model:   optional arguments that were required get values (owner history, composition type).
///          Surface styles of items get a style assignment, and shading with transparency becomes
///          rendering. Tessellated face sets become face-based surface models; indexed curves
///          become polylines, arcs in kArcPieces pieces. Products that IFC2X3 does not know become
///          proxies. Property sets and relations to types, which hold nothing to be seen, are
///          dropped.
///          Advanced B-reps and other curved faces remain, and are not read.
/// Returns: the text as it is where it has no data section.
/// Source:  IFC2X3 TC1 and IFC4 ADD2 TC1 (buildingSMART), EXPRESS schemas.
/// Checked: IfcText.*, ImportedPanes.IfcTransparencyPassesTheSun
IfcText as_ifc2x3(std::string_view text);

}  // namespace oriel::models
