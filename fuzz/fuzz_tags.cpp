// SPDX-License-Identifier: Apache-2.0
// Calls of functions of the C interface that take tags, with tags of any kind, of nothing, and
// parts of pointers.
#include <array>
#include <cstring>

#include "file.h"
#include "fuzzers.h"
#include "oriel/sdk/shader.h"
#include "oriel/sdk/shader/connection.h"
#include "oriel/sdk/shader/info.h"
#include "oriel/sdk/shader/interface.h"
#include "oriel/sdk/shader/kdtree.h"
#include "oriel/sdk/shader/lookup.h"
#include "sdk/current.h"
#include "sdk/testing/bare_state.h"

namespace {

using oriel::fuzz::Numbers;

/// Tags of the scene, of nothing near them, and any number.
miTag next_tag(Numbers& numbers, const void* pointer) {
  switch (numbers.below(4)) {
    case 0:
      return numbers.next<miTag>();
    case 1:
      return static_cast<miTag>(reinterpret_cast<std::uintptr_t>(pointer));
    default:
      const auto kind = static_cast<oriel::sdk::TagKind>(numbers.below(64));
      return oriel::sdk::make_tag(kind, numbers.below(8));
  }
}

/// Reads all bytes that the interface says are there.
void read_element(miTag tag) {
  const auto* bytes = static_cast<const unsigned char*>(mi_db_access(tag));
  const int size = mi_db_size(tag);
  volatile unsigned sum = 0;
  if (bytes)
    for (int i = 0; i < size; ++i) sum = sum + bytes[i];
  int type = 0;
  mi_db_access_type(&type, tag);
  mi_db_type(tag);
  mi_db_unpin(tag);
  mi_db_unpin(tag);
}

void query(Numbers& numbers, miTag tag, const miState* state) {
  alignas(16) std::array<unsigned char, 512> result{};
  const auto type = static_cast<miQ_type>(numbers.next<std::uint16_t>() % 800);
  const int number = numbers.next<std::int8_t>();
  int count = 0;
  if (type == miQ_FUNC_TLS_GETALL)
    mi_query(type, state, tag, result.data(), &count);
  else
    mi_query(type, state, tag, result.data(), number);
}

void look_up(Numbers& numbers, miTag tag) {
  mi_api_tag_lookup(tag);
  const std::string name = numbers.text(12);
  mi_api_name_lookup(mi_mem_strdup(name.c_str()));
  miParam_type type{};
  miBoolean is_array = miFALSE;
  int offset = 0;
  mi_api_parameter_lookup(&type, &is_array, &offset, tag, miFALSE, name.c_str());
  oriel_is_shader_tag(tag);
}

void ask(miTag tag, miState& state) {
  miTag item = 0, material = 0;
  miMatrix to_local, to_global;
  mi_instance_info(tag, &item, &material, to_local, to_global);
  char* name = nullptr;
  int version = 0, width = 0, height = 0;
  void* parameters = nullptr;
  mi_shader_info(tag, &name, &version, &parameters);
  miVector place{}, direction{};
  mi_light_info(tag, &place, &direction, &parameters);
  mi_texture_info(tag, &width, &height, &parameters);
  miColor color{};
  mi_lookup_color_texture(&color, &state, tag, &place);
  mi_lightprofile_sample(&state, tag, miFALSE);
}

void change(Numbers& numbers, miTag tag, miState& state) {
  switch (numbers.below(7)) {
    case 0: {
      miTag made = 0;
      mi_db_create(&made, numbers.next<std::int8_t>(), numbers.next<std::uint8_t>());
      return read_element(made);
    }
    case 1:
      mi_db_realloc(tag, numbers.next<std::uint8_t>());
      return read_element(tag);
    case 2:
      return read_element(mi_db_copy(tag));
    case 3:
      return mi_db_delete(tag);
    case 4:
      mi_scene_edit(tag);
      return mi_scene_edit_end(tag);
    case 5:
      if (miKdtree* tree = mi_kdtree_access(tag)) mi_kdtree_unpin(tree);
      if (oriel_framebuffers* buffers = oriel_framebuffers_open(tag, miFALSE))
        oriel_framebuffers_close(buffers);
      if (oriel_string_options* options = oriel_options_open(tag)) oriel_options_close(options);
      return mi_kdtree_delete(tag);
    default:
      miColor color{}, light{};
      miVector direction{};
      float dot = 0;
      mi_call_shader(&color, miSHADER_MATERIAL, &state, tag);
      mi_trace_light(&light, &direction, &dot, &state, tag);
  }
}

}  // namespace

int oriel::fuzz::fuzz_tags(const std::uint8_t* data, std::size_t size) {
  Numbers numbers(data, size);
  testing::BareState bare;
  sdk::set_current_host(&bare.host());
  for (int calls = 0; calls < 64 && !numbers.at_end(); ++calls) {
    const miTag tag = next_tag(numbers, &bare.state());
    switch (numbers.below(5)) {
      case 0:
        read_element(tag);
        break;
      case 1:
        query(numbers, tag, numbers.below(4) ? &bare.state() : nullptr);
        break;
      case 2:
        look_up(numbers, tag);
        break;
      case 3:
        ask(tag, bare.state());
        break;
      default:
        change(numbers, tag, bare.state());
    }
  }
  return 0;
}
