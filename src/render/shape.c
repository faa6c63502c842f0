#include "render/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/exact_math.h"
#include "core/mesh_weld.h"
#include "core/scene_shape.h"
#include "render/frame.h"
#include "weir/weir_render.h"

enum {
    AROUND = 64,            // pieces of a round shape's circumference
    SECTORS = 8,            // of two tones in turn
    MOST_CORNERS = 3 << 20, // 96 MiB: every device binds 128
};
static const float dark_tone = 0.80f;
static const double crease = 0.77; // cosine of the angle above which a mesh has an edge

// Where the triangles of one solid go.
typedef struct Job {
    WeirTriangles *triangles;
    uint32_t solid;
    double reference[3];
} Job;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static bool reserve(WeirTriangles *triangles)
{
    if (triangles->failed) return false;
    if (triangles->count < triangles->capacity) return true;
    uint32_t capacity = triangles->capacity > 0 ? 2 * triangles->capacity : 3072;
    WeirCorner *grown =
        capacity > 2 * MOST_CORNERS ? NULL : realloc(triangles->corners, capacity * sizeof *grown);
    triangles->failed = !grown;
    if (!grown) return false;
    triangles->corners = grown;
    triangles->capacity = capacity;
    return true;
}

static void add(const Job *job, const double place[3], const double normal[3], float tone)
{
    WeirTriangles *triangles = job->triangles;
    if (triangles->count >= MOST_CORNERS) triangles->failed = true;
    if (!reserve(triangles)) return;
    WeirCorner *corner = &triangles->corners[triangles->count++];
    *corner = (WeirCorner){.solid = job->solid, .tone = tone};
    for (int k = 0; k < 3; k++) {
        corner->place[k] = (float)(place[k] - job->reference[k]);
        corner->normal[k] = (float)normal[k];
    }
}

// A quadrilateral, its corners in the order of a strip.
static void add_quad(const Job *job, double places[4][3], double normals[4][3], float tone)
{
    static const int order[6] = {0, 1, 2, 2, 1, 3};
    for (int k = 0; k < 6; k++) add(job, places[order[k]], normals[order[k]], tone);
}

static void add_box(const Job *job, const double low[3], const double high[3])
{
    for (int face = 0; face < 6; face++) {
        int axis = face / 2;
        double places[4][3], normals[4][3] = {{0.0}};
        for (int k = 0; k < 4; k++) {
            places[k][axis] = face % 2 ? high[axis] : low[axis];
            places[k][(axis + 1) % 3] = k % 2 ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
            places[k][(axis + 2) % 3] = k / 2 ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
            normals[k][axis] = face % 2 ? 1.0 : -1.0;
        }
        add_quad(job, places, normals, 1.0f);
    }
}

// Of a step around: whole steps from 0 to AROUND.
static void turn_of(int step, double *sine, double *cosine)
{
    weir_sine_cosine(2.0 * WEIR_PI * step / AROUND, sine, cosine);
}

static void add_ball(const Job *job, const double center[3], double radius)
{
    for (int row = 0; row < AROUND / 2; row++) {
        for (int column = 0; column < AROUND; column++) {
            double places[4][3], normals[4][3];
            for (int k = 0; k < 4; k++) {
                double height, across, x, z;
                turn_of(row + k / 2, &across, &height); // from the top
                turn_of(column + k % 2, &z, &x);
                const double normal[3] = {across * x, height, across * z};
                for (int axis = 0; axis < 3; axis++) {
                    normals[k][axis] = normal[axis];
                    places[k][axis] = center[axis] + radius * normal[axis];
                }
            }
            bool dark = (column / (AROUND / SECTORS) + row / (AROUND / 4)) % 2;
            add_quad(job, places, normals, dark ? dark_tone : 1.0f);
        }
    }
}

// Two unit vectors across `axis` and each other.
static void frame_of(const double axis[3], double one[3], double other[3])
{
    int least = 0;
    for (int k = 1; k < 3; k++) least = fabs(axis[k]) < fabs(axis[least]) ? k : least;
    double helper[3] = {0.0};
    helper[least] = 1.0;
    cross(axis, helper, one);
    double length = sqrt(dot(one, one));
    for (int k = 0; k < 3; k++) one[k] /= length;
    cross(axis, one, other);
}

static void add_cylinder(const Job *job, const WeirShape *shape)
{
    double axis[3], one[3], other[3];
    for (int k = 0; k < 3; k++) axis[k] = shape->to[k] - shape->from[k];
    double length = sqrt(dot(axis, axis));
    for (int k = 0; k < 3; k++) axis[k] /= length;
    frame_of(axis, one, other);
    for (int step = 0; step < AROUND; step++) {
        double places[4][3], normals[4][3];
        for (int k = 0; k < 4; k++) {
            double sine, cosine;
            turn_of(step + k % 2, &sine, &cosine);
            for (int i = 0; i < 3; i++) {
                normals[k][i] = cosine * one[i] + sine * other[i];
                places[k][i] = (k / 2 ? shape->to : shape->from)[i] + shape->radius * normals[k][i];
            }
        }
        float tone = step / (AROUND / SECTORS) % 2 ? dark_tone : 1.0f;
        add_quad(job, places, normals, tone);
        for (int end = 0; end < 2; end++) {
            double outward[3];
            for (int i = 0; i < 3; i++) outward[i] = end ? axis[i] : -axis[i];
            add(job, end ? shape->to : shape->from, outward, tone);
            add(job, places[2 * end], outward, tone);
            add(job, places[2 * end + 1], outward, tone);
        }
    }
}

// ---- Meshes: smooth where neighbours hardly differ, with an edge where they do ----

// Which triangles meet in a corner: `list` from first[c] to first[c + 1].
typedef struct Meetings {
    WeirWeld weld;
    uint32_t *first, *list;
    double (*normal)[3]; // per triangle, as long as it is large
} Meetings;

static void meetings_end(Meetings *meetings)
{
    weir_weld_end(&meetings->weld);
    free(meetings->first);
    free(meetings->list);
    free(meetings->normal);
}

static void list_meetings(Meetings *meetings, const WeirMesh *mesh)
{
    const uint32_t *corner = meetings->weld.corner;
    size_t indices = 3 * (size_t)mesh->triangle_count;
    for (size_t k = 0; k < indices; k++) meetings->first[corner[mesh->triangles[k]] + 1]++;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) meetings->first[v + 1] += meetings->first[v];
    // Filled from the back, which leaves first[c + 1] where corner c begins: moved down by one below.
    for (size_t k = indices; k-- > 0;)
        meetings->list[--meetings->first[corner[mesh->triangles[k]] + 1]] = (uint32_t)(k / 3);
    memmove(meetings->first, meetings->first + 1, mesh->vertex_count * sizeof *meetings->first);
    meetings->first[mesh->vertex_count] = (uint32_t)indices;
}

static bool meetings_start(Meetings *meetings, const WeirMesh *mesh)
{
    *meetings = (Meetings){.list = NULL};
    meetings->first = calloc((size_t)mesh->vertex_count + 1, sizeof *meetings->first);
    meetings->list = malloc(3 * (size_t)mesh->triangle_count * sizeof *meetings->list);
    meetings->normal = malloc(mesh->triangle_count * sizeof *meetings->normal);
    if (!meetings->first || !meetings->list || !meetings->normal || !weir_weld_start(&meetings->weld, mesh))
        return false;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        double p[3][3], a[3], b[3];
        for (int k = 0; k < 3; k++) weir_mesh_corner(mesh, mesh->triangles[3 * (size_t)t + (size_t)k], p[k]);
        for (int i = 0; i < 3; i++) {
            a[i] = p[1][i] - p[0][i];
            b[i] = p[2][i] - p[0][i];
        }
        cross(a, b, meetings->normal[t]);
    }
    list_meetings(meetings, mesh);
    return true;
}

static void normal_at(const Meetings *meetings, uint32_t triangle, uint32_t corner, double normal[3])
{
    const double *own = meetings->normal[triangle];
    double sum[3] = {own[0], own[1], own[2]}, size = sqrt(dot(own, own));
    for (uint32_t k = meetings->first[corner]; k < meetings->first[corner + 1]; k++) {
        const double *other = meetings->normal[meetings->list[k]];
        if (meetings->list[k] == triangle || dot(own, other) < crease * size * sqrt(dot(other, other)))
            continue;
        for (int i = 0; i < 3; i++) sum[i] += other[i];
    }
    double length = sqrt(dot(sum, sum));
    for (int i = 0; i < 3; i++) normal[i] = length > 0.0 ? sum[i] / length : 0.0;
}

static void add_mesh(const Job *job, const WeirMesh *mesh)
{
    Meetings meetings;
    if (!meetings_start(&meetings, mesh)) job->triangles->failed = true;
    for (uint32_t t = 0; t < mesh->triangle_count && !job->triangles->failed; t++) {
        for (size_t k = 0; k < 3; k++) {
            uint32_t index = mesh->triangles[3 * (size_t)t + k];
            double place[3], normal[3];
            weir_mesh_corner(mesh, index, place);
            normal_at(&meetings, t, meetings.weld.corner[index], normal);
            add(job, place, normal, 1.0f);
        }
    }
    meetings_end(&meetings);
}

// ---- Forms ----

// Its middle and size; `radius` is that of the ball around it.
static WeirForm form_of(const Job *job, const double low[3], const double high[3], double radius)
{
    WeirForm form = {.solid = job->solid};
    double middle[3];
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (low[k] + high[k]) - job->reference[k];
        form.middle[k] = (float)middle[k];
        form.size[k] = (float)(0.5 * (high[k] - low[k]));
    }
    form.reach = (float)(sqrt(dot(middle, middle)) + radius);
    return form;
}

static void add_form(const Job *job, const WeirShape *shape, const double low[3], const double high[3],
                     uint32_t first)
{
    WeirTriangles *triangles = job->triangles;
    double diagonal[3];
    for (int k = 0; k < 3; k++) diagonal[k] = high[k] - low[k];
    double radius = shape->kind == WEIR_SHAPE_BALL ? shape->radius : 0.5 * sqrt(dot(diagonal, diagonal));
    WeirForm form = form_of(job, low, high, radius);
    form.kind = (uint32_t)shape->kind;
    if (shape->kind == WEIR_SHAPE_CYLINDER) {
        double axis[3], across[3], unused[3];
        for (int k = 0; k < 3; k++) axis[k] = shape->to[k] - shape->from[k];
        double length = sqrt(dot(axis, axis));
        for (int k = 0; k < 3; k++) axis[k] /= length;
        frame_of(axis, across, unused);
        for (int k = 0; k < 3; k++) {
            form.axis[k] = (float)axis[k];
            form.across[k] = (float)across[k];
        }
        form.size[0] = (float)shape->radius;
        form.size[1] = (float)(0.5 * length);
    }
    if (shape->kind == WEIR_SHAPE_MESH && triangles->count - first <= WEIR_FORM_CORNERS) {
        form.first = first;
        form.last = triangles->count;
    }
    triangles->forms[triangles->form_count++] = form;
}

// ---- All of them ----

static void add_piece(WeirTriangles *triangles, const WeirScene *scene, const WeirSolidPiece *piece,
                      uint32_t solid, bool is_body)
{
    Job job = {.triangles = triangles, .solid = solid};
    weir_piece_reference(piece, 3, job.reference);
    const WeirShape *shape = &piece->shape;
    uint32_t first = triangles->count;
    double low[3], high[3];
    weir_shape_bounds(shape, 3, low, high);
    switch (shape->kind) {
    case WEIR_SHAPE_BOX:
        for (int k = 0; k < 3; k++) {
            bool cut = !is_body && !piece->is_driven;
            low[k] = cut ? fmax(low[k], scene->domain_min[k]) : low[k];
            high[k] = cut ? fmin(high[k], scene->domain_max[k]) : high[k];
            if (low[k] >= high[k]) return;
        }
        add_box(&job, low, high);
        break;
    case WEIR_SHAPE_BALL:
        add_ball(&job, shape->center, shape->radius);
        break;
    case WEIR_SHAPE_CYLINDER:
        add_cylinder(&job, shape);
        break;
    case WEIR_SHAPE_MESH:
        add_mesh(&job, &shape->mesh);
        break;
    default:
        return;
    }
    add_form(&job, shape, low, high, first);
}

const WeirSolidPiece *weir_shown_piece(const WeirScene *scene, uint32_t n)
{
    if (weir_scene_look(scene, weir_scene_first_wall(scene) + n) == WEIR_LOOK_HIDDEN) return NULL;
    return n < scene->wall_count ? &scene->wall[n] : &scene->body[n - scene->wall_count];
}

void weir_triangles_of(WeirTriangles *triangles, const WeirScene *scene)
{
    *triangles = (WeirTriangles){.corners = NULL};
    for (uint32_t n = 0; n < scene->wall_count + scene->body_count; n++) {
        const WeirSolidPiece *piece = weir_shown_piece(scene, n);
        uint32_t solid = weir_scene_first_wall(scene) + n;
        if (piece) add_piece(triangles, scene, piece, solid, n >= scene->wall_count);
    }
}

void weir_triangles_free(WeirTriangles *triangles)
{
    free(triangles->corners);
    *triangles = (WeirTriangles){.corners = NULL};
}
