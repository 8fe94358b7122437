/* SPDX-License-Identifier: Apache-2.0 */
/* Macros that the illumination shaders of this folder share. */
#ifndef CORPUS_ILLUM_H
#define CORPUS_ILLUM_H

#define BLACK(col)      ((col)->r = (col)->g = (col)->b = (col)->a = 0.0f)
#define MULADD(to, c1, c2, f) \
    ((to)->r += (c1)->r * (c2)->r * (f), \
     (to)->g += (c1)->g * (c2)->g * (f), \
     (to)->b += (c1)->b * (c2)->b * (f))

/* Declarations first: light lists come as start, number and elements. */
#define LIGHT_VARS      int m_, n_l, i_l; miTag *light
#define LIGHT_LIST(p)                                           \
    do {                                                        \
        m_ = *mi_eval_integer(&(p)->mode);                      \
        n_l = *mi_eval_integer(&(p)->n_light);                  \
        i_l = *mi_eval_integer(&(p)->i_light);                  \
        light = mi_eval_tag((p)->light) + i_l;                  \
        switch (m_) {                                           \
          case 1: mi_inclusive_lightlist(&n_l, &light, state); break; \
          case 2: mi_exclusive_lightlist(&n_l, &light, state); break; \
          case 4: n_l = 0; light = 0;                           \
                  mi_instance_lightlist(&n_l, &light, state); break; \
        }                                                       \
    } while (0)

#endif
