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

float value_of(std::uint8_t stored) { return static_cast<float>(stored) * (1.0F / 255); }
float value_of(float value) { return value; }

template <BilevelRule Rule, class Stored>
LineValues line_values(std::span<const Stored> values, const CellTexels& t, bool along_rows, float across) {
    constexpr std::uint32_t n = kChannels<Rule>;
    LineValues out;
    for (std::uint32_t c = 0; c < n; ++c) {
        const auto value = [&](std::size_t corner) { return value_of(values[std::size_t{t[corner]} * n + c]); };
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

/// Parts of four lines.
struct Spans {
    Lanes from, to; ///< to < from: nothing

    [[nodiscard]] Lanes length() const { return larger(to - from, Lanes{}); }
};

Spans both(const Spans& a, const Spans& b) { return {larger(a.from, b.from), smaller(a.to, b.to)}; }

/// Where a channel is above one half, of lines from low to high; with Max where it isn't.
template <BilevelRule Rule> Spans channel_spans(Lanes from, Lanes to, float low, float high) {
    const Lanes slope = to - from, begin = from + slope * low, end = from + slope * high;
    const Lanes at = smaller(larger((0.5F - from) / slope, low - Lanes{}), high - Lanes{});
    const auto in = [](Lanes v) { return Rule == BilevelRule::Max ? v <= 0.5F : v > 0.5F; };
    const auto first = in(begin), last = in(end);
    return {first ? low - Lanes{} : (last ? at : high - Lanes{}), last ? high - Lanes{} : (first ? at : low - Lanes{})};
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

template <BilevelRule Rule, class Stored>
double ThresholdCells::wrong_area_of(std::span<const Stored> values, const Cell& c) const {
    constexpr std::uint32_t n = kChannels<Rule>;
    const CellTexels corners = this->corners(c);
    std::array<float, n> from0, from1, to0, to1; // at a channel's line 0 and line 1
    for (std::uint32_t k = 0; k < n; ++k) {
        const auto value = [&](std::size_t corner) { return value_of(values[std::size_t{corners[corner]} * n + k]); };
        from0[k] = value(0), from1[k] = value(c.along_rows ? 2 : 1);
        to0[k] = value(c.along_rows ? 1 : 2), to1[k] = value(3);
    }
    Lanes sum{};
    const Block* const end = blocks_.data() + c.first_block + c.lines / kLanes;
    for (const Block* b = blocks_.data() + c.first_block; b != end; ++b) {
        std::array<Spans, n> in;
        for (std::uint32_t k = 0; k < n; ++k)
            in[k] = channel_spans<Rule>(from0[k] + (from1[k] - from0[k]) * b->across,
                                        to0[k] + (to1[k] - to0[k]) * b->across, c.low, c.high);
        const Spans outline{b->from, b->to};
        Lanes shown, shared; // of the texture's; of it and the outline's
        if constexpr (Rule == BilevelRule::Median) {
            // Two of three: the sum over pairs counts what all three have three times.
            const Spans ab = both(in[0], in[1]), bc = both(in[1], in[2]), ca = both(in[2], in[0]),
                        abc = both(ab, in[2]);
            shown = ab.length() + bc.length() + ca.length() - 2 * abc.length();
            shared = both(ab, outline).length() + both(bc, outline).length() + both(ca, outline).length() -
                     2 * both(abc, outline).length();
        } else {
            Spans all = in[0];
            if constexpr (n == 2) all = both(in[0], in[1]);
            shown = all.length(), shared = both(all, outline).length();
        }
        sum += (shown + (b->to - b->from) - 2 * shared) * b->weight;
    }
    float total = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    for (const std::uint32_t k : std::span(thin_).subspan(c.first_thin, c.thin)) {
        const CellLine& line = lines_[k];
        const TextureCrossings t =
            crossings_of<Rule>(line_values<Rule, Stored>(values, corners, c.along_rows, line.across), c.low, c.high);
        total += disagreement(t.above_first, std::span(t.at).first(t.count), line.above_first, crossings(line), c.low,
                              c.high);
    }
    return static_cast<double>(std::max(total, 0.0F)) * line_width(); // rounding may leave less than nothing
}

ThresholdCells::ThresholdCells(const ScannedOutline& scanned, std::uint32_t width, std::uint32_t height,
                               BilevelRule rule, TexelPlaces places, std::span<const std::uint8_t> also)
    : width_(width), height_(height), per_texel_(scanned.rows().per_texel()), rule_(rule), places_(places),
      channels_(fetex::bilevel_channels(rule)) {
    const std::size_t columns = std::size_t{width} + 1;
    std::vector<std::uint32_t> across_rows(columns * (height + 1), 0), across_columns(across_rows);
    const auto count = [&](const ScanLines& lines, bool level, std::vector<std::uint32_t>& in) {
        const std::uint32_t most = squares(level ? width : height);
        for (std::uint32_t n = 0; n < lines.size(); ++n) {
            const auto across = static_cast<std::size_t>(lines.position(n) + shift());
            for (const Crossing& c : lines.crossings(n)) {
                if (c.at < 0 || c.at > most) continue;
                const auto along = std::min<std::size_t>(static_cast<std::size_t>(c.at + shift()), most);
                ++in[level ? across * columns + along : along * columns + across];
            }
        }
    };
    count(scanned.rows(), true, across_rows);
    count(scanned.columns(), false, across_columns);
    choose_texels(across_rows, across_columns, also);
    for (Cell& c : cells_)
        scan(c, scanned);
}

void ThresholdCells::choose_texels(const std::vector<std::uint32_t>& across_rows,
                                   const std::vector<std::uint32_t>& across_columns,
                                   std::span<const std::uint8_t> also) {
    std::vector<std::uint8_t> chosen(std::size_t{width_} * height_, 0);
    cell_at_.assign(across_rows.size(), kNone);
    const auto each = [&](const auto& visit) {
        for (std::uint32_t row = 0; row <= height_; ++row) {
            for (std::uint32_t column = 0; column <= width_; ++column)
                visit(Cell{column, row}, std::size_t{row} * (width_ + 1) + column);
        }
    };
    each([&](const Cell& c, std::size_t k) {
        const CellTexels around = corners(c);
        const bool touched =
            !also.empty() && std::ranges::any_of(around, [&](std::uint32_t t) { return also[t] != 0; });
        if (across_rows[k] + across_columns[k] == 0 && !touched) return;
        for (const std::uint32_t t : around)
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
    const bool centres = places_ == TexelPlaces::Centres;
    c.low = centres && along == 0 ? 0.5F : 0.0F, c.high = centres && along == most_along ? 0.5F : 1.0F;
    c.first_line = static_cast<std::uint32_t>(lines_.size());
    // Corners: what has no width, beyond the first and the last texel, has no lines.
    const bool nothing = !centres && (along == 0 || along == most_along);
    const std::uint32_t half = centres ? per_texel_ / 2 : 0, before = centres ? half : per_texel_;
    const std::uint32_t begin = across == 0 ? 0 : across * per_texel_ - before,
                        end = nothing                            ? begin
                              : across == most_across && centres ? most_across * per_texel_
                                                                 : std::min(across * per_texel_ + half, lines.size());
    const double origin = along - shift(), low = origin + static_cast<double>(c.low),
                 high = origin + static_cast<double>(c.high);
    for (std::uint32_t n = begin; n < end; ++n) {
        CellLine line;
        line.across = static_cast<float>(lines.position(n) - (across - shift()));
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
    add_blocks(c);
}

void ThresholdCells::add_blocks(Cell& c) {
    c.first_block = static_cast<std::uint32_t>(blocks_.size());
    c.first_thin = static_cast<std::uint32_t>(thin_.size());
    const bool keeps_below = rule_ == BilevelRule::Max;
    for (std::uint32_t k = c.first_line; k < c.first_line + c.lines; k += kLanes) {
        Block b;
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const CellLine& line = lines_[k + lane];
            const float at = line.crossings == 0 ? c.high : crossings_[line.first];
            const bool first = line.above_first != keeps_below;
            b.across[lane] = line.across, b.from[lane] = first ? c.low : at, b.to[lane] = first ? at : c.high;
            b.weight[lane] = line.crossings > 1 ? 0.0F : 1.0F;
            if (line.crossings > 1) thin_.push_back(k + lane);
        }
        blocks_.push_back(b);
    }
    c.thin = static_cast<std::uint32_t>(thin_.size()) - c.first_thin;
}

CellTexels ThresholdCells::corners(const Cell& c) const {
    const std::uint32_t i0 = clamped(std::int64_t{c.column} - 1, width_), i1 = clamped(c.column, width_);
    const std::uint32_t j0 = clamped(std::int64_t{c.row} - 1, height_), j1 = clamped(c.row, height_);
    return {j0 * width_ + i0, j0 * width_ + i1, j1 * width_ + i0, j1 * width_ + i1};
}

template <class Stored> double ThresholdCells::wrong_area_by_rule(std::span<const Stored> values, const Cell& c) const {
    switch (rule_) {
    case BilevelRule::Min:
        return wrong_area_of<BilevelRule::Min>(values, c);
    case BilevelRule::Max:
        return wrong_area_of<BilevelRule::Max>(values, c);
    case BilevelRule::Median:
        return wrong_area_of<BilevelRule::Median>(values, c);
    default:
        return wrong_area_of<BilevelRule::Single>(values, c);
    }
}

double ThresholdCells::wrong_area_in(std::span<const std::uint8_t> values, const Cell& c) const {
    return wrong_area_by_rule(values, c);
}
double ThresholdCells::wrong_area_in(std::span<const float> values, const Cell& c) const {
    return wrong_area_by_rule(values, c);
}

double ThresholdCells::wrong_area(std::span<const std::uint8_t> values) const {
    double sum = 0;
    for (const Cell& c : cells_)
        sum += wrong_area_in(values, c);
    return sum;
}
double ThresholdCells::wrong_area(std::span<const float> values) const {
    double sum = 0;
    for (const Cell& c : cells_)
        sum += wrong_area_in(values, c);
    return sum;
}

} // namespace fetexc
