// Coordinates in quanta, cells, and the runs of cells that hold a particle's neighbours (src/core/grid.h): one run per
// row of cells, trimmed to the chord that the support cuts out of it. Where an axis is periodic, what lies beyond its
// end is visited as an image, shifted by the period; the order is below, inside, above.
// A line is a column, row or layer; where the domain has more than the grid, those that lie `count` apart share
// their cells: far away particles may be candidates, but never neighbours.
fn column_line(coordinate: i32) -> u32 {
    return u32(max(coordinate, 0)) >> constants.column_shift;
}

// Of a row or layer, which are so many quanta high.
fn row_line(coordinate: i32, height: u32) -> u32 {
    return u32(max(coordinate, 0)) / height;
}

fn grid_cell(place: Place) -> u32 {
    let coordinate = wide_place(place);
    let column = folded(column_line(coordinate.x), constants.cell_columns);
    let row = folded(row_line(coordinate.y, ROW_HEIGHT), constants.cell_rows);
    if DIMENSION == 2u {
        return row * constants.cell_columns + column;
    }
    let layer = folded(row_line(coordinate.z, LAYER_HEIGHT), constants.cell_layers);
    return (layer * constants.cell_rows + row) * constants.cell_columns + column;
}

// Where things lie in `cell_link` behind the heads of the cells' lists: how many slots of fluid and of solids pass neighbors has put
// in order, and what follows each id in its cell's list.
fn fluid_put_at() -> u32 {
    return constants.cell_count;
}

fn solids_put_at() -> u32 {
    return constants.cell_count + 1u;
}

fn link_at(own: u32) -> u32 {
    return constants.cell_count + 2u + own;
}

// Rows (or layers) to visit along one axis: `below` in the lower image, then `inside`, then the rest above.
struct Visits {
    below_first: u32,
    below: u32,
    inside_first: u32,
    inside: u32,
    count: u32,
}

fn visits_of(at: i32, reach: i32, height: u32, count: u32, periodic: bool, period: u32) -> Visits {
    let low = at - reach;
    let high = at + reach;
    let first = row_line(low, height);
    if !periodic {
        let inside = min(row_line(high, height) + 1u - first, count);
        return Visits(0u, 0u, first, inside, inside);
    }
    let p = i32(period);
    let last = row_line(p - 1, height);
    var visits = Visits(0u, 0u, first, row_line(min(high, p - 1), height) + 1u - first, 0u);
    if low < 0 {
        visits.below_first = row_line(low + p, height);
        visits.below = last + 1u - visits.below_first;
    }
    visits.count = visits.below + visits.inside;
    if high >= p {
        visits.count += row_line(high - p, height) + 1u;
    }
    return visits;
}

// The row of visit k, and by how much its image is shifted, in periods.
fn visit(visits: Visits, k: u32) -> vec2i {
    if k < visits.below {
        return vec2i(i32(visits.below_first + k), -1);
    }
    if k < visits.below + visits.inside {
        return vec2i(i32(visits.inside_first + k - visits.below), 0);
    }
    return vec2i(i32(k - visits.below - visits.inside), 1);
}

// Distance along one axis from `at` to a row of cells, in quanta. Row 0 also holds all that lies below it.
fn row_distance(at: i32, row: i32, height: u32) -> f32 {
    let begin = row * i32(height);
    let below = select(begin - at, 0, row == 0);
    let above = at - begin - i32(height - 1u);
    return f32(max(max(below, above), 0));
}

// A walk over the runs that hold all that was sorted within `reach` of a place:
//   var walk = walk_around(place, reach);   while next_run(&walk) { ... }
struct Walk {
    reach: i32,
    rows: Visits,
    layers: Visits,
    row: u32,
    layer: u32,
    segment: u32,
    own: Place,
    place: Place,    // `own` as seen from the image that the run lies in
    first_cell: u32, // of the run; empty if it is end_cell
    end_cell: u32,
    run_layer: u32,  // which of the layers it lies in
}

// Images along x: below, inside, above. Of a folded grid: up to its end, and on from its begin.
const COLUMN_SEGMENTS = select(select(1u, 2u, FOLDED_X), 3u, PERIODIC_X);

fn walk_around(place: Place, reach: i32) -> Walk {
    var walk: Walk;
    let own = wide_place(place);
    walk.own = place;
    walk.reach = reach;
    walk.rows = visits_of(own.y, reach, ROW_HEIGHT, constants.cell_rows, PERIODIC_Y, constants.period_y);
    walk.layers = Visits(0u, 0u, 0u, 1u, 1u);
    if DIMENSION == 3u {
        walk.layers = visits_of(own.z, reach, LAYER_HEIGHT, constants.cell_layers, PERIODIC_Z, constants.period_z);
    }
    return walk;
}

fn set_columns(walk: ptr<function, Walk>, reach: i32, first_row_cell: u32) {
    var low = (*walk).place.x - reach;
    var high = (*walk).place.x + reach;
    if PERIODIC_X {
        let p = i32(constants.period_x);
        let image = i32((*walk).segment) - 1;
        low = max(low - image * p, 0);
        high = min(high - image * p, p - 1);
        (*walk).place.x -= image * p;
    }
    if low > high {
        return;
    }
    let columns = constants.cell_columns;
    let count = min(column_line(high) + 1u - column_line(low), columns);
    var first = folded(column_line(low), columns);
    var end = first + count;
    if FOLDED_X && end > columns {
        first = select(first, 0u, (*walk).segment == 1u);
        end = select(columns, end - columns, (*walk).segment == 1u);
    } else if FOLDED_X && (*walk).segment == 1u {
        return;
    }
    (*walk).first_cell = first_row_cell + first;
    (*walk).end_cell = first_row_cell + min(end, columns);
}

// Goes to the next run; false if there is none.
fn next_run(walk: ptr<function, Walk>) -> bool {
    if (*walk).layer == (*walk).layers.count {
        return false;
    }
    (*walk).run_layer = (*walk).layer;
    let reach = f32((*walk).reach);
    let row = visit((*walk).rows, (*walk).row);
    var first_row_cell = folded(u32(row.x), constants.cell_rows) * constants.cell_columns;
    (*walk).place = (*walk).own;
    (*walk).place.y -= row.y * i32(constants.period_y);
    let distance = row_distance((*walk).place.y, row.x, ROW_HEIGHT);
    var chord_squared = reach * reach - distance * distance;
    if DIMENSION == 3u {
        let layer = visit((*walk).layers, (*walk).layer);
        first_row_cell += folded(u32(layer.x), constants.cell_layers) * constants.cell_rows * constants.cell_columns;
        chord_squared -= deeper(walk, layer);
    }
    (*walk).first_cell = 0u;
    (*walk).end_cell = 0u;
    if chord_squared > 0.0 {
        // A few quanta more than the chord, for rounding.
        set_columns(walk, i32(sqrt(chord_squared)) + 4, first_row_cell);
    }
    (*walk).segment += 1u;
    if (*walk).segment == COLUMN_SEGMENTS {
        (*walk).segment = 0u;
        (*walk).row += 1u;
        if (*walk).row == (*walk).rows.count {
            (*walk).row = 0u;
            (*walk).layer += 1u;
        }
    }
    return true;
}
