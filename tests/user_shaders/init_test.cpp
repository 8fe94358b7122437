// SPDX-License-Identifier: Apache-2.0
// Init functions can read string parameters, look up and count frame buffers, and report messages.
#include "user_scene.h"

namespace oriel {
namespace init_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

const std::string kHead = "#include <shader.h>\n";

TEST(UserInit, TheFirstInitOfARunReadsStringsAndItsMessagesAreShown) {
  const ShaderFolder folder;
  folder.compile(
      "l", kHead +
               "struct tint { miTag name; };"
               "DLLEXPORT void tint_init(miState *state, struct tint *p, miBoolean *each) {"
               "  const char *name; void **user; *each = miTRUE; if (!p) return;"
               "  mi_info(\"said by init\");"
               "  name = mi_db_access(*mi_eval_tag(&p->name)); if (!name) return;"
               "  mi_query(miQ_FUNC_USERPTR, state, 0, &user); *user = mi_mem_strdup(name);"
               "  mi_db_unpin(p->name); }"
               "DLLEXPORT void tint_exit(miState *state, struct tint *p) { void **user;"
               "  if (p && mi_query(miQ_FUNC_USERPTR, state, 0, &user)) mi_mem_release(*user); }"
               "DLLEXPORT miBoolean tint(miColor *r, miState *state, struct tint *p) {"
               "  void **user; mi_query(miQ_FUNC_USERPTR, state, 0, &user);"
               "  r->r = *user && strcmp(*user, \"red\") == 0; r->g = r->b = 0; r->a = 1;"
               "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"l.so\" declare shader color \"tint\" ( string \"name\" ) apply lens end "
                  "declare ",
                  "", "", "lens \"tint\" ( \"name\" \"red\" )");
  expect_near(scene.pixel(4, 4, 1), Rgb(1, 0, 0), 0);
  EXPECT_NE(scene.messages().find("said by init"), std::string::npos) << scene.messages();
}

TEST(UserInit, TheFirstInitOfARunFindsNamedFrameBuffers) {
  const ShaderFolder folder;
  folder.compile("b",
                 kHead +
                     "#include <mi_shader_if.h>\n"
                     "static size_t number = 99;"
                     "extern \"C\" DLLEXPORT void into_init(miState *state, void *,"
                     "                                      miBoolean *) {"
                     "  const mi::shader::Access_fb fb(state->camera->buffertag);"
                     "  size_t index = 0; if (fb->get_index(\"own\", index)) number = index; }"
                     "extern \"C\" DLLEXPORT miBoolean into(miColor *r, miState *state, void *)"
                     "{ r->r = .5; r->g = r->b = 0; r->a = 1;"
                     "  mi_fb_put(state, (int)number, r); return miTRUE; }",
                 "cpp");
  UserScene scene(folder,
                  "link \"b.so\" declare shader color \"into\" ( ) apply material end declare "
                  "material \"m\" \"into\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "", "framebuffer \"own\" datatype \"rgba_fp\" user on ");
  ASSERT_EQ(scene.world->user_buffers.size(), 1u) << scene.messages();
  Rgba buffer(0);
  scene.pixel(4, 4, 2, &buffer);
  EXPECT_FLOAT_EQ(buffer.r, .5f);
}

TEST(UserInit, ImagesAreCountedWithTheStandardOnes) {
  const ShaderFolder folder;
  folder.compile("c", kHead +
                          "DLLEXPORT miBoolean count(miColor *r, miState *state, void *p) {"
                          "  int user = state->options->no_images - miRC_IMAGE_USER;"
                          "  r->r = user; r->g = r->b = r->a = 1; return miTRUE; }");
  const std::string body =
      "link \"c.so\" declare shader color \"count\" ( ) apply material end declare "
      "material \"m\" \"count\" ( ) end material " +
      UserScene::square("m");
  UserScene none(folder, body, "\"square_i\"");
  EXPECT_EQ(none.pixel(4, 4, 1).x, 0);
  UserScene two(folder, body, "\"square_i\"",
                "frame buffer 0 \"rgba_fp\" frame buffer 1 \"rgba_fp\" ");
  EXPECT_EQ(two.pixel(4, 4, 1).x, 2);
  UserScene named(folder, body, "\"square_i\"", "",
                  "framebuffer \"own\" datatype \"rgba_fp\" user on ");
  EXPECT_EQ(named.pixel(4, 4, 1).x, 1);
}

}  // namespace init_test
}  // namespace oriel
