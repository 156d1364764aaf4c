// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/sparse_bitmap.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/bilinear.h"
#include "compiler/measure/colors.h"
#include "compiler/measure/edge_index.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

constexpr std::uint32_t kBandRows = 32; ///< of texels, worked on together
constexpr int kBisections = 60;         ///< down to neighbouring doubles

/// An edge in texels.
class TexelEdge {
  public:
    TexelEdge(const VisibleEdge& edge, double width, double height) : edge_(edge), sx_(width), sy_(height) {}
    [[nodiscard]] double x(double t) const { return point_at(edge_, t).x * sx_; }
    [[nodiscard]] double y(double t) const { return point_at(edge_, t).y * sy_; }
    [[nodiscard]] double along(bool vertical, double t) const { return vertical ? y(t) : x(t); }

    /// Where a coordinate has the value; the nearer end if it hasn't.
    [[nodiscard]] double parameter(bool vertical, double value) const {
        const double first = along(vertical, 0), last = along(vertical, 1);
        const bool rising = last >= first;
        if (rising ? value <= first : value >= first) return 0;
        if (rising ? value >= last : value <= last) return 1;
        double low = 0, high = 1;
        for (int k = 0; k < kBisections; ++k) {
            const double middle = (low + high) / 2;
            ((along(vertical, middle) < value) == rising ? low : high) = middle;
        }
        return (low + high) / 2;
    }

    /// ∫ (right − x) dy; Gauss–Legendre with three points is exact up to degree 5.
    [[nodiscard]] double area_left_of(double right, double t0, double t1) const {
        constexpr double kNode = 0.7745966692414834, kWeights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const double t = (t0 + t1) / 2 + (k - 1) * kNode * (t1 - t0) / 2;
            sum += kWeights[k] * (right - x(t)) * direction_at(edge_, t).y * sy_;
        }
        return sum * (t1 - t0);
    }

  private:
    const VisibleEdge& edge_;
    double sx_, sy_;
};

/// What a piece of an edge inside a texel does to the areas of the results on its sides: `area` in the texel itself,
/// `cover` in all texels to the right of it.
struct Cell {
    std::uint32_t row = 0, column = 0;
    ResultId left = 0, right = 0;
    double area = 0, cover = 0;
};

std::uint32_t index_of(double position, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(position), 0.0, count - 1.0));
}

/// [first, last] of the texels between two positions.
struct Range {
    std::uint32_t first = 0, last = 0;
    Range(double a, double b, std::uint32_t count)
        : first(index_of(std::min(a, b), count)), last(index_of(std::max(a, b), count)) {}
};

/// The part between two parameters, which lies in one row, cut at the columns.
void add_cells(const TexelEdge& edge, const VisibleEdge& e, std::uint32_t row, double t0, double t1,
               std::uint32_t width, std::vector<Cell>& cells) {
    const double x0 = edge.x(t0), x1 = edge.x(t1);
    const Range columns(x0, x1, width);
    const std::uint32_t count = columns.last - columns.first + 1;
    double from = t0;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t column = x1 >= x0 ? columns.first + k : columns.last - k;
        const double line = x1 >= x0 ? column + 1.0 : column;
        const double to = k + 1 == count ? t1 : std::clamp(edge.parameter(false, line), from, t1);
        const double cover = edge.y(to) - edge.y(from);
        if (cover != 0)
            cells.push_back({row, column, e.left, e.right, edge.area_left_of(column + 1.0, from, to), cover});
        from = to;
    }
}

void add_cells(const TexelEdge& edge, const VisibleEdge& e, std::uint32_t first_row, std::uint32_t last_row,
               GridSize size, std::vector<Cell>& cells) {
    const double y0 = edge.y(0), y1 = edge.y(1);
    if (y0 == y1) return;
    const Range rows(y0, y1, size.height);
    for (std::uint32_t row = std::max(rows.first, first_row); row <= std::min(rows.last, last_row); ++row) {
        const double a = row == rows.first ? (y1 >= y0 ? 0 : 1) : edge.parameter(true, row);
        const double b = row == rows.last ? (y1 >= y0 ? 1 : 0) : edge.parameter(true, row + 1.0);
        add_cells(edge, e, row, std::min(a, b), std::max(a, b), size.width, cells);
    }
}

/// Areas of results; they add up to one.
class Mix {
  public:
    void clear() { shares_.clear(); }
    void add(ResultId result, double share) {
        for (auto& [known, sum] : shares_)
            if (known == result) {
                sum += share;
                return;
            }
        shares_.emplace_back(result, share);
    }
    void add(const Cell& cell, double amount) {
        add(cell.left, amount);
        add(cell.right, -amount);
    }
    /// Forgets what has cancelled out but for rounding.
    void tidy() {
        std::erase_if(shares_, [](const auto& share) { return std::abs(share.second) < budget::kShareNoise; });
    }
    [[nodiscard]] bool is_solid(const Truth& truth) const {
        return std::all_of(shares_.begin(), shares_.end(), [&](const auto& s) { return truth.is_solid(s.first); });
    }
    /// The only result, or kNone.
    [[nodiscard]] ResultId only() const { return shares_.size() == 1 ? shares_.front().first : kNone; }
    [[nodiscard]] Rgba color(const Truth& truth, TexturePoint p) const {
        Rgba sum;
        for (const auto& [result, share] : shares_)
            measure::add(sum, truth.color(result, p), share);
        return sum;
    }

  private:
    std::vector<std::pair<ResultId, double>> shares_;
};

std::uint32_t to_rgba8(const Rgba& c) {
    std::uint32_t packed = 0;
    int shift = 0;
    for (const double channel : {c.r, c.g, c.b, c.a}) {
        packed |= std::uint32_t{to_byte(channel)} << shift;
        shift += 8;
    }
    return packed;
}

/// Makes the rows of a band.
class Band {
  public:
    Band(const Truth& truth, GridSize size, std::span<const std::uint32_t> edges, std::uint32_t first_row,
         std::uint32_t last_row)
        : truth_(truth), size_(size), row_height_(truth.height() / size.height) {
        for (const std::uint32_t k : edges) {
            const VisibleEdge& e = truth.edges()[k];
            add_cells(TexelEdge(e, size.width, 1 / row_height_), e, first_row, last_row, size, cells_);
            for (const WidthPoint end : {e.p[0], e.p[static_cast<std::size_t>(e.degree)]})
                if (end.x <= budget::kBorderInset) border_ends_.push_back(end.y);
        }
        std::sort(border_ends_.begin(), border_ends_.end());
        std::stable_sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) {
            return a.row != b.row ? a.row < b.row : a.column < b.column;
        });
        next_ = cells_.begin();
    }

    /// Rows must be asked for in ascending order.
    std::vector<SparseBitmap::Stretch> row(std::uint32_t j) {
        std::vector<SparseBitmap::Stretch> stretches;
        Mix running = left_border(j), texel;
        std::uint32_t column = 0;
        while (next_ != cells_.end() && next_->row == j) {
            fill(column, next_->column, j, running, stretches);
            column = next_->column;
            texel = running;
            for (; next_ != cells_.end() && next_->row == j && next_->column == column; ++next_) {
                texel.add(*next_, next_->area);
                running.add(*next_, next_->cover);
            }
            running.tidy();
            stretches.push_back({column, false, to_rgba8(texel.color(truth_, center(column, j)))});
            ++column;
        }
        fill(column, size_.width, j, running, stretches);
        return stretches;
    }

  private:
    [[nodiscard]] TexturePoint center(std::uint32_t column, std::uint32_t row) const {
        return {(column + 0.5) / size_.width, (row + 0.5) / size_.height};
    }
    /// Texels that no edge crosses but, perhaps, level ones from side to side: then they are mixed, and all alike if
    /// what is mixed doesn't vary.
    void fill(std::uint32_t column, std::uint32_t end, std::uint32_t row, const Mix& mix,
              std::vector<SparseBitmap::Stretch>& stretches) const {
        if (column >= end) return;
        if (mix.is_solid(truth_)) {
            stretches.push_back({column, false, to_rgba8(mix.color(truth_, {}))});
        } else if (mix.only() != kNone) {
            stretches.push_back({column, true, mix.only()});
        } else {
            for (; column < end; ++column)
                stretches.push_back({column, false, to_rgba8(mix.color(truth_, center(column, row)))});
        }
    }
    /// Heights of the results along the left border of a row.
    [[nodiscard]] Mix left_border(std::uint32_t j) const {
        const double top = j * row_height_, bottom = (j + 1) * row_height_;
        Mix mix;
        double from = top;
        const auto add_up_to = [&](double y) {
            if (y > from)
                mix.add(truth_.result_at({budget::kBorderInset, (from + y) / 2 / truth_.height()}),
                        (y - from) / row_height_);
            from = y;
        };
        for (auto end = std::upper_bound(border_ends_.begin(), border_ends_.end(), top);
             end != border_ends_.end() && *end < bottom; ++end)
            add_up_to(*end);
        add_up_to(bottom);
        return mix;
    }

    const Truth& truth_;
    GridSize size_;
    double row_height_; ///< width units
    std::vector<Cell> cells_;
    std::vector<Cell>::const_iterator next_;
    std::vector<double> border_ends_;
};

/// Which edges reach each band.
std::vector<std::vector<std::uint32_t>> edges_of_bands(const Truth& truth, GridSize size, std::uint32_t bands) {
    std::vector<std::vector<std::uint32_t>> found(bands);
    const double scale = size.height / truth.height() / kBandRows;
    for (std::uint32_t k = 0; k < truth.edges().size(); ++k) {
        const VisibleEdge& e = truth.edges()[k];
        const Range range(e.p[0].y * scale, e.p[static_cast<std::size_t>(e.degree)].y * scale, bands);
        // A row's rounding may differ from a band's.
        for (std::uint32_t b = range.first - (range.first > 0); b <= std::min(range.last + 1, bands - 1); ++b)
            found[b].push_back(k);
    }
    return found;
}

} // namespace

SparseBitmap::SparseBitmap(const Truth& truth, GridSize size, unsigned threads)
    : truth_(truth), size_(size), rows_(size.height) {
    const std::uint32_t bands = (size.height + kBandRows - 1) / kBandRows;
    const auto edges = edges_of_bands(truth, size, bands);
    parallel_for(bands, threads, [&](std::size_t b) {
        const auto first = static_cast<std::uint32_t>(b) * kBandRows;
        const std::uint32_t last = std::min(first + kBandRows, size_.height) - 1;
        Band band(truth_, size_, edges[b], first, last);
        for (std::uint32_t j = first; j <= last; ++j)
            rows_[j] = band.row(j);
    });
}

std::uint32_t SparseBitmap::texel(std::uint32_t column, std::uint32_t row) const {
    const auto after = std::upper_bound(rows_[row].begin(), rows_[row].end(), column,
                                        [](std::uint32_t c, const Stretch& s) { return c < s.column; });
    const Stretch& stretch = *(after - 1);
    if (!stretch.varies) return stretch.value;
    return to_rgba8(truth_.color(stretch.value, {(column + 0.5) / size_.width, (row + 0.5) / size_.height}));
}

Rgba SparseBitmap::at(TexturePoint p) const {
    const TexelWeights x(p.u, size_.width), y(p.v, size_.height);
    std::uint32_t corners[4];
    for (int k = 0; k < 4; ++k)
        corners[k] = texel(x.index[k % 2], y.index[k / 2]);
    const auto channel = [&](int shift) {
        const auto corner = [&](int k) { return (corners[k] >> shift & 255u) / 255.0; };
        const double upper = corner(0) + x.offset * (corner(1) - corner(0));
        const double lower = corner(2) + x.offset * (corner(3) - corner(2));
        return upper + y.offset * (lower - upper);
    };
    return {channel(0), channel(8), channel(16), channel(24)};
}

} // namespace fetexc::measure
