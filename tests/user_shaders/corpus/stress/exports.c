/* SPDX-License-Identifier: Apache-2.0 */
/* The ways in which C sources say that a function is to be found in the library. */
#ifdef WIN_NT
#define DLLEXPORT __declspec(dllexport)
#else
#ifndef DLLEXPORT
#define DLLEXPORT
#endif
#endif
#include <shader.h>

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define EXPORT __attribute__((visibility("default")))
#else
#define EXPORT
#endif
#define SHADER_EXPORT extern DLLEXPORT miBoolean
#define VERSION(name, n) DLLEXPORT int name##_version(void) { return(n); }

struct cp_exports { miInteger nth; };

/* before the type, alone on its line */
DLLEXPORT
miBoolean
cp_exports_first(miScalar *result, miState *state, void *paras) { *result = .1; return miTRUE; }

/* between type and name */
miBoolean DLLEXPORT cp_exports_second(miScalar *result, miState *state, void *paras)
{ *result = .2; return miTRUE; }

/* at the declaration only */
SHADER_EXPORT cp_exports_third(miScalar *, miState *, void *);
miBoolean cp_exports_third(miScalar *result, miState *state, void *paras)
{ *result = .3; return miTRUE; }

/* by a word of the source's own */
EXPORT miBoolean cp_exports_fourth(miScalar *result, miState *state, void *paras)
{ *result = .4; return miTRUE; }

/* not at all */
miBoolean cp_exports_fifth(miScalar *result, miState *state, void *paras)
{ *result = .5; return miTRUE; }

VERSION(cp_exports, 7)
VERSION(cp_exports_first, 1)
VERSION(cp_exports_second, 1)
extern DLLEXPORT int cp_exports_third_version(void) { return 1; }
int DLLEXPORT cp_exports_fourth_version(void) { return 1; }
int cp_exports_fifth_version(void) { return 1; }

DLLEXPORT miBoolean cp_exports(miColor *result, miState *state, struct cp_exports *paras)
{
	static miBoolean (*const all[])(miScalar *, miState *, void *) = {
		cp_exports_first, cp_exports_second, cp_exports_third, cp_exports_fourth,
		cp_exports_fifth
	};
	miScalar value = 0;

	if (!all[*mi_eval_integer(&paras->nth)](&value, state, paras))
		return miFALSE;
	result->r = result->g = result->b = value;
	result->a = 1;
	return miTRUE;
}
