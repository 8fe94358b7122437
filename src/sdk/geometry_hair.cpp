// SPDX-License-Identifier: Apache-2.0
// Hair made by geometry shaders: the same element as `hair ... end hair` in scene files.
#include <algorithm>
#include <cmath>
#include <new>

#include "sdk/geometry_work.h"
#include "sdk/once.h"

namespace oriel::sdk {
namespace {

using scene::Hair;
using FieldKind = Hair::Field::Kind;

/// As in scene files: larger numbers are assumed to be errors.
constexpr int kMaxHairNumbers = 256;

HairWork* open_hair() {
  GeometryWork* work = GeometryWork::current();
  return work && work->hair.open ? &work->hair : nullptr;
}

/// A field of n numbers; false for unknown letters and invalid numbers.
bool field_of(char what, int n, Hair::Field& field) {
  if (n < 0 || n > kMaxHairNumbers) return false;
  switch (what) {
    case 'n':
      field = {FieldKind::Normal, 1};
      return n == 3;
    case 'm':
      field = {FieldKind::Motion, n / 3};
      return n % 3 == 0;
    case 't':
      field = {FieldKind::Texture, n};
      return true;
    case 'r':
      field = {FieldKind::Radius, 1};
      return n == 1;
    case 'u':
      field = {FieldKind::User, n};
      return true;
    default:
      return false;
  }
}

/// Memory for n more entries; null if out of memory.
template <class T>
T* room(std::vector<T>& list, int n) {
  if (n < 0) return nullptr;
  try {
    list.assign(static_cast<std::size_t>(n), T(0));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return list.data();
}

/// Removes invalid data: non-finite numbers and hairs out of range.
void clean(Hair& hair) {
  std::replace_if(
      hair.scalars.begin(), hair.scalars.end(), [](float f) { return !std::isfinite(f); }, 0.0f);
  auto& first = hair.first;
  const auto good = std::is_sorted_until(first.begin(), first.end());
  const auto end =
      std::find_if(first.begin(), good, [&](std::uint32_t i) { return i > hair.scalars.size(); });
  if (end == first.end()) return;
  warn_once("OR-SDK-040",
            "a geometry shader uses hair scalars that it did not write; these hairs are dropped");
  first.erase(end, first.end());
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miHair_list* mi_api_hair_begin(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work) {
    thread_local miHair_list nowhere;
    nowhere = {};
    return &nowhere;
  }
  work->hair = {};
  work->hair.open = true;
  work->hair.list.radius = 1;
  work->hair.list.degree = 1;
  return &work->hair.list;
}

miBoolean mi_api_hair_info(int where, char what, int n) {
  HairWork* hair = open_hair();
  Hair::Field field;
  if (!hair || where < 0 || where > 1 || !field_of(what, n, field)) return miFALSE;
  auto& fields = where == 0 ? hair->hair.per_hair : hair->hair.per_vertex;
  if (fields.size() >= static_cast<std::size_t>(kMaxHairNumbers)) return miFALSE;
  fields.push_back(field);
  return miTRUE;
}

miScalar* mi_api_hair_scalars_begin(int n) {
  HairWork* hair = open_hair();
  return hair ? room(hair->hair.scalars, n) : nullptr;
}

miBoolean mi_api_hair_scalars_end(int n) {
  HairWork* hair = open_hair();
  if (!hair || n < 0 || static_cast<std::size_t>(n) > hair->hair.scalars.size()) return miFALSE;
  hair->hair.scalars.resize(static_cast<std::size_t>(n));
  return miTRUE;
}

miGeoIndex* mi_api_hair_hairs_begin(int n) {
  HairWork* hair = open_hair();
  if (!hair) return nullptr;
  hair->added = 0;
  hair->adds = false;
  return room(hair->hair.first, n);
}

miBoolean mi_api_hair_hairs_add(int offset) {
  HairWork* hair = open_hair();
  if (!hair || offset < 0) return miFALSE;
  auto& first = hair->hair.first;
  if (hair->added == first.size()) first.push_back(0);
  first[hair->added++] = static_cast<std::uint32_t>(offset);
  hair->adds = true;
  return miTRUE;
}

miBoolean mi_api_hair_hairs_end(void) {
  HairWork* hair = open_hair();
  if (!hair) return miFALSE;
  if (hair->adds) hair->hair.first.resize(hair->added);
  return miTRUE;
}

void mi_api_hair_end(void) {
  HairWork* work = open_hair();
  if (!work) return;
  Hair& hair = work->hair;
  const miHair_list& list = work->list;
  if (const std::string* material = GeometryWork::name_of(list.material)) hair.material = *material;
  hair.radius = std::isfinite(list.radius) ? std::max(0.0f, list.radius) : 0.0f;
  hair.degree = std::clamp(list.degree, 1, 3);
  if (list.approx > 0) hair.approximate = list.approx;
  if (list.space_max_size > 0) hair.max_size = list.space_max_size;
  if (list.space_max_depth > 0) hair.max_depth = list.space_max_depth;
  clean(hair);
  GeometryWork& made = *GeometryWork::current();
  const auto record = made.objects.find(made.object.name);
  if (record != made.objects.end()) {
    record->second->flags.type = miOBJECT_HAIR;
    record->second->flags.geo.hair_list = list;
    made.object.hairs.push_back(std::move(hair));
  }
  made.hair = {};
}

}  // extern "C"
