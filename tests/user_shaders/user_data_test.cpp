// SPDX-License-Identifier: Apache-2.0
// User data of the scene, read by shaders.
#include <fstream>

#include "user_scene.h"

namespace oriel {
namespace user_data_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

/// Red: the object's integer plus the instance's second byte; green: its scalars' sum; blue: the
/// length of its text.
const char* const kReader =
    "#include <shader.h>\n#include <string.h>\n"
    "struct pair { miInteger a; miScalar b; miTag text; int i_s; int n_s; miScalar s[1]; };"
    "DLLEXPORT miBoolean reader(miColor *r, miState *state, void *p) {"
    "  miTag object, data = 0; char *bytes = 0; int size = 0, i; struct pair *pair = 0;"
    "  r->r = r->g = r->b = 0; r->a = 1;"
    "  mi_query(miQ_INST_ITEM, state, state->instance, &object);"
    "  if (mi_query(miQ_OBJ_DATA, state, object, &data) && data) {"
    "    mi_query(miQ_DATA_PARAM, state, data, &pair);"
    "    mi_query(miQ_DATA_PARAM_SIZE, state, data, &size);"
    "    if (size < (int)sizeof(struct pair)) return miTRUE;"
    "    r->r += pair->a; r->g += pair->b;"
    "    for (i = 0; i < pair->n_s; i++) r->g += pair->s[pair->i_s + i];"
    "    if (pair->text) { r->b = strlen((char*)mi_db_access(pair->text));"
    "                      mi_db_unpin(pair->text); } }"
    "  data = 0;"
    "  if (mi_query(miQ_INST_DATA, state, state->instance, &data) && data) {"
    "    miUserdata *user = (miUserdata*)mi_db_access(data);"
    "    if (user->parameter_size > 1) r->r += (unsigned char)user->parameters[1];"
    "    if (user->label == 9) r->r += 1000;"
    "    mi_db_unpin(data); }"
    "  return miTRUE; }";

const std::string kHead =
    "link \"d.so\" declare shader color \"reader\" ( ) apply material end declare "
    "declare data \"pair\" ( integer \"a\" default 3, scalar \"b\", string \"text\" default "
    "\"four\", array scalar \"s\" ) end declare material \"m\" \"reader\" ( ) end material ";

Rgb shown(const std::string& data, const std::string& of_object, const std::string& of_instance) {
  ShaderFolder folder;
  folder.compile("d", kReader);
  std::ofstream(folder.path() / "far.bin") << "abc";
  std::string square = UserScene::square("m");
  square.replace(square.find("object \"square\" "), 16, "object \"square\" " + of_object + " ");
  square.replace(square.find("material \"m\" end instance"), 12, "material \"m\" " + of_instance);
  std::string text = kHead + data + square;
  if (const std::size_t at = text.find("FOLDER"); at != std::string::npos)
    text.replace(at, 6, folder.path().string());
  UserScene scene(folder, text, "\"square_i\"");
  const Rgb color = scene.pixel(4, 4, 1);
  EXPECT_EQ(scene.messages(), "");
  return color;
}

// acceptance: H1
TEST(UserData, DeclaredParametersFormAStructWithDefaults) {
  expect_near(shown("data \"d\" \"pair\" ( ) ", "data \"d\"", ""), Rgb(3, 0, 4), 0);
  expect_near(shown("data \"d\" \"pair\" ( \"a\" 5, \"b\" .5, \"text\" \"\", \"s\" [ 1, 2, 3 ] ) ",
                    "data \"d\"", ""),
              Rgb(5, 6.5f, 0), 1e-6f);
}

TEST(UserData, BytesComeAsWrittenWithTheirLabel) {
  expect_near(shown("data \"d\" tag 9 3 [ '01ff 02' ] ", "", "data \"d\""), Rgb(1255, 0, 0), 0);
}

TEST(UserData, BytesComeFromAFile) {
  expect_near(shown("data \"d\" \"FOLDER/far.bin\" ", "", "data \"d\""), Rgb('b', 0, 0), 0);
}

TEST(UserData, NothingIsAttachedWhereNothingIsWritten) {
  expect_near(shown("", "", ""), Rgb(0), 0);
}

TEST(UserQueries, ObjectBoundsAndRootMembersAreReturned) {
  ShaderFolder folder;
  folder.compile("q",
                 "#include <shader.h>\n"
                 "DLLEXPORT miBoolean asks(miColor *r, miState *state, void *p) {"
                 "  miVector lo, hi; int n = 0, i, objects = 0; miTag root = 0, kid;"
                 "  r->r = r->g = r->b = 0; r->a = 1;"
                 "  if (!mi_query(miQ_PRI_BBOX_MIN, state, 0, &lo) ||"
                 "      !mi_query(miQ_PRI_BBOX_MAX, state, 0, &hi)) return miTRUE;"
                 "  r->r = hi.x - lo.x; r->g = hi.y - lo.y + hi.z;"
                 "  mi_query(miQ_SCENE_ROOT_GROUP, state, 0, &root);"
                 "  mi_query(miQ_GROUP_NKIDS, state, root, &n);"
                 "  for (i = 0; i < n; i++) { miTag item = 0;"
                 "    if (mi_query(miQ_GROUP_KID, state, root, &kid, i) &&"
                 "        mi_query(miQ_INST_ITEM, state, kid, &item) &&"
                 "        mi_db_type(item) == miSCENE_OBJECT) objects++; }"
                 "  r->b = 10 * n + objects; return miTRUE; }");
  UserScene scene(folder,
                  "link \"q.so\" declare shader color \"asks\" ( ) apply material end declare "
                  "material \"m\" \"asks\" ( ) end material object \"o\" visible group -1 -2 1 1 "
                  "-2 1 1 2 1 -1 2 1 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object instance "
                  "\"o_i\" \"o\" material \"m\" transform .5 0 0 0 0 .5 0 0 0 0 .5 0 0 0 1 1 end "
                  "instance ",
                  "\"o_i\"");
  // 2 by 4 in object space, for any instance transform; camera and object.
  expect_near(scene.pixel(4, 4, 1), Rgb(2, 4 + 1, 21), 1e-4f);
}

}  // namespace user_data_test
}  // namespace oriel
