// SPDX-License-Identifier: Apache-2.0
// Writes subdivision surfaces and Catmull-Clark meshes in the syntax of subdivision.cpp.
#include <algorithm>

#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

using scene::SubdivisionSurface;
using SubdivisionForm = SubdivisionSurface::Form;
using TextureRule = SubdivisionSurface::TextureRule;

void write_head(TextSink& out, const SubdivisionSurface& surface) {
  const bool ccmesh = surface.form == SubdivisionForm::CcMesh;
  out.put(ccmesh ? "        ccmesh " : "        subdivision surface ");
  out.quoted(surface.name);
  for (std::size_t i = 0; i < surface.announced.size(); ++i) {
    if (i == 0) out.put(" polygon");
    if (i == 1 && ccmesh) out.put(" vertex");
    out.put(' ');
    out.integer(surface.announced[i]);
  }
  for (std::size_t i = 0; i < surface.texture_rules.size(); ++i) {
    out.put(i == 0 ? " texture space [ " : ", ");
    out.put(surface.texture_rules[i] == TextureRule::Face ? "face" : "subdivision");
  }
  if (!surface.texture_rules.empty()) out.put(" ]");
  out.put('\n');
}

/// Writes the creases of one face, which are consecutive, and moves `crease` past them.
template <typename Iterator>
void write_creases(TextSink& out, SubdivisionForm form, std::uint32_t face, Iterator& crease,
                   Iterator end) {
  const Iterator begin = crease;
  while (crease != end && crease->face == face) ++crease;
  if (begin == crease) return;
  out.put(" crease");
  if (form == SubdivisionForm::CcMesh) {
    std::uint32_t edge = 0;
    for (Iterator c = begin; c != crease; ++c) {
      for (; edge < c->edge; ++edge) out.put(" 0");
      out.put(' ');
      out.number(c->sharpness);
      ++edge;
    }
    return;
  }
  constexpr std::uint32_t kMaskBits = 32;
  std::uint32_t mask = 0;
  for (Iterator c = begin; c != crease; ++c)
    if (c->edge < kMaskBits) mask |= 1u << c->edge;
  out.put(' ');
  out.index(mask);
  for (Iterator c = begin; c != crease; ++c) {
    out.put(' ');
    out.number(c->sharpness);
  }
}

}  // namespace

void FaceMaterials::write(TextSink& out, std::uint32_t material) {
  if (tagged_) {
    out.put(' ');
    out.index(material == scene::kNone ? 0 : material);
    out.put(' ');  // separates the label from the corners visually
  } else if (material < group_.materials.size()) {
    out.put(' ');
    out.quoted(group_.materials[material]);
    last_ = material;
  } else if (last_ != scene::kNone) {
    out.put(" \"\"");
    last_ = scene::kNone;
  }
}

void write_subdivision(TextSink& out, const SubdivisionSurface& surface, FaceMaterials& materials) {
  write_head(out, surface);
  const scene::PolygonList& faces = surface.faces;
  auto crease = surface.creases.begin();
  auto trim = surface.trims.begin();
  auto detail = surface.details.begin();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    out.put("          p");
    materials.write(out, i < faces.material.size() ? faces.material[i] : scene::kNone);
    for (std::uint32_t c = faces.first[i]; c < faces.first[i + 1]; ++c) {
      out.put(' ');
      out.index(faces.indices[c]);
    }
    write_creases(out, surface.form, i, crease, surface.creases.end());
    for (; trim != surface.trims.end() && trim->face == i; ++trim) {
      out.put(" trim ");
      out.index(trim->parts);
    }
    for (; detail != surface.details.end() && detail->face == i; ++detail) {
      out.put(' ');
      out.put(detail->text.keyword);
      out.put(' ');
      out.put(detail->text.text);
    }
    out.put('\n');
  }
  for (const SubdivisionSurface::Derivative& d : surface.derivatives) {
    out.put("          derivative ");
    out.integer(d.order);
    if (d.space) {
      out.put(" space ");
      out.integer(*d.space);
    }
    out.put('\n');
  }
  out.put(surface.form == SubdivisionForm::CcMesh ? "        end ccmesh\n"
                                                  : "        end subdivision surface\n");
}

}  // namespace oriel::mi
