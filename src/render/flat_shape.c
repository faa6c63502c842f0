#include "render/flat_shape.h"

#include <string.h>

#include "core/scene_shape.h"
#include "core/world_build.h"
#include "render/frame.h"
#include "render/shape.h"

static void add_edges(WeirFlatShapes *flat, WeirFlatShape *to, const WeirShape *shape, const double origin[3])
{
    to->first_edge = flat->edge_count;
    for (uint32_t k = 0; k < shape->point_count; k++) {
        const double *ends[2] = {&shape->points[2 * (size_t)k],
                                 &shape->points[2 * (size_t)((k + 1) % shape->point_count)]};
        // A corner given twice is no edge.
        if (memcmp(ends[0], ends[1], 2 * sizeof(double)) == 0) continue;
        if (flat->edge_count == WEIR_FLAT_EDGES) {
            flat->failed = true;
            return;
        }
        float *edge = flat->edges[flat->edge_count++];
        for (int i = 0; i < 4; i++) edge[i] = (float)(ends[i / 2][i % 2] - origin[i % 2]);
    }
    to->edge_count = flat->edge_count - to->first_edge;
}

static void add_piece(WeirFlatShapes *flat, const WeirScene *scene, const WeirSolidPiece *piece,
                      uint32_t solid, bool is_body)
{
    const WeirParameters parameters = weir_scene_resolved(scene);
    double origin[3], low[3], high[3];
    weir_piece_reference(piece, 2, origin);
    weir_shape_bounds(&piece->shape, 2, low, high);
    WeirFlatShape *shape = &flat->shapes[flat->count++];
    *shape = (WeirFlatShape){
        .kind = (uint32_t)piece->shape.kind, .solid = solid, .moves = is_body || piece->is_driven};
    for (int k = 0; k < 2; k++) {
        shape->low[k] = (float)(low[k] - origin[k]);
        shape->high[k] = (float)(high[k] - origin[k]);
    }
    if (piece->inside) shape->band = (float)weir_wall_layers(&parameters) * parameters.particle_spacing;
    if (piece->shape.kind == WEIR_SHAPE_POLYGON) add_edges(flat, shape, &piece->shape, origin);
}

void weir_flat_shapes_of(WeirFlatShapes *flat, const WeirScene *scene)
{
    flat->count = flat->edge_count = 0;
    flat->failed = false;
    for (uint32_t n = 0; n < scene->wall_count + scene->body_count; n++) {
        const WeirSolidPiece *piece = weir_shown_piece(scene, n);
        uint32_t solid = weir_scene_first_wall(scene) + n;
        if (piece) add_piece(flat, scene, piece, solid, n >= scene->wall_count);
    }
}
