// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/sampler_timer.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kSide = 256; ///< pixels drawn

std::vector<fetex::Backend> backends_for(const std::string& name) {
    if (name == "egl") return {fetex::Backend::EglDevice, fetex::Backend::EglSurfaceless};
    return {name == "glfw" ? fetex::Backend::Glfw : fetex::Backend::OSMesa};
}

} // namespace

SamplerTimer::SamplerTimer(const std::string& backend, std::uint32_t rounds) {
    options_.side = kSide, options_.rounds = rounds;
    for (const fetex::Backend b : backends_for(backend)) {
        auto opened = fetex::open_for_timing(b);
        if (opened) {
            gl_ = std::move(opened.value());
            return;
        }
        if (why_.empty()) why_ = "no GL: " + opened.error().message;
    }
}

std::optional<fetex::SamplerCost> SamplerTimer::timed(const fetex::RuntimeStatus& uploaded, fetex::Sampler sampler) {
    if (uploaded || !no_bitmap_.empty()) {
        why_ = uploaded ? uploaded->message : no_bitmap_;
        return std::nullopt;
    }
    const auto cost = fetex::sampler_cost(*gl_, sampler, options_);
    if (cost) return cost.value();
    why_ = cost.error().message;
    return std::nullopt;
}

void SamplerTimer::compare_with(const measure::BitmapPicture& bitmap) {
    if (!gl_) return;
    const GridSize n = bitmap.texels();
    const auto failed = gl_->upload_bitmap(bitmap.rgba(), n.width, n.height);
    no_bitmap_ = failed ? failed->message : std::string();
}

std::optional<fetex::SamplerCost> SamplerTimer::cost(const fetex::FbtTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(gl_->upload(texture), fetex::Sampler::Fbt);
}

std::optional<fetex::SamplerCost> SamplerTimer::area_cost(const fetex::FbtTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(gl_->upload(texture), fetex::Sampler::FbtArea);
}

fetex::RuntimeStatus SamplerTimer::upload(const fetex::BilevelTexture& texture) {
    const auto error = gl_->linear_filter_error();
    if (!error) return error.error();
    return gl_->upload_bilevel(texture, error.value() <= fetex::kGoodFilterError ? fetex::BilevelFetch::Filtered
                                                                                 : fetex::BilevelFetch::Interpolated);
}

std::optional<fetex::SamplerCost> SamplerTimer::cost(const fetex::BilevelTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(upload(texture), fetex::Sampler::Bilevel);
}

std::optional<fetex::SamplerCost> SamplerTimer::area_cost(const fetex::BilevelTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(upload(texture), fetex::Sampler::BilevelArea);
}

std::optional<fetex::SamplerCost> SamplerTimer::cost(const fetex::SilmapTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(gl_->upload_silmap(texture), fetex::Sampler::Silmap);
}

std::optional<fetex::SamplerCost> SamplerTimer::area_cost(const fetex::SilmapTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(gl_->upload_silmap(texture), fetex::Sampler::SilmapArea);
}

fetex::RuntimeStatus SamplerTimer::upload(const fetex::PinchmapTexture& texture) {
    const auto error = gl_->linear_filter_error();
    if (!error) return error.error();
    return gl_->upload_pinchmap(texture, error.value() <= fetex::kGoodFilterError ? fetex::PinchmapFetch::Filtered
                                                                                  : fetex::PinchmapFetch::Interpolated);
}

std::optional<fetex::SamplerCost> SamplerTimer::cost(const fetex::PinchmapTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(upload(texture), fetex::Sampler::Pinchmap);
}

std::optional<fetex::SamplerCost> SamplerTimer::area_cost(const fetex::PinchmapTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(upload(texture), fetex::Sampler::PinchmapArea);
}

std::optional<fetex::SamplerCost> SamplerTimer::cost(const fetex::FeatureCurvesTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(gl_->upload_feature_curves(texture), fetex::Sampler::FeatureCurves);
}

std::optional<fetex::SamplerCost> SamplerTimer::area_cost(const fetex::FeatureCurvesTexture& texture) {
    if (!gl_) return std::nullopt;
    return timed(gl_->upload_feature_curves(texture), fetex::Sampler::FeatureCurvesArea);
}

std::optional<fetex::SamplerCost> SamplerTimer::cost(const measure::FieldPicture& picture) {
    if (!gl_) return std::nullopt;
    const Rgba &below = picture.below(), &above = picture.above();
    fetex::Field field;
    field.width = picture.texels().width, field.height = picture.texels().height;
    field.values.assign(picture.values().begin(), picture.values().end());
    field.range = picture.range();
    const auto copy = [](const Rgba& c, float(&out)[4]) {
        out[0] = static_cast<float>(c.r), out[1] = static_cast<float>(c.g);
        out[2] = static_cast<float>(c.b), out[3] = static_cast<float>(c.a);
    };
    copy(below, field.below), copy(above, field.above);
    return timed(gl_->upload_field(field), fetex::Sampler::Field);
}

std::optional<fetex::SamplerCost> SamplerTimer::cost_of_bitmap() {
    if (!gl_) return std::nullopt;
    return timed({}, fetex::Sampler::Bilinear);
}

} // namespace fetexc::cli
