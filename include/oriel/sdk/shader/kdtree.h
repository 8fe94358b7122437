// SPDX-License-Identifier: Apache-2.0
// Storage of points with nearest-neighbour search.
#ifndef ORIEL_SDK_KDTREE_H
#define ORIEL_SDK_KDTREE_H

// Conventions
//   A tree stores points of `dimension` coordinates, each with `size` bytes of data. Its tag is an
//   element of the database until the end of the frame. All functions are thread-safe. The
//   signatures are specific to Oriel, because no description of them was available.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An open tree; opaque.
typedef struct miKdtree miKdtree;

/// Receives a point, its data, which may be modified, and its distance (0 if there was no search
/// position); returning miFALSE ends the search.
typedef miBoolean (*miKdtree_callback)(void* arg, const miScalar* point, void* data,
                                       miScalar distance);

/// Creates an empty tree with 1 to 64 coordinates and 0 to 65536 bytes of data per point; returns 0
/// on failure.
miTag mi_kdtree_create(int dimension, int size);
/// Opens a tree for adding points, until mi_kdtree_unpin; NULL if there is no such tree.
miKdtree* mi_kdtree_edit(miTag tag);
/// Opens a tree for searching, until mi_kdtree_unpin; NULL if there is no such tree.
miKdtree* mi_kdtree_access(miTag tag);
/// Closes a tree once.
void mi_kdtree_unpin(miKdtree* tree);
/// Adds a point and a copy of its data (NULL: zeros); miFALSE if a coordinate is not finite or
/// there is no memory.
miBoolean mi_kdtree_add(miKdtree* tree, const miScalar* point, const void* data);
/// Calls back for the points within a radius, the nearest first, at most `most` (0: all). Returns
/// the number of reported points.
int mi_kdtree_lookup(miKdtree* tree, const miScalar* place, miScalar radius, int most,
                     miKdtree_callback callback, void* arg);
/// Calls back for all points in insertion order. Returns the number of reported points.
int mi_kdtree_iterate(miKdtree* tree, miKdtree_callback callback, void* arg);
/// Deletes a tree as soon as no caller has it open.
void mi_kdtree_delete(miTag tag);

#ifdef __cplusplus
}
#endif

#endif
