// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/sweep.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "cli/bench/compile_time.h"
#include "cli/bench/curve_sweep.h"
#include "cli/bilevel_budget.h"
#include "cli/compile_bilevel.h"
#include "cli/compile_curves.h"
#include "cli/io.h"
#include "compiler/error_budget.h"
#include "compiler/measure/classifier.h"
#include "compiler/measure/pictures.h"
#include "compiler/measure/sparse_bitmap.h"
#include "compiler/pinchmap/pinchmap_builder.h"
#include "compiler/silmap/silmap_builder.h"
#include "compiler/svg/svg.h"

namespace fetexc::cli {
namespace {

using measure::Alternative;

constexpr std::uint32_t kLargestBitmap = 16384; ///< texels on the longer side: what GPUs take

/// Bitmaps of one drawing, each measured once however many textures ask for their equal.
class BitmapLadder {
  public:
    /// At the last of the sizes.
    static Result<BitmapLadder> of(const measure::Truth& truth, measure::MeasureOptions options) {
        options.sizes = {options.sizes.back()};
        options.figures = measure::Figures::none();
        options.figures.misclassified = true;
        auto measurer = measure::Measurer::of(truth, options);
        if (!measurer) return measurer.error();
        return BitmapLadder(truth, std::move(measurer).value(), options.threads);
    }

    Result<measure::EqualErrorBitmap> equal_to(double ppm) {
        const auto good_enough = [&](std::uint32_t side) -> Result<bool> { return error_of(side) <= ppm; };
        const auto smallest = measure::smallest_side(kLargestBitmap, budget::kEqualErrorPrecision, good_enough);
        if (!smallest) return smallest.error();
        const std::uint32_t side = smallest.value().side;
        const GridSize size = grid_for(truth_->scene().extent, side);
        return measure::EqualErrorBitmap{smallest.value().found, size, std::uint64_t{size.width} * size.height * 4,
                                         error_of(side), smallest.value().tried};
    }

  private:
    BitmapLadder(const measure::Truth& truth, measure::Measurer measurer, unsigned threads)
        : truth_(&truth), measurer_(std::move(measurer)), threads_(threads) {}

    double error_of(std::uint32_t side) {
        if (const auto known = errors_.find(side); known != errors_.end()) return known->second;
        const measure::SparseBitmap bitmap(*truth_, grid_for(truth_->scene().extent, side), threads_);
        return errors_[side] = measurer_.measure(bitmap).front().misclassified_ppm;
    }

    const measure::Truth* truth_;
    measure::Measurer measurer_;
    unsigned threads_;
    std::map<std::uint32_t, double> errors_; ///< ppm, by the longer side
};

/// What is held against the FBT, in as many bytes.
struct Rival {
    BenchPoint point;
    std::unique_ptr<const measure::Picture> picture;      ///< null: doesn't apply to the drawing
    std::function<Status(const Scene&)> make;             ///< again, on one thread
    std::function<void(SamplerTimer&, BenchTimes&)> time; ///< its samplers; empty: the bitmap's alone
};

/// Gives the rival its texture, which picture and timer share.
template <class Texture> void show(Rival& rival, Texture made) {
    const auto texture = std::make_shared<const Texture>(std::move(made));
    rival.picture = measure::picture_of(*texture);
    rival.time = [texture](SamplerTimer& timer, BenchTimes& times) {
        times.sampler = timer.cost(*texture);
        if (!times.sampler) times.why_no_sampler = timer.why();
        times.area_sampler = timer.area_cost(*texture);
    };
}

/// The sweep of one drawing.
class Sweep {
  public:
    Sweep(std::string path, const std::vector<std::uint8_t>& bytes, const SweepOptions& options, SamplerTimer* timer,
          const ProgressSink& progress)
        : path_(std::move(path)), options_(options), timer_(timer), progress_(progress), bytes_(bytes) {}

    Result<BenchFile> run(std::vector<Diagnostic>& diagnostics);

  private:
    Status load(std::vector<Diagnostic>& diagnostics);
    Status add_size(std::uint32_t size);
    Result<BenchPoint> fbt_point(const fetex::FbtTexture& texture, std::uint32_t size);
    [[nodiscard]] BenchPoint rival_point(const char* method, std::uint32_t size, std::string note) const;
    Result<Rival> alternative(Alternative kind, std::uint64_t bytes, std::uint32_t size) const;
    Result<Rival> bilevel(std::uint32_t channels, std::uint64_t bytes, std::uint32_t size) const;
    Result<Rival> silmap(fetex::SilmapCellFormat cells, std::uint64_t bytes, std::uint32_t size) const;
    Result<Rival> pinchmap(std::uint64_t bytes, std::uint32_t size) const;
    Result<std::vector<Rival>> rivals_of(std::uint64_t bytes, std::uint32_t size) const;
    void measure_into(const measure::Picture& picture, BenchPoint& point) const;
    Status time_into(BenchPoint& fbt, std::span<Rival> rivals, const fetex::FbtTexture& texture);
    void time_samplers(BenchPoint& fbt, std::span<Rival> rivals, const fetex::FbtTexture& texture);
    [[nodiscard]] Result<Scene> load_again() const;
    [[nodiscard]] SceneOptions scene_options() const;
    [[nodiscard]] std::uint32_t largest_size() const {
        return *std::max_element(options_.sizes.begin(), options_.sizes.end());
    }
    void say(std::uint32_t size, const char* what);

    std::string path_;
    const SweepOptions& options_;
    SamplerTimer* timer_;
    const ProgressSink& progress_;
    const std::vector<std::uint8_t>& bytes_;
    Scene scene_;
    std::unique_ptr<measure::Truth> truth_;
    std::optional<measure::Measurer> measurer_;
    std::optional<BitmapLadder> ladder_;
    BenchFile out_;
    double steps_done_ = 0;
};

/// The drawing is the same at every size, and so is what can't be vector in it.
SceneOptions Sweep::scene_options() const {
    SceneOptions scene = options_.scene;
    if (scene.raster_size == 0) scene.raster_size = raster_size_for(largest_size());
    return scene;
}

Status Sweep::load(std::vector<Diagnostic>& diagnostics) {
    auto loaded = scene_of_bytes(bytes_, scene_options(), largest_size(), options_.threads, diagnostics);
    if (!loaded) return loaded.error();
    scene_ = std::move(loaded).value().scene;
    auto truth = measure::Truth::of(scene_, options_.threads);
    if (!truth) return truth.error();
    truth_ = std::move(truth).value();
    measure::MeasureOptions how;
    how.threads = options_.threads;
    for (const std::uint32_t output : options_.outputs)
        how.sizes.push_back(grid_for(scene_.extent, output));
    auto measurer = measure::Measurer::of(*truth_, how);
    if (!measurer) return measurer.error();
    measurer_.emplace(std::move(measurer).value());
    if (options_.equal_bitmap) {
        auto ladder = BitmapLadder::of(*truth_, how);
        if (!ladder) return ladder.error();
        ladder_.emplace(std::move(ladder).value());
    }
    out_.path = path_;
    out_.two_colors = measure::why_not(*truth_, Alternative::DistanceField).empty();
    return {};
}

Result<Scene> Sweep::load_again() const {
    std::vector<Diagnostic> heard_already;
    auto loaded = scene_of_bytes(bytes_, scene_options(), largest_size(), 1, heard_already);
    if (!loaded) return loaded.error();
    return std::move(loaded).value().scene;
}

void Sweep::say(std::uint32_t size, const char* what) {
    constexpr double kStepsOfASize = 4;
    if (progress_)
        progress_(fmt::format("{} texels, {}", size, what).c_str(),
                  steps_done_ / (kStepsOfASize * static_cast<double>(options_.sizes.size())));
    ++steps_done_;
}

void Sweep::measure_into(const measure::Picture& picture, BenchPoint& point) const {
    point.bytes = picture.gpu_bytes();
    point.texels = picture.texels();
    point.texel_side = measure::texel_side(*truth_, picture);
    point.errors = measurer_->measure(picture);
}

Result<BenchPoint> Sweep::fbt_point(const fetex::FbtTexture& texture, std::uint32_t size) {
    BenchPoint point;
    point.file = path_, point.method = kFbtMethod, point.size = size;
    point.options = fmt::format("size={}", size);
    measure_into(measure::FbtPicture(texture), point);
    if (!ladder_) return point;
    say(size, "bitmap of equal error");
    auto equal = ladder_->equal_to(point.errors.back().misclassified_ppm);
    if (!equal) return equal.error();
    point.equal_bitmap = std::move(equal).value();
    return point;
}

BenchPoint Sweep::rival_point(const char* method, std::uint32_t size, std::string note) const {
    BenchPoint point;
    point.file = path_, point.method = method, point.size = size, point.note = std::move(note);
    return point;
}

Result<Rival> Sweep::alternative(Alternative kind, std::uint64_t bytes, std::uint32_t size) const {
    Rival rival;
    rival.point = rival_point(measure::alternative_name(kind), size, measure::why_not(*truth_, kind));
    if (kind == Alternative::DistanceField) rival.point.options = fmt::format("range={:g}", measure::kDistanceRange);
    const GridSize texels = measure::grid_of_bytes(truth_->height(), bytes, measure::bytes_per_texel(kind));
    rival.point.texels = texels;
    if (!rival.point.note.empty()) return rival;
    auto made = measure::make_alternative(*truth_, kind, texels, options_.threads);
    if (!made) return made.error();
    rival.picture = std::move(made).value();
    rival.make = [kind, texels](const Scene& scene) -> Status {
        const auto truth = measure::Truth::of(scene, 1);
        if (!truth) return truth.error();
        const auto again = measure::make_alternative(*truth.value(), kind, texels, 1);
        return again ? Status() : Status(again.error());
    };
    return rival;
}

Result<BilevelBuild> bilevel_of(const Scene& scene, std::uint32_t channels, std::uint64_t bytes, unsigned threads) {
    const auto silhouette = silhouette_of(scene, SilhouetteRule{}, threads);
    if (!silhouette) return silhouette.error();
    BilevelOptions options;
    options.channels = channels, options.threads = threads;
    return compile_bilevel_within(silhouette.value(), options, bytes);
}

/// channels 0: whichever shows least wrong.
Result<Rival> Sweep::bilevel(std::uint32_t channels, std::uint64_t bytes, std::uint32_t size) const {
    Rival rival;
    rival.point = rival_point(channels == 1 ? kBilevelOneMethod : kBilevelMethod, size,
                              measure::why_not(*truth_, Alternative::BoxThreshold));
    rival.point.texels = measure::grid_of_bytes(truth_->height(), bytes, 1);
    if (!rival.point.note.empty()) return rival;
    auto made = bilevel_of(scene_, channels, bytes, options_.threads);
    if (!made) return made.error();
    rival.point.options = fmt::format("rule={}", rule_name(made.value().texture.rule));
    show(rival, std::move(made.value().texture));
    rival.make = [channels, bytes](const Scene& scene) -> Status {
        const auto again = bilevel_of(scene, channels, bytes, 1);
        return again ? Status() : Status(again.error());
    };
    return rival;
}

Result<Rival> Sweep::silmap(fetex::SilmapCellFormat cells, std::uint64_t bytes, std::uint32_t size) const {
    Rival rival;
    rival.point = rival_point(cells == fetex::SilmapCellFormat::Bits8 ? kSilmapMethod : kSilmapWideMethod, size, "");
    SilmapOptions options;
    options.cell_format = cells, options.threads = options_.threads;
    auto made = compile_silmap_at_chosen_size(scene_, options, bytes, 0);
    if (!made) return made.error();
    options.size = {made.value().texture.width, made.value().texture.height}, options.threads = 1;
    rival.make = [options](const Scene& scene) -> Status {
        const auto again = compile_silmap(scene, options);
        return again ? Status() : Status(again.error());
    };
    show(rival, std::move(made.value().texture));
    return rival;
}

Result<Rival> Sweep::pinchmap(std::uint64_t bytes, std::uint32_t size) const {
    Rival rival;
    rival.point = rival_point(kPinchmapMethod, size, "");
    PinchmapOptions options;
    options.threads = options_.threads;
    auto made = compile_pinchmap_at_chosen_size(scene_, options, bytes, 0);
    if (!made) return made.error();
    options.size = {made.value().texture.width, made.value().texture.height}, options.threads = 1;
    rival.make = [options](const Scene& scene) -> Status {
        const auto again = compile_pinchmap(scene, options);
        return again ? Status() : Status(again.error());
    };
    show(rival, std::move(made.value().texture));
    return rival;
}

/// The bitmap first.
Result<std::vector<Rival>> Sweep::rivals_of(std::uint64_t bytes, std::uint32_t size) const {
    std::vector<Rival> rivals;
    const auto add = [&](Result<Rival> rival) -> Status {
        if (!rival) return rival.error();
        rivals.push_back(std::move(rival).value());
        if (rivals.back().picture) measure_into(*rivals.back().picture, rivals.back().point);
        return {};
    };
    for (const Alternative kind : measure::kAlternatives) {
        if (const Status status = add(alternative(kind, bytes, size)); !status) return status.error();
    }
    for (const std::uint32_t channels : {1u, 0u}) {
        if (!options_.bilevel) break;
        if (const Status status = add(bilevel(channels, bytes, size)); !status) return status.error();
    }
    for (const auto cells : {fetex::SilmapCellFormat::Bits8, fetex::SilmapCellFormat::Bits16}) {
        if (!options_.silmap) break;
        if (const Status status = add(silmap(cells, bytes, size)); !status) return status.error();
    }
    if (!options_.pinchmap) return rivals;
    if (const Status status = add(pinchmap(bytes, size)); !status) return status.error();
    return rivals;
}

/// The FBT, then all the others, applicable or not.
Status Sweep::add_size(std::uint32_t size) {
    say(size, "compiling and measuring");
    const GridSize grid = grid_for(scene_.extent, size);
    const auto build = compile_fbt(scene_, {grid, options_.threads, {}});
    if (!build) return build.error();
    const fetex::FbtTexture& texture = build.value().texture;
    auto fbt = fbt_point(texture, size);
    if (!fbt) return fbt.error();
    say(size, "alternatives");
    auto rivals = rivals_of(fbt.value().bytes, size);
    if (!rivals) return rivals.error();
    if (options_.timing) {
        say(size, "timing");
        if (const Status status = time_into(fbt.value(), rivals.value(), texture); !status) return status;
    }
    out_.points.push_back(std::move(fbt).value());
    for (Rival& rival : rivals.value())
        out_.points.push_back(std::move(rival.point));
    return {};
}

/// Front end included, one thread: the others need the drawing too.
Status Sweep::time_into(BenchPoint& fbt, std::span<Rival> rivals, const fetex::FbtTexture& texture) {
    const GridSize grid{texture.width, texture.height};
    const auto with_scene = [this](std::function<Status(const Scene&)> make) -> Work {
        return [this, make = std::move(make)]() -> Status {
            const auto scene = load_again();
            return scene ? make(scene.value()) : Status(scene.error());
        };
    };
    std::vector<BenchPoint*> timed = {&fbt};
    std::vector<Work> works = {with_scene([grid](const Scene& scene) -> Status {
        const auto build = compile_fbt(scene, {grid, 1, {}});
        return build ? Status() : Status(build.error());
    })};
    for (Rival& rival : rivals) {
        if (!rival.picture) continue;
        timed.push_back(&rival.point);
        works.push_back(with_scene(rival.make));
    }
    const auto times = time_works(works, options_.compile_rounds);
    if (!times) return times.error();
    for (std::size_t n = 0; n < timed.size(); ++n) {
        timed[n]->times.emplace();
        timed[n]->times->compile_seconds = times.value()[n].seconds;
        timed[n]->times->compile_ratio = times.value()[n].ratio;
    }
    time_samplers(fbt, rivals, texture);
    return {};
}

/// All against the bitmap of equal bytes.
void Sweep::time_samplers(BenchPoint& fbt, std::span<Rival> rivals, const fetex::FbtTexture& texture) {
    if (timer_ == nullptr) return;
    const auto set = [&](BenchPoint& point, const std::optional<fetex::SamplerCost>& cost) {
        point.times->sampler = cost;
        if (!cost) point.times->why_no_sampler = timer_->why();
    };
    const auto& bitmap = dynamic_cast<const measure::BitmapPicture&>(*rivals.front().picture);
    timer_->compare_with(bitmap);
    set(fbt, timer_->cost(texture));
    fbt.times->area_sampler = timer_->area_cost(texture);
    set(rivals.front().point, timer_->cost_of_bitmap());
    for (Rival& rival : rivals) {
        if (const auto* field = dynamic_cast<const measure::FieldPicture*>(rival.picture.get()))
            set(rival.point, timer_->cost(*field));
        if (rival.time) rival.time(*timer_, *rival.point.times);
    }
}

Result<BenchFile> Sweep::run(std::vector<Diagnostic>& diagnostics) {
    if (const Status status = load(diagnostics); !status) return status.error();
    for (const std::uint32_t size : options_.sizes) {
        if (const Status status = add_size(size); !status) return status.error();
    }
    return std::move(out_);
}

} // namespace

Result<BenchFile> sweep_file(const std::string& path, const SweepOptions& options, SamplerTimer* timer,
                             const ProgressSink& progress, std::vector<Diagnostic>& diagnostics) {
    assert(!options.sizes.empty() && !options.outputs.empty());
    const auto bytes = read_input(path, SvgLimits{}.bytes);
    if (!bytes) return bytes.error();
    BenchFile out;
    const bool only_curves = is_network(bytes.value()) || !options.fbt;
    if (!only_curves) {
        auto swept = Sweep(path, bytes.value(), options, timer, progress).run(diagnostics);
        if (!swept) return swept;
        out = std::move(swept).value();
    }
    out.path = path;
    if (!only_curves && !options.curves) return out;
    std::vector<Diagnostic> said; // of a drawing: heard already
    const Status status = sweep_curves(bytes.value(), options, timer, progress, only_curves ? diagnostics : said, out);
    if (!status) return status.error();
    return out;
}

} // namespace fetexc::cli
