/* SPDX-License-Identifier: Apache-2.0 */
/* The three ways to end the rendering; of mi_fatal and mi_nfatal nothing comes back. */
#include "coverage.h"

struct cover_stop {
  miInteger way;
};

DLLEXPORT miBoolean cover_stop(miColor* result, miState* state, struct cover_stop* paras) {
  *result = paint(0, 1, 0);
  switch (*mi_eval_integer(&paras->way)) {
    case 0:
      mi_abort();
      COVER(mi_abort, mi_par_aborted());
      break;
    case 1:
      COVER(mi_fatal, 1);
      mi_fatal("covered: %s", "mi_fatal");
      COVER(mi_fatal, 0);
      break;
    default:
      COVER(mi_nfatal, 1);
      mi_nfatal(19, "covered: %s", "mi_nfatal");
      COVER(mi_nfatal, 0);
  }
  return miTRUE;
}
