// SPDX-License-Identifier: Apache-2.0
// Per-thread data of user shaders, and independence of images from the number of threads.
#include "base/parallel.h"
#include "user_picture.h"

namespace oriel {
namespace threads_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

const std::string kHead = "#include <shader.h>\n";

std::string shown(const std::string& library, const std::string& shader) {
  return "link \"" + library + "\" declare shader color \"" + shader +
         "\" ( ) apply material end declare material \"m\" \"" + shader + "\" ( ) end material ";
}

/// Keeps a table for each thread, seeds it by the primitive and reads it after tracing.
const std::string kThreads =
    kHead +
    "DLLEXPORT miBoolean tables(miColor *r, miState *state, void *p) {"
    "  unsigned *table = 0, seed = (unsigned)(size_t)state->pri; int i;"
    "  miVector up = {0, 0, 1};"
    "  if (!mi_query(miQ_FUNC_TLS_GET, state, 0, &table) || !table) {"
    "    table = mi_mem_allocate(64 * sizeof *table);"
    "    mi_query(miQ_FUNC_TLS_SET, state, 0, &table); }"
    "  for (i = 0; i < 64; ++i) table[i] = seed = seed * 1664525u + 1013904223u;"
    "  mi_trace_reflection(r, state, &up);"
    "  for (i = 1; i < 64; ++i) if (table[i] != table[i - 1] * 1664525u + 1013904223u)"
    "    return miFALSE;"
    "  r->r = table[63] / 4294967296.; r->a = 1;"
    "  return miTRUE; }";

TEST(UserThreads, OneAndTwoThreadsGiveTheSamePicture) {
  const ShaderFolder folder;
  folder.compile("t", kThreads);
  std::vector<Rgba> pictures[3];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    UserScene scene(folder, shown("t.so", "tables") + UserScene::square("m"), "\"square_i\"", "",
                    "resolution 64 64 environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" .1 "
                    ".2 .3 1 )");
    const UserPicture picture(scene, 8);
    const Film& film = picture.session->film();
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) pictures[threads].push_back(film.pixel(x, y).beauty);
  }
  EXPECT_EQ(pictures[1], pictures[2]);
  bool varies = false;
  for (const Rgba& c : pictures[1]) varies |= c.r != pictures[1][0].r;
  EXPECT_TRUE(varies);
}

/// Counts in tables indexed by state->thread, which no two threads share at a time.
TEST(UserThreads, ThreadsHaveNumbersOfTheirOwn) {
  const ShaderFolder folder;
  folder.compile("n", kHead +
                          "static __thread int mine = -1; static volatile long owner[64];"
                          "DLLEXPORT miBoolean number(miColor *r, miState *state, void *p) {"
                          "  long before; r->r = r->g = r->b = 0; r->a = 1;"
                          "  if (state->thread < 0 || state->thread >= 64) return miTRUE;"
                          "  if (mine < 0) mine = state->thread;"
                          "  before = __sync_val_compare_and_swap(&owner[mine], 0L, (long)&mine);"
                          "  r->r = mine == state->thread;"
                          "  r->g = before == 0 || before == (long)&mine;"
                          "  r->b = 1; return miTRUE; }");
  const ThreadLimit limit(2);
  UserScene scene(folder, shown("n.so", "number") + UserScene::square("m"), "\"square_i\"", "",
                  "resolution 64 64");
  const UserPicture picture(scene, 64);
  expect_near(picture.mean(), Rgb(1), 0);
}

/// Shows 1 where a thread has a pointer before it stored one.
TEST(UserThreads, PointersOfAnEarlierSceneAreForgotten) {
  const ShaderFolder folder;
  folder.compile("p", kHead +
                          "DLLEXPORT miBoolean stale(miColor *r, miState *state, void *p) {"
                          "  static int some; void *mine = 0, *kept = &some;"
                          "  r->r = mi_query(miQ_FUNC_TLS_GET, state, 0, &mine) && mine;"
                          "  r->g = r->b = 0; r->a = 1;"
                          "  mi_query(miQ_FUNC_TLS_SET, state, 0, &kept); return miTRUE; }");
  // Calls of one scene lie where those of an earlier one lay.
  for (int i = 0; i < 32; ++i) {
    UserScene scene(folder, shown("p.so", "stale") + UserScene::square("m"), "\"square_i\"");
    scene.indirect = false;
    ASSERT_EQ(scene.pixel(4, 4, 1).x, 0) << "scene " << i;
  }
}

}  // namespace threads_test
}  // namespace oriel
