// The uniform grid of src/core/grid.h: rows of cells, one search radius high and a quarter as wide. Where the domain has
// more columns or rows than the grid, those that lie the grid's count apart share their cells.
fn grid_column(x: f32) -> u32 {
    let column = i32((x - constants.domain_min.x) * constants.inverse_cell_width);
    return u32(clamp(column, 0, i32(constants.domain_columns) - 1));
}

fn grid_row(y: f32) -> u32 {
    let row = i32((y - constants.domain_min.y) * constants.inverse_cell_height);
    return u32(clamp(row, 0, i32(constants.domain_rows) - 1));
}

fn grid_cell(position: vec2f) -> u32 {
    return folded(grid_row(position.y), constants.cell_rows) * constants.cell_columns
        + folded(grid_column(position.x), constants.cell_columns);
}

// First and last row that may hold neighbours of a particle in `row`.
fn grid_rows(row: u32) -> vec2u {
    return vec2u(max(row, 1u) - 1u, min(row + 1u, constants.domain_rows - 1u));
}

// Runs of cells per row: up to the grid's end, and on from its begin.
const SEGMENTS = select(1u, 2u, FOLDED_X);

// A run of cells in `row` that may hold neighbours: its first cell and the cell after its last one. The runs are
// trimmed to the chord that the search circle cuts out of the row, seen from `own_row`.
fn grid_run(position: vec2f, own_row: u32, row: u32, segment: u32) -> vec2u {
    let offset = (position.y - constants.domain_min.y) * constants.inverse_cell_height - f32(own_row);
    // Distance to the row, in rows; made smaller by what rounding may add to it.
    let distance = select(select(0.0, 1.0 - offset, row > own_row), offset, row < own_row);
    let gap = max(distance - ROW_ROUNDING * f32(own_row + 2u), 0.0) / constants.inverse_cell_height;
    let reach = sqrt(max(constants.search_radius * constants.search_radius - gap * gap, 0.0));
    let columns = constants.cell_columns;
    let first_cell = folded(row, constants.cell_rows) * columns;
    var first = grid_column(position.x - reach);
    var end = grid_column(position.x + reach) + 1u;
    if FOLDED_X {
        let count = min(end - first, columns);
        first = folded(first, columns);
        end = min(first + count, columns);
        if segment == 1u {
            end = first + count - end;
            first = 0u;
        }
    }
    return vec2u(first_cell + first, first_cell + end);
}

// Largest relative error of a row's coordinate: a few units in the last place of a float.
const ROW_ROUNDING = 3e-7;
