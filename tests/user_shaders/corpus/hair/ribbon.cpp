// SPDX-License-Identifier: Apache-2.0
// Flat hairs that face the camera and become thinner: normals, radius and coordinate of each vertex.
#include <vector>

#include <shader.h>
#include <geoshader.h>

struct cp_ribbon {
  int i_x, n_x;
  miScalar x[1];
  miScalar root, tip;
};

namespace {

const int kVertices = 4;
const miScalar kLow = -6, kHigh = 6;

/// Collects hairs as the interface wants them.
class HairWriter {
 public:
  HairWriter() : offsets_(1, 0) {}

  template <typename T>
  HairWriter& operator<<(T value) {
    scalars_.push_back(static_cast<miScalar>(value));
    return *this;
  }
  void end_hair() { offsets_.push_back(static_cast<int>(scalars_.size())); }

  void write() const {
    miScalar* to = mi_api_hair_scalars_begin(static_cast<int>(scalars_.size()));
    memcpy(to, &scalars_[0], scalars_.size() * sizeof(miScalar));
    mi_api_hair_scalars_end(static_cast<int>(scalars_.size()));
    mi_api_hair_hairs_begin(static_cast<int>(offsets_.size()));
    for (std::vector<int>::const_iterator o = offsets_.begin(); o != offsets_.end(); ++o)
      mi_api_hair_hairs_add(*o);
    mi_api_hair_hairs_end();
  }

 private:
  std::vector<miScalar> scalars_;
  std::vector<int> offsets_;
};

}  // namespace

extern "C" {

DLLEXPORT int cp_ribbon_version(void) { return 2; }

DLLEXPORT miBoolean cp_ribbon(miTag* result, miState* state, cp_ribbon* paras) {
  const miScalar* x = mi_eval_scalar(paras->x) + *mi_eval_integer(&paras->i_x);
  const int n = *mi_eval_integer(&paras->n_x);
  const miScalar root = *mi_eval_scalar(&paras->root), tip = *mi_eval_scalar(&paras->tip);
  miObject* const object = mi_api_object_begin(mi_mem_strdup("cp_ribbon"));
  object->visible = miTRUE;
  miHair_list* const list = mi_api_hair_begin();
  miApprox approx;
  miAPPROX_DEFAULT(approx);
  approx.cnst[miCNST_UPARAM] = 2;
  list->approx = approx;
  list->degree = 1;
  mi_api_hair_info(1, 'n', 3);
  mi_api_hair_info(1, 't', 1);
  mi_api_hair_info(1, 'r', 1);
  HairWriter writer;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < kVertices; ++k) {
      const miScalar t = miScalar(k) / (kVertices - 1);
      writer << x[i] << kLow + t * (kHigh - kLow) << 0;
      writer << 0 << 0 << 1 << t << root + t * (tip - root);
    }
    writer.end_hair();
  }
  writer.write();
  mi_api_hair_end();
  return mi_geoshader_add_result(result, mi_api_object_end());
}

}
