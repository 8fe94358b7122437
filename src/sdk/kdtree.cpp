// SPDX-License-Identifier: Apache-2.0
// Trees of points for user shaders.
#include "oriel/sdk/shader/kdtree.h"

#include <limits>
#include <memory>
#include <new>

#include "oriel/sdk/shader/system.h"
#include "sdk/current.h"
#include "sdk/host.h"

namespace {

using oriel::geom::PointTree;
using oriel::sdk::current_host;
using oriel::sdk::Host;

// The handle is the address of the tree.
PointTree* tree_of(miKdtree* tree) { return reinterpret_cast<PointTree*>(tree); }

miKdtree* open(miTag tag) {
  Host* host = current_host();
  return reinterpret_cast<miKdtree*>(host ? host->elements().pin(tag) : nullptr);
}

}  // namespace

extern "C" {

miTag mi_kdtree_create(int dimension, int size) {
  Host* host = current_host();
  if (!host || dimension < 1 || dimension > PointTree::kMaxDimensions || size < 0 ||
      static_cast<std::size_t>(size) > PointTree::kMaxData) {
    mi_error("mi_kdtree_create: cannot create a tree of %d coordinates and %d bytes per point",
             dimension, size);
    return miNULLTAG;
  }
  return host->elements().create(
      std::make_shared<PointTree>(dimension, static_cast<std::size_t>(size)));
}

miKdtree* mi_kdtree_edit(miTag tag) { return open(tag); }
miKdtree* mi_kdtree_access(miTag tag) { return open(tag); }

void mi_kdtree_unpin(miKdtree* tree) {
  Host* host = current_host();
  if (host && tree) host->elements().unpin(tree_of(tree));
}

miBoolean mi_kdtree_add(miKdtree* tree, const miScalar* point, const void* data) {
  if (!tree || !point) return miFALSE;
  try {
    return tree_of(tree)->add(point, data) ? miTRUE : miFALSE;
  } catch (const std::bad_alloc&) {
    return miFALSE;
  }
}

// Callbacks run after the search, because they may use the tree themselves.
int mi_kdtree_lookup(miKdtree* tree, const miScalar* place, miScalar radius, int most,
                     miKdtree_callback callback, void* arg) {
  if (!tree || !place || most < 0) return 0;
  const std::size_t wanted =
      most == 0 ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(most);
  int count = 0;
  for (const PointTree::Near& near : tree_of(tree)->near(place, radius, wanted)) {
    ++count;
    if (callback && !callback(arg, near.point.place, near.point.data, near.distance)) break;
  }
  return count;
}

int mi_kdtree_iterate(miKdtree* tree, miKdtree_callback callback, void* arg) {
  if (!tree) return 0;
  int count = 0;
  for (const PointTree::Point& point : tree_of(tree)->all()) {
    ++count;
    if (callback && !callback(arg, point.place, point.data, 0)) break;
  }
  return count;
}

void mi_kdtree_delete(miTag tag) {
  Host* host = current_host();
  if (host) host->elements().erase_tree(tag);
}

}  // extern "C"
