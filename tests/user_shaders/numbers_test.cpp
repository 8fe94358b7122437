// SPDX-License-Identifier: Apache-2.0
// Shader results that are NaN or infinite.
#include "user_scene.h"

namespace oriel {
namespace numbers_test {

using testing::ShaderFolder;
using testing::UserScene;

const std::string kHead = "#include <shader.h>\n";

TEST(UserNumbers, ShaderReturningNanIsReportedOnce) {
  const ShaderFolder folder;
  folder.compile("n", kHead +
                          "struct outer { miColor c; };"
                          "DLLEXPORT miBoolean broken(miColor *r, miState *state, void *p) {"
                          "  volatile float zero = 0; r->r = zero / zero; r->g = r->b = r->a = 1;"
                          "  return miTRUE; }"
                          "DLLEXPORT miBoolean outer(miColor *r, miState *state, struct outer *p)"
                          "{ *r = *mi_eval_color(&p->c); return miTRUE; }");
  UserScene scene(folder,
                  "link \"n.so\" declare shader color \"broken\" ( ) apply texture end declare "
                  "declare shader color \"outer\" ( color \"c\" ) apply material end declare "
                  "shader \"t\" \"broken\" ( ) material \"m\" \"outer\" ( \"c\" = \"t\" ) end "
                  "material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  scene.pixel(4, 4, 16);
  const std::string said = scene.messages();
  EXPECT_NE(said.find("shader \"broken\" of n.so returned"), std::string::npos) << said;
  EXPECT_EQ(said.find("\"outer\""), std::string::npos) << said;
  EXPECT_EQ(said.find("OR-SDK-007"), said.rfind("OR-SDK-007")) << said;
}

}  // namespace numbers_test
}  // namespace oriel
