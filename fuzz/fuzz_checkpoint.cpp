// SPDX-License-Identifier: Apache-2.0
// A checkpoint of which everything but the checksum and the sizes may be forged, resumed by a
// render with final gather points and photons.
#include <cstring>

#include "base/checkpoint_file.h"
#include "base/checksum.h"
#include "file.h"
#include "fuzzers.h"
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"

namespace {

constexpr const char* kElements =
    "material \"m\" \"mib_illum_lambert\" (\"diffuse\" .5 .5 .5) end material\n"
    "light \"lamp\" \"mib_light_point\" (\"color\" 5 5 5) origin 0 0 -3 energy 9 9 9 "
    "globillum photons 20 end light\n"
    "instance \"lamp_inst\" \"lamp\" end instance\n";

/// Header: magic, version, byte order (16 bytes); sizes of labels and body; checksum.
constexpr std::size_t kSizes = 16, kChecksum = 32, kHeader = 40;

void make_consistent(std::string& bytes) {
  std::uint64_t labels = 0;
  std::memcpy(&labels, bytes.data() + kSizes, sizeof labels);
  const std::uint64_t body = bytes.size() - kHeader - labels;
  std::memcpy(bytes.data() + kSizes + sizeof labels, &body, sizeof body);
  oriel::Checksum64 sum;
  sum.add(std::string_view(bytes).substr(kHeader));
  sum.add(std::string_view(bytes).substr(0, kChecksum));
  const std::uint64_t value = sum.value();
  std::memcpy(bytes.data() + kChecksum, &value, sizeof value);
}

/// A picture of 4 x 3 pixels with caches of both kinds.
struct LitSquare : oriel::testing::PreparedScene {
  LitSquare()
      : PreparedScene(oriel::testing::scene_text(kElements, "\"lamp_inst\"", {},
                                                 "\"light group key\" \"lamp*\" finalgather "
                                                 "accuracy 4 photon trace depth 2 2 2"),
                      oriel::builtin_shaders(), small()) {
    world->options.indirect = oriel::scene::IndirectMethod::FinalGatherPhotons;
  }
  static oriel::PrepareOptions small() {
    oriel::PrepareOptions options;
    options.width = 4, options.height = 3;
    return options;
  }
};

}  // namespace

int oriel::fuzz::fuzz_checkpoint(const std::uint8_t* data, std::size_t size) {
  static const LitSquare prepared;
  if (size < kHeader) return 0;
  std::string bytes(text_of(data, size));
  make_consistent(bytes);
  const MemoryFile file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  SessionSettings settings;
  settings.budget.samples = 2;
  const std::vector<std::string> names(prepared.world->instances.size(), "n");
  settings.mattes = MatteNames{names, names, std::vector<std::uint32_t>(names.size(), 0)};
  RenderSession session(*prepared.world, settings);
  try {
    CheckpointReader reader(file.path());
    session.restore(reader);
  } catch (const CheckpointError&) {  // a message is what is asked for
    return 0;
  }
  session.run();
  return 0;
}
