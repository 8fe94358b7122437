// SPDX-License-Identifier: Apache-2.0
// A hierarchy of waves: init makes the objects that a call needs, exit deletes them.
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include <shader.h>

struct cp_ladder {
  int i_wave, n_wave;
  struct {
    miTag kind;
    miScalar size;
  } wave[1];
};

namespace {

class Wave {
 public:
  explicit Wave(miScalar size) : size_(size) { ++alive; }
  virtual ~Wave() { --alive; }
  virtual miScalar at(const miVector& p) const = 0;
  static int alive;

 protected:
  const miScalar size_;

 private:
  Wave(const Wave&);
  void operator=(const Wave&);
};
int Wave::alive = 0;

class Sine : public Wave {
 public:
  explicit Sine(miScalar size) : Wave(size) {}
  virtual miScalar at(const miVector& p) const { return miScalar(std::sin(p.x / size_)); }
};

class Rings : virtual public Wave {
 public:
  explicit Rings(miScalar size) : Wave(size) {}
  virtual ~Rings() {}
  virtual miScalar at(const miVector& p) const {
    return miScalar(std::cos(std::sqrt(double(p.x * p.x + p.y * p.y)) / size_));
  }
};

class HalfRings : public Rings {
 public:
  explicit HalfRings(miScalar size) : Wave(size), Rings(size) {}
  virtual miScalar at(const miVector& p) const { return p.y > 0 ? Rings::at(p) : miScalar(0); }
};

/// Owns its waves.
class Sum : public Wave {
 public:
  Sum() : Wave(1) {}
  virtual ~Sum() {
    for (std::vector<Wave*>::iterator w = waves_.begin(); w != waves_.end(); ++w) delete *w;
  }
  void add(Wave* wave) {
    if (wave) waves_.push_back(wave);
  }
  virtual miScalar at(const miVector& p) const {
    miScalar sum = 0;
    for (std::vector<Wave*>::const_iterator w = waves_.begin(); w != waves_.end(); ++w)
      sum += (*w)->at(p);
    return sum;
  }

 private:
  std::vector<Wave*> waves_;
};

Wave* wave_of(const char* kind, miScalar size) {
  if (!std::strcmp(kind, "sine")) return new Sine(size);
  if (!std::strcmp(kind, "rings")) return new Rings(size);
  if (!std::strcmp(kind, "half rings")) return new HalfRings(size);
  mi_warning("cp_ladder: unknown wave \"%s\"", kind);
  return 0;
}

}  // namespace

extern "C" {

DLLEXPORT int cp_ladder_version(void) { return 1; }

DLLEXPORT void cp_ladder_init(miState* state, cp_ladder* paras, miBoolean* inst_init_req) {
  if (!paras) {
    *inst_init_req = miTRUE;
    return;
  }
  std::auto_ptr<Sum> sum(new Sum);
  const int n = *mi_eval_integer(&paras->n_wave), first = *mi_eval_integer(&paras->i_wave);
  for (int i = first; i < first + n; ++i) {
    const miTag kind = *mi_eval_tag(&paras->wave[i].kind);
    sum->add(wave_of(static_cast<const char*>(mi_db_access(kind)),
                     *mi_eval_scalar(&paras->wave[i].size)));
    mi_db_unpin(kind);
  }
  void** user;
  mi_query(miQ_FUNC_USERPTR, state, 0, &user);
  *user = static_cast<Wave*>(sum.release());
}

DLLEXPORT void cp_ladder_exit(miState* state, cp_ladder* paras) {
  if (!paras) {
    if (Wave::alive != 0) mi_error("cp_ladder: %d waves are left", Wave::alive);
    return;
  }
  void** user;
  mi_query(miQ_FUNC_USERPTR, state, 0, &user);
  delete static_cast<Wave*>(*user);
  *user = 0;
}

DLLEXPORT miBoolean cp_ladder(miColor* result, miState* state, cp_ladder* paras) {
  void** user;
  if (!mi_query(miQ_FUNC_USERPTR, state, 0, &user) || !*user) return miFALSE;
  const miScalar v = static_cast<const Wave*>(*user)->at(state->point) * .125f;
  result->r = v > 0 ? v : 0;
  result->g = v < 0 ? -v : 0;
  result->b = 0;
  result->a = 1;
  return miTRUE;
}

}
