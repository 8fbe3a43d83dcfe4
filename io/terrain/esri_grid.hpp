// Heights on a grid in ESRI's ASCII format (.asc), also packed (.asc.gz): a header of keys and values in any order,
// then ncols x nrows heights, the northernmost row first.
//
//   ncols 300             columns: nodes along x
//   nrows 220             rows: nodes along y
//   xllcorner -10805      x of the lower left corner of the lower left cell; or xllcenter, of its centre
//   yllcorner 193395      the same for y
//   cellsize 10           edge of a cell; or dx and dy where cells are not square
//   NODATA_value -9999    what stands where no height is known; -9999 if the line is absent
//
// A height is that of a cell's centre: nodes are half a cell inside of the corner.
#pragma once

#include <string>
#include <string_view>

#include "core/errors.hpp"
#include "core/terrain.hpp"

namespace scree::io {

// `what()` is "path:line: ...".
struct EsriFault : IoError {
    EsriFault(const std::string& path, int at, const std::string& message)
        : IoError(path + ":" + std::to_string(at) + ": " + message), line(at), fault(message) {}
    int line;
    std::string fault;
};

// In the coordinates of the file; NaN where there is no data.
HeightGrid parse_esri_grid(std::string_view text, const std::string& path);
HeightGrid read_esri_grid(const std::string& path);

// Reads back to the same bits. Packed if the name ends in .gz.
std::string esri_text(const HeightGrid& grid);
void write_esri_grid(const std::string& path, const HeightGrid& grid);

}  // namespace scree::io
