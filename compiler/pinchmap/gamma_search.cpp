// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/gamma_search.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <utility>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

constexpr std::array kSteps = {4, 1};            ///< in grains,
constexpr std::uint32_t kFinest = 1024;          ///< which are no less than such a part of all steps
constexpr std::uint32_t kFartherBy = 12;         ///< a perturbation is at most so large a part of all steps
constexpr std::uint32_t kPatch = 2, kAround = 1; ///< texels: perturbed; fitted again on every side of them

/// The numbers as they are, of all texels.
struct State {
    State(const ThresholdCells& of, const ValueLevels& in, std::vector<std::uint16_t>& numbers)
        : cells(of), levels(in), grain(std::max(in.grain, static_cast<int>(in.steps / kFinest))), stored(numbers),
          values(numbers.size()), is_free(numbers.size(), 0) {
        for (const std::uint32_t t : cells.texels())
            is_free[t] = 1;
        for (std::size_t k = 0; k < stored.size(); ++k)
            values[k] = levels.value(k, stored[k]);
        for (const Cell& c : cells.cells())
            areas.push_back(cells.wrong_area_in(values, c));
    }

    [[nodiscard]] double wrong_area() const { return std::accumulate(areas.begin(), areas.end(), 0.0); }

    const ThresholdCells& cells;
    const ValueLevels& levels;
    int grain;
    std::vector<std::uint16_t>& stored;
    std::vector<float> values;
    std::vector<std::uint8_t> is_free;
    std::vector<double> areas;
};

/// Of some texels of rows next to each other.
class Search {
  public:
    Search(State& state, std::vector<std::uint32_t> places, std::uint64_t seed)
        : cells_(state.cells), levels_(state.levels), grain_(state.grain), stored_(state.stored), values_(state.values),
          is_free_(state.is_free), areas_(state.areas), places_(std::move(places)), random_(seed) {}

    /// A round for each place, at random ones.
    void rounds() {
        for (std::size_t n = places_.size(); n > 0; --n)
            round();
    }

    std::uint64_t tried = 0;

  private:
    void round() {
        const std::uint32_t place = places_[below(places_.size())];
        collect(place % cells_.width(), place / cells_.width());
        const double before = area_of_patch();
        if (before < budget::kPinchmapWorthARound) return;
        save();
        for (const std::uint32_t t : core_)
            perturb(t);
        for (const std::uint32_t c : patch_cells_)
            areas_[c] = area_in(c);
        if (!(refit(before) < before - budget::kWorthAByte)) restore();
    }

    std::uint64_t below(std::uint64_t n) { return random_() % n; }

    [[nodiscard]] double area_in(std::uint32_t cell) const {
        return cells_.wrong_area_in(values_, cells_.cells()[cell]);
    }
    void set(std::uint32_t texel, std::uint16_t v) { stored_[texel] = v, values_[texel] = levels_.value(texel, v); }

    [[nodiscard]] double area_of_patch() const {
        double sum = 0;
        for (const std::uint32_t c : patch_cells_)
            sum += areas_[c];
        return sum;
    }
    void save() {
        saved_.clear(), saved_areas_.clear();
        for (const std::uint32_t t : patch_)
            saved_.push_back(stored_[t]);
        for (const std::uint32_t c : patch_cells_)
            saved_areas_.push_back(areas_[c]);
    }
    void restore() {
        for (std::size_t k = 0; k < patch_.size(); ++k)
            set(patch_[k], saved_[k]);
        for (std::size_t k = 0; k < patch_cells_.size(); ++k)
            areas_[patch_cells_[k]] = saved_areas_[k];
    }
    /// Until nothing helps, or until a sweep wins less than what is still missing.
    double refit(double before) {
        double area = area_of_patch();
        for (bool any = true; any;) {
            any = false;
            for (const std::uint32_t t : patch_)
                any = optimise(t) || any;
            const double now = area_of_patch();
            if (now > before && now - before > area - now) return now;
            area = now;
        }
        return area;
    }

    void collect(std::uint32_t i, std::uint32_t j) {
        const std::uint32_t w = cells_.width(), h = cells_.height();
        core_.clear(), patch_.clear(), patch_cells_.clear();
        for (std::uint32_t y = j - std::min(j, kAround); y <= std::min(j + kPatch - 1 + kAround, h - 1); ++y) {
            for (std::uint32_t x = i - std::min(i, kAround); x <= std::min(i + kPatch - 1 + kAround, w - 1); ++x) {
                const std::uint32_t t = y * w + x;
                if (is_free_[t] == 0) continue;
                patch_.push_back(t);
                if (x >= i && x < i + kPatch && y >= j && y < j + kPatch) core_.push_back(t);
                for (const std::uint32_t c : cells_.around(t))
                    patch_cells_.push_back(c);
            }
        }
        std::ranges::sort(patch_cells_);
        patch_cells_.erase(std::unique(patch_cells_.begin(), patch_cells_.end()), patch_cells_.end());
    }

    void perturb(std::uint32_t t) {
        const std::uint64_t most = levels_.steps / kFartherBy;
        const std::int64_t by = static_cast<std::int64_t>(below(2 * most + 1)) - static_cast<std::int64_t>(most);
        set(t, moved(t, static_cast<int>(by)));
    }
    [[nodiscard]] std::uint16_t moved(std::uint32_t t, int by) const {
        const int least = levels_.least, most = levels_.most;
        return static_cast<std::uint16_t>(std::clamp(stored_[t] + by, least, most));
    }

    bool optimise(std::uint32_t t) {
        bool any = false;
        const CellsAround around = cells_.around(t);
        for (const int step : kSteps) {
            for (const int by : {step, -step}) {
                while (move(t, by * grain_, around))
                    any = true;
            }
        }
        return any;
    }

    bool move(std::uint32_t t, int by, const CellsAround& around) {
        const std::uint16_t before = stored_[t], to = moved(t, by);
        if (to == before) return false;
        set(t, to);
        ++tried;
        std::array<double, 4> area;
        double left = 0;
        for (const std::uint32_t c : around)
            left += areas_[c];
        left -= budget::kWorthAByte;
        for (std::size_t k = 0; k < around.size(); ++k) {
            area[k] = area_in(around[k]), left -= area[k];
            if (!(left > 0)) {
                set(t, before);
                return false;
            }
        }
        for (std::size_t k = 0; k < around.size(); ++k)
            areas_[around[k]] = area[k];
        return true;
    }

    const ThresholdCells& cells_;
    const ValueLevels& levels_;
    int grain_;
    std::vector<std::uint16_t>& stored_;
    std::vector<float>& values_;
    const std::vector<std::uint8_t>& is_free_;
    std::vector<double>& areas_;
    std::vector<std::uint32_t> places_;
    std::vector<std::uint32_t> core_, patch_, patch_cells_;
    std::vector<std::uint16_t> saved_;
    std::vector<double> saved_areas_;
    std::mt19937_64 random_;
};

/// Rows of texels in a band. A round reads and writes at most two rows before its place and three after it, so two
/// bands with one between them share nothing.
constexpr std::uint32_t kBandRows = 16;

std::vector<Search> bands_of(State& state) {
    std::vector<std::vector<std::uint32_t>> places((state.cells.height() + kBandRows - 1) / kBandRows);
    for (const std::uint32_t t : state.cells.texels())
        places[t / state.cells.width() / kBandRows].push_back(t);
    std::vector<Search> out;
    for (std::vector<std::uint32_t>& band : places)
        out.emplace_back(state, std::move(band), out.size() + 1);
    return out;
}

} // namespace

std::uint64_t search_stored(const ThresholdCells& cells, const ValueLevels& levels, std::uint32_t rounds,
                            unsigned threads, std::vector<std::uint16_t>& stored, FitTrace& trace) {
    if (cells.texels().empty()) return 0;
    State state(cells, levels, stored);
    std::vector<Search> bands = bands_of(state);
    for (std::uint32_t k = 0; k < rounds; ++k) {
        for (const std::size_t first : {0U, 1U})
            parallel_for((bands.size() + 1 - first) / 2, threads,
                         [&](std::size_t n) { bands[2 * n + first].rounds(); });
        trace.push_back(state.wrong_area());
    }
    std::uint64_t tried = 0;
    for (const Search& band : bands)
        tried += band.tried;
    return tried;
}

} // namespace fetexc
