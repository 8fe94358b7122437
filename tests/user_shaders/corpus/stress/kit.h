// SPDX-License-Identifier: Apache-2.0
// A kit that makes the C functions of a shader from a class, one object for each call of the scene.
#ifndef CORPUS_KIT_H
#define CORPUS_KIT_H

#include <shader.h>

template <class Shader, class Paras>
class ShaderKit {
 public:
  typedef Paras ParamType;

  static void init_class(miState*, miBoolean* needs_instances) { *needs_instances = miTRUE; }
  static void exit_class(miState*) {}
  void init(miState*, Paras*) {}

  static void make(miState* state, Paras* paras) {
    Shader* const made = new Shader;
    *slot(state) = made;
    made->init(state, paras);
  }
  static void end(miState* state) {
    delete of(state);
    *slot(state) = 0;
  }
  static Shader* of(miState* state) { return static_cast<Shader*>(*slot(state)); }

 private:
  static void** slot(miState* state) {
    void** user = 0;
    mi_query(miQ_FUNC_USERPTR, state, miNULLTAG, &user);
    return user;
  }
};

/// The functions of a shader NAME, whose class is CLASS, with a result of type RESULT.
#define KIT_EXPOSE(NAME, CLASS, RESULT, VERSION)                                            \
  extern "C" {                                                                              \
  DLLEXPORT int NAME##_version(void) { return VERSION; }                                    \
  DLLEXPORT void NAME##_init(miState* state, CLASS::ParamType* paras, miBoolean* needs) {   \
    if (paras)                                                                              \
      CLASS::make(state, paras);                                                            \
    else                                                                                    \
      CLASS::init_class(state, needs);                                                      \
  }                                                                                         \
  DLLEXPORT void NAME##_exit(miState* state, CLASS::ParamType* paras) {                     \
    if (paras)                                                                              \
      CLASS::end(state);                                                                    \
    else                                                                                    \
      CLASS::exit_class(state);                                                             \
  }                                                                                         \
  DLLEXPORT miBoolean NAME(RESULT* result, miState* state, CLASS::ParamType* paras) {       \
    CLASS* const shader = CLASS::of(state);                                                 \
    return shader ? (*shader)(result, state, paras) : miFALSE;                              \
  }                                                                                         \
  }

#endif
