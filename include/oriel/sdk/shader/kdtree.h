// SPDX-License-Identifier: Apache-2.0
// How does a shader keep points, and find those near a place?
#ifndef ORIEL_SDK_KDTREE_H
#define ORIEL_SDK_KDTREE_H

// Conventions
//   A tree holds points of `dimension` coordinates, each with `size` bytes of data. Its tag is an
//   element of the database, to the end of the frame. All calls may run in several threads at once.
//   The arguments are Oriel's choice: no description of them was available.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A tree that is open; opaque.
typedef struct miKdtree miKdtree;

/// Gets a point that was found, its data, which may be written, and its distance (0 when nothing
/// was looked for); miFALSE ends the search.
typedef miBoolean (*miKdtree_callback)(void* arg, const miScalar* point, void* data,
                                       miScalar distance);

/// A new, empty tree of 1 to 64 coordinates and 0 to 65536 bytes of data a point; 0: not possible.
miTag mi_kdtree_create(int dimension, int size);
/// Opens a tree to add to it, until mi_kdtree_unpin; NULL: there is no such tree.
miKdtree* mi_kdtree_edit(miTag tag);
/// Opens a tree to look into it, until mi_kdtree_unpin; NULL: there is no such tree.
miKdtree* mi_kdtree_access(miTag tag);
/// Closes a tree once.
void mi_kdtree_unpin(miKdtree* tree);
/// Adds a point and a copy of its data (NULL: zeros); miFALSE: a coordinate is not finite,
/// or there is no memory.
miBoolean mi_kdtree_add(miKdtree* tree, const miScalar* point, const void* data);
/// Calls back for the points within a radius, the nearest first, at most so many (0: all). Number
/// of points that were handed out.
int mi_kdtree_lookup(miKdtree* tree, const miScalar* place, miScalar radius, int most,
                     miKdtree_callback callback, void* arg);
/// Calls back for all points in the order in which they were added. Number of points handed out.
int mi_kdtree_iterate(miKdtree* tree, miKdtree_callback callback, void* arg);
/// Ends a tree; it is deleted when no caller has it open.
void mi_kdtree_delete(miTag tag);

#ifdef __cplusplus
}
#endif

#endif
