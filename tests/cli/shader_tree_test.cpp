// SPDX-License-Identifier: Apache-2.0
// oriel shader-build on folders of old sources: flags, helpers, undefined symbols, hints.
#include <dlfcn.h>

#include "support/program.h"

namespace oriel {
namespace shader_tree_test {

namespace fs = std::filesystem;

class ShaderTreeProgram : public ProgramTest {
 protected:
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(file(name)).parent_path());
    write(name, text);
  }
  RunResult build(const std::vector<std::string>& words) const {
    std::vector<std::string> all = {"shader-build"};
    all.insert(all.end(), words.begin(), words.end());
    return run(all);
  }
  /// What `float NAME(float)` of a library answers.
  float call(const std::string& library, const std::string& name, float x) const {
    void* const handle = dlopen(file(library).c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) return ADD_FAILURE() << dlerror(), 0;
    const auto function = reinterpret_cast<float (*)(float)>(dlsym(handle, name.c_str()));
    const float value = function ? function(x) : -1;
    dlclose(handle);
    return value;
  }
  static bool says(const RunResult& r, const std::string& text) {
    return r.err.find(text) != std::string::npos;
  }
  /// A tree with a helper library of two files, whose headers are in a third folder.
  void put_tree() const {
    put("tree/common/util.h", "float twice(float x);\nfloat half_of(float x);\n");
    put("tree/common/twice.c",
        "#include <shader.h>\n#include <tree_colours.h>\n#include \"util.h\"\n"
        "float twice(float x) { return x * FACTOR * KC; }\n");
    put("tree/common/half.c", "#include \"util.h\"\nfloat half_of(float x) { return x / 2; }\n");
    put("tree/inc/tree_colours.h", "#define KC 1\n");
    // CRLF, Latin-1, a backslash and another case in the path, K&R parameters, a macro of two
    // lines.
    put("tree/shaders/old.c",
        "#include \"shader.h\"\r\n#include \"..\\Common\\Util.h\"\r\n/* caf\xe9 */\r\n"
        "#define ADD(a, b) \\\r\n  ((a) + (b))\r\n"
        "DLLEXPORT miBoolean old(result, state, paras)\r\n"
        "miColor *result; miState *state; void *paras;\r\n"
        "{ result->r = ADD(twice(1.f), half_of(1.f)); return miTRUE; }\r\n"
        "float old_sum(float x) { return ADD(twice(x), half_of(x)); }\r\n");
    put("tree/shaders/deep/sums.cpp",
        "#include \"mi_shader_if.h\"\n#include \"geoshader.h\"\n#include \"mayaapi.h\"\n"
        "#include \"shader.h\"\nextern \"C\" {\n#include \"util.h\"\n}\n"
        "template <class T, int N> struct Sum {\n"
        "  static T of(const T* v) { return v[N - 1] + Sum<T, N - 1>::of(v); }\n};\n"
        "template <class T> struct Sum<T, 0> { static T of(const T*) { return T(); } };\n"
        "extern \"C\" float sums(float x) {\n"
        "  int cut[] = {3.5}; float v[3] = {x, 2 * x, twice(x)};\n"
        "  return Sum<float, 3>::of(v) + cut[0];\n}\n");
  }
};

// acceptance: I4
TEST_F(ShaderTreeProgram, BuildsATreeWithAHelperLibraryIntoOneOrEach) {
  put_tree();
  const std::vector<std::string> words = {"tree", "-r",       "--helper",   "tree/common",
                                          "-I",   "tree/inc", "-DFACTOR=2", "-j2"};
  RunResult r = build(words);
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "tree.so: 2 sources\n");
  EXPECT_FLOAT_EQ(call("tree.so", "old_sum", 3), 7.5f);
  EXPECT_FLOAT_EQ(call("tree.so", "sums", 1), 8);

  std::vector<std::string> each = words;
  each.insert(each.end(), {"--each", "-o", "out", "-std=c89", "-std=c++98"});
  r = build(each);
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "out/old.so: 1 source\nout/sums.so: 1 source\n");
  EXPECT_FLOAT_EQ(call("out/old.so", "old_sum", 3), 7.5f);
  EXPECT_FLOAT_EQ(call("out/sums.so", "sums", 1), 8);
  // A library contains only the helpers it needs.
  EXPECT_FLOAT_EQ(call("out/sums.so", "half_of", 1), -1);
}

TEST_F(ShaderTreeProgram, AnArchiveIsLinkedAsAHelper) {
  put("half.c", "float half_of(float x) { return x / 2; }\n");
  put("a.c", "float half_of(float); float quarter(float x) { return half_of(half_of(x)); }\n");
  const std::string in = "cd '" + file(".") + "' && ";
  ASSERT_EQ(std::system((in + "cc -fPIC -c half.c && ar rcs libhalf.a half.o").c_str()), 0);
  const RunResult r = build({"a.c", "--helper", "libhalf.a"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_FLOAT_EQ(call("a.so", "quarter", 8), 2);
}

TEST_F(ShaderTreeProgram, HintsNameTheOptionThatHelps) {
  put_tree();
  RunResult r = build({"tree"});
  EXPECT_TRUE(says(r, "those in its folders are built with -r")) << r.err;
  r = build({"tree", "-r"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_TRUE(says(r, "hint: tree_colours.h is in tree/inc: add -I tree/inc")) << r.err;
  r = build({"tree", "-r", "-I", "tree/inc"});
  EXPECT_TRUE(says(r, "-D FACTOR=VALUE")) << r.err;
  put("b.c", "#include <nowhere/at_all.h>\n");
  r = build({"b.c"});
  EXPECT_TRUE(
      says(r, "hint: nowhere/at_all.h was not found: name the folder that holds it with -I"))
      << r.err;
  put("c.cpp", "#include <shader.h>\nint c() { return mi_made_up(0); }\n");
  r = build({"c.cpp"});
  EXPECT_TRUE(says(r, "hint: mi_made_up is not offered: see docs/c-interface-functions.md"))
      << r.err;
  put("d.c", "#ifndef MODE\n#error MODE is needed\n#endif\nint d;\n");
  r = build({"d.c"});
  EXPECT_TRUE(says(r, "give it with -D NAME")) << r.err;
  EXPECT_EQ(build({"d.c", "-D", "MODE"}).exit_code, 0);
  put("e.cpp", "#define F \"f\"\nconst char* e() { return \"%\"F; }\n");
  r = build({"e.cpp"});
  EXPECT_TRUE(says(r, "add --std=gnu++98")) << r.err;
  EXPECT_EQ(build({"e.cpp", "--std=gnu++98"}).exit_code, 0);
}

TEST_F(ShaderTreeProgram, UndefinedSymbolsAreNamedWithTheirSources) {
  put("s/a.c",
      "#include <shader.h>\nint mi_made_up(miState *);\n"
      "int a(miState *state) { return mi_made_up(state) + (int)*mi_eval_scalar(0); }\n");
  put("s/b.cpp", "float lost(float); extern \"C\" float b(float x) { return lost(x); }\n");
  put("s/c.cpp", "float lost(float); extern \"C\" float c(float x) { return lost(x); }\n");
  write("s.so", "an older one");
  RunResult r = build({"s"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_TRUE(says(r, "s/a.c: mi_made_up is not offered: see docs/c-interface-functions.md"))
      << r.err;
  EXPECT_TRUE(says(r,
                   "s/b.cpp, s/c.cpp: lost(float) is not defined: give the source, folder or "
                   "archive that defines it with --helper"))
      << r.err;
  EXPECT_FALSE(says(r, "mi_eval_scalar")) << r.err;
  EXPECT_TRUE(says(r, "2 undefined symbols; nothing was written")) << r.err;
  EXPECT_EQ(text_of(file("s.so")), "an older one");

  // What a library of the link defines is not undefined; sources can be left out.
  put("lost.cpp", "float lost(float x) { return x; }\n");
  const std::string in = "cd '" + file(".") + "' && ";
  ASSERT_EQ(std::system((in + "c++ -shared -fPIC -o liblost.so lost.cpp").c_str()), 0);
  put("s/oriel-shaders.txt", "skip a.c\n");
  r = build({"s", "--flag=" + file("liblost.so")});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_FLOAT_EQ(call("s.so", "b", 3), 3);
}

// acceptance: I4
TEST_F(ShaderTreeProgram, FunctionsWithoutReturnReturnToTheirCaller) {
  const std::string text =
      "struct Big { float x[9]; };\n"
      "static int seen;\n"
      "static int empty(int x) { if (x > 3) return 1; seen += 1; }\n"
      "static int chosen(int x) { switch (x) { case 1: return 1; case 2: return 2; } }\n"
      "static struct Big big(int x) { struct Big b; if (x > 3) return b; seen += 10; }\n"
      "static float real(int x) { if (x > 3) return 1; seen += 100; }\n";
  const std::string body =
      "float without(float x) {\n"
      "  int n = (int)x; empty(n); chosen(n); big(n); real(n); return seen; }\n";
  put("a.c", text + body);
  put("b.cpp", text + "extern \"C\" " + body);
  put("c.cpp", text + "extern \"C\" " + body);
  put("c-flags.txt", "flags c.cpp -O3\n");
  for (const std::string source : {"a.c", "b.cpp", "c.cpp"}) {
    const RunResult r = build({source, "-o", source + ".so", "--manifest", "c-flags.txt"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(says(r, "hint: the result of a function that ends without 'return'")) << r.err;
    EXPECT_EXIT(_exit(call(source + ".so", "without", 0) == 111 ? 0 : 1),
                ::testing::ExitedWithCode(0), "")
        << source;
  }
}

TEST_F(ShaderTreeProgram, FunctionsWithoutReturnReturnInClangAsWell) {
  if (std::system("clang++ --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no clang++ here";
  put("a.cpp",
      "static int seen;\n"
      "static int empty(int x) { if (x > 3) return 1; seen += 1; }\n"
      "static float real(int x) { if (x > 3) return 1; seen += 100; }\n"
      "extern \"C\" float without(float x) { empty((int)x); real((int)x); return seen; }\n");
  const RunResult r = build({"a.cpp", "--cxx", "clang++"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EXIT(_exit(call("a.so", "without", 0) == 101 ? 0 : 1), ::testing::ExitedWithCode(0), "");
}

TEST_F(ShaderTreeProgram, AHeaderBesideTheSourceThatHidesOnesOfOrielIsNamed) {
  put("s/a.c", "#include \"shader.h\"\nint a = OTHER;\n");
  put("s/shader.h", "#define OTHER 1\n");
  const RunResult r = build({"s"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(says(r, "s/shader.h may be taken for Oriel's header of that name")) << r.err;
}

TEST_F(ShaderTreeProgram, IntegersWrapAndNullIsTested) {
  put("a.cpp",
      "extern \"C\" float wraps(float x) { int n = 2147483647 - 3 + (int)x; return n + 1 < n; }\n"
      "struct S { int v; bool none() { return this == 0; } };\n"
      "extern \"C\" float none(float x) { S s, *p = x > 0 ? &s : 0; return p->none(); }\n"
      "extern \"C\" float puns(float x) { *(int *)&x += 1 << 23; return x; }\n");
  const RunResult r = build({"a.cpp"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_FLOAT_EQ(call("a.so", "wraps", 3), 1);
  EXPECT_FLOAT_EQ(call("a.so", "none", 0), 1);
  EXPECT_FLOAT_EQ(call("a.so", "puns", 3), 6);
}

class ShaderManifestProgram : public ShaderTreeProgram {};

TEST_F(ShaderManifestProgram, GivesSingleSourcesTheirFlags) {
  put("m/inc/own.h", "#define OWN 7\n");
  put("m/a.c", "#include <own.h>\nfloat a(float x) { return x + A + OWN; }\n");
  put("m/sub/b.c", "float b(float x) { return x + B; }\n");
  put("m/sub/broken.c", "this is no C\n");
  put("m/lib/c.c", "float shared(float x) { return x + 1; }\n");
  put("m/sub/d.c", "float shared(float); float d(float x) { return shared(x); }\n");
  put("m/oriel-shaders.txt",
      "# what this folder needs\n"
      "flags a.c -DA=1\nflags sub/* \"-DB=20 + 2\"   # quoted\n"
      "skip broken.c\r\ninclude inc\nhelper lib\n");
  const RunResult r = build({"m", "-r"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "m.so: 3 sources\n");
  EXPECT_FLOAT_EQ(call("m.so", "a", 1), 9);
  EXPECT_FLOAT_EQ(call("m.so", "b", 1), 23);
  EXPECT_FLOAT_EQ(call("m.so", "d", 1), 2);
}

TEST_F(ShaderManifestProgram, ErrorsHaveFileAndLine) {
  put("m/a.c", "int a;\n");
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"\nflag a.c -O1\n", "oriel-shaders.txt:2: unknown statement 'flag'"},
           {"flags a.c\n", "oriel-shaders.txt:1: 'flags' requires a pattern and words"},
           {"flags a.c '-O1\n", "oriel-shaders.txt:1: a quote is not closed"},
           {"include nowhere\n", "there is no '"}}) {
    write("m/oriel-shaders.txt", text);
    const RunResult r = build({"m"});
    EXPECT_EQ(r.exit_code, 1);
    EXPECT_TRUE(says(r, message)) << r.err;
  }
  EXPECT_EQ(build({"m", "-sx"}).exit_code, 2);
}

}  // namespace shader_tree_test
}  // namespace oriel
