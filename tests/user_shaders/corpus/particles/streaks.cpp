// SPDX-License-Identifier: Apache-2.0
// Particles as the tubes that they pass through while the shutter is open.
#include <geoshader.h>
#include <shader.h>
#include <string>

struct cp_particle {
  miVector point, velocity;
};

struct cp_streaks {
  int i_particle, n_particle;
  cp_particle particle[1];
  miScalar shutter, radius;
};

namespace cp {

/// Declares a map field by field.
class MapDeclaration {
 public:
  MapDeclaration() : fields_(0) {}
  MapDeclaration& field(const char* name, int dimension = 0) {
    fields_ = mi_api_map_field_append(
        fields_, mi_api_map_field_decl(miTYPE_SCALAR, mi_mem_strdup(name), dimension, miFALSE));
    return *this;
  }
  bool declare(const std::string& name) {
    const bool made = mi_api_map_decl_begin(mi_mem_strdup(name.c_str()), fields_) != 0;
    mi_api_map_decl_end();
    return made;
  }

 private:
  miParameter* fields_;
};

class MapField {
 public:
  ~MapField() { mi_api_map_field_end(); }
  MapField& operator()(miScalar value) {
    mi_api_map_value(miTYPE_SCALAR, &value);
    return *this;
  }
  MapField& operator()(const miVector& v) { return (*this)(v.x)(v.y)(v.z); }
};

}  // namespace cp

extern "C" DLLEXPORT int cp_streaks_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_streaks(miTag* result, miState* state, cp_streaks* paras) {
  const cp_particle* p =
      reinterpret_cast<cp_particle*>(mi_eval(state, paras->particle)) +
      *mi_eval_integer(&paras->i_particle);
  const int n = *mi_eval_integer(&paras->n_particle);
  const miScalar shutter = *mi_eval_scalar(&paras->shutter);
  const miScalar radius = *mi_eval_scalar(&paras->radius);
  mi_api_map_decl_dim(3);
  if (!cp::MapDeclaration().field("r").field("way", 3).field("reach").declare("cp streaks"))
    return miFALSE;
  miObject* object = mi_api_object_begin(mi_mem_strdup("cp_streaks"));
  object->visible = miTRUE;
  mi_api_map_obj_type(mi_mem_strdup("tubes"));
  static const char* const kShape[][2] = {{"radius", "r"}, {"direction", "way"}, {"length", "reach"}};
  for (int k = 0; k < 3; ++k)
    mi_api_map_obj_field(mi_mem_strdup(kShape[k][0]), mi_mem_strdup(kShape[k][1]));
  mi_api_map_begin(mi_mem_strdup("cp streaks"));
  for (const cp_particle* const end = p + n; p != end; ++p) {
    miVector way = p->velocity;
    const miScalar speed = mi_vector_norm(&way);
    mi_vector_normalize(&way);
    { cp::MapField()(p->point); }
    { cp::MapField()(radius); }
    { cp::MapField()(way); }
    { cp::MapField()(speed * shutter); }
    mi_api_map_element_end();
  }
  const miTag map = mi_api_map_end(0);
  const miTag made = mi_api_object_end();
  return map && mi_geoshader_add_result(result, made);
}
