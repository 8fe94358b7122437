// SPDX-License-Identifier: Apache-2.0
// A sphere of triangles, from containers of indices; normals are shared.
#include <cmath>
#include <vector>

#include <shader.h>
#include <geoshader.h>

struct cp_ball {
  miScalar radius;
  miInteger rings;
};

namespace {

struct Triangle { int a, b, c; };

class Mesh {
 public:
  explicit Mesh(int rings) : around_(2 * rings) {
    for (int j = 0; j <= rings; ++j)
      for (int i = 0; i <= around_; ++i) {
        const double t = M_PI * j / rings, p = 2 * M_PI * i / around_;
        miVector v = {(miScalar)(sin(t) * cos(p)), (miScalar)(sin(t) * sin(p)), (miScalar)cos(t)};
        points_.push_back(v);
      }
    for (int j = 0; j < rings; ++j)
      for (int i = 0; i < around_; ++i) {
        const int a = j * (around_ + 1) + i, b = a + around_ + 1;
        const Triangle first = {a, b, b + 1}, second = {a, b + 1, a + 1};
        if (j + 1 < rings) triangles_.push_back(first);
        if (j > 0) triangles_.push_back(second);
      }
  }

  miTag object(const char* name, miScalar radius) const {
    miObject* object = mi_api_object_begin(mi_mem_strdup(name));
    object->visible = miTRUE;
    mi_api_basis_list_clear();
    mi_api_object_group_begin(0.0);
    const int n = (int)points_.size();
    for (int i = 0; i < n; ++i) {
      miVector v = points_[i];
      mi_vector_mul(&v, radius);
      mi_api_vector_xyz_add(&v);
    }
    for (int i = 0; i < n; ++i) {
      miVector normal = points_[i];
      mi_api_vector_xyz_add(&normal);
    }
    for (int i = 0; i < n; ++i) {
      mi_api_vertex_add(i);
      mi_api_vertex_normal_add(n + i);
    }
    for (std::vector<Triangle>::const_iterator t = triangles_.begin(); t != triangles_.end(); ++t) {
      mi_api_poly_begin_tag(1, miNULLTAG);
      mi_api_poly_index_add(t->a);
      mi_api_poly_index_add(t->b);
      mi_api_poly_index_add(t->c);
      mi_api_poly_end();
    }
    mi_api_object_group_end();
    return mi_api_object_end();
  }

 private:
  int around_;
  std::vector<miVector> points_;
  std::vector<Triangle> triangles_;
};

}  // namespace

extern "C" DLLEXPORT int cp_ball_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_ball(miTag* result, miState* state, cp_ball* paras) {
  const Mesh mesh(*mi_eval_integer(&paras->rings));
  return mi_geoshader_add_result(result, mesh.object("cp_ball", *mi_eval_scalar(&paras->radius)));
}
