// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/curve_sweep.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/bench/compile_time.h"
#include "cli/compile_curves.h"
#include "compiler/measure/alternatives.h"
#include "compiler/measure/colors.h"
#include "compiler/scene/lattice.h"

namespace fetexc::cli {
namespace {

using measure::BitmapPicture;
using measure::CurveTruth;

constexpr auto kMapFormat = fetex::FeatureSampleFormat::Rgba8;
constexpr std::size_t kMethods = 3;

/// As the texture with feature curves has its base map: 0 is one of the numbers.
std::vector<std::uint8_t> normal_map_bytes(const std::vector<Rgba>& means) {
    const double factor = fetex::feature_normal_factor(kMapFormat);
    std::vector<std::uint8_t> out;
    for (const Rgba& c : means) {
        const double x = 2 * c.r - 1, y = 2 * c.g - 1, z = 2 * c.b - 1, length = std::hypot(x, y, z);
        for (const double v : {x, y, z})
            out.push_back(measure::to_byte((length > 0 ? v / length + 1 : 1) / factor));
        out.push_back(255);
    }
    return out;
}

/// What a shader makes of the map's interpolated colour: a normal of length 1, as (n + 1) / 2.
Rgba shown_normal(const Rgba& c) {
    const double factor = fetex::feature_normal_factor(kMapFormat);
    const double x = c.r * factor - 1, y = c.g * factor - 1, z = c.b * factor - 1, length = std::hypot(x, y, z);
    if (!(length > 0)) return {0.5, 0.5, 1, 1};
    return {(x / length + 1) / 2, (y / length + 1) / 2, (z / length + 1) / 2, 1};
}

/// An ordinary one, of the truth's means over its texels.
BitmapPicture normal_map(const CurveTruth& truth, GridSize size, unsigned threads) {
    return {size, normal_map_bytes(measure::box_means(truth, size, threads, measure::PixelMeans::Smooth)),
            BitmapPicture::Filter::Bilinear};
}

std::unique_ptr<const CurveTruth> truth_of(const Network& network) {
    return std::make_unique<const CurveTruth>(network, curve_profiles(network, std::nullopt),
                                              measure::CurveTruthOptions{});
}

class CurveSweep {
  public:
    CurveSweep(const std::vector<std::uint8_t>& bytes, const SweepOptions& options, SamplerTimer* timer,
               const ProgressSink& progress, BenchFile& out)
        : bytes_(bytes), options_(options), timer_(timer), progress_(progress), out_(out) {}

    Status run(std::vector<Diagnostic>& diagnostics) {
        auto network = load(options_.threads, diagnostics);
        if (!network) return network.error();
        network_ = std::move(network).value();
        const auto extent = make_extent(network_.width, network_.height);
        if (!extent) return extent.error();
        extent_ = extent.value(), truth_ = truth_of(network_);
        measure::CurveMeasureOptions how;
        how.threads = options_.threads;
        std::vector<GridSize> outputs;
        for (const std::uint32_t output : options_.outputs)
            outputs.push_back(grid_for(extent_, output));
        measurer_.emplace(*truth_, outputs, how);
        for (std::size_t k = 0; k < options_.sizes.size(); ++k) {
            const std::uint32_t size = options_.sizes[k];
            if (progress_)
                progress_(fmt::format("{} texels, curves", size).c_str(),
                          static_cast<double>(k) / static_cast<double>(options_.sizes.size()));
            if (const Status s = network_.curves.empty() ? nothing(size) : add_size(size); !s) return s;
        }
        return {};
    }

  private:
    Result<Network> load(unsigned threads, std::vector<Diagnostic>& diagnostics) const {
        return network_of_bytes(bytes_, CurvesCommandOptions{}.curves, options_.scene, threads, diagnostics);
    }

    [[nodiscard]] BenchPoint point(const char* method, std::uint32_t size) const {
        BenchPoint out;
        out.file = out_.path, out.method = method, out.size = size;
        return out;
    }

    Status nothing(std::uint32_t size) {
        for (const char* method : {kCurvesMethod, kStraightCurvesMethod, kNormalMapMethod}) {
            out_.curve_points.push_back(point(method, size));
            out_.curve_points.back().note = "not applicable: no curves";
        }
        return {};
    }

    void measure_into(const measure::Picture& picture, const fetex::FeatureCurvesTexture* texture,
                      BenchPoint& point) const {
        point.bytes = picture.gpu_bytes(), point.texels = picture.texels();
        point.texel_side = measure::texel_side(*truth_, picture);
        point.curve_errors = measurer_->measure(picture, texture);
    }

    Status add_size(std::uint32_t size) {
        FeatureCurvesOptions how;
        how.size = grid_for(extent_, size), how.threads = options_.threads;
        const auto curved = compile_feature_curves(network_, how);
        if (!curved) return curved.error();
        const fetex::FeatureCurvesTexture& texture = curved.value().texture;
        std::vector<BenchPoint> points{point(kCurvesMethod, size), point(kStraightCurvesMethod, size),
                                       point(kNormalMapMethod, size)};
        points[0].options = fmt::format("size={}", size);
        measure_into(measure::FeatureCurvesPicture(texture), &texture, points[0]);
        how.linear = true;
        const auto straight = compile_feature_curves_within(network_, how, points[0].bytes);
        if (!straight) return straight.error();
        const fetex::FeatureCurvesTexture& lines = straight.value().texture;
        measure_into(measure::FeatureCurvesPicture(lines), &lines, points[1]);
        const GridSize texels = measure::grid_of_bytes(truth_->height(), points[0].bytes, 4);
        const BitmapPicture map = normal_map(*truth_, texels, options_.threads);
        const std::function<Rgba(const Rgba&)> shown = shown_normal;
        measure_into(measure::SeenPicture(map, shown), nullptr, points[2]);
        if (options_.timing) {
            if (const Status s = time_into(points, {&texture, &lines}, map); !s) return s;
        }
        for (BenchPoint& p : points)
            out_.curve_points.push_back(std::move(p));
        return {};
    }

    /// Front end included, one thread.
    Status time_into(std::vector<BenchPoint>& points, const std::array<const fetex::FeatureCurvesTexture*, 2>& textures,
                     const BitmapPicture& map) {
        const auto with_network = [this](auto make) -> Work {
            return [this, make]() -> Status {
                std::vector<Diagnostic> heard_already;
                const auto network = load(1, heard_already);
                return network ? make(network.value()) : Status(network.error());
            };
        };
        std::vector<Work> works;
        for (std::size_t k = 0; k < textures.size(); ++k) {
            FeatureCurvesOptions how;
            how.size = {textures[k]->width, textures[k]->height}, how.linear = k == 1;
            works.push_back(with_network([how](const Network& network) -> Status {
                const auto again = compile_feature_curves(network, how);
                return again ? Status() : Status(again.error());
            }));
        }
        works.push_back(with_network([texels = map.texels()](const Network& network) -> Status {
            normal_map(*truth_of(network), texels, 1);
            return {};
        }));
        const auto times = time_works(works, options_.compile_rounds);
        if (!times) return times.error();
        for (std::size_t k = 0; k < kMethods; ++k) {
            points[k].times.emplace();
            points[k].times->compile_seconds = times.value()[k].seconds;
            points[k].times->compile_ratio = times.value()[k].ratio;
        }
        if (timer_ == nullptr) return {};
        timer_->compare_with(map);
        for (std::size_t k = 0; k < kMethods; ++k) {
            BenchTimes& t = *points[k].times;
            t.sampler = k < textures.size() ? timer_->cost(*textures[k]) : timer_->cost_of_bitmap();
            if (!t.sampler) t.why_no_sampler = timer_->why();
            if (k < textures.size()) t.area_sampler = timer_->area_cost(*textures[k]);
        }
        return {};
    }

    const std::vector<std::uint8_t>& bytes_;
    const SweepOptions& options_;
    SamplerTimer* timer_;
    const ProgressSink& progress_;
    BenchFile& out_;
    Network network_;
    Extent extent_;
    std::unique_ptr<const CurveTruth> truth_;
    std::optional<measure::CurveMeasurer> measurer_;
};

} // namespace

Status sweep_curves(const std::vector<std::uint8_t>& bytes, const SweepOptions& options, SamplerTimer* timer,
                    const ProgressSink& progress, std::vector<Diagnostic>& diagnostics, BenchFile& out) {
    return CurveSweep(bytes, options, timer, progress, out).run(diagnostics);
}

} // namespace fetexc::cli
