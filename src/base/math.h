// SPDX-License-Identifier: Apache-2.0
// Transcendental functions with bit-identical results on every processor and C library.
#pragma once

namespace oriel::math {

// C libraries select implementations by processor, and their results differ in the last bit. These
// functions use only IEEE additions, multiplications, divisions, square roots and explicit fused
// multiply-adds in double precision, which the standard defines exactly.
//
// Model:   argument reduction and Taylor or atanh series; see math.cpp for error bounds.
// Inputs:  any value; special values (zeros, infinities, NaN, poles) as in C99 Annex F.
// Returns: float versions: within 0.51 ulp (pow: 0.52); double versions: within 3 ulp (pow: 16).
// Checked: Math.*

float sin(float x);
float cos(float x);
float tan(float x);
float asin(float x);
float acos(float x);
float atan(float x);
float atan2(float y, float x);
float exp(float x);
float exp2(float x);
float expm1(float x);
float log(float x);
float log2(float x);
float log10(float x);
float log1p(float x);
float pow(float x, float y);
float cbrt(float x);
float hypot(float x, float y);

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double exp(double x);
double exp2(double x);
double log(double x);
double log2(double x);
double log10(double x);
double pow(double x, double y);
double hypot(double x, double y);

}  // namespace oriel::math
