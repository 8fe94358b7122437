// SPDX-License-Identifier: Apache-2.0
// Memory of user shaders: released blocks and initial contents.
#include "user_scene.h"

namespace oriel {
namespace memory_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

TEST(UserMemory, AnyBlockIsReleased) {
  const ShaderFolder folder;
  folder.compile("m",
                 "#include <shader.h>\n"
                 "#include <new>\n#include <string>\n"
                 "void *operator new(size_t n) throw(std::bad_alloc) { return malloc(n); }"
                 "void operator delete(void *p) throw() { mi_mem_release(p); }"
                 "static int zeros(const char *p, size_t from, size_t to) {"
                 "  while (from < to && p[from] == 0) ++from; return from == to; }"
                 "extern \"C\" DLLEXPORT miBoolean blocks(miColor *r, miState *, void *) {"
                 "  miImg_file file; miImg_image *image; memset(&file, 0, sizeof file);"
                 "  file.type = miIMG_TYPE_RGBA_FP; file.width = 8; file.height = 4;"
                 "  image = mi_img_image_alloc(&file);"
                 "  miColor c = {.25, .5, .75, 1}, seen; char *p;"
                 "  r->r = r->g = r->b = 0; r->a = 1;"
                 "  mi_img_put_color(image, &c, 7, 3); mi_img_get_color(image, &seen, 7, 3);"
                 "  if (seen.g == .5) r->r = 1;"
                 "  mi_mem_release(image); mi_mem_release(malloc(100)); mi_mem_release(0);"
                 "  { std::string text(1000, 'a'); delete new int(3); free(mi_mem_allocate(100)); }"
                 "  p = (char *)mi_mem_reallocate(0, 100); r->g = p && zeros(p, 0, 100);"
                 "  memset(p, 7, 100); p = (char *)mi_mem_reallocate(p, 40);"
                 "  p = (char *)mi_mem_reallocate(p, 5000);"
                 "  r->b = p && p[39] == 7 && zeros(p, 40, 5000) &&"
                 "    mi_mem_reallocate(p, 0) == 0;"
                 "  return miTRUE; }",
                 "cpp", "-Wno-deprecated");
  UserScene scene(folder,
                  "link \"m.so\" declare shader color \"blocks\" ( ) apply material end declare "
                  "material \"m\" \"blocks\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(1), 0);
}

}  // namespace memory_test
}  // namespace oriel
