// SPDX-License-Identifier: Apache-2.0
// Each call of the shader prepares a table of its own: containers behind the user pointer.
#include <map>
#include <string>
#include <vector>

#include "shader.h"

struct cp_palette {
  miTag text;  // colours by letter: "r g b w"
  miScalar columns;
};

namespace {

typedef std::map<char, miColor> Letters;

struct Palette {
  std::vector<miColor> colors;
};

Letters letters() {
  Letters all;
  const miColor r = {1, 0, 0, 1}, g = {0, 1, 0, 1}, b = {0, 0, 1, 1}, w = {1, 1, 1, 1};
  all['r'] = r;
  all['g'] = g;
  all['b'] = b;
  all.insert(std::make_pair('w', w));
  return all;
}

Palette** slot(miState* state) {
  void** user = 0;
  mi_query(miQ_FUNC_USERPTR, state, miNULLTAG, (void*)&user);
  return (Palette**)user;
}

}  // namespace

extern "C" {

DLLEXPORT int cp_palette_version(void) { return 1; }

DLLEXPORT void cp_palette_init(miState* state, struct cp_palette* paras, miBoolean* inst_init_req) {
  if (!paras) {
    *inst_init_req = miTRUE;
    return;
  }
  const Letters known = letters();
  miTag tag = *mi_eval_tag(&paras->text);
  std::string text((char*)mi_db_access(tag));
  mi_db_unpin(tag);
  Palette* made = new Palette;
  for (std::string::const_iterator c = text.begin(); c != text.end(); ++c) {
    Letters::const_iterator found = known.find(*c);
    if (found != known.end()) made->colors.push_back(found->second);
  }
  *slot(state) = made;
}

DLLEXPORT void cp_palette_exit(miState* state, struct cp_palette* paras) {
  if (!paras) return;
  delete *slot(state);
  *slot(state) = 0;
}

DLLEXPORT miBoolean cp_palette(miColor* result, miState* state, struct cp_palette* paras) {
  const Palette* palette = *slot(state);
  if (!palette || palette->colors.empty()) return miFALSE;
  const int column = (int)(state->tex_list[0].x * *mi_eval_scalar(&paras->columns));
  *result = palette->colors[column % palette->colors.size()];
  return miTRUE;
}

}
