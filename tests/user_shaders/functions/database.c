/* SPDX-License-Identifier: Apache-2.0 */
/* Elements that a shader makes for itself, and trees of points. */
#include "coverage.h"

static void elements(miState* state) {
  miTag tag = 0, copy;
  int* numbers = mi_db_create(&tag, miSCENE_USERDATA, 4 * (int)sizeof(int));

  COVER(mi_db_create, numbers && tag && numbers[3] == 0);
  COVER(mi_db_create, mi_db_access(tag) == (void*)numbers && mi_db_size(tag) == 16 &&
                          mi_db_type(tag) == miSCENE_USERDATA);
  numbers[3] = 33;
  mi_db_unpin(tag);
  numbers = mi_db_realloc(tag, 1000 * (int)sizeof(int));
  COVER(mi_db_realloc, numbers && numbers[3] == 33 && numbers[999] == 0 && mi_db_size(tag) == 4000);
  COVER(mi_db_realloc, !mi_db_realloc(state->instance, 16));
  copy = mi_db_copy(tag);
  numbers[3] = 34;
  numbers = mi_db_access(copy);
  COVER(mi_db_copy, copy != tag && numbers && numbers[3] == 33);
  mi_db_flush(tag);
  COVER(mi_db_flush, ((int*)mi_db_access(tag))[3] == 34);
  COVER(mi_db_isjob, !mi_db_isjob(tag) && !mi_db_isjob(state->instance));
  mi_db_dump(); /* what it says is looked for where the program says it */
  mi_db_delete(tag);
  mi_db_delete(copy);
  COVER(mi_db_delete, !mi_db_access(tag) && !mi_db_access(copy));
}

struct walk {
  int count, last, stop;
  double sum, distance;
};

static miBoolean step(void* arg, const miScalar* point, void* data, miScalar distance) {
  struct walk* walk = arg;
  walk->count++;
  walk->sum += point[0];
  if (distance < walk->distance) walk->count = -1000; /* not the nearest first */
  walk->distance = distance;
  walk->last = *(int*)data;
  return walk->count != walk->stop;
}

/* The points 0, 1, ... 99 of a line in the plane. */
static void trees(void) {
  const struct walk none = {0, -1, -1, 0, 0};
  const miScalar place[2] = {40.25f, 0}, bad[2] = {HUGE_VAL, 0};
  struct walk walk = none;
  miTag tag = mi_kdtree_create(2, sizeof(int));
  miKdtree* tree = mi_kdtree_edit(tag);
  miScalar point[2] = {0, 0};
  int i, added = 0;

  COVER(mi_kdtree_create, tag && !mi_kdtree_create(0, 0));
  COVER(mi_kdtree_edit, tree && !mi_kdtree_edit(0));
  for (i = 0; i < 100; i++) {
    int number = (7 * i) % 100;
    point[0] = (miScalar)number;
    added += mi_kdtree_add(tree, point, &number);
  }
  COVER(mi_kdtree_add, added == 100 && !mi_kdtree_add(tree, bad, &i));
  mi_kdtree_unpin(tree);
  tree = mi_kdtree_access(tag);
  COVER(mi_kdtree_access, tree && !mi_kdtree_access(0));

  /* 40, 41, 39 and 42 lie within 2 of 40.25, in this order. */
  COVER(mi_kdtree_lookup, mi_kdtree_lookup(tree, place, 2, 0, step, &walk) == 4);
  COVER(mi_kdtree_lookup, walk.count == 4 && walk.last == 42 && NEAR(walk.sum, 162, 0) &&
                              NEAR(walk.distance, 1.75, 1e-6));
  walk = none;
  COVER(mi_kdtree_lookup,
        mi_kdtree_lookup(tree, place, 50, 3, step, &walk) == 3 && walk.last == 39);
  walk = none;
  walk.stop = 1;
  COVER(mi_kdtree_lookup,
        mi_kdtree_lookup(tree, place, 50, 0, step, &walk) == 1 && walk.last == 40);
  COVER(mi_kdtree_lookup, mi_kdtree_lookup(tree, place, .1f, 0, NULL, NULL) == 0);
  walk = none;
  COVER(mi_kdtree_iterate,
        mi_kdtree_iterate(tree, step, &walk) == 100 && walk.last == 93 && NEAR(walk.sum, 4950, 0));
  mi_kdtree_delete(tag);
  COVER(mi_kdtree_delete, !mi_kdtree_access(tag));
  COVER(mi_kdtree_unpin, mi_kdtree_iterate(tree, NULL, NULL) == 100);
  mi_kdtree_unpin(tree);
}

DLLEXPORT miBoolean cover_database(miColor* result, miState* state, void* paras) {
  static int told = 0;
  if (!told) {
    told = 1;
    elements(state);
    trees();
  }
  *result = paint(0, 1, 0);
  return miTRUE;
}
