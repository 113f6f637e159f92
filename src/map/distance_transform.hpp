// The two passes of the separable exact Euclidean transform (Felzenszwalb and Huttenlocher 2012,
// with whole numbers as in Meijster et al. 2000, so that a windowed update equals a rebuild).
#pragma once

#include <cstdint>
#include <vector>

namespace otter_nav::map {

// A row-major array with sites marked; `width` is its row length.
struct ColumnSweep {
  int width = 0;
  int height = 0;
  std::uint16_t cap = 0;      // steps saturate here
  std::uint16_t outside = 0;  // steps held by the rows just beyond the array
};

// First pass: steps to the nearest site upwards and downwards in the same column, 0 at a site, for
// columns [x0, x1), after sites in rows [y0, y1) changed.
void sweepColumns(const ColumnSweep& sweep, const std::vector<std::uint8_t>& sites, int x0, int x1,
                  int y0, int y1, std::vector<std::uint16_t>& up, std::vector<std::uint16_t>& down);

// One row of corners: squared distance (cells^2, at most cap^2) and the site it is to, relative to
// the row in y. Where the distance is capped the site means nothing.
struct CornerRow {
  explicit CornerRow(int width);
  std::vector<std::int32_t> squared, site_x, site_y;
};

// Second pass over one row: squared[x] = min over x' of (x - x')^2 + gap(x')^2 for x in [x0, x1),
// where gap is the nearer of up and down. Workspaces are reused from row to row.
class RowEnvelope {
 public:
  RowEnvelope(int width, int cap);
  void run(const std::uint16_t* up, const std::uint16_t* down, int x0, int x1, CornerRow& out);

 private:
  void build(const std::uint16_t* up, const std::uint16_t* down, int x0, int x1);

  int width_;
  int cap_;
  std::size_t size_ = 0;
  std::vector<std::int32_t> site_;    // the envelope's parabolas, left to right
  std::vector<std::int64_t> height_;  // gap^2 + x^2 of each
};

}  // namespace otter_nav::map
