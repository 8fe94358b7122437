/* SPDX-License-Identifier: Apache-2.0 */
/* Colours of two layers. */
#pragma once
#ifdef __cplusplus
extern "C" {
#endif
typedef enum { cplib_OVER, cplib_ADD, cplib_MULTIPLY, cplib_N_MODES } cplib_mode;
/* to = a and b by mode; to may be a or b. */
void cplib_mix(miColor *to, const miColor *a, const miColor *b, cplib_mode mode);
#ifdef __cplusplus
}
#endif
