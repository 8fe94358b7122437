// SPDX-License-Identifier: Apache-2.0
// The C++ side of the interface: LightIterator, Options, named frame buffers.
#ifndef ORIEL_SDK_MI_SHADER_IF_H
#define ORIEL_SDK_MI_SHADER_IF_H

// Conventions
//   Everything here is inline in the shader and calls C functions (shader/interface.h), so shaders
//   need not be built with the compiler or the standard of the renderer. C++98 and later.

#include "shader/interface.h"
#include "shader/light.h"
#include "shader/map_access.h"

#ifdef __cplusplus

namespace mi {
namespace shader {

/// The samples of one light at the point of a state.
class LightList {
 public:
  LightList()
      : state_(0),
        light_(miNULLTAG),
        has_axis_(false),
        axis_(),
        cos_spread_(0),
        samples_(0),
        dot_nl_(0),
        direction_(),
        color_() {}

  /// The next sample; false: there is no more.
  bool sample() {
    return oriel_light_sample(&color_, &direction_, &dot_nl_, state_, light_, &samples_,
                              has_axis_ ? &axis_ : 0, cos_spread_) != miFALSE;
  }
  /// Cosine between the normal and the direction.
  miScalar get_dot_nl() const { return dot_nl_; }
  /// To the light, unit, internal space.
  const miVector& get_direction() const { return direction_; }
  /// Light of this sample, shadows included; divide the sum by get_number_of_samples().
  void get_contribution(miColor* color) const { *color = color_; }
  void get_contribution(miSpectrum* spectrum) const {
    oriel_spectrum_from_color(spectrum, state_, &color_);
  }
  int get_number_of_samples() const { return samples_; }

 private:
  friend class LightIterator;
  void start(miTag light) {
    light_ = light;
    samples_ = 0;
  }

  miState* state_;
  miTag light_;
  bool has_axis_;
  miVector axis_;
  miScalar cos_spread_;
  int samples_;
  miScalar dot_nl_;
  miVector direction_;
  miColor color_;
};

/// Iterates over the lights of a list; without a list, those of the instance or of the scene.
class LightIterator {
 public:
  explicit LightIterator(miState* state, const miTag* list = 0, int n = 0) {
    start(state, list, n);
  }
  /// Light from directions around a unit axis, up to the cosine of an angle.
  LightIterator(miState* state, const miVector& axis, miScalar cos_spread, const miTag* list = 0,
                int n = 0) {
    current_.has_axis_ = true;
    current_.axis_ = axis;
    current_.cos_spread_ = cos_spread;
    start(state, list, n);
  }

  miTag operator*() const { return lights_[index_]; }
  LightList* operator->() { return &current_; }
  LightIterator& operator++() {
    ++index_;
    enter();
    return *this;
  }
  LightIterator operator++(int) {
    LightIterator before(*this);
    ++*this;
    return before;
  }
  bool at_end() const { return index_ >= count_; }
  bool operator==(const LightIterator& other) const {
    return (at_end() && other.at_end()) || (lights_ == other.lights_ && index_ == other.index_);
  }
  bool operator!=(const LightIterator& other) const { return !(*this == other); }

 private:
  void start(miState* state, const miTag* list, int n) {
    lights_ = list;
    count_ = n;
    index_ = 0;
    current_.state_ = state;
    if (list == 0 || n <= 0) {
      miTag* found = 0;
      count_ = 0;
      if (!mi_instance_lightlist(&count_, &found, state)) count_ = 0;
      lights_ = found;
    }
    enter();
  }
  void enter() {
    if (!at_end()) current_.start(lights_[index_]);
  }

  const miTag* lights_;
  int count_, index_;
  LightList current_;
};

/// The named options of the scene.
class Options {
 public:
  bool set(const char* name, bool value) {
    return oriel_options_set_boolean(options_, name, value ? miTRUE : miFALSE) != miFALSE;
  }
  bool set(const char* name, int value) {
    return oriel_options_set_integer(options_, name, value) != miFALSE;
  }
  bool set(const char* name, float value) { return set_scalars(name, &value, 1); }
  bool set(const char* name, float a, float b, float c) {
    const float values[3] = {a, b, c};
    return set_scalars(name, values, 3);
  }
  bool set(const char* name, float a, float b, float c, float d) {
    const float values[4] = {a, b, c, d};
    return set_scalars(name, values, 4);
  }
  bool set(const char* name, const char* value) {
    return oriel_options_set_string(options_, name, value) != miFALSE;
  }

  /// Returns false and leaves the value unchanged if there is no such option of that type.
  bool get(const char* name, bool* value) const {
    miBoolean found = miFALSE;
    if (!oriel_options_get_boolean(options_, name, &found)) return false;
    *value = found != miFALSE;
    return true;
  }
  bool get(const char* name, int* value) const {
    return oriel_options_get_integer(options_, name, value) != miFALSE;
  }
  bool get(const char* name, float* value) const { return get_scalars(name, value, 1); }
  bool get(const char* name, float* a, float* b, float* c) const {
    float values[3];
    if (!get_scalars(name, values, 3)) return false;
    *a = values[0], *b = values[1], *c = values[2];
    return true;
  }
  bool get(const char* name, float* a, float* b, float* c, float* d) const {
    float values[4];
    if (!get_scalars(name, values, 4)) return false;
    *a = values[0], *b = values[1], *c = values[2], *d = values[3];
    return true;
  }
  bool get(const char* name, const char** value) const {
    return oriel_options_get_string(options_, name, value) != miFALSE;
  }
  /// Same for references.
  bool get(const char* name, bool& value) const { return get(name, &value); }
  bool get(const char* name, int& value) const { return get(name, &value); }
  bool get(const char* name, float& value) const { return get(name, &value); }
  bool get(const char* name, const char*& value) const { return get(name, &value); }
  bool get(const char* name, float& a, float& b, float& c) const { return get(name, &a, &b, &c); }
  bool get(const char* name, float& a, float& b, float& c, float& d) const {
    return get(name, &a, &b, &c, &d);
  }

  bool remove(const char* name) { return oriel_options_remove(options_, name) != miFALSE; }
  /// Deletes this object.
  void release() { delete this; }

 private:
  friend class Interface;
  explicit Options(miTag tag) : options_(oriel_options_open(tag)) {}
  ~Options() { oriel_options_close(options_); }
  Options(const Options&);
  Options& operator=(const Options&);

  bool set_scalars(const char* name, const float* values, int n) {
    return oriel_options_set_scalars(options_, name, values, n) != miFALSE;
  }
  bool get_scalars(const char* name, float* values, int n) const {
    return oriel_options_get_scalars(options_, name, values, n) != miFALSE;
  }

  oriel_string_options* options_;
};

/// Named frame buffers, obtained by Access_fb and Edit_fb.
class Framebuffer {
 public:
  Framebuffer(miTag tag, bool edit)
      : buffers_(oriel_framebuffers_open(tag, edit ? miTRUE : miFALSE)) {}
  ~Framebuffer() { oriel_framebuffers_close(buffers_); }

  bool set(const char* buffer, const char* param, bool value) {
    return oriel_framebuffers_set_boolean(buffers_, buffer, param, value ? miTRUE : miFALSE) !=
           miFALSE;
  }
  bool set(const char* buffer, const char* param, int value) {
    return oriel_framebuffers_set_integer(buffers_, buffer, param, value) != miFALSE;
  }
  bool set(const char* buffer, const char* param, float value) {
    return oriel_framebuffers_set_scalar(buffers_, buffer, param, value) != miFALSE;
  }
  bool set(const char* buffer, const char* param, const char* value) {
    return oriel_framebuffers_set_string(buffers_, buffer, param, value) != miFALSE;
  }
  /// Returns false and leaves the value unchanged if there is none of that type.
  bool get(const char* buffer, const char* param, bool& value) const {
    miBoolean found = miFALSE;
    if (!oriel_framebuffers_get_boolean(buffers_, buffer, param, &found)) return false;
    value = found != miFALSE;
    return true;
  }
  bool get(const char* buffer, const char* param, int& value) const {
    return oriel_framebuffers_get_integer(buffers_, buffer, param, &value) != miFALSE;
  }
  bool get(const char* buffer, const char* param, float& value) const {
    return oriel_framebuffers_get_scalar(buffers_, buffer, param, &value) != miFALSE;
  }
  bool get(const char* buffer, const char* param, const char*& value) const {
    return oriel_framebuffers_get_string(buffers_, buffer, param, &value) != miFALSE;
  }
  /// Number for mi_fb_put; false if there is no buffer of that name.
  bool get_index(const char* name, size_t& index) const {
    return oriel_framebuffers_index(buffers_, name, &index) != miFALSE;
  }
  void reset() { oriel_framebuffers_reset(buffers_); }
  void echo(FILE* file) const { oriel_framebuffers_echo(buffers_, file); }

 private:
  Framebuffer(const Framebuffer&);
  Framebuffer& operator=(const Framebuffer&);

  oriel_framebuffers* buffers_;
};

/// Read access to the named frame buffers of a tag.
class Access_fb {
 public:
  explicit Access_fb(miTag tag) : buffers_(tag, false) {}
  const Framebuffer* operator->() const { return &buffers_; }

 private:
  Framebuffer buffers_;
};

/// Write access to the named frame buffers of a tag.
class Edit_fb {
 public:
  explicit Edit_fb(miTag tag) : buffers_(tag, true) {}
  Framebuffer* operator->() { return &buffers_; }

 private:
  Framebuffer buffers_;
};

/// Factory of the other classes.
class Interface {
 public:
  /// Null if the renderer does not support the version.
  static Interface* get(int version = ORIEL_SHADER_INTERFACE_VERSION) {
    oriel_shader_interface* const found = mi_get_shader_interface(version);
    return found != 0 ? new Interface() : 0;
  }
  /// The caller has to release the result.
  Options* getOptions(miTag tag) { return new Options(tag); }
  miTag createFramebuffer() { return oriel_framebuffers_create(); }
  miTag copyFramebuffer(miTag tag) { return oriel_framebuffers_copy(tag); }
  void release() { delete this; }

 private:
  Interface() {}
  ~Interface() {}
  Interface(const Interface&);
  Interface& operator=(const Interface&);
};

}  // namespace shader

/// Namespace name of later levels.
namespace shader_v3 = shader;

}  // namespace mi

#endif

#endif
