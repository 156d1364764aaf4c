// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/seed.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

using fetex::BilevelRule;

/// Segments in chains: which follows which. Where several begin in one point each end takes the next of them.
class Chains {
  public:
    Chains(std::span<const OutlineSegment> outline, double window)
        : next(outline.size(), kNone), previous(outline.size(), kNone), turn(outline.size(), 0),
          corner_(outline.size(), 0) {
        std::multimap<std::pair<double, double>, std::uint32_t> starts;
        for (std::uint32_t k = 0; k < outline.size(); ++k)
            starts.emplace(std::pair(outline[k].x0, outline[k].y0), k);
        for (std::uint32_t k = 0; k < outline.size(); ++k) {
            const auto start = starts.find({outline[k].x1, outline[k].y1});
            if (start == starts.end()) continue;
            next[k] = start->second, previous[start->second] = k;
            starts.erase(start);
        }
        for (std::uint32_t k = 0; k < outline.size(); ++k) {
            if (previous[k] == kNone) continue;
            const auto [ax, ay] = behind(outline, k, window);
            const auto [bx, by] = ahead(outline, k, window);
            turn[k] = std::atan2(ax * by - ay * bx, ax * bx + ay * by);
        }
        for (std::uint32_t k = 0; k < outline.size(); ++k)
            corner_[k] = is_corner(outline, k, window) ? 1 : 0;
    }

    /// At the segment's beginning.
    [[nodiscard]] bool corner(std::uint32_t k) const { return corner_[k] != 0; }

    std::vector<std::uint32_t> next, previous;
    std::vector<double> turn; ///< from the segment before, radians; y is down, above on the left: a corner of what is
                              ///< above turns left, below 0

  private:
    struct Way {
        double x, y;
    };
    static double length(const OutlineSegment& s) { return std::hypot(s.x1 - s.x0, s.y1 - s.y0); }

    /// From the beginning of segment k on along the outline, over the window, at least one segment.
    [[nodiscard]] Way ahead(std::span<const OutlineSegment> outline, std::uint32_t k, double window) const {
        std::uint32_t at = k;
        double sum = length(outline[at]);
        for (; sum < window && next[at] != kNone && next[at] != k; sum += length(outline[at]))
            at = next[at];
        return {outline[at].x1 - outline[k].x0, outline[at].y1 - outline[k].y0};
    }
    /// To there from behind.
    [[nodiscard]] Way behind(std::span<const OutlineSegment> outline, std::uint32_t k, double window) const {
        std::uint32_t at = previous[k];
        double sum = length(outline[at]);
        for (; sum < window && previous[at] != kNone && previous[at] != k; sum += length(outline[at]))
            at = previous[at];
        return {outline[k].x0 - outline[at].x0, outline[k].y0 - outline[at].y0};
    }

    /// In a window the sharpest turn, of equal ones the first.
    [[nodiscard]] bool is_corner(std::span<const OutlineSegment> outline, std::uint32_t k, double window) const {
        if (previous[k] == kNone) return true;
        if (window == 0) return std::fabs(turn[k]) > budget::kCornerTurn;
        const double sharp = std::fabs(turn[k]);
        if (sharp <= budget::kCornerTurnOfPixels) return false;
        double sum = 0;
        for (std::uint32_t at = k; sum < window;) {
            sum += length(outline[at]), at = next[at];
            if (at == kNone || at == k) break;
            if (std::fabs(turn[at]) > sharp) return false;
        }
        sum = 0;
        for (std::uint32_t at = previous[k]; sum < window && at != kNone && at != k; at = previous[at]) {
            sum += length(outline[at]);
            if (std::fabs(turn[at]) >= sharp) return false;
        }
        return true;
    }

    std::vector<std::uint8_t> corner_;
};

/// Runs of one chain that begins with a corner.
std::vector<std::vector<std::uint32_t>> runs_from(const Chains& chains, std::uint32_t first) {
    std::vector<std::vector<std::uint32_t>> runs;
    std::uint32_t k = first;
    do {
        if (chains.corner(k)) runs.emplace_back();
        runs.back().push_back(k);
        k = chains.next[k];
    } while (k != kNone && k != first);
    return runs;
}

class ChannelAssigner {
  public:
    ChannelAssigner(const Chains& chains, BilevelRule rule)
        : chains_(chains), rule_(rule), all_(static_cast<std::uint8_t>((1U << fetex::bilevel_channels(rule)) - 1)),
          sets_(chains.next.size(), all_) {}

    std::vector<std::uint8_t> assign() {
        std::vector<std::uint8_t> done(chains_.next.size(), 0);
        const auto chain = [&](std::uint32_t k) {
            if (done[k] != 0 || !chains_.corner(k)) return;
            const auto runs = runs_from(chains_, k);
            for (const auto& run : runs) {
                for (const std::uint32_t s : run)
                    done[s] = 1;
            }
            rule_ == BilevelRule::Median ? assign_pairs(runs) : assign_single(runs);
        };
        for (std::uint32_t k = 0; k < chains_.next.size(); ++k) { // open chains first, from their beginnings
            if (chains_.previous[k] == kNone) chain(k);
        }
        for (std::uint32_t k = 0; k < chains_.next.size(); ++k)
            chain(k);
        return std::move(sets_);
    }

  private:
    using Run = std::vector<std::uint32_t>;

    void set(const Run& run, std::size_t begin, std::size_t end, std::uint8_t channels) {
        for (std::size_t k = begin; k < end; ++k)
            sets_[run[k]] = channels;
    }

    /// A run that meets itself in one corner: its thirds.
    void assign_loop(const Run& run, std::uint8_t first, std::uint8_t last) {
        const std::size_t n = run.size();
        set(run, 0, n / 3, first), set(run, n / 3, n - n / 3, all_), set(run, n - n / 3, n, last);
    }

    void assign_pairs(const std::vector<Run>& runs) {
        constexpr std::uint8_t pairs[] = {0b011, 0b110, 0b101};
        const bool closed = chains_.previous[runs[0][0]] != kNone;
        if (runs.size() == 1 && closed) return assign_loop(runs[0], pairs[0], pairs[1]);
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const bool odd_end = closed && r + 1 == runs.size() && r % 2 == 0;
            set(runs[r], 0, runs[r].size(), odd_end ? pairs[2] : pairs[r % 2]);
        }
    }

    /// A corner of what is above is where both channels must be above: min sharpens it; max the others.
    [[nodiscard]] bool sharpened(std::uint32_t k) const {
        return chains_.previous[k] != kNone && chains_.corner(k) &&
               (chains_.turn[k] < 0) == (rule_ == BilevelRule::Min);
    }

    void assign_single(const std::vector<Run>& runs) {
        if (runs.size() == 1) {
            if (sharpened(runs[0][0])) assign_loop(runs[0], 1, 2);
            return;
        }
        std::uint8_t channel = 1;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const bool last = r + 1 == runs.size();
            const bool begins = sharpened(runs[r][0]), ends = sharpened(runs[last ? 0 : r + 1][0]);
            if (begins) channel ^= 3U;
            std::uint8_t end_channel = channel;
            // The last must differ from the first, too.
            if (last && ends && r > 0 && sets_[runs[0][0]] == channel) end_channel = channel ^ 3U;
            if (!begins && !ends) continue;
            const std::size_t n = runs[r].size(), middle = n / 2;
            set(runs[r], 0, middle, begins ? channel : all_);
            set(runs[r], middle, n, ends ? end_channel : all_);
            if (end_channel != channel && n > 2) set(runs[r], n / 3, n - n / 3, all_);
        }
    }

    const Chains& chains_;
    BilevelRule rule_;
    std::uint8_t all_;
    std::vector<std::uint8_t> sets_;
};

/// Segments by the texels that they come near.
class SegmentBuckets {
  public:
    SegmentBuckets(std::span<const OutlineSegment> outline, std::uint32_t width, std::uint32_t height, double reach)
        : first_(std::size_t{width} * height + 1, 0) {
        const auto each = [&](const auto& visit) {
            for (std::uint32_t k = 0; k < outline.size(); ++k) {
                const OutlineSegment& s = outline[k];
                const auto cell = [](double v, std::uint32_t size) {
                    return static_cast<std::uint32_t>(std::clamp(v, 0.0, size - 1.0));
                };
                const std::uint32_t i1 = cell(std::max(s.x0, s.x1) + reach, width),
                                    j1 = cell(std::max(s.y0, s.y1) + reach, height);
                for (std::uint32_t j = cell(std::min(s.y0, s.y1) - reach, height); j <= j1; ++j) {
                    for (std::uint32_t i = cell(std::min(s.x0, s.x1) - reach, width); i <= i1; ++i)
                        visit(std::size_t{j} * width + i, k);
                }
            }
        };
        each([&](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
        for (std::size_t k = 1; k < first_.size(); ++k)
            first_[k] += first_[k - 1];
        items_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        each([&](std::size_t cell, std::uint32_t k) { items_[next[cell]++] = k; });
    }
    [[nodiscard]] std::span<const std::uint32_t> near(std::uint32_t texel) const {
        return std::span(items_).subspan(first_[texel], first_[texel + 1] - first_[texel]);
    }

  private:
    std::vector<std::uint32_t> first_, items_;
};

/// Nearest point of a segment.
struct Nearest {
    double square = INFINITY;
    double slant = INFINITY; ///< of the way there against the segment's normal: 0 where it is upright
    double signed_line = 0;  ///< distance from the segment's line, positive above
    double t = 0;            ///< of the foot on the line; 0…1 inside the segment
    std::uint32_t segment = kNone;

    [[nodiscard]] bool closer_than(const Nearest& other) const {
        const double same = budget::kSameDistance;
        if (square < other.square - same) return true;
        return square <= other.square + same && slant < other.slant;
    }
};

Nearest nearest_on(const OutlineSegment& s, std::uint32_t index, double x, double y) {
    Nearest out;
    const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length = std::hypot(dx, dy);
    if (!(length > 0)) return out;
    out.t = ((x - s.x0) * dx + (y - s.y0) * dy) / (length * length);
    const double t = std::clamp(out.t, 0.0, 1.0);
    const double ex = s.x0 + t * dx - x, ey = s.y0 + t * dy - y;
    out.square = ex * ex + ey * ey;
    out.slant = t == out.t || out.square == 0 ? 0 : std::fabs(ex * dx + ey * dy) / (length * std::sqrt(out.square));
    out.signed_line = ((x - s.x0) * dy - (y - s.y0) * dx) / length; // left: (y', −x')
    out.segment = index;
    return out;
}

} // namespace

std::vector<std::uint8_t> assign_channels(std::span<const OutlineSegment> outline, BilevelRule rule, double window) {
    if (rule == BilevelRule::Single) return std::vector<std::uint8_t>(outline.size(), 1);
    const Chains chains(outline, window);
    return ChannelAssigner(chains, rule).assign();
}

std::vector<std::uint16_t> seed_stored(const ThresholdCells& cells, const ScannedOutline& scanned,
                                       std::span<const OutlineSegment> outline, double reach, double window,
                                       const ValueLevels& levels) {
    const std::uint32_t channels = std::min(cells.channels(), 3U), width = cells.width(), height = cells.height();
    const std::vector<std::uint8_t> sets = assign_channels(outline, cells.rule(), window);
    const Chains chains(outline, window);
    const double search = budget::kSeedSearch;
    const SegmentBuckets buckets(outline, width, height, search + 0.5); // half a texel to its centre
    std::vector<std::uint16_t> values(std::size_t{width} * height * channels);
    const double place = cells.first_place(), half = levels.steps / 2.0;
    const auto stored = [&](std::uint32_t texel, double v) { // in steps
        const double own = v - static_cast<double>(levels.offset(texel)) * levels.steps;
        return static_cast<std::uint16_t>(std::lround(std::clamp<double>(own, levels.least, levels.most)));
    };
    for (std::uint32_t j = 0; j < height; ++j) {
        for (std::uint32_t i = 0; i < width; ++i) {
            const std::uint32_t texel = j * width + i;
            const std::uint16_t flat = stored(texel, scanned.above(i + place, j + place) ? levels.steps : 0);
            std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(std::size_t{texel} * channels), channels, flat);
        }
    }
    for (const std::uint32_t texel : cells.texels()) {
        const double x = texel % width + place, y = texel / width + place;
        std::array<Nearest, 3> nearest;
        for (const std::uint32_t k : buckets.near(texel)) {
            const Nearest n = nearest_on(outline[k], k, x, y);
            for (std::uint32_t c = 0; c < channels; ++c) {
                if ((sets[k] >> c & 1U) != 0 && n.closer_than(nearest[c])) nearest[c] = n;
            }
        }
        const auto is_near = [&](const Nearest& n) { return n.segment != kNone && n.square <= search * search; };
        if (std::ranges::none_of(nearest, is_near)) continue;
        for (std::uint32_t c = 0; c < channels; ++c) {
            const Nearest& n = nearest[c];
            std::uint16_t& value = values[std::size_t{texel} * channels + c];
            if (!is_near(n)) {
                // Nothing of this channel is near: out of the others' way.
                if (cells.rule() == BilevelRule::Min) value = stored(texel, levels.steps);
                if (cells.rule() == BilevelRule::Max) value = stored(texel, 0);
                continue;
            }
            const std::uint32_t beyond = n.t < 0   ? chains.previous[n.segment]
                                         : n.t > 1 ? chains.next[n.segment]
                                                   : n.segment;
            const bool prolonged = beyond == kNone || sets[beyond] != sets[n.segment];
            const double distance =
                beyond == n.segment || prolonged ? n.signed_line : std::copysign(std::sqrt(n.square), n.signed_line);
            value = stored(texel, half + half * distance / reach);
        }
    }
    return values;
}

std::vector<std::uint8_t> seed_values(const ThresholdCells& cells, const ScannedOutline& scanned,
                                      std::span<const OutlineSegment> outline, double reach, double window) {
    const std::vector<std::uint16_t> stored = seed_stored(cells, scanned, outline, reach, window, {});
    std::vector<std::uint8_t> values(stored.size());
    std::ranges::transform(stored, values.begin(), [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
    return values;
}

} // namespace fetexc
