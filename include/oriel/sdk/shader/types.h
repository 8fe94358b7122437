// SPDX-License-Identifier: Apache-2.0
// Types and constants for shaders: numbers, vectors, colours, tags.
#ifndef ORIEL_SDK_TYPES_H
#define ORIEL_SDK_TYPES_H

// Conventions
//   Valid as C99 and as C++98 and later. Only mi*, MI*, RAY*, DLL* (and oriel_*, ORIEL_*) enter the
//   global namespace, in addition to constants that shaders expect here.
//   Every basic parameter type consists of 4-byte units, see shader/scene.h.

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Interface level: RAYnm stands for "at least n.m".
#define RAY2 1
#define RAY3 1
#define RAY31 1
#define RAY32 1
#define RAY33 1
#define RAY34 1
#define RAY35 1
#define RAY36 1

/// Shaders are found by name in their shared library; no export declaration is required.
#ifndef DLLEXPORT
#define DLLEXPORT
#endif
#ifndef DLLIMPORT
#define DLLIMPORT
#endif

#ifdef __cplusplus
#define miC_LINKAGE extern "C"
#else
#define miC_LINKAGE
#endif

/// Lets the compiler check the arguments of messages: `format` and `first` count from 1.
#if defined(__GNUC__)
#define ORIEL_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define ORIEL_PRINTF(format_index, first)
#endif

/// The square root of the vector macros; a shader may define its own in advance.
#ifndef MI_SQRT
#define MI_SQRT sqrt
#endif

typedef int miBoolean;
typedef unsigned char miCBoolean;
typedef int miInteger;
typedef float miScalar;
typedef double miGeoScalar;
typedef unsigned int miUint;
typedef unsigned int miUint4;
typedef signed int miSint4;
typedef unsigned short miUshort;
typedef unsigned short miUint2;
typedef signed short miSint2;
typedef unsigned short miIndex;
typedef unsigned char miUchar;
typedef unsigned char miUint1;
typedef signed char miSchar;
typedef signed char miSint1;
typedef unsigned long miUlong;
typedef signed long miSlong;
typedef unsigned int miGeoIndex;
typedef size_t miIntptr;

/// Handle of an element of the scene; 0 = none.
typedef unsigned int miTag;

/// Row vectors multiply on the left, p' = p * M; the translation is in 12..14.
typedef miScalar miMatrix[16];

typedef struct miVector {
  miScalar x, y, z;
} miVector;

typedef struct miVector2d {
  miScalar u, v;
} miVector2d;

typedef struct miGeoVector {
  miGeoScalar x, y, z;
} miGeoVector;

typedef struct miGeoVector2d {
  miGeoScalar u, v;
} miGeoVector2d;

typedef struct miQuaternion {
  miScalar x, y, z, w;
} miQuaternion;

/// Linear colour; a is opacity.
typedef struct miColor {
  miScalar r, g, b, a;
} miColor;

typedef struct miRange {
  miScalar min, max;
} miRange;

typedef struct miGeoRange {
  miGeoScalar min, max;
} miGeoRange;

/// 8 bytes on every platform.
typedef union miPointer {
  void* p;
  miUint4 padding[2];
} miPointer;

/// Opaque; created by mi_init_lock.
typedef union miLock {
  void* p;
  miUint4 padding[2];
} miLock;

typedef miBoolean (*miFunction_ptr)(void);

/// Parameter of type spectrum; the first 4 entries hold CIE XYZ.
typedef float miSpectrum_para[74];

/// For mi_spectrum_* only.
typedef struct miSpectrum {
  miSpectrum_para value;
} miSpectrum;

#define miFALSE 0
#define miTRUE 1

#define miNULLTAG ((miTag)0)
#define miNOLIGHTS ((miTag)0xffffffffU)
#define miGHOSTTAG ((miTag)0xffffffffU)

#define miSCALAR_EPSILON ((miScalar)1.0e-5)
#define miGEO_SCALAR_EPSILON ((miGeoScalar)1.0e-9)
#define miHUGE_SCALAR ((miScalar)1.0e36)
#define miHUGE_INT 0x7fffffff
#define miNULL_INDEX ((miIndex)0xffffU)
#define miMAX_INDEX ((miIndex)0xfffeU)
#define miNULL_GEOINDEX ((miGeoIndex)0xffffffffU)
#define miMAX_GEOINDEX ((miGeoIndex)0xfffffffeU)

/// Maximum number of texture spaces of an object.
#define MAX_TEX 64
/// Number of vectors in miState::derivs.
#define NO_DERIVS 5

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif
#ifndef M_PI_F
#define M_PI_F 3.14159265358979323846f
#endif
#ifndef M_PI_2
#define M_PI_2 1.57079632679489661923
#endif
#ifndef M_SQRT1_2
#define M_SQRT1_2 0.70710678118654752440
#endif

#endif
