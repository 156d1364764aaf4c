// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/gamma_annealing.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "tests/support/random.h"

namespace fetexc::test {
namespace {

using fetex::PinchmapTexel;

/// Pixels of cells that match, row by row, for every place where a row may change sides (the paper's table).
class PixelTable {
  public:
    explicit PixelTable(const PixelZones& zones) : n_(zones.pixels), columns_(zones.width) {
        const std::size_t stride = std::size_t{zones.width} * n_;
        counts_.resize(std::size_t{zones.width} * zones.height * n_ * (n_ + 1));
        for (std::size_t j = 0; j < zones.height; ++j) {
            for (std::size_t i = 0; i < zones.width; ++i) {
                for (std::size_t y = 0; y < n_; ++y) {
                    const std::uint8_t* const row = &zones.above[(j * n_ + y) * stride + i * n_];
                    std::uint16_t* const out = counts(i, j, y);
                    for (std::size_t x = 0; x < n_; ++x)
                        out[x + 1] = static_cast<std::uint16_t>(out[x] + row[x]);
                }
            }
        }
    }

    /// Wrong pixels of a cell with k − γ at its corners.
    [[nodiscard]] std::uint32_t wrong(std::size_t i, std::size_t j, double nw, double ne, double sw, double se) const {
        std::uint32_t sum = 0;
        for (std::size_t y = 0; y < n_; ++y) {
            const double v = (static_cast<double>(y) + 0.5) / n_;
            const double left = nw + (sw - nw) * v, right = ne + (se - ne) * v;
            const std::uint16_t* const above = counts(i, j, y);
            const auto upto = [&](std::size_t x, bool shown) { return shown ? x - above[x] : above[x]; };
            std::size_t change = n_; // pixels before it are as the row begins
            if ((left > 0) != (right > 0)) {
                const double at = left / (left - right) * n_ - 0.5;
                change = static_cast<std::size_t>(std::clamp(std::ceil(at), 0.0, static_cast<double>(n_)));
            }
            const std::size_t rest = n_ - change, above_rest = above[n_] - above[change];
            sum += static_cast<std::uint32_t>(upto(change, left > 0) + (left > 0 ? above_rest : rest - above_rest));
        }
        return sum;
    }

  private:
    std::uint16_t* counts(std::size_t i, std::size_t j, std::size_t y) {
        return &counts_[((j * columns_ + i) * n_ + y) * (n_ + 1)];
    }
    [[nodiscard]] const std::uint16_t* counts(std::size_t i, std::size_t j, std::size_t y) const {
        return &counts_[((j * columns_ + i) * n_ + y) * (n_ + 1)];
    }

    std::size_t n_, columns_;
    std::vector<std::uint16_t> counts_;
};

class Annealer {
  public:
    Annealer(const PixelZones& zones, double zero, std::uint64_t seed, std::vector<PinchmapTexel>& map)
        : zones_(zones), table_(zones), zero_(zero), random_(seed), map_(map),
          wrong_(std::size_t{zones.width} * zones.height) {
        for (std::uint32_t j = 0; j < zones_.height; ++j) {
            for (std::uint32_t i = 0; i < zones_.width; ++i)
                wrong_[cell(i, j)] = measure(i, j);
        }
        for (std::uint32_t j = 0; j <= zones_.height; ++j) {
            for (std::uint32_t i = 0; i <= zones_.width; ++i) {
                if (near_active(i, j)) places_.emplace_back(i, j);
            }
        }
    }

    AnnealingResult run(double seconds) {
        const double start = processor_seconds();
        const auto passed = [&] { return processor_seconds() - start; };
        AnnealingResult out;
        for (const auto& [i, j] : places_)
            optimise(i, j);
        out.at_first = total();
        while (passed() < seconds && !places_.empty()) {
            try_round();
            ++out.rounds;
        }
        out.wrong = total(), out.seconds = passed();
        return out;
    }

    [[nodiscard]] std::uint64_t total() const {
        std::uint64_t sum = 0;
        for (const std::uint32_t w : wrong_)
            sum += w;
        return sum;
    }

  private:
    [[nodiscard]] std::size_t node(std::uint32_t i, std::uint32_t j) const {
        return std::size_t{j} * (zones_.width + 1) + i;
    }
    [[nodiscard]] std::size_t cell(std::uint32_t i, std::uint32_t j) const { return std::size_t{j} * zones_.width + i; }

    template <class Visit>
    void each_node(std::int64_t i0, std::int64_t j0, std::int64_t i1, std::int64_t j1, const Visit& visit) const {
        for (std::int64_t j = std::max<std::int64_t>(j0, 0); j <= std::min<std::int64_t>(j1, zones_.height); ++j) {
            for (std::int64_t i = std::max<std::int64_t>(i0, 0); i <= std::min<std::int64_t>(i1, zones_.width); ++i)
                visit(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        }
    }
    template <class Visit> void each_cell_around(std::uint32_t i, std::uint32_t j, const Visit& visit) const {
        for (std::uint32_t y = j == 0 ? 0 : j - 1; y < std::min(j + 1, zones_.height); ++y) {
            for (std::uint32_t x = i == 0 ? 0 : i - 1; x < std::min(i + 1, zones_.width); ++x)
                visit(x, y);
        }
    }

    [[nodiscard]] bool near_active(std::int64_t i, std::int64_t j) const {
        bool found = false;
        each_node(i - 1, j - 1, i + 1, j + 1,
                  [&](std::uint32_t x, std::uint32_t y) { found = found || map_[node(x, y)].k == 0; });
        return found;
    }

    [[nodiscard]] std::uint32_t measure(std::uint32_t i, std::uint32_t j) const {
        const auto f = [&](std::uint32_t x, std::uint32_t y) { return map_[node(x, y)].k - map_[node(x, y)].gamma; };
        return table_.wrong(i, j, f(i, j), f(i + 1, j), f(i, j + 1), f(i + 1, j + 1));
    }

    [[nodiscard]] double stored(double gamma) const {
        const double most = (zero_ - 1) / zero_;
        return std::clamp(std::round(gamma * zero_) / zero_, -most, most);
    }

    /// Up and down by ever smaller steps.
    void optimise(std::uint32_t i, std::uint32_t j) {
        double& gamma = map_[node(i, j)].gamma;
        for (double delta = 0.5; delta * zero_ >= 1; delta /= 2) {
            for (const double by : {delta, -delta}) {
                while (attempt(i, j, gamma, stored(gamma + by))) {
                }
            }
        }
    }
    bool attempt(std::uint32_t i, std::uint32_t j, double& gamma, double to) {
        if (to == gamma) return false;
        const double before = gamma;
        std::int64_t change = 0;
        gamma = to;
        each_cell_around(i, j, [&](std::uint32_t x, std::uint32_t y) {
            change += std::int64_t{measure(x, y)} - wrong_[cell(x, y)];
        });
        if (change >= 0) {
            gamma = before;
            return false;
        }
        each_cell_around(i, j, [&](std::uint32_t x, std::uint32_t y) { wrong_[cell(x, y)] = measure(x, y); });
        return true;
    }

    void try_round() {
        const auto& [i, j] = places_[static_cast<std::size_t>(random_.unit() * static_cast<double>(places_.size()))];
        std::vector<std::pair<std::size_t, double>> gammas;
        std::vector<std::pair<std::size_t, std::uint32_t>> cells;
        const std::int64_t x0 = std::int64_t{i} - 1, y0 = std::int64_t{j} - 1; // 4 × 4 from here on
        each_node(x0, y0, x0 + 3, y0 + 3,
                  [&](std::uint32_t x, std::uint32_t y) { gammas.emplace_back(node(x, y), map_[node(x, y)].gamma); });
        std::uint64_t before = 0;
        for (std::int64_t y = std::max<std::int64_t>(y0 - 1, 0); y <= std::min<std::int64_t>(y0 + 3, zones_.height - 1);
             ++y) {
            for (std::int64_t x = std::max<std::int64_t>(x0 - 1, 0);
                 x <= std::min<std::int64_t>(x0 + 3, zones_.width - 1); ++x) {
                const std::size_t at = cell(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
                cells.emplace_back(at, wrong_[at]), before += wrong_[at];
            }
        }
        each_node(i, j, std::int64_t{i} + 1, std::int64_t{j} + 1, [&](std::uint32_t x, std::uint32_t y) {
            map_[node(x, y)].gamma = stored(map_[node(x, y)].gamma + random_.between(-0.5, 0.5));
            each_cell_around(x, y, [&](std::uint32_t a, std::uint32_t b) { wrong_[cell(a, b)] = measure(a, b); });
        });
        each_node(x0, y0, x0 + 3, y0 + 3, [&](std::uint32_t x, std::uint32_t y) {
            if (near_active(x, y)) optimise(x, y);
        });
        std::uint64_t after = 0;
        for (const auto& [at, wrong] : cells)
            after += wrong_[at];
        if (after < before) return;
        for (const auto& [at, gamma] : gammas)
            map_[at].gamma = gamma;
        for (const auto& [at, wrong] : cells)
            wrong_[at] = wrong;
    }

    const PixelZones& zones_;
    PixelTable table_;
    double zero_;
    Random random_;
    std::vector<PinchmapTexel>& map_;
    std::vector<std::uint32_t> wrong_; ///< of cells
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places_;
};

} // namespace

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

AnnealingResult anneal_gamma(const PixelZones& zones, fetex::PinchmapFormat format, double seconds, std::uint64_t seed,
                             std::vector<PinchmapTexel>& map) {
    return Annealer(zones, fetex::pinchmap_zero(format), seed, map).run(seconds);
}

std::uint64_t wrong_pixels(const PixelZones& zones, const std::vector<PinchmapTexel>& map) {
    std::vector<PinchmapTexel> copy = map;
    return Annealer(zones, 1, 1, copy).total();
}

} // namespace fetexc::test
