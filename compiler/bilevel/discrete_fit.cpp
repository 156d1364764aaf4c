// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/discrete_fit.h"

#include <algorithm>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr int kFirstGrey = 112, kLastGrey = 143;

class ByteFit {
  public:
    ByteFit(const ThresholdCells& cells, std::vector<std::uint8_t>& values, MidGreys greys)
        : cells_(cells), values_(values), greys_(greys), number_(std::size_t{cells.width()} * cells.height(), kNone) {
        for (const std::uint32_t t : cells.texels())
            number_[t] = count_++;
        bytes_.resize(std::size_t{count_} * cells.channels());
        if (greys_ == MidGreys::Avoid) leave_greys();
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
        bool busy = false;
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < cells_.channels(); ++c)
                busy = visit_pairs(t, c) || busy;
        }
        return busy;
    }

    std::uint64_t tried = 0;

  private:
    struct Byte {
        std::int16_t step = kFirstStep;
        bool open = true; ///< may still change
        bool pairs_open = true;
    };
    static constexpr int kFirstStep = 4, kLargestStep = 64;

    void leave_greys() {
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < cells_.channels(); ++c) {
                std::uint8_t& v = values_[std::size_t{t} * cells_.channels() + c];
                if (v >= kFirstGrey && v <= kLastGrey) v = v < 128 ? kFirstGrey - 1 : kLastGrey + 1;
            }
        }
    }

    [[nodiscard]] std::uint8_t moved(std::uint8_t v, int by) const {
        int to = std::clamp(v + by, 0, 255);
        if (greys_ == MidGreys::Avoid && to >= kFirstGrey && to <= kLastGrey)
            to = by > 0 ? kLastGrey + 1 : kFirstGrey - 1;
        return static_cast<std::uint8_t>(to);
    }

    /// Goes on in the direction as long as it helps.
    bool descend(std::uint32_t texel, std::uint8_t& v, int by, double& least) {
        bool any = false;
        for (;;) {
            const std::uint8_t before = v;
            v = moved(v, by);
            if (v == before) return any;
            ++tried;
            const double area = cells_.wrong_area_around(values_, texel);
            if (!(area < least - budget::kWorthAByte)) {
                v = before;
                return any;
            }
            least = area, any = true;
        }
    }

    /// Whether the byte stays open.
    bool visit(std::uint32_t texel, std::uint32_t channel) {
        Byte& byte = bytes_[std::size_t{number_[texel]} * cells_.channels() + channel];
        if (!byte.open) return false;
        double least = cells_.wrong_area_around(values_, texel);
        std::uint8_t& v = values_[std::size_t{texel} * cells_.channels() + channel];
        if (least > 0 && (descend(texel, v, byte.step, least) || descend(texel, v, -byte.step, least))) {
            byte.step = static_cast<std::int16_t>(std::min(kLargestStep, 2 * byte.step));
            open_around(texel, channel);
            return true;
        }
        byte.open = least > 0 && byte.step > 1;
        byte.step = static_cast<std::int16_t>(std::max(1, byte.step / 2));
        return byte.open;
    }

    struct Neighbour {
        int i, j;
    };

    bool visit_pairs(std::uint32_t texel, std::uint32_t channel) {
        const std::uint32_t n = cells_.channels(), w = cells_.width(), i = texel % w, j = texel / w;
        Byte& byte = bytes_[std::size_t{number_[texel]} * n + channel];
        if (!byte.pairs_open) return false;
        byte.pairs_open = false;
        bool any = false;
        for (std::uint32_t other = channel + 1; other < n; ++other)
            any = descend_pair(texel, channel, texel, other) || any;
        for (const Neighbour d : {Neighbour{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) {
            const std::int64_t x = std::int64_t{i} + d.i, y = std::int64_t{j} + d.j;
            if (x < 0 || x >= w || y >= cells_.height()) continue;
            const auto other = static_cast<std::uint32_t>(y * w + x);
            if (number_[other] != kNone) any = descend_pair(texel, channel, other, channel) || any;
        }
        return any;
    }

    bool descend_pair(std::uint32_t a, std::uint32_t channel_a, std::uint32_t b, std::uint32_t channel_b) {
        const std::uint32_t n = cells_.channels();
        std::uint8_t &va = values_[std::size_t{a} * n + channel_a], &vb = values_[std::size_t{b} * n + channel_b];
        double least = cells_.wrong_area_around(values_, a, b);
        if (!(least > 0)) return false;
        bool any = false;
        for (const int by_a : {1, -1}) {
            for (const int by_b : {1, -1}) {
                const std::uint8_t before_a = va, before_b = vb;
                va = moved(va, by_a), vb = moved(vb, by_b);
                ++tried;
                const double area = cells_.wrong_area_around(values_, a, b);
                if (area < least - budget::kWorthAByte) {
                    least = area, any = true;
                    open_around(a, channel_a), open_around(b, channel_b);
                } else {
                    va = before_a, vb = before_b;
                }
            }
        }
        return any;
    }

    void open_around(std::uint32_t texel, std::uint32_t channel) {
        const std::uint32_t w = cells_.width(), i = texel % w, j = texel / w;
        for (std::uint32_t y = j == 0 ? 0 : j - 1; y <= std::min(j + 1, cells_.height() - 1); ++y) {
            for (std::uint32_t x = i == 0 ? 0 : i - 1; x <= std::min(i + 1, w - 1); ++x) {
                const std::uint32_t n = number_[y * w + x];
                if (n == kNone) continue;
                for (std::uint32_t c = 0; c < cells_.channels(); ++c) {
                    Byte& other = bytes_[std::size_t{n} * cells_.channels() + c];
                    other.open = other.pairs_open = true;
                    if (y * w + x != texel || c != channel) other.step = std::max<std::int16_t>(other.step, 2);
                }
            }
        }
    }

    const ThresholdCells& cells_;
    std::vector<std::uint8_t>& values_;
    MidGreys greys_;
    std::vector<std::uint32_t> number_;
    std::uint32_t count_ = 0;
    std::vector<Byte> bytes_;
};

} // namespace

std::uint64_t fit_bytes(const ThresholdCells& cells, std::vector<std::uint8_t>& values, MidGreys greys,
                        ByteSweeps sweeps, FitTrace& trace) {
    ByteFit fit(cells, values, greys);
    bool busy = !cells.texels().empty();
    for (int k = 0, pairs = 0; k < sweeps.most && busy; ++k) {
        busy = fit.sweep();
        if (!busy && pairs < sweeps.pairs) ++pairs, busy = fit.sweep_pairs();
        trace.push_back(cells.wrong_area(values));
    }
    return fit.tried;
}

} // namespace fetexc
