// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/discrete_fit.h"

#include <algorithm>
#include <array>
#include <utility>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr int kFirstGrey = 112, kLastGrey = 143;

class ByteFit {
  public:
    ByteFit(const ThresholdCells& cells, std::vector<std::uint16_t>& stored, const StoredLevels& levels)
        : cells_(cells), stored_(stored), levels_(levels), grain_(levels.levels.grain), values_(stored.size()),
          number_(std::size_t{cells.width()} * cells.height(), kNone) {
        for (const std::uint32_t t : cells.texels())
            number_[t] = count_++;
        bytes_.resize(std::size_t{count_} * cells.channels());
        if (levels_.greys == MidGreys::Avoid) leave_greys();
        for (std::size_t k = 0; k < stored_.size(); ++k)
            values_[k] = levels_.levels.value(k / cells.channels(), stored_[k]);
        for (const Cell& c : cells.cells())
            areas_.push_back(cells.wrong_area_in(values_, c));
    }

    [[nodiscard]] double wrong_area() const {
        double sum = 0;
        for (const double area : areas_)
            sum += area;
        return sum;
    }

    /// Whether any byte is left that may change.
    bool sweep() {
        bool busy = false;
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < cells_.channels(); ++c)
                busy = visit(t, c) || busy;
        }
        return busy;
    }

    /// The same of two bytes at a time, by one step each, in both directions.
    bool sweep_pairs() {
        steps_.resize(bytes_.size());
        bool busy = false;
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < cells_.channels(); ++c)
                busy = visit_pairs(t, c) || busy;
        }
        return busy;
    }

    /// Every byte goes away from one half as far as that costs no area: what doesn't show is no ridge just below it,
    /// which soft cuts would show.
    void settle() {
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < cells_.channels(); ++c) {
                const Place p = place(t, c);
                const int away = values_[p.value] < 0.5F ? -grain_ : grain_;
                for (int step = kLargestStep; step > 0; step /= 4) {
                    while (move(p, away * step, budget::kWorthAByte)) {
                    }
                }
            }
        }
    }

    std::uint64_t tried = 0;

  private:
    struct Byte {
        std::int16_t step = kFirstStep;
        bool open = true; ///< may still change
        bool pairs_open = true;
    };
    static constexpr int kFirstStep = 4, kLargestStep = 64; ///< in grains
    /// Of a byte.
    struct Place {
        std::uint32_t texel, channel;
        std::size_t byte, value; ///< in bytes_ and steps_; in stored_ and values_
        CellsAround cells;
    };

    void leave_greys() {
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < cells_.channels(); ++c) {
                std::uint16_t& v = stored_[std::size_t{t} * cells_.channels() + c];
                if (v >= kFirstGrey && v <= kLastGrey) v = v < 128 ? kFirstGrey - 1 : kLastGrey + 1;
            }
        }
    }

    [[nodiscard]] double area_in(std::uint32_t cell) const {
        return cells_.wrong_area_in(values_, cells_.cells()[cell]);
    }

    /// What becomes of a change if nothing stays wrong in the cells from the k-th on. Never more than what does,
    /// rounded as it is.
    [[nodiscard]] double least_change(double change, const CellsAround& around, std::size_t k) const {
        for (; k < around.size(); ++k)
            change -= areas_[around[k]];
        return change;
    }

    void set(const Place& p, std::uint16_t stored) {
        stored_[p.value] = stored, values_[p.value] = levels_.levels.value(p.texel, stored);
    }

    /// Moves a byte if that changes the wrong area in the cells around it by less than `most`.
    bool move(const Place& p, int by, double most) {
        const CellsAround& around = p.cells;
        const std::uint16_t before = stored_[p.value], to = levels_.moved(before, by);
        if (to == before) return false;
        set(p, to);
        ++tried;
        std::array<double, 4> area;
        double change = 0;
        for (std::size_t k = 0; k < around.size(); ++k) {
            if (!(least_change(change, around, k) < most)) {
                set(p, before);
                return false;
            }
            area[k] = area_in(around[k]);
            change += area[k] - areas_[around[k]];
        }
        if (!(change < most)) {
            set(p, before);
            return false;
        }
        for (std::size_t k = 0; k < around.size(); ++k)
            areas_[around[k]] = area[k];
        return true;
    }

    /// Goes on in the direction as long as it helps.
    bool descend(const Place& p, int by) {
        bool any = false;
        while (move(p, by * grain_, -budget::kWorthAByte))
            any = true;
        return any;
    }

    /// Whether the byte stays open.
    bool visit(std::uint32_t texel, std::uint32_t channel) {
        Byte& byte = bytes_[std::size_t{number_[texel]} * cells_.channels() + channel];
        if (!byte.open) return false;
        const Place here = place(texel, channel);
        double area = 0;
        for (const std::uint32_t c : here.cells)
            area += areas_[c];
        if (area > 0 && (descend(here, byte.step) || descend(here, -byte.step))) {
            byte.step = static_cast<std::int16_t>(std::min(kLargestStep, 2 * byte.step));
            open_around(texel, channel);
            return true;
        }
        byte.open = area > 0 && byte.step > 1;
        byte.step = static_cast<std::int16_t>(std::max(1, byte.step / 2));
        return byte.open;
    }

    struct Neighbour {
        int i, j;
    };
    struct Steps {
        std::array<std::array<double, 4>, 2> area{}; ///< down, up; in the cells around
        bool known = false;
    };

    [[nodiscard]] Place place(std::uint32_t texel, std::uint32_t channel) const {
        const std::uint32_t n = cells_.channels();
        return {texel, channel, std::size_t{number_[texel]} * n + channel, std::size_t{texel} * n + channel,
                cells_.around(texel)};
    }

    bool visit_pairs(std::uint32_t texel, std::uint32_t channel) {
        const std::uint32_t n = cells_.channels(), w = cells_.width(), i = texel % w, j = texel / w;
        Byte& byte = bytes_[std::size_t{number_[texel]} * n + channel];
        if (!byte.pairs_open) return false;
        byte.pairs_open = false;
        bool any = false;
        const Place here = place(texel, channel);
        for (std::uint32_t other = channel + 1; other < n; ++other)
            any = descend_pair(here, place(texel, other)) || any;
        for (const Neighbour d : {Neighbour{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) {
            const std::int64_t x = std::int64_t{i} + d.i, y = std::int64_t{j} + d.j;
            if (x < 0 || x >= w || y >= cells_.height()) continue;
            const auto other = static_cast<std::uint32_t>(y * w + x);
            if (number_[other] != kNone) any = descend_pair(here, place(other, channel)) || any;
        }
        return any;
    }

    /// The area of a cell after a byte's steps down and up by one.
    const Steps& steps_of(const Place& p) {
        Steps& out = steps_[p.byte];
        if (out.known) return out;
        const std::uint16_t before = stored_[p.value];
        for (std::size_t up = 0; up < 2; ++up) {
            const std::uint16_t v = levels_.moved(before, up == 0 ? -grain_ : grain_);
            set(p, v);
            for (std::size_t k = 0; k < p.cells.size(); ++k)
                out.area[up][k] = v == before ? areas_[p.cells[k]] : area_in(p.cells[k]);
            tried += v == before ? 0 : 1;
        }
        set(p, before), out.known = true;
        return out;
    }

    /// Cells with only one of the two bytes change as they do when it alone changes. If the others can't win back what
    /// that costs, nothing is tried.
    bool descend_pair(const Place& a, const Place& b) {
        bool any = false;
        for (std::size_t direction = 0; direction < 4; ++direction)
            any = step_both(a, direction >> 1, b, direction & 1) || any;
        return any;
    }

    bool step_both(const Place& a, std::size_t up_a, const Place& b, std::size_t up_b) {
        std::array<std::pair<std::uint32_t, double>, 8> after;
        std::size_t count = 0;
        double change = 0; // of the cells with one
        const auto alone = [&](const Place& p, const Place& other, std::size_t up) {
            const Steps& steps = steps_of(p);
            for (std::size_t k = 0; k < p.cells.size(); ++k) {
                if (std::ranges::find(other.cells, p.cells[k]) != other.cells.end()) continue;
                after[count++] = {p.cells[k], steps.area[up][k]};
                change += steps.area[up][k] - areas_[p.cells[k]];
            }
        };
        alone(a, b, up_a), alone(b, a, up_b);
        double shared = 0;
        for (const std::uint32_t c : a.cells)
            shared += std::ranges::find(b.cells, c) != b.cells.end() ? areas_[c] : 0;
        if (!(change - shared < -budget::kWorthAByte)) return false;
        const std::uint16_t before_a = stored_[a.value], before_b = stored_[b.value];
        set(a, levels_.moved(before_a, up_a == 0 ? -grain_ : grain_));
        set(b, levels_.moved(before_b, up_b == 0 ? -grain_ : grain_));
        ++tried;
        for (const std::uint32_t c : a.cells) {
            if (std::ranges::find(b.cells, c) == b.cells.end()) continue;
            after[count++] = {c, area_in(c)};
            change += after[count - 1].second - areas_[c];
        }
        if (!(change < -budget::kWorthAByte)) {
            set(a, before_a), set(b, before_b);
            return false;
        }
        for (std::size_t k = 0; k < count; ++k)
            areas_[after[k].first] = after[k].second;
        open_around(a.texel, a.channel), open_around(b.texel, b.channel);
        return true;
    }

    void open_around(std::uint32_t texel, std::uint32_t channel) {
        const std::uint32_t w = cells_.width(), i = texel % w, j = texel / w;
        for (std::uint32_t y = j == 0 ? 0 : j - 1; y <= std::min(j + 1, cells_.height() - 1); ++y) {
            for (std::uint32_t x = i == 0 ? 0 : i - 1; x <= std::min(i + 1, w - 1); ++x) {
                const std::uint32_t n = number_[y * w + x];
                if (n == kNone) continue;
                for (std::uint32_t c = 0; c < cells_.channels(); ++c) {
                    Byte& other = bytes_[std::size_t{n} * cells_.channels() + c];
                    if (!steps_.empty()) steps_[std::size_t{n} * cells_.channels() + c].known = false;
                    other.open = other.pairs_open = true;
                    if (y * w + x != texel || c != channel) other.step = std::max<std::int16_t>(other.step, 2);
                }
            }
        }
    }

    const ThresholdCells& cells_;
    std::vector<std::uint16_t>& stored_;
    const StoredLevels& levels_;
    int grain_;
    std::vector<float> values_; ///< of stored_
    std::vector<std::uint32_t> number_;
    std::uint32_t count_ = 0;
    std::vector<Byte> bytes_;
    std::vector<Steps> steps_;  ///< once pairs are tried
    std::vector<double> areas_; ///< of the cells, with the values as they are
};

} // namespace

std::uint16_t StoredLevels::moved(std::uint16_t v, int by) const {
    const int least = levels.least, most = levels.most;
    int to = std::clamp(v + by, least, most);
    if (greys == MidGreys::Avoid && to >= kFirstGrey && to <= kLastGrey) to = by > 0 ? kLastGrey + 1 : kFirstGrey - 1;
    return static_cast<std::uint16_t>(to);
}

std::uint8_t moved(std::uint8_t v, int by, MidGreys greys) {
    return static_cast<std::uint8_t>(StoredLevels{{}, greys}.moved(v, by));
}

std::uint64_t fit_stored(const ThresholdCells& cells, std::vector<std::uint16_t>& stored, const StoredLevels& levels,
                         ByteSweeps sweeps, FitTrace& trace) {
    ByteFit fit(cells, stored, levels);
    bool busy = !cells.texels().empty();
    for (int k = 0, pairs = 0; k < sweeps.most && busy; ++k) {
        busy = fit.sweep();
        if (!busy && pairs < sweeps.pairs) ++pairs, busy = fit.sweep_pairs();
        trace.push_back(fit.wrong_area());
    }
    if (sweeps.settle) {
        fit.settle();
        trace.push_back(fit.wrong_area());
    }
    return fit.tried;
}

std::uint64_t fit_bytes(const ThresholdCells& cells, std::vector<std::uint8_t>& values, MidGreys greys,
                        ByteSweeps sweeps, FitTrace& trace) {
    std::vector<std::uint16_t> stored(values.begin(), values.end());
    const std::uint64_t tried = fit_stored(cells, stored, {{}, greys}, sweeps, trace);
    std::ranges::transform(stored, values.begin(), [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
    return tried;
}

} // namespace fetexc
