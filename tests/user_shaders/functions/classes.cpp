// SPDX-License-Identifier: Apache-2.0
// Lights, lists of lights, and the classes of the C++ interface with the functions behind them.
#include "coverage.h"

struct cover_classes {
  miTag lamp;   // of cover_light, behind a pane that passes half
  miTag other;  // another one
};

namespace {

using mi::shader::Access_fb;
using mi::shader::Edit_fb;
using mi::shader::Interface;
using mi::shader::LightIterator;
using mi::shader::Options;

bool lit(const miColor& c) { return SHOWS(c, .5, .25, .125); }

void lights(miState* state, const cover_classes* p) {
  const miTag lamp = p->lamp, other = p->other;
  const miVector at = make(0, 0, 3), up = make(0, 0, 1), x = make(1, 0, 0);
  miVector to_light, d, org;
  mi_vector_sub(&to_light, &at, &state->point);
  mi_vector_normalize(&to_light);
  miColor c;
  float dot_nl = 0;
  int samples = 0, passes = 0;
  while (mi_sample_light(&c, &d, &dot_nl, state, lamp, &samples)) {
    ++passes;
    COVER(mi_sample_light,
          lit(c) && NEAR(dot_nl, to_light.z, 1e-4) && IS(d, to_light.x, to_light.y, to_light.z));
  }
  COVER(mi_sample_light, samples > 0 && passes > 0);
  COVER(mi_trace_light, mi_trace_light(&c, &d, &dot_nl, state, lamp) && lit(c));
  samples = 0;
  COVER(oriel_light_sample,
        oriel_light_sample(&c, &d, &dot_nl, state, lamp, &samples, &up, 0) && lit(c));
  samples = 0;
  COVER(oriel_light_sample,
        !oriel_light_sample(&c, &d, &dot_nl, state, lamp, &samples, &x, .999f) && samples > 0);

  int seen = 0;
  for (LightIterator light(state, &lamp, 1); !light.at_end(); ++light)
    while (light->sample()) {
      light->get_contribution(&c);
      seen += lit(c) && NEAR(light->get_dot_nl(), to_light.z, 1e-4) ? 1 : 10;
    }
  COVER(oriel_light_sample, seen == 1);

  void* paras = 0;
  mi_light_info(lamp, &org, &d, &paras);
  COVER(mi_light_info, IS(org, 0, 0, 0) && paras != 0);
  miTag* list = 0;
  COVER(mi_global_lights_info, mi_global_lights_info(&list) == 2 && list[0] != list[1]);
  miTag both[2] = {lamp, other};
  int n = 1;
  list = both;
  COVER(mi_inclusive_lightlist,
        mi_inclusive_lightlist(&n, &list, state) && n == 1 && list[0] == lamp);
  n = 1;
  list = both;
  COVER(mi_exclusive_lightlist,
        mi_exclusive_lightlist(&n, &list, state) && n == 1 && list[0] == other);
  n = 2;
  list = both;
  COVER(mi_expand_lightlist, mi_expand_lightlist(&n, &list, state) && n == 2 && list[1] == other);
  COVER(mi_instance_lightlist, mi_instance_lightlist(&n, &list, state) && n == 2);
}

void spectrum(miState* state) {
  miSpectrum s;
  const miColor white = paint(1, 1, 1);
  oriel_spectrum_from_color(&s, state, &white);
  COVER(oriel_spectrum_from_color, NEAR(s.value[0], .9505, 2e-4) && NEAR(s.value[1], 1, 2e-4));
}

void options(miState* state, Interface* interface) {
  bool flag = false;
  int number = 0;
  float scalar = 0, r = 0, g = 0, b = 0;
  const char* text = "";
  Options* o = interface->getOptions(state->options->string_options);
  COVER(oriel_options_get_boolean, o->get("own flag", &flag) && flag);
  COVER(oriel_options_get_integer, o->get("own number", &number) && number == 5);
  COVER(oriel_options_get_scalars, o->get("own scalar", &scalar) && NEAR(scalar, .5, 0));
  COVER(oriel_options_get_scalars,
        o->get("own color", &r, &g, &b) && NEAR(r, .1, 1e-6) && NEAR(b, .3, 1e-6));
  COVER(oriel_options_get_string, o->get("own text", &text) && strcmp(text, "some") == 0);
  COVER(oriel_options_get_integer, !o->get("no such", &number) && number == 5);
  // The frame has begun: options cannot be changed.
  COVER(oriel_options_set_boolean, !o->set("own flag", false) && o->get("own flag", flag) && flag);
  COVER(oriel_options_set_integer, !o->set("own number", 6));
  COVER(oriel_options_set_scalars, !o->set("own scalar", 1.0f));
  COVER(oriel_options_set_string, !o->set("own text", "other"));
  COVER(oriel_options_remove, !o->remove("own text") && o->get("own text", &text));
  o->release();
  oriel_string_options* opened = oriel_options_open(state->options->string_options);
  COVER(oriel_options_open, opened != 0 && oriel_options_open(miNULLTAG) == 0);
  oriel_options_close(opened);
  oriel_options_close(0);
  COVER(oriel_options_close, 1);
}

void buffers(miState* state, Interface* interface) {
  const miTag tag = state->camera->buffertag;
  bool flag = false;
  int number = 3;
  float scalar = 4;
  const char* text = "";
  size_t index = 0;
  const Access_fb fb(tag);
  COVER(oriel_framebuffers_index, fb->get_index("own", index) && index > 0);
  COVER(oriel_framebuffers_index, !fb->get_index("no such", index));
  COVER(oriel_framebuffers_get_string,
        fb->get("own", "datatype", text) && strcmp(text, "rgba") == 0);
  COVER(oriel_framebuffers_get_boolean, fb->get("own", "user", flag) && flag);
  // No parameter of a buffer is a number here.
  COVER(oriel_framebuffers_get_integer, !fb->get("own", "datatype", number) && number == 3);
  COVER(oriel_framebuffers_get_scalar, !fb->get("own", "datatype", scalar) && scalar == 4);
  char written[200] = "";
  FILE* file = tmpfile();
  fb->echo(file);
  rewind(file);
  const size_t length = fread(written, 1, sizeof(written) - 1, file);
  fclose(file);
  COVER(oriel_framebuffers_echo, length > 0 && strstr(written, "\"own\"") != 0);

  // Buffers are made by the scene, not by shaders.
  Edit_fb edit(tag);
  COVER(oriel_framebuffers_set_boolean, !edit->set("own", "user", false));
  COVER(oriel_framebuffers_set_integer, !edit->set("own", "user", 1));
  COVER(oriel_framebuffers_set_scalar, !edit->set("own", "user", 1.0f));
  COVER(oriel_framebuffers_set_string, !edit->set("own", "datatype", "rgb"));
  edit->reset();
  COVER(oriel_framebuffers_reset, fb->get("own", "datatype", text));
  COVER(oriel_framebuffers_create, interface->createFramebuffer() == miNULLTAG);
  COVER(oriel_framebuffers_copy, interface->copyFramebuffer(tag) == tag);
  oriel_framebuffers* opened = oriel_framebuffers_open(tag, miFALSE);
  COVER(oriel_framebuffers_open, opened != 0 && oriel_framebuffers_open(tag, miTRUE) == 0);
  oriel_framebuffers_close(opened);
  oriel_framebuffers_close(0);
  COVER(oriel_framebuffers_close, 1);

  miColor put = paint(.25, .5, .75), got = paint(0, 0, 0);
  fb->get_index("own", index);
  COVER(mi_fb_put, mi_fb_put(state, static_cast<int>(index), &put));
  COVER(mi_fb_get, mi_fb_get(state, static_cast<int>(index), &got) && SHOWS(got, .25, .5, .75));
  COVER(mi_fb_put, !mi_fb_put(state, 77, &put));
  COVER(mi_fb_get, !mi_fb_get(state, 77, &got));
}

}  // namespace

extern "C" DLLEXPORT miBoolean cover_classes(miColor* result, miState* state,
                                             cover_classes* paras) {
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  Interface* interface = Interface::get();
  COVER(mi_get_shader_interface, interface != 0 && mi_get_shader_interface(99) == 0);
  if (interface == 0) return miFALSE;
  lights(state, paras);
  spectrum(state);
  options(state, interface);
  buffers(state, interface);
  interface->release();
  return miTRUE;
}
