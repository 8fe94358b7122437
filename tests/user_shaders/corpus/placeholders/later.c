/* SPDX-License-Identifier: Apache-2.0 */
/* Boxes whose content is made when it is needed: the arguments live until then. */
#include <shader.h>
#include <geoshader.h>

struct room { miTag name; miScalar half, height; };
struct cp_later { int i_room, n_room; struct room room[1]; };

/* What a callback must know. */
typedef struct { double half, height; miUint label; } content_t;

DLLEXPORT int cp_later_version(void) { return 1; }

static miBoolean fill(miTag tag, content_t *content)
{
    static const int x[] = { -1, 1, 1, -1 }, y[] = { -1, -1, 1, 1 };
    const char *name = mi_api_tag_lookup(tag);
    miObject *o;
    miVector v;
    int i;

    if (!name)
        return miFALSE;
    mi_api_incremental(miTRUE);
    if (!(o = mi_api_object_begin(mi_mem_strdup(name))))
        return miFALSE;
    if (o->label != content->label)
        mi_error("cp_later: %s has lost its label", name);
    mi_api_basis_list_clear();
    mi_api_object_group_begin(0.0);
    for (i = 0; i < 4; i++) {
        v.x = x[i] * content->half;
        v.y = y[i] * content->half;
        v.z = content->height;
        mi_api_vector_xyz_add(&v);
    }
    for (i = 0; i < 4; i++)
        mi_api_vertex_add(i);
    mi_api_poly_begin_tag(1, miNULLTAG);
    for (i = 0; i < 4; i++)
        mi_api_poly_index_add(i);
    mi_api_poly_end();
    mi_api_object_group_end();
    mi_api_object_end();
    mi_mem_release(content);
    return miTRUE;
}

DLLEXPORT miBoolean cp_later(miTag *result, miState *state, struct cp_later *paras)
{
    int n = *mi_eval_integer(&paras->n_room), i = *mi_eval_integer(&paras->i_room);
    struct room *r = (struct room *)mi_eval(state, paras->room) + i;
    content_t *content;
    miObject *o;

    for (i = 0; i < n; i++, r++) {
        content = (content_t *)mi_mem_allocate(sizeof(content_t));
        o = mi_api_object_begin(mi_mem_strdup((char *)mi_db_access(r->name)));
        mi_db_unpin(r->name);
        o->visible = o->shadow = miTRUE;
        o->label = content->label = 40 + i;
        o->bbox_min.x = o->bbox_min.y = -r->half;
        o->bbox_max.x = o->bbox_max.y = r->half;
        o->bbox_min.z = o->bbox_max.z = r->height;
        mi_api_object_callback((miApi_object_callback)fill, content);
        mi_geoshader_add_result(result, mi_api_object_end());
        /* Only now is it known what the box holds. */
        content->half = r->half;
        content->height = r->height;
    }
    return miTRUE;
}
