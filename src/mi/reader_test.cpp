// SPDX-License-Identifier: Apache-2.0
// Statements of each element, and errors in them.
#include "mi/reader.h"

#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace reader_test {

using scene::kNone;

#define EXPECT_SILENT(read) EXPECT_TRUE((read).diagnostics.all().empty()) << (read).messages()

// acceptance: H1
TEST(Options, AllStatementsAreRead) {
  for (const char* statement : {"samples 2",
                                "samples -1 2 0 1",
                                "samples collect 4",
                                "contrast .1 .1 .1 .1",
                                "time contrast .2 .2 .2",
                                "filter clip mitchell 4 4",
                                "filter clip lanczos",
                                "filter box",
                                "jitter .5",
                                "samplelock on",
                                "shading samples 1.",
                                "task size 32",
                                "trace depth 2 2 4",
                                "scanline rapid",
                                "shadow segments",
                                "shadow sort on",
                                "shadowmap detail",
                                "shadowmap rebuild merge",
                                "shadowmap bias .1",
                                "face both",
                                "acceleration large bsp",
                                "bsp size 10",
                                "grid resolution 1 2 3",
                                "displace presample on",
                                "max displace .1",
                                "motion steps 3",
                                "shutter 0 .5",
                                "shutter delay .1",
                                "photon autovolume off",
                                "lightmap only",
                                "field even",
                                "object space",
                                "inheritance \"f\"",
                                "caustic 3",
                                "caustic accuracy 500 3.0",
                                "caustic filter cone 1.1",
                                "globillum scale 1 1 1 1",
                                "photonvol accuracy 30",
                                "photon trace depth 5 5 5",
                                "photonmap file \"f\"",
                                "photonmap file off",
                                "photonmap only",
                                "finalgather fastlookup",
                                "finalgather accuracy view 100 5 1",
                                "finalgather trace depth 1 1 0 2",
                                "finalgather presample density 1.",
                                "finalgather falloff 0 1",
                                "finalgather secondary scale 1 1 1",
                                "finalgather file [ \"a\", \"b\" ]",
                                "finalgather rebuild freeze",
                                "frame buffer 1 \"+rgba\"",
                                "gamma 2.2",
                                "colorclip raw",
                                "luminance weight ntsc",
                                "luminance weight .3 .6 .1",
                                "diagnostic photon density 1.",
                                "approximate fine view length .1 all",
                                "\"finalgather mode\" \"automatic\""}) {
    const Snippet read(fmt::format("options \"o\" {} trace on end options", statement));
    EXPECT_SILENT(read) << statement;
    EXPECT_EQ(read.get<scene::Options>("o").statements.size(), 2u) << statement;
  }
}

TEST(Options, UnknownStatementAffectsOnlyItself) {
  const Snippet read("options \"o\"\n samples 0 2\n contrats .1 .1 .1\n trace on\nend options");
  EXPECT_EQ(read.message(code::kUnknownStatement).where.line, 3u);
  EXPECT_EQ(read.message(code::kUnknownStatement).hint, "did you mean contrast?");
  EXPECT_EQ(read.get<scene::Options>("o").statements.size(), 2u);
}

// acceptance: H1
TEST(Camera, ListsAppendAndBareKeywordsClear) {
  const Snippet read(
      "camera \"c\" lens \"s\" ( ) lens \"t\" ( ) environment = \"e\" environment "
      "framebuffer \"f\" datatype \"rgba\" primary on aspect 1.5 clip .1 100 "
      "focal 50 aperture 36 end camera shader \"e\" \"s\" ( )\n"
      "incremental camera \"c\" lens focal 35 end camera");
  EXPECT_SILENT(read);
  const auto& c = read.get<scene::Camera>("c");
  EXPECT_TRUE(c.lens.empty() && c.environment.empty());
  EXPECT_EQ(*c.focal, 35);
  EXPECT_EQ(*c.aperture, 36);
  ASSERT_EQ(c.frame_buffers.size(), 1u);
  EXPECT_EQ(c.frame_buffers[0].name, "f");
}

// acceptance: H1
TEST(FrameBuffer, ItemsEndAtTheNextCameraStatement) {
  const Snippet read(
      "camera \"c\" framebuffer \"diffuse_raw\" datatype \"rgba_fp\" filename \"d.exr\" "
      "filetype \"exr\" filtering off primary user on quality 90 compression \"zip\" tiled "
      "premultiplied off framebuffer \"z\" datatype \"z\" dpi 72 72 focal 50 "
      "pass \"p\" read \"a\" aperture 36 end camera");
  EXPECT_SILENT(read);
  const auto& c = read.get<scene::Camera>("c");
  ASSERT_EQ(c.frame_buffers.size(), 2u);
  const scene::FrameBuffer& b = c.frame_buffers[0];
  EXPECT_EQ(b.datatype, "rgba_fp");
  EXPECT_EQ(b.filename, "d.exr");
  EXPECT_EQ(b.filetype, "exr");
  EXPECT_EQ(b.filtering, false);
  EXPECT_EQ(b.primary, true);
  EXPECT_EQ(b.user, true);
  ASSERT_EQ(b.modifiers.size(), 4u);
  EXPECT_EQ(b.modifiers[0].values[0].numbers, std::vector<double>{90});
  EXPECT_EQ(b.modifiers[1].values[0].text, "zip");
  EXPECT_TRUE(b.modifiers[2].values.empty());
  EXPECT_FALSE(c.frame_buffers[1].filtering.has_value());
  EXPECT_EQ(*c.focal, 50);
  EXPECT_EQ(*c.aperture, 36);
  EXPECT_EQ(c.uninterpreted.size(), 1u);
}

TEST(FrameBuffer, UnknownItemsAreStoredWithANoteAndStrayValuesSkipped) {
  const Snippet read(
      "camera \"c\" framebuffer \"f\" filterin on deep [ 1 ( 2 ) ] primary on \"stray\" 3 "
      "user 0 focal 50 end camera");
  EXPECT_EQ(read.count(code::kIgnored), 2u) << read.messages();
  EXPECT_EQ(read.diagnostics.all().size(), 2u) << read.messages();
  EXPECT_EQ(read.diagnostics.all()[0].hint, "did you mean filtering?");
  const auto& c = read.get<scene::Camera>("c");
  ASSERT_EQ(c.frame_buffers.size(), 1u);
  ASSERT_EQ(c.frame_buffers[0].uninterpreted.size(), 1u);
  EXPECT_EQ(c.frame_buffers[0].uninterpreted[0].text, "on deep [ 1 ( 2 ) ]");
  EXPECT_EQ(c.frame_buffers[0].primary, true);
  EXPECT_EQ(c.frame_buffers[0].user, false);
  EXPECT_EQ(*c.focal, 50);
}

TEST(FrameBuffer, AnIncrementalCameraReplacesTheOneOfThatName) {
  const Snippet read(
      "camera \"c\" framebuffer \"a\" datatype \"rgba\" framebuffer \"b\" end camera\n"
      "incremental camera \"c\" framebuffer \"a\" filename \"x.exr\" end camera");
  EXPECT_SILENT(read);
  const auto& c = read.get<scene::Camera>("c");
  ASSERT_EQ(c.frame_buffers.size(), 2u);
  EXPECT_EQ(c.frame_buffers[0].filename, "x.exr");
  EXPECT_EQ(c.frame_buffers[0].datatype, "");
}

// acceptance: H1
TEST(Light, AreasSamplesAndPhotonsAreRead) {
  const Snippet read(
      "light \"l\" \"s\" ( ) emitter = \"e\" energy 1 2 3 exponent 2 caustic photons "
      "100 0 rectangle 2 0 0 0 2 0 4 4 3 2 2 visible shadowmap detail samples 4 "
      "spread .5 end light shader \"e\" \"s\" ( )\n"
      "light \"i\" object \"li\" 16 1 1 1 1 visible on origin 0 0 0 end light\n"
      "incremental light \"l\" rectangle end light");
  EXPECT_SILENT(read);
  const auto& i = read.get<scene::Light>("i");
  EXPECT_EQ(i.area->values[0].text, "li");
  EXPECT_EQ(i.area->values[1].numbers.size(), 5u);
  EXPECT_FALSE(read.get<scene::Light>("l").area);
  EXPECT_EQ(read.get<scene::Light>("l").other.size(), 5u);
}

// acceptance: H1
TEST(Texture, EveryKindOfDataIsRead) {
  const Snippet read(
      "color texture \"a\" \"a.tif\"\nlocal filter 2 scalar texture \"b\" \"b.exr\"\n"
      "writable color texture \"c\" \"c.lm\" [64 32]\n"
      "color texture \"d\" [2 1] 'ff00' '7f'\nvector texture \"e\" \"s\" ( ) = \"f\"\n"
      "shader \"f\" \"s\" ( )");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::Texture>("a").file, "a.tif");
  EXPECT_EQ(*read.get<scene::Texture>("b").filter, 2);
  EXPECT_TRUE(read.get<scene::Texture>("b").local);
  EXPECT_EQ(read.get<scene::Texture>("c").size, (std::vector<int>{64, 32}));
  EXPECT_EQ(read.get<scene::Texture>("d").pixels, (std::vector<std::uint8_t>{255, 0, 127}));
  EXPECT_EQ(read.get<scene::Texture>("e").procedure.size(), 2u);
}

// acceptance: H1
TEST(Object, HolesStripsAndFansAreRead) {
  const Snippet read(
      "object \"o\" group 0 0 0 1 0 0 1 1 0 v 0 v 1 v 2 v 0 v 1 v 2 "
      "p 0 1 2 hole 3 4 5 strip 0 1 2 3 fan 0 1 2 3 end group end object");
  EXPECT_SILENT(read);
  const auto& p = read.get<scene::Object>("o").groups[0].polygons;
  EXPECT_EQ(p.first, (std::vector<std::uint32_t>{0, 6, 9, 12, 15, 18}));
  EXPECT_EQ(p.holes, (std::vector<std::uint32_t>{3}));
  EXPECT_EQ((std::vector<std::uint32_t>(p.indices.begin() + 6, p.indices.end())),
            (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 0, 1, 2, 0, 2, 3}));
}

TEST(Object, IndicesOutsideTheListsAreReportedAndLeaveValidGeometry) {
  const Snippet read(
      "object \"o\" group 0 0 0 1 0 0\nv 0 n 9\nv 1\nv 7\nv 0\np 0 1 3\n"
      "p 0 1 2\np 0 1 9\np 0 -1 1\np 0 1\nend group end object");
  EXPECT_EQ(read.count(code::kBadIndex), 2u);
  EXPECT_EQ(read.count(code::kBadPolygon), 4u) << read.messages();
  EXPECT_EQ(read.message(code::kBadPolygon).where.line, 7u);
  const auto& g = read.get<scene::Object>("o").groups[0];
  EXPECT_EQ(g.polygons.indices, (std::vector<std::uint32_t>{0, 1, 3}));
  for (const std::uint32_t i : g.vertices.point) EXPECT_LT(i, g.vectors.size());
  for (const std::uint32_t i : g.vertices.normal) EXPECT_EQ(i, kNone);
}

TEST(Trilist, BinaryBlocksMayContainTheClosingQuote) {
  std::string floats, ints;
  for (const char* word : {"\x3f\x80\0\0", "````", "\0\0\0\0"})
    for (int i = 0; i < 3; ++i) floats.append(word, 4);
  for (const char byte : {0, 1, 2}) ints += std::string(3, '\0') + byte;
  const Snippet read("object \"o\" tagged trilist vertex 3 p triangle 1 scalar `" + floats +
                     "` integer `" + ints + "` integer `" + std::string("\0\0\0\4", 4) +
                     "` end trilist end object");
  EXPECT_SILENT(read);
  const auto& g = read.get<scene::Object>("o").groups.at(0);
  EXPECT_EQ(g.vectors[0], Vec3(1, 1, 1));
  EXPECT_EQ(g.polygons.indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(g.polygons.material, (std::vector<std::uint32_t>{4}));
}

TEST(Trilist, WrongCountsAreReportedAndNotTrusted) {
  const Snippet read(
      "object \"o\" trilist vertex 4000000000 p triangle 3000000000 [ 0 0 0 1 0 0 "
      "0 1 0 ] [ 0 1 2 ] end trilist end object options \"x\" end options");
  EXPECT_EQ(read.count(code::kBadCount), 2u) << read.messages();
  EXPECT_EQ(read.get<scene::Object>("o").groups.at(0).polygons.size(), 1u);
  EXPECT_NE(read.scene.find("x"), nullptr);
}

// acceptance: H1
TEST(Instance, TransformsMaterialsAndMotionAreRead) {
  const Snippet read(
      "instance \"i\" \"o\" hide off visible on shadow 3\n"
      "transform 1 0 0 0 0 1 0 0 0 0 1 0 -1 -2 -3 1\n"
      "motion transform 1 0 0 0 0 1 0 0 0 0 1 0 4 5 6 1 material \"m\" override "
      "( \"k\" 1 ) end instance\ninstance \"g\" geometry \"s\" ( ) end instance\n"
      "incremental instance \"i\" transform motion off end instance");
  EXPECT_SILENT(read);
  const auto& i = read.get<scene::Instance>("i");
  EXPECT_EQ(i.element, "o");
  EXPECT_FALSE(i.transform || i.motion_transform);
  EXPECT_EQ(i.materials[0], "m");
  EXPECT_EQ(i.flags.size(), 5u);
  EXPECT_EQ(read.get<scene::Instance>("g").geometry[0].type, "s");
}

TEST(Instance, ASingularTransformBecomesTheIdentity) {
  const Snippet read("instance \"i\" \"o\" transform 1 0 0 0 0 0 0 0 0 0 1 0 0 0 0 1 end instance");
  EXPECT_EQ(read.count(code::kSingular), 1u);
  EXPECT_EQ(*read.get<scene::Instance>("i").transform, Mat4());
}

// acceptance: H1
TEST(Declare, TypesNestAndOldFormsEndAtTheParenthesis) {
  const Snippet read(
      "declare color \"old\" ( color \"c\" default 1 1 1, array light \"lights\" )\n"
      "declare shader color \"new\" ( array struct \"sets\" { string \"n\" default \"x\", scalar "
      "\"v\" },"
      " color texture \"t\", shader \"sh\", data \"d\", transform \"m\" ) version 2 apply material "
      "trace on derivative 1 2 volume level 1 hardware ( cg \"x\" ) end declare\n"
      "declare \"plain\" ( )\ndeclare data \"dd\" ( integer \"i\" ) version 1 end declare");
  EXPECT_SILENT(read);
  const auto* old = read.scene.find_declaration("old");
  EXPECT_TRUE(old->old_form);
  EXPECT_EQ(old->parameters[1].name, "lights");
  EXPECT_EQ(old->parameters[1].members[0].type, scene::ParamType::Light);
  const auto* d = read.scene.find_declaration("new");
  EXPECT_EQ(d->parameters[0].members[0].members.size(), 2u);
  EXPECT_EQ(d->parameters[1].type, scene::ParamType::ColorTexture);
  EXPECT_EQ(d->requirements.size(), 5u);
  EXPECT_EQ(read.scene.data_declarations.size(), 1u);
}

// acceptance: H1
TEST(Phenomenon, ElementsInsideAreLocal) {
  const Snippet read(
      "declare phenomenon color \"p\" ( color \"c\" ) shader \"in\" \"s\" ( \"a\" = "
      "interface \"c\", \"b\" = shader \"deep\" \"t\" ( ) ) material \"m\" = \"in\" end "
      "material root material \"m\" lens priority 2 volume \"s\" ( ) version 1 "
      "apply material end declare shader \"use\" \"p\" ( \"c\" 1 1 1 )");
  EXPECT_SILENT(read);
  const auto* p = read.scene.find_phenomenon("p");
  ASSERT_NE(p, nullptr);
  EXPECT_EQ(p->shaders.size(), 2u);
  EXPECT_EQ(p->roots[0].name, "m");
  EXPECT_EQ(p->requirements[0].keyword, "lens priority");
  EXPECT_EQ(read.scene.find("in"), nullptr);
}

// acceptance: H1
TEST(Commands, ConditionsFollowVariables) {
  const Snippet read(
      "$ifndef \"x\"\nset \"x\"\n$ifdef \"x\"\nshader \"a\" \"s\" ( )\n$else\n\"junk\n\n$endif\n"
      "$endif\n$ifdef \"y\"\n$ifdef \"x\"\n$endif\nshader \"b\" \"s\" ( )\n$else\n"
      "shader \"c\" \"s\" ( )\n$endif\n$ifndef \"x\"\nshader \"d\" \"s\" ( )\n$endif");
  EXPECT_SILENT(read);
  EXPECT_NE(read.scene.find("a"), nullptr);
  EXPECT_EQ(read.scene.find("b"), nullptr);
  EXPECT_NE(read.scene.find("c"), nullptr);
  EXPECT_EQ(read.scene.find("d"), nullptr);
}

TEST(Commands, AnUnknownDirectiveIsSkippedWithTheNearestName) {
  const Snippet read("$ifdeff\nshader \"a\" \"s\" ( )");
  EXPECT_EQ(read.diagnostics.all().size(), 1u) << read.messages();
  EXPECT_EQ(read.message(code::kUnknownDirective).hint, "did you mean $ifdef?");
  EXPECT_NE(read.scene.find("a"), nullptr);
}

// acceptance: H1
TEST(Commands, NamespacesPrefixNames) {
  const Snippet read(
      "shader \"out\" \"s\" ( ) namespace \"n\" shader \"a\" \"s\" ( ) material \"m\" = "
      "\"a\" = \"::out\" end material end namespace material \"k\" = \"n::a\" end "
      "material");
  EXPECT_SILENT(read);
  const auto& m = read.get<scene::Material>("n::m");
  EXPECT_EQ(m.shaders[0].reference, "n::a");
  EXPECT_EQ(m.shaders[1].reference, "out");
}

// acceptance: H1
TEST(Commands, UnusedCommandsAreStored) {
  const Snippet read(
      "verbose on min version \"3.4\" link \"base.so\" echo \"x\" memory 5 "
      "gui \"g\" { control \"a\" \"b\" ( \"c\" ) } data \"d\" 2 '0001' touch \"d\" "
      "spectrum \"sp\" 400 1 end spectrum registry \"r\" value \"v\" end registry");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.scene.commands.size(), 6u);
  EXPECT_EQ(read.scene.elements().size(), 4u);
  EXPECT_EQ(read.get<scene::UserData>("d").bytes, (std::vector<std::uint8_t>{0, 1}));
}

// acceptance: H1
TEST(Commands, UserDataAreBytesAFileOrDeclaredParameters) {
  const Snippet read(
      "declare data \"pair\" ( integer \"a\", scalar \"b\" default 2 ) end declare "
      "data \"raw\" tag 7 4 [ '00ff' '1020' ] data \"kept\" \"far.bin\" "
      "data \"typed\" \"pair\" ( \"a\" 3 ) data \"none\" null");
  EXPECT_SILENT(read);
  const auto& raw = read.get<scene::UserData>("raw");
  EXPECT_EQ(raw.label, 7u);
  EXPECT_EQ(raw.size, 4);
  EXPECT_EQ(raw.bytes, (std::vector<std::uint8_t>{0, 255, 16, 32}));
  EXPECT_EQ(read.get<scene::UserData>("kept").file, "far.bin");
  const auto& typed = read.get<scene::UserData>("typed");
  EXPECT_EQ(typed.declaration, "pair");
  ASSERT_EQ(typed.arguments.size(), 1u);
  EXPECT_EQ(typed.arguments[0].value.numbers, std::vector<double>{3});
  EXPECT_TRUE(read.get<scene::UserData>("none").bytes.empty());
}

TEST(Commands, TouchChangesTheRevision) {
  const std::string gui = "gui \"g\" { control \"a\" \"b\" ( \"c\" ) } ";
  const Snippet once(gui), again(gui + "touch \"g\"");
  EXPECT_SILENT(again);
  EXPECT_NE(once.scene.revision("g"), again.scene.revision("g"));
  EXPECT_EQ(again.scene.revision("h"), 0u);
  const Snippet nothing("touch \"h\"");
  EXPECT_EQ(nothing.diagnostics.all().size(), 1u);
}

TEST(Commands, CodeAndSystemCommandsAreNotRun) {
  const Snippet read(
      "system \"touch /tmp/x\"\ncode \"a.c\"\nregistry \"r\" system \"rm\" end registry\n"
      "$code\nint f(); # not a comment: \"\n$end code\nshader \"a\" \"s\" ( )");
  EXPECT_EQ(read.count(code::kRefused), 4u) << read.messages();
  EXPECT_EQ(read.scene.commands.size(), 3u);
  EXPECT_NE(read.scene.find("a"), nullptr);
}

TEST(Commands, TrustedCodeIsNotReported) {
  ReadOptions options = Snippet::known_shaders();
  options.trusts_code = true;
  const Snippet read(
      "code \"a.c\"\ncode '2f2f' '0a'\n$code\nint f();\n$end code\n"
      "registry \"r\" { code \"b.c\" } end registry\nsystem \"rm\"\nshader \"a\" \"s\" ( )",
      options);
  EXPECT_EQ(read.count(code::kRefused), 1u) << read.messages();
  ASSERT_EQ(read.scene.commands.size(), 5u);
  EXPECT_EQ(read.scene.commands[1].values.size(), 2u);
  EXPECT_TRUE(read.scene.commands[1].values[0].bare);
  EXPECT_EQ(read.scene.commands[2].values[0].text, "\nint f();\n");
  EXPECT_EQ(read.scene.commands[2].where.line, 3u);
  EXPECT_EQ(read.scene.commands[3].values[0].text, "b.c");
}

TEST(Commands, RegistriesLinkEchoAndReadFiles) {
  ReadOptions options = Snippet::known_shaders();
  options.packages = {"base"};
  const Snippet read(
      "registry \"r\" { value \"v\" } { link \"x.so\" } { mi \"base.mi\" } { echo \"hi\" }\n"
      "  { one two } end registry\nshader \"a\" \"s\" ( )",
      options);
  EXPECT_SILENT(read);
  ASSERT_EQ(read.scene.commands.size(), 2u);
  EXPECT_EQ(read.scene.commands[0].keyword, "link");
  EXPECT_EQ(read.scene.commands[0].values[0].text, "x.so");
  EXPECT_EQ(read.scene.commands[1].keyword, "echo");
  EXPECT_EQ(read.scene.packages, std::vector<std::string>{"base.mi"});
  const std::string& text = read.get<scene::UninterpretedElement>("r").text;
  EXPECT_NE(text.find("value \"v\""), std::string::npos) << text;
  EXPECT_NE(text.find("one two"), std::string::npos) << text;
  EXPECT_EQ(text.find("link"), std::string::npos) << text;
  EXPECT_NE(read.scene.find("a"), nullptr);
}

TEST(Commands, TheFrameFormIsRejectedByName) {
  const Snippet read("frame 1 view samples 2 end view end frame\nshader \"a\" \"s\" ( )");
  EXPECT_EQ(read.count(code::kObsolete), 1u);
  EXPECT_NE(read.scene.find("a"), nullptr);
}

// acceptance: H1
TEST(Frames, RenderEndsAFrame) {
  Diagnostics d;
  Reader reader = Reader::from_text(
      "options \"o\" samples 1 end options camera \"c\" end camera instance \"ci\" \"c\" end "
      "instance "
      "instgroup \"r\" \"ci\" end instgroup render \"r\" \"ci\" \"o\" incremental options \"o\" "
      "samples 2 "
      "end options delete \"nobody\" render \"r\" \"ci\" \"o\" shader \"late\" \"s\" ( )",
      Snippet::known_shaders(), d);
  scene::Scene scene;
  ASSERT_TRUE(reader.next_frame(scene));
  EXPECT_EQ(scene.get<scene::Options>("o")->statements[0].values[0].numbers[0], 1);
  ASSERT_TRUE(reader.next_frame(scene));
  ASSERT_EQ(scene.get<scene::Options>("o")->statements.size(), 1u);
  EXPECT_EQ(scene.get<scene::Options>("o")->statements[0].values[0].numbers[0], 2);
  EXPECT_FALSE(reader.next_frame(scene));
  EXPECT_NE(scene.find("late"), nullptr);
  EXPECT_EQ(scene.renders.size(), 2u);
  EXPECT_TRUE(d.has(code::kNotThere));
}

TEST(Names, UnknownTypesAndElementsAreReportedOnceWithAHint) {
  const Snippet read(
      "shader \"wood\" \"mib_x\" ( ) shader \"a\" \"nobody\" ( \"p\" = \"wod\" )\n"
      "shader \"b\" \"nobody\" ( \"p\" = \"wod\" ) render \"r\" \"c\" \"o\"");
  EXPECT_EQ(read.count(code::kUnknownShader), 1u) << read.messages();
  EXPECT_EQ(read.message(code::kUnresolved).hint, "did you mean \"wood\"?");
  EXPECT_EQ(read.count(code::kUnresolved), 4u);
}

TEST(Errors, SyntaxErrorAffectsOneElement) {
  const Snippet read(
      "shader \"a\" \"s\" ( \"p\" ,, )\nmaterial \"m\" = end material\n"
      "instance \"i\" \"o\" transform 1 2 end instance\nobject \"o\" group 0 0 end group "
      "end object\nlight \"l\" origin end light\nbogus \"x\"\noptions \"ok\" end options");
  EXPECT_EQ(read.count(code::kSyntax), 6u) << read.messages();
  EXPECT_NE(read.get<scene::Options>("ok").name, "");
  EXPECT_EQ(read.message(code::kSyntax).where.line, 1u);
  EXPECT_EQ(read.message(code::kSyntax).where.column, 22u);
}

TEST(Errors, MissingEndStopsAtTheNextElement) {
  const Snippet read("camera \"c\"\n  focal 50\nobject \"o\" group 0 0 0\nend group\nend object\n");
  EXPECT_NE(read.scene.find("o"), nullptr) << read.messages();
  EXPECT_EQ(*read.get<scene::Camera>("c").focal, 50);
}

}  // namespace reader_test
}  // namespace oriel::mi
