// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/mend_parts.h"

#include <algorithm>
#include <cmath>

#include "compiler/bilevel/shown_parts.h"
#include "compiler/error_budget.h"

namespace fetexc {
namespace {

/// Changes of single bytes that leave fewer parts lost or invented.
class Mender {
  public:
    Mender(const ThresholdCells& fine, const PartJudge& judge, MidGreys greys, std::vector<std::uint8_t>& values)
        : fine_(fine), judge_(judge), greys_(greys), values_(values) {}

    std::uint64_t run() {
        for (int pass = 0; pass < kPasses; ++pass) {
            const std::uint64_t before = changed_;
            const Shown now = judge_.shown(texture(), 1);
            for (const PartExtent& e : now.invented)
                mend(e, [](const Shown& was, const Shown& is) {
                    return is.invented.size() < was.invented.size() && is.alive.size() >= was.alive.size();
                });
            for (const PartExtent& e : judge_.lost(now))
                mend(e, [](const Shown& was, const Shown& is) {
                    return is.invented.size() <= was.invented.size() && is.alive.size() > was.alive.size();
                });
            if (changed_ == before) break;
        }
        return changed_;
    }

  private:
    struct Change {
        double cost = 0; ///< square texels
        std::size_t value = 0;
        std::uint8_t to = 0;
    };
    static constexpr int kPasses = 4;            ///< a change may uncover a part
    static constexpr std::uint32_t kLargest = 4; ///< cells along a part's sides: those that are larger stay

    [[nodiscard]] TextureValues texture() const { return {values_, fine_.width(), fine_.height(), fine_.rule()}; }

    template <class Better> void mend(const PartExtent& e, const Better& better) {
        const auto cell = [](double at) { return static_cast<std::uint32_t>(std::floor(at + 0.5)); };
        const auto row = [&](std::uint32_t n) { return cell((n + 0.5) / judge_.per_texel()); };
        const Window at{cell(e.from), std::min(cell(e.to), fine_.width()) + 1, row(e.first_row), row(e.last_row) + 1};
        if (at.last_column - at.first_column > kLargest || at.last_row - at.first_row > kLargest) return;
        // A byte changes the cells around it, and one more says whether what shows there goes on.
        const auto before = [](std::uint32_t v) { return v < 2 ? 0 : v - 2; };
        const Window around{before(at.first_column), std::min(at.last_column + 2, fine_.width() + 1),
                            before(at.first_row), std::min(at.last_row + 2, fine_.height() + 1)};
        const Shown now = judge_.shown(texture(), around);
        for (const Change& c : changes(at)) {
            if (c.cost > budget::kWorthAPart) return;
            const std::uint8_t old = values_[c.value];
            values_[c.value] = c.to;
            if (better(now, judge_.shown(texture(), around))) {
                ++changed_;
                return;
            }
            values_[c.value] = old;
        }
    }

    /// Of every byte at the cells' corners, the cheapest first.
    std::vector<Change> changes(const Window& at) {
        std::vector<Change> out;
        const std::uint32_t channels = fine_.channels();
        for (std::uint32_t j = at.first_row == 0 ? 0 : at.first_row - 1; j < std::min(at.last_row, fine_.height());
             ++j) {
            for (std::uint32_t i = at.first_column == 0 ? 0 : at.first_column - 1;
                 i < std::min(at.last_column, fine_.width()); ++i) {
                const std::uint32_t texel = j * fine_.width() + i;
                if (!std::ranges::binary_search(fine_.texels(), texel)) continue;
                for (std::uint32_t c = 0; c < channels; ++c)
                    add_changes(texel, std::size_t{texel} * channels + c, out);
            }
        }
        std::ranges::stable_sort(out, {}, &Change::cost);
        return out;
    }

    void add_changes(std::uint32_t texel, std::size_t value, std::vector<Change>& out) {
        const std::uint8_t old = values_[value];
        const double now = area_around(texel);
        for (int step = 1; step < 256; step *= 2) {
            for (const int by : {step, -step}) {
                const std::uint8_t to = moved(old, by, greys_);
                if (to == old) continue;
                values_[value] = to;
                out.push_back({area_around(texel) - now, value, to});
            }
        }
        values_[value] = old;
    }

    [[nodiscard]] double area_around(std::uint32_t texel) const {
        double sum = 0;
        for (const std::uint32_t c : fine_.around(texel))
            sum += fine_.wrong_area_in(values_, fine_.cells()[c]);
        return sum;
    }

    const ThresholdCells& fine_;
    const PartJudge& judge_;
    MidGreys greys_;
    std::vector<std::uint8_t>& values_;
    std::uint64_t changed_ = 0;
};

} // namespace

std::uint64_t mend_parts(const ThresholdCells& fine, const ScannedOutline& rows,
                         std::span<const OutlineSegment> outline, MidGreys greys, std::vector<std::uint8_t>& values) {
    return Mender(fine, PartJudge(rows, outline, fine.height()), greys, values).run();
}

} // namespace fetexc
