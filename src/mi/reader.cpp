// SPDX-License-Identifier: Apache-2.0
#include "mi/reader.h"

#include "mi/elements.h"

namespace oriel::mi {

class ReaderState {
 public:
  ReaderState(ReadOptions read_options, Diagnostics& diagnostics)
      : options(std::move(read_options)), parse(options, diagnostics) {}
  const ReadOptions options;
  Parse parse;
  bool opened = true;
};

Reader::Reader(const std::string& path, ReadOptions options, Diagnostics& diagnostics)
    : state_(std::make_unique<ReaderState>(std::move(options), diagnostics)) {
  state_->opened = state_->parse.in.open(path);
}

Reader::Reader(std::unique_ptr<ReaderState> state) : state_(std::move(state)) {}
Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;

Reader Reader::from_text(std::string_view text, ReadOptions options, Diagnostics& diagnostics,
                         std::string name) {
  auto state = std::make_unique<ReaderState>(std::move(options), diagnostics);
  state->parse.in.permit_folder_of(name);
  state->parse.in.open_text(text, std::move(name));
  return Reader(std::move(state));
}

bool Reader::next_frame(scene::Scene& scene) {
  Parse& parse = state_->parse;
  parse.scene = &scene;
  scene.files = parse.in.files();
  scene.budgets = state_->options.budgets;
  while (!parse.in.at_end())
    if (read_top_level(parse)) return true;
  finish_reading(parse);
  return false;
}

bool Reader::at_end() {
  Cursor& in = state_->parse.in;
  const bool end = in.at_end();
  in.forget_what_was_read();
  return end;
}

bool Reader::opened() const { return state_->opened; }

scene::Scene read_all(Reader& reader) {
  scene::Scene scene;
  while (reader.next_frame(scene)) {
  }
  return scene;
}

scene::Scene read_scene(const std::string& path, ReadOptions options, Diagnostics& diagnostics) {
  Reader reader(path, std::move(options), diagnostics);
  return read_all(reader);
}

scene::Scene read_text(std::string_view text, ReadOptions options, Diagnostics& diagnostics,
                       std::string name) {
  Reader reader = Reader::from_text(text, std::move(options), diagnostics, std::move(name));
  return read_all(reader);
}

}  // namespace oriel::mi
