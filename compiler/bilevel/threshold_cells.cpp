// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/threshold_cells.h"

#include <algorithm>
#include <cmath>

namespace fetexc {
namespace {

using fetex::BilevelRule;

template <BilevelRule Rule> bool combine(const std::array<bool, 3>& above) {
    if constexpr (Rule == BilevelRule::Single) return above[0];
    if constexpr (Rule == BilevelRule::Min) return above[0] && above[1];
    if constexpr (Rule == BilevelRule::Max) return above[0] || above[1];
    return above[0] + above[1] + above[2] >= 2;
}

template <BilevelRule Rule>
constexpr std::uint32_t kChannels = Rule == BilevelRule::Single   ? 1
                                    : Rule == BilevelRule::Median ? 3
                                                                  : 2;

std::uint32_t clamped(std::int64_t v, std::uint32_t size) {
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(v, 0, std::int64_t{size} - 1));
}

/// Length on which two sets of points of a line differ, each given by whether it begins with them and where it changes.
float disagreement(bool first_a, std::span<const float> a, bool first_b, std::span<const float> b, float low,
                   float high) {
    bool differ = first_a != first_b;
    float at = low, sum = 0;
    std::size_t i = 0, k = 0;
    while (i < a.size() || k < b.size()) {
        const bool from_a = k == b.size() || (i < a.size() && a[i] < b[k]);
        const float next = std::clamp(from_a ? a[i++] : b[k++], at, high);
        if (differ) sum += next - at;
        at = next, differ = !differ;
    }
    return differ ? sum + (high - at) : sum;
}

template <BilevelRule Rule>
LineValues line_values(std::span<const std::uint8_t> values, const CellTexels& t, bool along_rows, float across) {
    constexpr std::uint32_t n = kChannels<Rule>;
    LineValues out;
    for (std::uint32_t c = 0; c < n; ++c) {
        const auto value = [&](std::size_t corner) {
            return static_cast<float>(values[std::size_t{t[corner]} * n + c]) * (1.0F / 255);
        };
        const float v00 = value(0), v10 = value(1), v01 = value(2), v11 = value(3);
        const float from1 = along_rows ? v01 : v10, to0 = along_rows ? v10 : v01;
        out.from[c] = v00 + (from1 - v00) * across;
        out.to[c] = to0 + (v11 - to0) * across;
    }
    return out;
}

template <BilevelRule Rule> inline TextureCrossings crossings_of(const LineValues& v, float low, float high) {
    std::array<bool, 3> above{};
    std::array<float, 3> at{};
    std::array<std::uint8_t, 3> order{};
    std::uint32_t found = 0;
    for (std::uint8_t c = 0; c < kChannels<Rule>; ++c) {
        const float slope = v.to[c] - v.from[c];
        above[c] = v.from[c] + slope * low > 0.5F;
        if ((v.from[c] + slope * high > 0.5F) == above[c]) continue;
        at[c] = (0.5F - v.from[c]) / slope;
        std::uint32_t k = found++;
        for (; k > 0 && at[order[k - 1]] > at[c]; --k)
            order[k] = order[k - 1];
        order[k] = c;
    }
    TextureCrossings out;
    out.above_first = combine<Rule>(above);
    bool now = out.above_first;
    for (std::uint32_t k = 0; k < found; ++k) {
        above[order[k]] = !above[order[k]];
        if (combine<Rule>(above) == now) continue;
        now = !now;
        out.at[out.count] = at[order[k]], out.channel[out.count++] = order[k];
    }
    return out;
}

template <BilevelRule Rule>
double wrong_area_of(const ThresholdCells& cells, std::span<const std::uint8_t> values, const Cell& c) {
    const CellTexels corners = cells.corners(c);
    float sum = 0;
    for (const CellLine& line : cells.lines(c)) {
        const LineValues v = line_values<Rule>(values, corners, c.along_rows, line.across);
        const TextureCrossings t = crossings_of<Rule>(v, c.low, c.high);
        const std::span<const float> outline = cells.crossings(line);
        if (t.count == 1 && outline.size() == 1 && t.above_first == line.above_first) // most
            sum += std::fabs(std::clamp(t.at[0], c.low, c.high) - outline[0]);
        else
            sum +=
                disagreement(t.above_first, std::span(t.at).first(t.count), line.above_first, outline, c.low, c.high);
    }
    return static_cast<double>(sum) * cells.line_width();
}

} // namespace

TextureCrossings texture_crossings(BilevelRule rule, const LineValues& v, float low, float high) {
    switch (rule) {
    case BilevelRule::Min:
        return crossings_of<BilevelRule::Min>(v, low, high);
    case BilevelRule::Max:
        return crossings_of<BilevelRule::Max>(v, low, high);
    case BilevelRule::Median:
        return crossings_of<BilevelRule::Median>(v, low, high);
    default:
        return crossings_of<BilevelRule::Single>(v, low, high);
    }
}

ThresholdCells::ThresholdCells(const ScannedOutline& scanned, std::uint32_t width, std::uint32_t height,
                               BilevelRule rule)
    : width_(width), height_(height), per_texel_(scanned.rows().per_texel()), rule_(rule),
      channels_(fetex::bilevel_channels(rule)) {
    const std::size_t columns = std::size_t{width} + 1;
    std::vector<std::uint32_t> across_rows(columns * (height + 1), 0), across_columns(across_rows);
    const auto count = [&](const ScanLines& lines, bool level, std::vector<std::uint32_t>& in) {
        const std::uint32_t most = level ? width : height;
        for (std::uint32_t n = 0; n < lines.size(); ++n) {
            const auto across = static_cast<std::size_t>(lines.position(n) + 0.5);
            for (const Crossing& c : lines.crossings(n)) {
                if (c.at < 0 || c.at > most) continue;
                const auto along = static_cast<std::size_t>(c.at + 0.5);
                ++in[level ? across * columns + along : along * columns + across];
            }
        }
    };
    count(scanned.rows(), true, across_rows);
    count(scanned.columns(), false, across_columns);
    choose_texels(across_rows, across_columns);
    for (Cell& c : cells_)
        scan(c, scanned);
}

void ThresholdCells::choose_texels(const std::vector<std::uint32_t>& across_rows,
                                   const std::vector<std::uint32_t>& across_columns) {
    std::vector<std::uint8_t> chosen(std::size_t{width_} * height_, 0);
    cell_at_.assign(across_rows.size(), kNone);
    const auto each = [&](const auto& visit) {
        for (std::uint32_t row = 0; row <= height_; ++row) {
            for (std::uint32_t column = 0; column <= width_; ++column)
                visit(Cell{column, row}, std::size_t{row} * (width_ + 1) + column);
        }
    };
    each([&](const Cell& c, std::size_t k) {
        if (across_rows[k] + across_columns[k] == 0) return;
        for (const std::uint32_t t : corners(c))
            chosen[t] = 1;
    });
    for (std::uint32_t t = 0; t < chosen.size(); ++t) {
        if (chosen[t] != 0) texels_.push_back(t);
    }
    each([&](Cell c, std::size_t k) {
        const CellTexels around = corners(c);
        if (std::ranges::none_of(around, [&](std::uint32_t t) { return chosen[t] != 0; })) return;
        c.along_rows = across_rows[k] >= across_columns[k];
        c.holds_outline = across_rows[k] + across_columns[k] > 0;
        cell_at_[k] = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back(c);
    });
}

void ThresholdCells::scan(Cell& c, const ScannedOutline& scanned) {
    const ScanLines& lines = c.along_rows ? scanned.rows() : scanned.columns();
    const std::uint32_t along = c.along_rows ? c.column : c.row, across = c.along_rows ? c.row : c.column;
    const std::uint32_t most_along = c.along_rows ? width_ : height_, most_across = c.along_rows ? height_ : width_;
    c.low = along == 0 ? 0.5F : 0.0F, c.high = along == most_along ? 0.5F : 1.0F;
    c.first_line = static_cast<std::uint32_t>(lines_.size());
    const std::uint32_t half = per_texel_ / 2;
    const std::uint32_t begin = across == 0 ? 0 : across * per_texel_ - half,
                        end = across == most_across ? most_across * per_texel_ : across * per_texel_ + half;
    const double origin = along - 0.5, low = origin + static_cast<double>(c.low),
                 high = origin + static_cast<double>(c.high);
    for (std::uint32_t n = begin; n < end; ++n) {
        CellLine line;
        line.across = static_cast<float>(lines.position(n) - (across - 0.5));
        line.above_first = scanned.above_at_start(c.along_rows, n);
        line.first = static_cast<std::uint32_t>(crossings_.size());
        for (const Crossing& x : lines.crossings(n)) {
            if (x.at >= high) break;
            if (x.at <= low)
                line.above_first = x.enters;
            else
                crossings_.push_back(static_cast<float>(x.at - origin));
        }
        line.crossings = static_cast<std::uint32_t>(crossings_.size()) - line.first;
        lines_.push_back(line);
    }
    c.lines = static_cast<std::uint32_t>(lines_.size()) - c.first_line;
}

CellTexels ThresholdCells::corners(const Cell& c) const {
    const std::uint32_t i0 = clamped(std::int64_t{c.column} - 1, width_), i1 = clamped(c.column, width_);
    const std::uint32_t j0 = clamped(std::int64_t{c.row} - 1, height_), j1 = clamped(c.row, height_);
    return {j0 * width_ + i0, j0 * width_ + i1, j1 * width_ + i0, j1 * width_ + i1};
}

double ThresholdCells::wrong_area_in(std::span<const std::uint8_t> values, const Cell& c) const {
    switch (rule_) {
    case BilevelRule::Min:
        return wrong_area_of<BilevelRule::Min>(*this, values, c);
    case BilevelRule::Max:
        return wrong_area_of<BilevelRule::Max>(*this, values, c);
    case BilevelRule::Median:
        return wrong_area_of<BilevelRule::Median>(*this, values, c);
    default:
        return wrong_area_of<BilevelRule::Single>(*this, values, c);
    }
}

double ThresholdCells::wrong_area(std::span<const std::uint8_t> values) const {
    double sum = 0;
    for (const Cell& c : cells_)
        sum += wrong_area_in(values, c);
    return sum;
}

double ThresholdCells::wrong_area_around(std::span<const std::uint8_t> values, std::uint32_t texel) const {
    const std::size_t corner = std::size_t{texel / width_} * (width_ + 1) + texel % width_;
    double sum = 0;
    for (const std::size_t k : {corner, corner + 1, corner + width_ + 1, corner + width_ + 2})
        sum += wrong_area_in(values, cells_[cell_at_[k]]);
    return sum;
}

double ThresholdCells::wrong_area_around(std::span<const std::uint8_t> values, std::uint32_t texel,
                                         std::uint32_t other) const {
    const std::uint32_t i = texel % width_, j = texel / width_, oi = other % width_, oj = other / width_;
    double sum = wrong_area_around(values, texel);
    for (std::uint32_t row = oj; row <= oj + 1; ++row) {
        for (std::uint32_t column = oi; column <= oi + 1; ++column) {
            const bool shared = column >= i && column <= i + 1 && row >= j && row <= j + 1;
            if (!shared) sum += wrong_area_in(values, cells_[cell_at_[std::size_t{row} * (width_ + 1) + column]]);
        }
    }
    return sum;
}

} // namespace fetexc
