// SPDX-License-Identifier: Apache-2.0
// Implementation of the C++ classes: string options, named frame buffers, spectra.
#include <algorithm>
#include <cstring>
#include <string>

#include "scene/render_options.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/frame_buffers.h"
#include "sdk/host.h"

/// The options block of the rendering.
struct oriel_string_options {
  const oriel::scene::Options* block;
};

/// The frame buffers of the camera.
struct oriel_framebuffers {
  const oriel::sdk::Host* host;
};

namespace oriel::sdk {
namespace {

const scene::Value* option(const oriel_string_options* options, const char* name) {
  if (!options || !name) return nullptr;
  for (auto s = options->block->statements.rbegin(); s != options->block->statements.rend(); ++s)
    if (s->quoted && s->keyword == name && !s->values.empty()) return &s->values[0];
  return nullptr;
}

const scene::FrameBuffer* buffer(const oriel_framebuffers* buffers, const char* name) {
  const scene::Camera* camera = buffers ? scene_camera(*buffers->host) : nullptr;
  if (!camera || !name) return nullptr;
  for (const scene::FrameBuffer& b : camera->frame_buffers)
    if (b.name == name) return &b;
  return nullptr;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

oriel_shader_interface* mi_get_shader_interface(int version) {
  // Only its address is used.
  static int some;
  return version <= ORIEL_SHADER_INTERFACE_VERSION
             ? reinterpret_cast<oriel_shader_interface*>(&some)
             : nullptr;
}

void oriel_spectrum_from_color(miSpectrum* result, miState*, const miColor* color) {
  if (!result) return;
  mi_spectrum_clear(result);
  mi_spectrum_color_add(result, color);
}

oriel_string_options* oriel_options_open(miTag tag) {
  Host* host = current_host();
  if (!host || kind_of(tag) != TagKind::Options || host->scene().renders.empty()) return nullptr;
  const auto* block = host->scene().get<scene::Options>(host->scene().renders.back().options);
  return block ? new oriel_string_options{block} : nullptr;
}
void oriel_options_close(oriel_string_options* options) { delete options; }

// Changes have no effect, because the options are evaluated at the start of the frame.
miBoolean oriel_options_set_boolean(oriel_string_options*, const char*, miBoolean) {
  return miFALSE;
}
miBoolean oriel_options_set_integer(oriel_string_options*, const char*, int) { return miFALSE; }
miBoolean oriel_options_set_scalars(oriel_string_options*, const char*, const float*, int) {
  return miFALSE;
}
miBoolean oriel_options_set_string(oriel_string_options*, const char*, const char*) {
  return miFALSE;
}
miBoolean oriel_options_remove(oriel_string_options*, const char*) { return miFALSE; }

miBoolean oriel_options_get_boolean(const oriel_string_options* options, const char* name,
                                    miBoolean* value) {
  const scene::Value* v = option(options, name);
  if (!v || v->kind != scene::Value::Kind::Boolean) return miFALSE;
  *value = v->boolean ? miTRUE : miFALSE;
  return miTRUE;
}

miBoolean oriel_options_get_integer(const oriel_string_options* options, const char* name,
                                    int* value) {
  const scene::Value* v = option(options, name);
  if (!v || v->kind != scene::Value::Kind::Numbers || v->numbers.size() != 1) return miFALSE;
  *value = static_cast<int>(v->numbers[0]);
  return miTRUE;
}

miBoolean oriel_options_get_scalars(const oriel_string_options* options, const char* name,
                                    float* values, int n) {
  const scene::Value* v = option(options, name);
  if (!v || v->kind != scene::Value::Kind::Numbers || static_cast<int>(v->numbers.size()) != n)
    return miFALSE;
  std::transform(v->numbers.begin(), v->numbers.end(), values,
                 [](double number) { return static_cast<float>(number); });
  return miTRUE;
}

miBoolean oriel_options_get_string(const oriel_string_options* options, const char* name,
                                   const char** value) {
  const scene::Value* v = option(options, name);
  if (!v || v->kind != scene::Value::Kind::Text) return miFALSE;
  *value = v->text.c_str();
  return miTRUE;
}

// Frame buffers are defined by the scene; shaders can only query them.
miTag oriel_framebuffers_create(void) { return miNULLTAG; }
miTag oriel_framebuffers_copy(miTag tag) { return tag; }

oriel_framebuffers* oriel_framebuffers_open(miTag tag, miBoolean edit) {
  Host* host = current_host();
  if (!host || edit || kind_of(tag) != TagKind::Camera) return nullptr;
  return new oriel_framebuffers{host};
}
void oriel_framebuffers_close(oriel_framebuffers* buffers) { delete buffers; }

miBoolean oriel_framebuffers_index(const oriel_framebuffers* buffers, const char* name,
                                   size_t* index) {
  if (!buffers || !name) return miFALSE;
  const int found = buffer_index(*buffers->host, name);
  if (found < 0) return miFALSE;
  *index = static_cast<size_t>(found);
  return miTRUE;
}

miBoolean oriel_framebuffers_set_boolean(oriel_framebuffers*, const char*, const char*, miBoolean) {
  return miFALSE;
}
miBoolean oriel_framebuffers_set_integer(oriel_framebuffers*, const char*, const char*, int) {
  return miFALSE;
}
miBoolean oriel_framebuffers_set_scalar(oriel_framebuffers*, const char*, const char*, float) {
  return miFALSE;
}
miBoolean oriel_framebuffers_set_string(oriel_framebuffers*, const char*, const char*,
                                        const char*) {
  return miFALSE;
}
void oriel_framebuffers_reset(oriel_framebuffers*) {}

miBoolean oriel_framebuffers_get_boolean(const oriel_framebuffers* buffers, const char* name,
                                         const char* param, miBoolean* value) {
  const scene::FrameBuffer* b = buffer(buffers, name);
  if (!b || !param) return miFALSE;
  const std::string_view p = param;
  const std::optional<bool> found = p == "filtering" ? b->filtering
                                    : p == "primary" ? b->primary
                                    : p == "user"    ? b->user
                                                     : std::nullopt;
  if (!found) return miFALSE;
  *value = *found ? miTRUE : miFALSE;
  return miTRUE;
}

miBoolean oriel_framebuffers_get_string(const oriel_framebuffers* buffers, const char* name,
                                        const char* param, const char** value) {
  const scene::FrameBuffer* b = buffer(buffers, name);
  if (!b || !param) return miFALSE;
  const std::string_view p = param;
  const std::string* found = p == "datatype"   ? &b->datatype
                             : p == "filename" ? &b->filename
                             : p == "filetype" ? &b->filetype
                                               : nullptr;
  if (!found || found->empty()) return miFALSE;
  *value = found->c_str();
  return miTRUE;
}

miBoolean oriel_framebuffers_get_integer(const oriel_framebuffers*, const char*, const char*,
                                         int*) {
  return miFALSE;
}
miBoolean oriel_framebuffers_get_scalar(const oriel_framebuffers*, const char*, const char*,
                                        float*) {
  return miFALSE;
}

void oriel_framebuffers_echo(const oriel_framebuffers* buffers, FILE* file) {
  const scene::Camera* camera = buffers ? scene_camera(*buffers->host) : nullptr;
  if (!camera) return;
  for (const scene::FrameBuffer& b : camera->frame_buffers)
    std::fprintf(file, "framebuffer \"%s\" datatype \"%s\"\n", b.name.c_str(), b.datatype.c_str());
}

}  // extern "C"
