// SPDX-License-Identifier: Apache-2.0
// Saving changes the text of the edited values alone; histories, journals.
#include "interactive/save_edits.h"
#include "interactive/edit_history.h"
#include "interactive/journal.h"
#include "interactive/loop_support.h"
#include "interactive/text_patch.h"

namespace oriel::interactive {
namespace {

using Edits = std::vector<std::string>;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class SaveEdits : public LoopTest {
 protected:
  /// Saves edits and returns the new text. The saved scene gives the picture of the edits.
  std::string saved(const Edits& edits) {
    RenderLoop loop(source(), {}, {});
    loop.set_view(small_view());
    EXPECT_TRUE(loop.read());
    loop.set_edits(edits);
    finish(loop);
    const std::vector<float> edited = beauty(loop);
    EXPECT_EQ(save_into_files(loop.scene(), file("")), Edits{"scene.mi"});
    RenderLoop reopened(source(), {}, {});
    reopened.set_view(small_view());
    EXPECT_TRUE(reopened.read());
    finish(reopened);
    EXPECT_EQ(beauty(reopened), edited) << "the saved scene has another picture";
    return text("scene.mi");
  }
};

TEST_F(SaveEdits, OnlyTheValueOfAParameterChanges) {
  EXPECT_EQ(saved({"floor_mtl.diffuse=.1 .6 .2"}),
            replaced(editable_scene(), "\"diffuse\" .5 .4 .3,   # warm",
                     "\"diffuse\" .1 .6 .2,   # warm"));
}

TEST_F(SaveEdits, AMissingParameterIsInserted) {
  EXPECT_EQ(saved({"floor_mtl.cutout_opacity=.5"}),
            replaced(editable_scene(), "\"mia_material_x\" (",
                     "\"mia_material_x\" (\"cutout_opacity\" .5, "));
}

TEST_F(SaveEdits, StatementsAreReplacedOrAppended) {
  EXPECT_EQ(saved({"cam.focal=50", "opt.trace depth=1 1 2", "opt.shadow=off", "lamp.origin=1 0 2"}),
            replaced(replaced(replaced(replaced(editable_scene(), "focal 35", "focal 50"),
                                       "trace depth 3 3 4", "trace depth 1 1 2"),
                              "end options", "    shadow off\nend options"),
                     "origin 0 0 3", "origin 1 0 2"));
}

TEST_F(SaveEdits, OtherLineEndsStay) {
  std::string text = editable_scene(), crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  write("scene.mi", crlf);
  EXPECT_EQ(saved({"floor_mtl.refl_gloss=.4"}),
            replaced(crlf, "\"refl_gloss\" 1", "\"refl_gloss\" .4"));
}

TEST_F(SaveEdits, FilesOutsideOfTheFolderStay) {
  RenderLoop loop(source(), {}, {});
  ASSERT_TRUE(loop.read());
  loop.set_edits({"floor_mtl.refl_gloss=.4"});
  EXPECT_THROW(save_into_files(loop.scene(), file("other")), SaveError);
  EXPECT_EQ(text("scene.mi"), editable_scene());
}

TEST_F(SaveEdits, IncrementalFileShowsTheEditsInItsSecondFrame) {
  RenderLoop loop(source(), {}, {});
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  loop.set_edits({"floor_mtl.diffuse=.1 .6 .2", "lamp.origin=1 0 2"});
  finish(loop);
  const std::vector<float> edited = beauty(loop);
  save_incremental(loop.scene(), file("scene.edits.mi"));
  EXPECT_EQ(text("scene.mi"), editable_scene());

  SceneSource changed = source("scene.edits.mi");
  changed.frame = 2;
  RenderLoop second(changed, {}, {});
  second.set_view(small_view());
  ASSERT_TRUE(second.read());
  finish(second);
  EXPECT_EQ(beauty(second), edited);
}

TEST(TextPatch, ValuesOfAllForms) {
  const auto value = [](const std::string& text) {
    const auto patch = parameter_value(text, 0, "a");
    return patch ? text.substr(patch->begin, patch->end - patch->begin) : "none";
  };
  EXPECT_EQ(value("\"a\" 1 2 3, \"b\" 4)"), "1 2 3");
  EXPECT_EQ(value("\"a\" = \"x, y)\" )"), "= \"x, y)\"");
  EXPECT_EQ(value("\"a\" [ {\"c\" 1}, {\"c\" 2} ] , \"b\""), "[ {\"c\" 1}, {\"c\" 2} ]");
  EXPECT_EQ(value("\"a\" 1 # , comment\n)"), "1");
  EXPECT_EQ(value("\"b\" 1)"), "none");
  EXPECT_EQ(value("\"a\" 1"), "none");
}

TEST(EditHistory, GesturesAreOneStep) {
  EditHistory history;
  history.push({"a.x=1"});
  history.push({"a.x=2"}, "drag");
  history.push({"a.x=3"}, "drag");
  EXPECT_EQ(history.undo_count(), 2u);
  ASSERT_TRUE(history.undo());
  EXPECT_EQ(history.now(), Edits{"a.x=1"});
  ASSERT_TRUE(history.redo());
  EXPECT_EQ(history.now(), Edits{"a.x=3"});
  EXPECT_FALSE(history.redo());
  history.undo();
  history.push({"a.x=4"}, "drag");
  EXPECT_EQ(history.redo_count(), 0u);
  history.undo(), history.undo();
  EXPECT_EQ(history.now(), Edits{});
  EXPECT_FALSE(history.undo());
}

TEST_F(SaveEdits, JournalsReturnWhatWasWritten) {
  const EditJournal journal(file("state/journal"));
  EXPECT_EQ(journal.read(), Edits{});
  const Edits edits = {"a.x=1 2 3", "a.file=C:\\new\\tex.png", "a.text=two\nlines"};
  journal.write(edits);
  EXPECT_EQ(journal.read(), edits);
  journal.write({});
  EXPECT_EQ(journal.read(), Edits{});
}

}  // namespace
}  // namespace oriel::interactive
